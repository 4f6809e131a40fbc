#include <fmt/format.h>

#include <array>

#include "app/composites/composite.h"

namespace weft {
namespace {

// A string of a composition, which is written in the syntax of Lua.
std::string lua_string(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + '"';
}

using Channels = std::array<std::string, 4>;
// What Fusion itself writes for a channel that is not to be read.
constexpr const char* kNoChannel = "SomethingThatWontMatchHopefully";

Channels layer_channels(const std::string& layer) {
    if (layer.empty()) return {"R", "G", "B", kNoChannel};
    return {layer + ".R", layer + ".G", layer + ".B", kNoChannel};
}

// Tools in rows; each is a box in the flow.
class FusionTools {
  public:
    explicit FusionTools(const Composite& of) : of_(of) {}

    void load(std::string_view name, const std::string& path, bool numbered,
              const Channels& channels) {
        const int frames = of_.last - of_.first;
        std::string body = fmt::format(
            "\t\t\tClips = {{\n\t\t\t\tClip {{\n\t\t\t\t\tID = \"Clip1\",\n"
            "\t\t\t\t\tFilename = {},\n",
            lua_string("Comp:/" + path));
        if (path.ends_with(".exr")) body += "\t\t\t\t\tFormatID = \"OpenEXRFormat\",\n";
        if (numbered)
            body += fmt::format("\t\t\t\t\tStartFrame = {},\n\t\t\t\t\tLengthSetManually = true,\n",
                                of_.first);
        body += fmt::format(
            "\t\t\t\t\tTrimIn = 0,\n\t\t\t\t\tTrimOut = {},\n\t\t\t\t\tExtendFirst = 0,\n"
            "\t\t\t\t\tExtendLast = {},\n\t\t\t\t\tLoop = 0,\n\t\t\t\t\tAspectMode = 0,\n"
            "\t\t\t\t\tDepth = 4,\n\t\t\t\t\tGlobalStart = {},\n\t\t\t\t\tGlobalEnd = {},\n"
            "\t\t\t\t}},\n\t\t\t}},\n",
            numbered ? frames : 0, numbered ? 0 : frames, of_.first, of_.last);
        std::string inputs;
        if (text_.empty())
            inputs =
                fmt::format("\t\t\t\tComments = Input {{ Value = \"{}.\", }},\n", kCompositeMark);
        if (path.ends_with(".exr")) {
            inputs += "\t\t\t\t[\"Clip1.OpenEXRFormat.Channels\"] = Input { Value = 1, },\n";
            constexpr std::array<const char*, 4> kNames{"Red", "Green", "Blue", "Alpha"};
            for (std::size_t k = 0; k < kNames.size(); ++k)
                inputs += fmt::format(
                    "\t\t\t\t[\"Clip1.OpenEXRFormat.{}Name\"] = Input {{ Value = FuID {{ {} }}, "
                    "}},\n",
                    kNames[k], lua_string(channels[k]));
        }
        column_ = 0;
        tool("Loader", name, body, inputs);
    }

    // Background and foreground, channel by channel; the background's alpha stays.
    void channels(std::string_view name, int operation, std::string_view background,
                  std::string_view foreground) {
        tool("ChannelBoolean", name, {},
             fmt::format("\t\t\t\tOperation = Input {{ Value = {}, }},\n"
                         "\t\t\t\tToAlpha = Input {{ Value = 4, }},\n",
                         operation) +
                 source("Background", background) + source("Foreground", foreground));
    }

    void custom(std::string_view name, const Channels& expressions, std::string_view first,
                std::string_view second = {}) {
        std::string inputs;
        constexpr std::array<const char*, 4> kNames{"Red", "Green", "Blue", "Alpha"};
        for (std::size_t k = 0; k < kNames.size(); ++k)
            inputs += fmt::format("\t\t\t\t{}Expression = Input {{ Value = {}, }},\n", kNames[k],
                                  lua_string(expressions[k]));
        inputs += source("Image1", first);
        if (!second.empty()) inputs += source("Image2", second);
        tool("Custom", name, {}, inputs);
    }

    void join(std::string_view kind, std::string_view name, const std::string& values,
              std::string_view background, std::string_view foreground) {
        tool(kind, name, {},
             values + source("Background", background) + source("Foreground", foreground));
    }

    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    static std::string source(std::string_view input, std::string_view tool) {
        return fmt::format("\t\t\t\t{} = Input {{ SourceOp = \"{}\", Source = \"Output\", }},\n",
                           input, tool);
    }
    void tool(std::string_view kind, std::string_view name, const std::string& body,
              const std::string& inputs) {
        constexpr int kAcross = 110, kDown = 33;
        if (column_ == 0) row_ += kDown;
        text_ += fmt::format(
            "\t\t{} = {} {{\n\t\t\tNameSet = true,\n{}\t\t\tInputs = {{\n{}\t\t\t}},\n"
            "\t\t\tViewInfo = OperatorInfo {{ Pos = {{ {}, {} }} }},\n\t\t}},\n",
            name, kind, body, inputs, column_, row_);
        column_ += kAcross;
    }

    const Composite& of_;
    std::string text_;
    int column_ = 0, row_ = 0;
};

// Operations of ChannelBoolean.
constexpr int kAdd = 1, kMultiply = 6;

void load_plate(const Composite& of, FusionTools& tools) {
    tools.load("Weft_plate_file", of.plate.first, of.plate.numbered,
               layer_channels(of.plate_layer));
    const auto all = [](const char* curve) {
        Channels out{"", "", "", "a1"};
        for (std::size_t k = 0; k < 3; ++k)
            out[k] = fmt::format(fmt::runtime(curve), fmt::arg("v", fmt::format("{}1", "rgb"[k])));
        return out;
    };
    Channels curve{"r1", "g1", "b1", "a1"};
    if (of.curve == PlateCurve::kSrgb)
        curve = all("if({v}<=0.04045, {v}/12.92, (({v}+0.055)/1.055)^2.4)");
    // Codes 95 and 685 of 1023, 0.002 of density each, gamma 0.6; black becomes 0, white 1.
    else if (of.curve == PlateCurve::kCineon)
        curve =
            all("(10^((1023*{v}-685)*0.002/0.6)-10^((95-685)*0.002/0.6))/"
                "(1-10^((95-685)*0.002/0.6))");
    tools.custom("Weft_plate", curve, "Weft_plate_file");
}

// The planes through the ST-map, each where its region is on top; what the switch takes.
std::string load_planes(const Composite& of, FusionTools& tools) {
    std::string shown;
    tools.load("Weft_st", of.layers.first, of.layers.numbered, layer_channels("st"));
    if (!of.one_region)
        tools.load("Weft_id", of.layers.first, of.layers.numbered,
                   {"id.Y", "id.Y", "id.Y", "id.Y"});
    for (const CompositePlane& plane : of.planes) {
        const std::string file = fmt::format("Weft_plane_{}", plane.id);
        std::string name = fmt::format("Weft_st_map_{}", plane.id);
        tools.load(file, plane.path, false, layer_channels({}));
        tools.custom(name, {"getr2w(r1,g1)", "getg2w(r1,g1)", "getb2w(r1,g1)", "1"}, "Weft_st",
                     file);
        if (!of.one_region) {
            const auto where = [&](char c) {
                return fmt::format("if(abs(r2-{})<0.5, {}1, 0)", plane.id, c);
            };
            const std::string inside = fmt::format("Weft_region_{}", plane.id);
            tools.custom(inside, {where('r'), where('g'), where('b'), "1"}, name, "Weft_id");
            name = inside;
        }
        if (!shown.empty()) {
            const std::string sum = fmt::format("Weft_regions_{}", plane.id);
            tools.channels(sum, kAdd, shown, name);
            name = sum;
        }
        shown = name;
    }
    return shown;
}

}  // namespace

std::string fusion_composite(const Composite& of) {
    FusionTools tools(of);
    const auto layer = [&](const std::string& name, const Channels& channels) {
        tools.load("Weft_" + name + "_layer", of.layers.first, of.layers.numbered, channels);
    };
    load_plate(of, tools);
    std::string texture = "Weft_texture_layer";
    std::string through;
    if (!of.planes.empty()) through = load_planes(of, tools);
    layer("texture", layer_channels("texture"));
    if (!through.empty()) {
        // 0: as rendered, 1: the plane through the ST-map.
        tools.join("Dissolve", "Weft_texture", "\t\t\t\tMix = Input { Value = 0, },\n", texture,
                   through);
        texture = "Weft_texture";
    }
    layer("light", layer_channels("light"));
    tools.channels("Weft_light", kMultiply, texture, "Weft_light_layer");
    layer("gloss", layer_channels("gloss"));
    tools.channels("Weft_gloss", kAdd, "Weft_light", "Weft_gloss_layer");
    layer("finish", layer_channels("finish"));
    tools.channels("Weft_finish", kAdd, "Weft_gloss", "Weft_finish_layer");
    layer("matte", {"matte.A", "matte.A", "matte.A", "matte.A"});
    tools.custom("Weft_holdout", {"r1*a2", "g1*a2", "b1*a2", "a2"}, "Weft_finish",
                 "Weft_matte_layer");
    tools.join("Merge", "Weft_over", "\t\t\t\tPerformDepthMerge = Input { Value = 0, },\n",
               "Weft_plate", "Weft_holdout");
    layer("edge", layer_channels("edge"));
    tools.channels("Weft_edge", kAdd, "Weft_over", "Weft_edge_layer");
    return fmt::format(
        "Composition {{\n\tCurrentTime = {0},\n\tRenderRange = {{ {0}, {1} }},\n"
        "\tGlobalRange = {{ {0}, {1} }},\n\tCurrentID = 1,\n\tHiQ = true,\n"
        "\tTools = ordered() {{\n{2}\t}},\n"
        "\tPrefs = {{\n\t\tComp = {{\n\t\t\tFrameFormat = {{ Width = {3}, Height = {4}, Rate = "
        "{5}, "
        "AspectX = {6}, AspectY = 1, DepthFull = 4, }},\n\t\t}},\n\t}},\n}}\n",
        of.first, of.last, tools.text(), of.size.width, of.size.height, of.fps, of.pixel_aspect);
}

}  // namespace weft
