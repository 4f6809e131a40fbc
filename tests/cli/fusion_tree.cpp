// Fusion's compositions: tables in the syntax of Lua, whose tools name their sources.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/cli/node_trees.h"

namespace weft::test {
namespace {

struct LuaField;

struct LuaValue {
    std::string kind, text;  ///< The word before a table; a string, number or word.
    std::vector<LuaField> fields;

    [[nodiscard]] const LuaValue* find(const std::string& key) const;
};

struct LuaField {
    std::string name;
    LuaValue value;
};

const LuaValue* LuaValue::find(const std::string& key) const {
    const auto found = std::find_if(fields.begin(), fields.end(),
                                    [&](const LuaField& field) { return field.name == key; });
    return found == fields.end() ? nullptr : &found->value;
}

class LuaReader {
  public:
    explicit LuaReader(std::string text) : text_(std::move(text)) {}

    LuaValue value() {
        LuaValue out;
        if (peek() == '"') {
            out.text = quoted();
            return out;
        }
        if (peek() != '{') {
            out.kind = word();
            if (out.kind == "ordered") skip("()");
            if (peek() != '{') {
                out.text = out.kind;
                return out;
            }
        }
        skip("{");
        while (peek() != '}') {
            out.fields.push_back(field());
            if (peek() == ',') skip(",");
        }
        skip("}");
        return out;
    }

  private:
    LuaField field() {
        std::string key;
        const std::size_t start = at_;
        if (peek() == '[') {
            skip("[");
            key = quoted();
            skip("]");
            skip("=");
        } else if (peek() != '"' && peek() != '{') {
            key = word();
            if (peek() == '=') {
                skip("=");
            } else {
                key.clear();
                at_ = start;
            }
        }
        return {key, value()};
    }
    char peek() {
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])))
            ++at_;
        return at_ < text_.size() ? text_[at_] : '}';
    }
    void skip(const std::string& what) {
        for (const char c : what) {
            ASSERT_EQ(peek(), c) << text_.substr(at_, 40);
            ++at_;
        }
    }
    std::string word() {
        std::string out;
        for (peek(); at_ < text_.size(); ++at_) {
            const char c = text_[at_];
            if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '.' && c != '-')
                break;
            out += c;
        }
        if (out.empty()) {
            ADD_FAILURE() << "not a word: " << text_.substr(at_, 40);
            at_ = text_.size();
        }
        return out;
    }
    std::string quoted() {
        std::string out;
        skip("\"");
        for (; at_ < text_.size() && text_[at_] != '"'; ++at_) {
            if (text_[at_] == '\\') ++at_;
            out += text_[at_];
        }
        ++at_;
        return out;
    }

    std::string text_;
    std::size_t at_ = 0;
};

// The expressions of the Custom tool.
class Formula {
  public:
    Formula(std::string text, const Rgba* first, const Rgba* second)
        : text_(std::move(text)), images_{first, second} {}

    float at(int x, int y) {
        x_ = x, y_ = y, at_ = 0;
        const float out = comparison();
        EXPECT_EQ(at_, text_.size()) << text_;
        return out;
    }

  private:
    bool take(const std::string& what) {
        while (at_ < text_.size() && text_[at_] == ' ')
            ++at_;
        if (text_.compare(at_, what.size(), what) != 0) return false;
        at_ += what.size();
        return true;
    }
    float comparison() {
        const float a = sum();
        if (take("<=")) return a <= sum() ? 1.0f : 0.0f;
        if (take("<")) return a < sum() ? 1.0f : 0.0f;
        return a;
    }
    float sum() {
        float out = product();
        while (true) {
            if (take("+"))
                out += product();
            else if (take("-"))
                out -= product();
            else
                return out;
        }
    }
    float product() {
        float out = power();
        while (true) {
            if (take("*"))
                out *= power();
            else if (take("/"))
                out /= power();
            else
                return out;
        }
    }
    float power() {
        const float base = atom();
        return take("^") ? std::pow(base, atom()) : base;
    }
    float atom() {
        if (take("(")) {
            const float out = comparison();
            EXPECT_TRUE(take(")"));
            return out;
        }
        if (take("if(")) {
            const auto [condition, yes, no] = three();
            return condition != 0 ? yes : no;
        }
        if (take("abs(")) {
            const float out = std::fabs(comparison());
            EXPECT_TRUE(take(")"));
            return out;
        }
        if (take("get")) return other_pixel();
        std::size_t used = 0;
        if (std::isdigit(static_cast<unsigned char>(text_[at_]))) {
            const float out = std::stof(text_.substr(at_), &used);
            at_ += used;
            return out;
        }
        const ImageF1& channel = named();
        return channel.at(x_, y_);
    }
    std::array<float, 3> three() {
        std::array<float, 3> out{};
        for (std::size_t k = 0; k < 3; ++k) {
            out[k] = comparison();
            EXPECT_TRUE(take(k == 2 ? ")" : ","));
        }
        return out;
    }
    const ImageF1& named() {
        const std::size_t channel = std::string("rgba").find(text_[at_]);
        const std::size_t image = static_cast<std::size_t>(text_[at_ + 1] - '1');
        at_ += 2;
        EXPECT_LT(channel, 4u) << text_;
        EXPECT_LT(image, 2u) << text_;
        return (*images_.at(image)).at(channel);
    }
    // A pixel of an image at a place of 0 to 1, y upwards; w: wraps.
    float other_pixel() {
        const ImageF1& image = named();
        EXPECT_TRUE(take("w("));
        const float s = comparison();
        EXPECT_TRUE(take(","));
        const float t = comparison();
        EXPECT_TRUE(take(")"));
        return sample(image, s, t, true);
    }

    std::string text_;
    std::array<const Rgba*, 2> images_;
    std::size_t at_ = 0;
    int x_ = 0, y_ = 0;
};

class FusionFlow {
  public:
    FusionFlow(const std::string& composition, const TreeRun& run)
        : whole_(LuaReader(composition).value()), run_(run) {
        EXPECT_EQ(whole_.kind, "Composition");
    }

    Rgba result() { return output(tools().fields.back().name); }

  private:
    const LuaValue& tools() { return *whole_.find("Tools"); }

    static const std::string& input(const LuaValue& tool, const std::string& name,
                                    const std::string& of = "Value") {
        static const std::string kNone;
        const LuaValue* found = tool.find("Inputs")->find(name);
        const LuaValue* value = found ? found->find(of) : nullptr;
        if (value && value->kind == "FuID") return value->fields[0].value.text;
        return value ? value->text : kNone;
    }
    Rgba source(const LuaValue& tool, const std::string& name) {
        return output(input(tool, name, "SourceOp"));
    }

    Rgba output(const std::string& name) {
        const LuaValue* tool = tools().find(name);
        EXPECT_TRUE(tool) << name;
        if (!tool) return {};
        if (tool->kind == "Loader") return load(*tool);
        if (tool->kind == "Custom") return custom(*tool);
        if (tool->kind == "Dissolve")
            return source(*tool, mix(*tool) == 0 ? "Background" : "Foreground");
        if (tool->kind == "ChannelBoolean") return channels(*tool);
        EXPECT_EQ(tool->kind, "Merge");
        return merge(*tool);
    }

    int mix(const LuaValue& tool) {
        EXPECT_EQ(input(tool, "Mix"), "0");
        return run_.texture;
    }

    Rgba load(const LuaValue& tool) {
        const LuaValue& clip = tool.find("Clips")->fields[0].value;
        std::string path = clip.find("Filename")->text;
        EXPECT_EQ(path.rfind("Comp:/", 0), 0u) << path;
        path = run_.folder + path.substr(5);
        if (const LuaValue* start = clip.find("StartFrame")) {
            // Fusion takes the last number of the name.
            std::size_t end = path.find_last_of("0123456789", path.rfind('.')) + 1;
            std::size_t begin = end;
            while (std::isdigit(static_cast<unsigned char>(path[begin - 1])))
                --begin;
            EXPECT_EQ(std::stoi(path.substr(begin, end - begin)), std::stoi(start->text));
            char number[32];
            std::snprintf(number, sizeof number, "%0*d", static_cast<int>(end - begin), run_.frame);
            path.replace(begin, end - begin, number);
        }
        if (!path.ends_with(".exr")) return read_rgba(path);
        Rgba out;
        const std::array<const char*, 4> names{"Red", "Green", "Blue", "Alpha"};
        for (std::size_t c = 0; c < 4; ++c) {
            const std::string channel =
                input(tool, std::string("Clip1.OpenEXRFormat.") + names[c] + "Name");
            if (channel == "SomethingThatWontMatchHopefully")
                out[c] = ImageF1(out[0].size(), 1.0f);
            else
                out[c] = exr_channel(path, channel);
        }
        return out;
    }

    Rgba custom(const LuaValue& tool) {
        const Rgba first = source(tool, "Image1");
        const bool two = !input(tool, "Image2", "SourceOp").empty();
        const Rgba second = two ? source(tool, "Image2") : Rgba();
        Rgba out = first;
        const std::array<const char*, 4> names{"Red", "Green", "Blue", "Alpha"};
        for (std::size_t c = 0; c < 4; ++c) {
            Formula formula(input(tool, std::string(names[c]) + "Expression"), &first, &second);
            for (int y = 0; y < out[c].height(); ++y)
                for (int x = 0; x < out[c].width(); ++x)
                    out[c].at(x, y) = formula.at(x, y);
        }
        return out;
    }

    template <class F>
    static Rgba joined(Rgba background, const Rgba& foreground, const F& join) {
        for (std::size_t c = 0; c < 3; ++c)
            for (int y = 0; y < background[c].height(); ++y)
                for (int x = 0; x < background[c].width(); ++x)
                    background[c].at(x, y) = join(background[c].at(x, y), foreground[c].at(x, y),
                                                  foreground[3].at(x, y));
        return background;
    }

    Rgba channels(const LuaValue& tool) {
        EXPECT_EQ(input(tool, "ToAlpha"), "4") << "the background's alpha stays";
        const std::string operation = input(tool, "Operation");
        EXPECT_TRUE(operation == "1" || operation == "6") << "add or multiply";
        return joined(source(tool, "Background"), source(tool, "Foreground"),
                      [&](float b, float f, float) { return operation == "6" ? b * f : b + f; });
    }

    Rgba merge(const LuaValue& tool) {
        return joined(source(tool, "Background"), source(tool, "Foreground"),
                      [](float b, float f, float alpha) { return f + b * (1 - alpha); });
    }

    LuaValue whole_;
    TreeRun run_;
};

}  // namespace

Rgba evaluate_fusion(const std::string& composition, const TreeRun& run) {
    return FusionFlow(composition, run).result();
}

}  // namespace weft::test
