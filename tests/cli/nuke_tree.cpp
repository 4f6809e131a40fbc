// Nuke's scripts: a stack machine. A node takes its inputs from the stack, the first from the top.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <sstream>
#include <vector>

#include "tests/cli/node_trees.h"

namespace weft::test {
namespace {

// Channels by their names in Nuke: "rgba.red", "light.red", "matte.alpha".
using NukeStream = std::map<std::string, ImageF1>;

struct NukeNode {
    std::string kind;
    std::map<std::string, std::string> knobs;
};

// A word in quotes, or as it stands.
std::string nuke_word(std::string text) {
    if (text.size() < 2 || text.front() != '"') return text;
    std::string out;
    for (std::size_t k = 1; k + 1 < text.size(); ++k) {
        if (text[k] == '\\') ++k;
        out += text[k];
    }
    return out;
}

std::string nuke_path(const std::string& knob, const TreeRun& run) {
    const std::string folder = "[value Weft_folder.folder]";
    EXPECT_EQ(knob.rfind(folder, 0), 0u) << knob << " depends on no folder";
    std::string out = run.folder;
    for (std::size_t k = folder.size(); k < knob.size(); ++k) {
        EXPECT_TRUE(knob[k] != '[' && knob[k] != '$') << "Nuke evaluates it: " << knob;
        if (knob[k] == '\\') ++k;
        out += knob[k];
    }
    if (out.find('%') == std::string::npos) return out;
    char text[4096];
    std::snprintf(text, sizeof text, out.c_str(), run.frame);
    return text;
}

std::string nuke_channel(const std::string& exr) {
    const std::size_t dot = exr.rfind('.');
    const std::string layer = dot == std::string::npos ? "rgba" : exr.substr(0, dot);
    const std::string name = exr.substr(dot == std::string::npos ? 0 : dot + 1);
    const std::map<std::string, std::string> known{
        {"R", "red"}, {"G", "green"}, {"B", "blue"}, {"A", "alpha"}};
    const auto at = known.find(name);
    return layer + "." + (at == known.end() ? name : at->second);
}

class NukeMachine {
  public:
    explicit NukeMachine(const TreeRun& run) : run_(run) {}

    Rgba result(const std::string& script) {
        std::istringstream lines(script);
        NukeNode node;
        for (std::string line; std::getline(lines, line);) {
            if (line.empty() || line[0] == '#' || line.rfind("version", 0) == 0) continue;
            if (line.rfind("set ", 0) == 0) {
                kept_["$" + line.substr(4, line.find(' ', 4) - 4)] = stack_.back();
            } else if (line.rfind("push ", 0) == 0) {
                stack_.push_back(kept_.at(line.substr(5)));
            } else if (line == "}") {
                evaluate(node);
            } else if (line[0] == ' ') {
                const std::size_t blank = line.find(' ', 1);
                node.knobs[line.substr(1, blank - 1)] = nuke_word(line.substr(blank + 1));
            } else {
                node = {line.substr(0, line.find(' ')), {}};
            }
        }
        Rgba out;
        for (std::size_t c = 0; c < 4; ++c)
            out[c] = stack_.back().at(kRgba[c]);
        return out;
    }

  private:
    static constexpr std::array<const char*, 4> kRgba{"rgba.red", "rgba.green", "rgba.blue",
                                                      "rgba.alpha"};

    NukeStream pop() {
        EXPECT_FALSE(stack_.empty());
        NukeStream top = std::move(stack_.back());
        stack_.pop_back();
        return top;
    }

    void evaluate(const NukeNode& node) {
        if (node.kind == "Root") return;
        const auto inputs = node.knobs.count("inputs") ? std::stoi(node.knobs.at("inputs")) : 1;
        std::vector<NukeStream> in;
        in.reserve(static_cast<std::size_t>(inputs));
        for (int k = 0; k < inputs; ++k)
            in.push_back(pop());
        using Step = NukeStream (NukeMachine::*)(const NukeNode&, std::vector<NukeStream>&) const;
        const std::map<std::string, Step> kinds{
            {"NoOp", &NukeMachine::pass},           {"Dot", &NukeMachine::pass},
            {"Read", &NukeMachine::read},           {"Colorspace", &NukeMachine::linear},
            {"Shuffle", &NukeMachine::shuffle},     {"STMap", &NukeMachine::st_map},
            {"Switch", &NukeMachine::choice},       {"Merge2", &NukeMachine::merge},
            {"Copy", &NukeMachine::copy},           {"Premult", &NukeMachine::premultiply},
            {"Expression", &NukeMachine::is_region}};
        const auto kind = kinds.find(node.kind);
        ASSERT_NE(kind, kinds.end()) << node.kind;
        stack_.push_back((this->*kind->second)(node, in));
    }

    NukeStream pass(const NukeNode&, std::vector<NukeStream>& in) const {
        return in.empty() ? NukeStream() : in[0];
    }

    NukeStream read(const NukeNode& node, std::vector<NukeStream>&) const {
        EXPECT_EQ(node.knobs.at("raw"), "true");
        const std::string path = nuke_path(node.knobs.at("file"), run_);
        NukeStream out;
        for (const std::string& name : exr_channels(path))
            out[nuke_channel(name)] = exr_channel(path, name);
        if (!out.count("rgba.alpha")) out["rgba.alpha"] = ImageF1(out.at("rgba.red").size());
        return out;
    }

    NukeStream linear(const NukeNode& node, std::vector<NukeStream>& in) const {
        EXPECT_EQ(node.knobs.at("colorspace_in"), "sRGB");
        for (std::size_t c = 0; c < 3; ++c)
            for_each(in[0].at(kRgba[c]), [](float& v, int, int) { v = linear_from_srgb(v); });
        return in[0];
    }

    NukeStream shuffle(const NukeNode& node, std::vector<NukeStream>& in) const {
        const std::string layer = node.knobs.at("in");
        NukeStream out = in[0];
        // Of a layer with one channel that is its first, "red".
        const bool one = in[0].count(layer + ".Y") > 0;
        const Size size = in[0].at("rgba.red").size();
        for (const char* to : {"red", "green", "blue", "alpha"}) {
            const std::string from = node.knobs.count(to) ? node.knobs.at(to) : to;
            ImageF1& channel = out["rgba." + std::string(to)];
            if (from == "black")
                channel = ImageF1(size);
            else
                channel = in[0].at(std::string(layer).append(".").append(one ? "Y" : from));
        }
        return out;
    }

    NukeStream st_map(const NukeNode& node, std::vector<NukeStream>& in) const {
        EXPECT_EQ(node.knobs.at("uv"), "rgb");
        const ImageF1 &s = in[1].at("rgba.red"), &t = in[1].at("rgba.green");
        NukeStream out;
        for (const char* name : kRgba) {
            out[name] = ImageF1(s.size());
            for_each(out[name], [&](float& v, int x, int y) {
                v = sample(in[0].at(name), s.at(x, y), t.at(x, y), false);
            });
        }
        return out;
    }

    NukeStream choice(const NukeNode& node, std::vector<NukeStream>& in) const {
        EXPECT_EQ(node.knobs.at("which"), "0");
        return in[static_cast<std::size_t>(run_.texture)];
    }

    // B is the first input.
    NukeStream merge(const NukeNode& node, std::vector<NukeStream>& in) const {
        EXPECT_EQ(node.knobs.at("output"), "rgb");
        const std::string& operation = node.knobs.at("operation");
        NukeStream out = in[0];
        const ImageF1& alpha = in[1].at("rgba.alpha");
        for (std::size_t c = 0; c < 3; ++c) {
            const ImageF1& a = in[1].at(kRgba[c]);
            for_each(out.at(kRgba[c]), [&](float& b, int x, int y) {
                if (operation == "multiply")
                    b *= a.at(x, y);
                else if (operation == "plus")
                    b += a.at(x, y);
                else if (operation == "over")
                    b = a.at(x, y) + b * (1 - alpha.at(x, y));
                else
                    ADD_FAILURE() << operation;
            });
        }
        return out;
    }

    NukeStream copy(const NukeNode& node, std::vector<NukeStream>& in) const {
        NukeStream out = in[0];
        out[node.knobs.at("to0")] = in[1].at(node.knobs.at("from0"));
        return out;
    }

    NukeStream premultiply(const NukeNode&, std::vector<NukeStream>& in) const {
        NukeStream out = in[0];
        for (std::size_t c = 0; c < 3; ++c)
            for_each(out.at(kRgba[c]),
                     [&](float& v, int x, int y) { v *= in[0].at("rgba.alpha").at(x, y); });
        return out;
    }

    NukeStream is_region(const NukeNode& node, std::vector<NukeStream>& in) const {
        float id = 0;
        EXPECT_EQ(std::sscanf(node.knobs.at("expr0").c_str(), "fabs(r-%f)<0.5", &id), 1);
        const ImageF1 red = in[0].at("rgba.red");
        for (std::size_t c = 0; c < 3; ++c)
            for_each(in[0].at(kRgba[c]), [&](float& v, int x, int y) {
                v = std::fabs(red.at(x, y) - id) < 0.5f ? 1.0f : 0.0f;
            });
        return in[0];
    }

    template <class F>
    static void for_each(ImageF1& image, const F& visit) {
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x)
                visit(image.at(x, y), x, y);
    }

    TreeRun run_;
    std::vector<NukeStream> stack_;
    std::map<std::string, NukeStream> kept_;
};

}  // namespace

Rgba evaluate_nuke(const std::string& script, const TreeRun& run) {
    return NukeMachine(run).result(script);
}

}  // namespace weft::test
