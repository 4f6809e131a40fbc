#include <fmt/format.h>

#include <algorithm>

#include "app/composites/composite.h"
#include "engine/core/short_number.h"

namespace weft {
namespace {

std::string escaped(std::string_view text, std::string_view special) {
    std::string out;
    for (const char c : text) {
        if (special.find(c) != std::string_view::npos) out += '\\';
        out += c;
    }
    return out;
}

// A script's string; and a path in a knob, of which Nuke evaluates what is in brackets.
std::string nuke_string(std::string_view text) {
    return '"' + escaped(text, "\\\"[]$") + '"';
}
std::string nuke_path(const std::string& relative) {
    return nuke_string("[value Weft_folder.folder]/" + escaped(relative, "\\[]$"));
}

// A node; `inputs` are taken from the stack, the first input from its top.
std::string nuke_node(std::string_view kind, std::string_view inputs, std::string_view name,
                      const std::string& knobs, std::string_view label = {}) {
    std::string out = fmt::format("{} {{\n", kind);
    if (!inputs.empty()) out += fmt::format(" inputs {}\n", inputs);
    out += knobs + fmt::format(" name {}\n", name);
    if (!label.empty()) out += fmt::format(" label {}\n", nuke_string(label));
    return out + "}\n";
}

std::string nuke_keep(std::string_view variable) {
    return fmt::format("set {} [stack 0]\n", variable);
}
std::string nuke_push(std::string_view variable) {
    return fmt::format("push ${}\n", variable);
}

std::string nuke_read(const std::string& path, std::string_view name, int first, int last) {
    return nuke_node("Read", "0", name,
                     fmt::format(" file {}\n first {}\n last {}\n origfirst {}\n origlast {}\n"
                                 " raw true\n",
                                 nuke_path(path), first, last, first, last));
}

std::string nuke_read(const CompositePictures& pictures, std::string_view name,
                      const Composite& of) {
    if (pictures.numbered) return nuke_read(pictures.pattern, name, of.first, of.last);
    return nuke_read(pictures.first, name, 1, 1);
}

// A layer's colours, from what is on top.
std::string nuke_colours(const std::string& layer, std::string_view name) {
    return nuke_node("Shuffle", "", name, fmt::format(" in {}\n alpha black\n", layer));
}

std::string nuke_merge(std::string_view operation, std::string_view name, std::string_view label) {
    return nuke_node("Merge2", "2", name, fmt::format(" operation {}\n output rgb\n", operation),
                     label);
}

std::string nuke_heading(const Composite& of) {
    const std::string format = fmt::format("{0} {1} 0 0 {0} {1} {2} weft", of.size.width,
                                           of.size.height, short_number(of.pixel_aspect, 6));
    return fmt::format("# {}.\nversion 12.0 v1\n", kCompositeMark) +
           nuke_node(
               "Root", "0", "weft",
               fmt::format(" format {}\n first_frame {}\n last_frame {}\n frame {}\n fps {}\n",
                           nuke_string(format), of.first, of.last, of.first,
                           short_number(of.fps, 6))) +
           nuke_node("NoOp", "0", "Weft_folder",
                     " addUserKnob {20 Weft}\n addUserKnob {2 folder l \"Folder of the files\"}\n"
                     " folder \"\\[python \\{nuke.script_directory()\\}\\]\"\n",
                     "Inserted into another script: set the folder");
}

std::string nuke_plate(const Composite& of) {
    std::string out = nuke_read(of.plate, "Weft_plate_file", of);
    if (!of.plate_layer.empty()) {
        std::string layer = of.plate_layer;  // Nuke has no dots in names of layers
        std::replace(layer.begin(), layer.end(), '.', '_');
        out += nuke_colours(layer, "Weft_plate_layer");
    }
    if (of.curve != PlateCurve::kNone)
        out += nuke_node(
            "Colorspace", "", "Weft_plate_linear",
            fmt::format(" colorspace_in {}\n", of.curve == PlateCurve::kSrgb ? "sRGB" : "Cineon"));
    return out + nuke_node("Dot", "", "Weft_plate", "") + nuke_keep("Nplate");
}

// The planes through the ST-map, each where its region is on top.
std::string nuke_through_st(const Composite& of) {
    std::string out;
    for (std::size_t k = 0; k < of.planes.size(); ++k) {
        const CompositePlane& plane = of.planes[k];
        out += nuke_push("Nlayers") + nuke_colours("st", fmt::format("Weft_st_{}", plane.id)) +
               nuke_read(plane.path, fmt::format("Weft_plane_{}", plane.id), 1, 1) +
               nuke_node("STMap", "2", fmt::format("Weft_st_map_{}", plane.id),
                         " channels rgb\n uv rgb\n", plane.region);
        if (!of.one_region)
            out += nuke_push("Nlayers") +
                   nuke_node("Shuffle", "", fmt::format("Weft_id_{}", plane.id),
                             " in id\n green red\n blue red\n alpha red\n") +
                   nuke_node("Expression", "", fmt::format("Weft_is_{}", plane.id),
                             fmt::format(" expr0 \"fabs(r-{0})<0.5\"\n expr1 \"fabs(r-{0})<0.5\"\n"
                                         " expr2 \"fabs(r-{0})<0.5\"\n",
                                         plane.id)) +
                   nuke_merge("multiply", fmt::format("Weft_region_{}", plane.id), {});
        if (k > 0) out += nuke_merge("plus", fmt::format("Weft_regions_{}", plane.id), {});
    }
    return out;
}

}  // namespace

std::string nuke_composite(const Composite& of) {
    std::string out = nuke_heading(of) + nuke_plate(of) + nuke_read(of.layers, "Weft_layers", of) +
                      nuke_keep("Nlayers");
    out += nuke_through_st(of);
    out += nuke_push("Nlayers") + nuke_colours("texture", "Weft_as_rendered");
    if (!of.planes.empty())
        out += nuke_node("Switch", "2", "Weft_texture", " which 0\n",
                         "0: as rendered, 1: the plane through the ST-map");
    struct Step {
        const char *layer, *operation, *name, *label;
    };
    for (const Step& step : {Step{"light", "multiply", "Weft_light", "Light"},
                             {"gloss", "plus", "Weft_gloss", "Gloss"},
                             {"finish", "plus", "Weft_finish", "Grain, ink, blending"}}) {
        // The texture is the first input, so the layer goes beneath it.
        out += nuke_keep("Ntexture") + nuke_push("Nlayers") +
               nuke_colours(step.layer, fmt::format("Weft_{}_layer", step.layer)) +
               nuke_push("Ntexture") + nuke_merge(step.operation, step.name, step.label);
    }
    out += nuke_keep("Ntexture") + nuke_push("Nlayers") + nuke_push("Ntexture") +
           nuke_node("Copy", "2", "Weft_holdout", " from0 matte.alpha\n to0 rgba.alpha\n",
                     "Coverage, holdouts taken off") +
           nuke_node("Premult", "", "Weft_premultiplied", "") + nuke_push("Nplate") +
           nuke_merge("over", "Weft_over", "Over the plate");
    out += nuke_keep("Nover") + nuke_push("Nlayers") + nuke_colours("edge", "Weft_edge_layer") +
           nuke_push("Nover") +
           nuke_merge("plus", "Weft_edge", "What soft edges take away of the old surface");
    return out;
}

}  // namespace weft
