// Controls of the document's parameters, generated from the tables that also define the
// command-line flags.
#include <algorithm>
#include <cmath>

#include "ui/base/icons.h"
#include "ui/parameters/parameter_control.h"
#include "ui/parameters/parameters.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

// Range and speed of a slider; typed values may use the table's full range.
struct Shape {
    std::string_view key;
    const char* label;
    double min, max;
    int decimals;
    bool logarithmic;
    const char* unit;
};
constexpr Shape kShapes[] = {
    {"placement.scale", "Scale", 0.1, 10, 2, true, "×"},
    {"placement.rotate_deg", "Rotation", -180, 180, 1, false, "°"},
    {"form.amount", "Amount", 0, 1, 2, false, ""},
    {"synthesis.overlap_px", "Overlap", 12, 96, 0, false, "px"},
    {"synthesis.feather_px", "Feather", 0, 16, 0, false, "px"},
    {"synthesis.refine", "Refinement", 0, 8, 0, false, ""},
    {"temporal.blend", "Temporal blend (α)", 0, 1, 2, false, ""},
    {"temporal.weight", "Temporal weight (λt)", 0, 10, 2, false, ""},
    {"light.strength", "Strength", 0, 2, 2, false, ""},
    {"light.detail", "Light detail", 0, 1, 2, false, ""},
    {"light.keep_detail", "Keep plate detail", 0, 2, 2, false, ""},
    {"light.cast", "Light tint", 0, 1, 2, false, ""},
    {"light.highlights", "Keep highlights", 0, 2, 2, false, ""},
    {"light.roughness", "Roughness", 0, 1, 2, false, ""},
    {"grade.match", "Match exposure", 0, 1, 2, false, ""},
    {"grade.exposure", "Exposure", -4, 4, 2, false, "stops"},
    {"grade.temperature", "Temperature", -100, 100, 0, false, "mired"},
    {"grade.multiply", "Multiply", 0, 2, 2, false, ""},
    {"grade.contrast", "Contrast", 0, 2, 2, false, ""},
    {"grade.gamma", "Gamma", 0.2, 4, 2, true, ""},
    {"grade.saturation", "Saturation", 0, 2, 2, false, ""},
    {"grade.hue_deg", "Hue", -180, 180, 0, false, "°"},
    {"grade.offset", "Offset", -0.5, 0.5, 3, false, ""},
    {"layer.opacity", "Opacity", 0, 1, 2, false, ""},
    {"finish.grain", "Grain", 0, 2, 2, false, ""},
    {"finish.focus", "Focus", 0, 2, 2, false, ""},
    {"finish.shutter_deg", "Shutter", 0, 360, 0, false, "°"},
    {"matte.steadiness", "Stabilize edge", 0, 1, 2, false, ""},
    {"matte.choke_px", "Choke", -20, 20, 1, false, "px"},
    {"matte.feather_px", "Feather", -50, 50, 1, false, "px"},
    {"matte.blur_px", "Blur", 0, 20, 1, false, "px"},
    {"matte.smooth_px", "Smooth", 0, 10, 1, false, "px"},
    {"matte.min_island_px", "Remove islands", 0, 2000, 0, false, "px²"},
    {"matte.min_hole_px", "Fill holes", 0, 2000, 0, false, "px²"},
    {"output.jpeg_quality", "JPEG quality", 1, 100, 0, false, ""},
    {"plate.fps", "Frame rate", 0, 120, 3, false, "fps"},
};

// Labels of choices; names in files are not affected.
struct Word {
    std::string_view key, name;
    const char* shown;
};
constexpr Word kWords[] = {
    {"synthesis.seam", "graphcut", "Graph cut"},
    {"synthesis.seam", "dp", "Dynamic programming"},
    {"synthesis.seam", "none", "None (blocks)"},
    {"synthesis.seam_cost", "gradient", "Gradient"},
    {"synthesis.seam_cost", "paper", "Paper (eq. 2, 3)"},
    {"temporal.mode", "locked", "Locked to the surface"},
    {"temporal.mode", "paper", "Temporal blend (paper)"},
    {"temporal.mode", "none", "Synthesize every frame"},
    {"temporal.surface", "found", "Found from the clip"},
    {"temporal.surface", "plane", "Rigid plane"},
    {"temporal.surface", "rigid", "Rigid"},
    {"temporal.surface", "cloth", "Cloth"},
    {"temporal.surface", "body", "Body"},
    {"light.source", "plate", "From the plate"},
    {"light.source", "none", "No light"},
    {"light.source", "painted", "Painted lamps"},
    {"light.source", "image", "From a picture"},
    {"light.form", "gain", "Multiply"},
    {"light.form", "detail", "Match plate exposure"},
    {"light.form", "literal", "Plate shading only"},
    {"layer.blend", "normal", "Normal"},
    {"layer.blend", "multiply", "Multiply"},
    {"layer.blend", "screen", "Screen"},
    {"layer.blend", "overlay", "Overlay"},
    {"layer.blend", "soft-light", "Soft light"},
    {"layer.blend", "color", "Color"},
    {"form.source", "auto", "Auto"},
    {"form.source", "pass", "Pass"},
    {"form.source", "depth", "Depth"},
    {"form.source", "shape", "Shape"},
    {"form.source", "flat", "Flat"},
    {"texture.mode", "auto", "Auto"},
    {"texture.mode", "synthesize", "Synthesize"},
    {"texture.mode", "tile", "Tile"},
    {"texture.mode", "stretch", "Stretch"},
    {"texture.mode", "mirror", "Mirror"},
    {"texture.wrap", "repeat", "Repeat"},
    {"texture.wrap", "mirror", "Mirror"},
    {"texture.wrap", "clamp", "Clamp"},
    {"motion.direction", "forward", "To the next frame"},
    {"motion.direction", "backward", "To the previous frame"},
    {"output.depth", "auto", "Same as plate"},
    {"output.depth", "8", "8 bit"},
    {"output.depth", "16", "16 bit"},
    {"output.depth", "half", "Half float"},
    {"output.depth", "float", "Float"},
    {"settings.quality", "draft", "Draft"},
    {"settings.quality", "final", "Final"},
};

const Shape* shape_of(std::string_view key) {
    for (const Shape& shape : kShapes)
        if (shape.key == key) return &shape;
    return nullptr;
}

std::vector<double> numbers_of(const ParameterValue& value, std::size_t count) {
    const auto* numbers = std::get_if<std::vector<double>>(&value);
    return numbers && numbers->size() == count ? *numbers : std::vector<double>(count);
}

SliderSpec tuple_spec(const ParameterInfo& info, const std::string& tip) {
    SliderSpec spec;
    spec.tip = tip.c_str();
    spec.typed_min = info.min;
    spec.typed_max = info.max;
    return spec;
}

// A slider for each number of `value`; `usual`: what a double click gives back, or empty.
template <class Emit>
void tuple_sliders(Ctx& c, const std::string& label, std::initializer_list<const char*> names,
                   SliderSpec spec, std::vector<double> value, const std::vector<double>& usual,
                   Emit&& emit) {
    std::size_t k = 0;
    for (const char* name : names) {
        const std::string row = label + name;
        spec.label = row.c_str();
        if (!usual.empty()) spec.standard = usual[k];
        const Change change = slider(c, spec, value[k++]);
        if (change != Change::kNone) emit(ParameterValue(value), change == Change::kDone);
    }
}

}  // namespace

std::string_view parameter_label(std::string_view key) {
    const Shape* shape = shape_of(key);
    return shape ? shape->label : std::string_view();
}

std::string readable_label(std::string_view key) {
    std::string out(parameter_label(key));
    if (!out.empty()) return out;
    out = key.substr(key.find_last_of('.') + 1);
    if (out.ends_with("_px")) out.resize(out.size() - 3);
    if (out.ends_with("_deg")) out.resize(out.size() - 4);
    std::replace(out.begin(), out.end(), '_', ' ');
    if (!out.empty()) out[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(out[0])));
    return out;
}

std::string parameter_name(const ParameterInfo& info, const char* given) {
    if (given) return given;
    if (const Shape* shape = shape_of(info.full_key())) return shape->label;
    std::string label(info.key);
    std::replace(label.begin(), label.end(), '_', ' ');
    if (!label.empty())
        label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(label[0])));
    return label;
}

std::string choice_label(std::string_view key, std::string_view name) {
    for (const Word& word : kWords)
        if (word.key == key && word.name == name) return word.shown;
    return std::string(name);
}

void parameter_control(Ctx& c, const ParameterInfo& info, const ParameterValue& now,
                       const char* given, const EmitValue& emit) {
    const std::string label = parameter_name(info, given), key = info.full_key(), help(info.help);
    const Shape* shape = shape_of(key);
    switch (info.kind) {
        case ParameterKind::kInteger:
        case ParameterKind::kNumber: {
            SliderSpec spec;
            spec.label = label.c_str();
            spec.tip = help.c_str();
            spec.integer = info.kind == ParameterKind::kInteger;
            const auto number = [&](const ParameterValue& v) {
                if (const auto* i = std::get_if<std::int64_t>(&v)) return static_cast<double>(*i);
                const auto* d = std::get_if<double>(&v);
                return d ? *d : 0.0;
            };
            spec.min = shape ? shape->min : std::max(info.min, -1000.0);
            spec.max = shape ? shape->max : std::min(info.max, 1000.0);
            spec.decimals = shape ? shape->decimals : 2;
            spec.logarithmic = shape && shape->logarithmic;
            spec.unit = shape ? shape->unit : "";
            spec.standard = number(info.default_value);
            spec.typed_min = info.min;
            spec.typed_max = info.max;
            double value = number(now);
            const Change change = slider(c, spec, value);
            if (change == Change::kNone) return;
            const bool done = change == Change::kDone;
            if (spec.integer)
                emit(ParameterValue(static_cast<std::int64_t>(std::llround(value))), done);
            else
                emit(ParameterValue(value), done);
            return;
        }
        case ParameterKind::kChoice: {
            std::vector<std::string> names;
            int value = -1, standard = -1;
            const auto* text = std::get_if<std::string>(&now);
            const auto* usual = std::get_if<std::string>(&info.default_value);
            for (std::size_t k = 0; k < info.choices.size(); ++k) {
                names.push_back(choice_label(key, info.choices[k]));
                if (text && *text == info.choices[k]) value = static_cast<int>(k);
                if (usual && *usual == info.choices[k]) standard = static_cast<int>(k);
            }
            if (choice(c, label.c_str(), names, value, help.c_str(), standard))
                emit(ParameterValue(std::string(info.choices[static_cast<std::size_t>(value)])),
                     true);
            return;
        }
        case ParameterKind::kFlag: {
            bool value = std::get_if<bool>(&now) && std::get<bool>(now);
            if (checkbox(c, label.c_str(), value, help.c_str())) emit(ParameterValue(value), true);
            return;
        }
        case ParameterKind::kText:
        case ParameterKind::kPath: {
            const auto* text = std::get_if<std::string>(&now);
            std::string value = text ? *text : std::string();
            if (text_row(c, label.c_str(), value, "default", help.c_str()) == Change::kDone)
                emit(ParameterValue(value), true);
            return;
        }
        case ParameterKind::kPaths: {
            // Several paths in one row, separated by semicolons.
            std::string value = format_parameter(info, now);
            std::replace(value.begin(), value.end(), '\n', ';');
            if (text_row(c, label.c_str(), value, "none", help.c_str()) != Change::kDone) return;
            std::replace(value.begin(), value.end(), ';', '\n');
            if (auto parsed = parse_parameter(info, value)) emit(*parsed, true);
            return;
        }
        case ParameterKind::kPoint: {
            SliderSpec spec = tuple_spec(info, help);
            spec.unit = "px";
            spec.min = -500;
            spec.max = 500;
            spec.decimals = 1;
            tuple_sliders(c, label, {" X", " Y"}, spec, numbers_of(now, 2), {}, emit);
            return;
        }
        case ParameterKind::kRgb: {
            SliderSpec spec = tuple_spec(info, help);
            spec.min = shape ? shape->min : info.min;
            spec.max = shape ? shape->max : info.max;
            spec.decimals = shape ? shape->decimals : 2;
            tuple_sliders(c, label, {" R", " G", " B"}, spec, numbers_of(now, 3),
                          numbers_of(info.default_value, 3), emit);
            return;
        }
        case ParameterKind::kCorners:
        case ParameterKind::kNames:
        case ParameterKind::kKeys:
        case ParameterKind::kLamps:
        case ParameterKind::kGuides:
        case ParameterKind::kWarp:
        case ParameterKind::kFrames: {
            std::string value = format_parameter(info, now);
            if (text_row(c, label.c_str(), value, "default", help.c_str()) != Change::kDone) return;
            if (auto parsed = parse_parameter(info, value)) emit(*parsed, true);
            return;
        }
    }
}

void region_parameter(Ctx& c, const Region& region, std::string_view key, const char* label) {
    const auto found = find_parameter(region_parameters(), key);
    if (!found) return;
    parameter_control(c, **found, (*found)->read(region), label,
                      [&](const ParameterValue& value, bool done) {
                          const SetRegionParameter set{{region.id, {}}, std::string(key), value};
                          if (done)
                              c.emit(DoEdit{set});
                          else
                              c.emit(TryEdit{set});
                      });
}

void space_parameter(Ctx& c, std::string_view key, const char* label, const char* usual) {
    const auto found = find_parameter(project_parameters(), key);
    if (!found) return;
    const ParameterValue now = (*found)->read(c.view.project);
    const auto* text = std::get_if<std::string>(&now);
    std::vector<std::string> values{"", "srgb", "linear", "cineon"};
    values.insert(values.end(), c.view.color_spaces.begin(), c.view.color_spaces.end());
    const std::string chosen = text ? *text : std::string();
    auto at = std::find(values.begin(), values.end(), chosen);
    if (at == values.end()) at = values.insert(values.end(), chosen);
    int value = static_cast<int>(at - values.begin());
    std::vector<std::string> names = values;
    names[0] = usual;
    const std::string help((*found)->help);
    if (choice(c, label, names, value, help.c_str(), 0))
        c.edit(SetProjectParameter{std::string(key), values[static_cast<std::size_t>(value)]});
}

void project_parameter(Ctx& c, std::string_view key, const char* label) {
    const auto found = find_parameter(project_parameters(), key);
    if (!found) return;
    parameter_control(c, **found, (*found)->read(c.view.project), label,
                      [&](const ParameterValue& value, bool done) {
                          const SetProjectParameter set{std::string(key), value};
                          if (done)
                              c.emit(DoEdit{set});
                          else
                              c.emit(TryEdit{set});
                      });
}

}  // namespace weft::ui
