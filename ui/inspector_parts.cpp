// Parts of the inspector: shapes, corrections, lamps and credits.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace weft::ui {

namespace {

// What the choice offers: mattes propagated along the surface, or drawn from the shape.
constexpr std::array<ShapeFollow, 4> kFollows{ShapeFollow::kNone, ShapeFollow::kPosition,
                                              ShapeFollow::kSimilarity, ShapeFollow::kPlanar};

void follow_controls(Ctx& c) {
    const KeyedShape shape = c.view.painted_source().shape;
    int now = 0;
    for (std::size_t k = 0; k < kFollows.size(); ++k)
        if (!shape.empty() && shape.follow == kFollows[k]) now = static_cast<int>(k) + 1;
    if (choice(c, "Follow", {"Surface", "None", "Position", "Position, rotation, scale", "Planar"},
               now,
               "What moves the shape between its keys: the matte is propagated along the surface, "
               "or the shape is drawn on every frame and moves with a track. Keys are then offsets "
               "to the track")) {
        if (now == 0)
            c.emit(DetachShape{});
        else
            c.emit(FollowShape{kFollows[static_cast<std::size_t>(now - 1)]});
    }
    if (shape.empty() || shape.follow == ShapeFollow::kNone) return;
    info_row(c, "Track", std::filesystem::path(shape.track).filename().string(),
             shape.track.c_str());
    if (button(c, "Track again",
               {.icon = icons::kMotion,
                .tip = "Takes the motion of the region's surface inside the shape again",
                .width = -1}))
        c.emit(FollowShape{shape.follow, "", true});
    if (button(c, "Track from a file…",
               {.icon = icons::kFolderImage,
                .tip = "A planar track or the track of a point: Nuke, After Effects, text or JSON",
                .width = -1})) {
        c.state.browser.purpose = BrowserState::Purpose::kShapeTrack;
        c.state.browser.just_opened = true;
    }
}

}  // namespace

void shape_controls(Ctx& c) {
    const Theme& t = c.theme;
    if (c.state.shape_drawing) {
        wrapped(c, "Click for corners, drag for curves. Enter closes the shape, Esc cancels.",
                t.quiet);
        return;
    }
    if (!c.view.shape) {
        wrapped(c, "Click on the picture to begin a shape; drag for a curve.", t.quiet);
        return;
    }
    wrapped(
        c,
        "Drag points; drag inside to move the whole shape. Ctrl sets a point's feather, Ctrl+Shift "
        "removes a point; Ctrl+Shift beside the shape begins another.",
        t.quiet);
    std::string frames;
    for (const int frame : c.view.shape_frames)
        frames += (frames.empty() ? "" : ", ") + std::to_string(frame);
    info_row(c, "Keys on frames", frames, "Frames with a shape keyframe");
    if (button(c, "Smooth corners",
               {.enabled = !c.view.matte_busy,
                .tip = "Gives every corner smooth handles",
                .width = -1}))
        c.emit(SetShape{smoothed(*c.view.shape)});
    follow_controls(c);
}

void corrections_section(Ctx& c, const Region& region) {
    const Theme& t = c.theme;
    if (!section(c, "Corrections")) return;
    const PanelName panel(c, "Corrections");
    if (button(c, "Pin texture",
               {.icon = icons::kPin,
                .look = c.state.tool == Tool::kPin ? Look::kPrimary : Look::kNormal,
                .tip = "Click to hold a place, drag to move the texture back into place; "
                       "Ctrl removes a pin",
                .command = "tool.pin",
                .width = -1}))
        c.state.tool = Tool::kPin;
    if (region.corrections.empty())
        wrapped(c,
                "Where the texture slides, pin it on that frame; frames between two "
                "corrections are interpolated.",
                t.quiet);
    for (const auto& [frame, pins] : region.corrections) {
        ImGui::PushID(frame);
        const std::string label = "Frame " + std::to_string(frame) + ", " +
                                  std::to_string(pins.size()) +
                                  (pins.size() == 1 ? " pin" : " pins");
        if (button(c, label.c_str(),
                   {.icon = icons::kPin,
                    .look = frame == c.view.frame ? Look::kNormal : Look::kQuiet}))
            c.emit(GoToFrame{frame});
        ImGui::SameLine();
        if (icon_button(c, icons::kClose, ("Unpin " + std::to_string(frame)).c_str(), false,
                        nullptr, true, t.row))
            c.edit(SetCorrection{{region.id, {}}, frame, {}});
        ImGui::PopID();
    }
    section_gap(c);
}

namespace {

void add_lamp_buttons(Ctx& c, const Region& region) {
    const Size plate = c.view.plate.size;
    const double w = plate.width, h = plate.height;
    const float third = std::floor((ImGui::GetContentRegionAvail().x - 2 * c.theme.gap) / 3);
    const auto add = [&](const char* label, const char* tip, LampKind kind,
                         std::vector<double> numbers) {
        if (!button(c, label, {.enabled = !plate.empty(), .tip = tip, .width = third})) return;
        std::vector<Lamp> lamps = region.light.lamps;
        lamps.push_back({kind, {{{0, std::move(numbers)}}}});
        c.state.lamp = static_cast<int>(lamps.size()) - 1;
        c.edit(SetRegionParameter{{region.id, {}}, "light.lamps", std::move(lamps)});
        c.state.tool = Tool::kLamp;
    };
    add("+ Point", "Point light: a bright or dark spot", LampKind::kPoint,
        {w / 2, h / 2, 0.25 * std::min(w, h), 1.5});
    ImGui::SameLine();
    add("+ Directional", "Directional light: from one side of the picture", LampKind::kDirectional,
        {135, 1.3});
    ImGui::SameLine();
    add("+ Gradient", "Gradient light: between two points", LampKind::kGradient,
        {w / 2, 0.1 * h, w / 2, 0.9 * h, 1.2, 0.8});
}

}  // namespace

void lamps_controls(Ctx& c, const Region& region) {
    add_lamp_buttons(c, region);
    const std::vector<Lamp>& lamps = region.light.lamps;
    if (lamps.empty()) {
        wrapped(c, "Add a lamp, then drag it on the picture (Shift+L).", c.theme.quiet);
        return;
    }
    c.state.lamp = std::clamp(c.state.lamp, 0, static_cast<int>(lamps.size()) - 1);
    std::vector<std::string> names;
    for (std::size_t k = 0; k < lamps.size(); ++k) {
        static constexpr const char* kNames[] = {"Point ", "Directional ", "Gradient "};
        names.push_back(kNames[static_cast<int>(lamps[k].kind)] + std::to_string(k + 1));
    }
    int chosen = c.state.lamp;
    if (choice(c, "Selected", names, chosen)) c.state.lamp = chosen;
    const auto index = static_cast<std::size_t>(c.state.lamp);
    const Lamp& lamp = lamps[index];
    const std::vector<double> here = lamp.numbers.at(c.view.frame);
    const RegionRef ref{region.id, {}};
    const auto gain = [&](const char* label, std::size_t which) {
        double value = here[which];
        const Change change = slider(c,
                                     {.label = label,
                                      .unit = "×",
                                      .tip = "1 changes nothing",
                                      .min = 0.1,
                                      .max = 4,
                                      .standard = 1,
                                      .logarithmic = true,
                                      .typed_min = 0.01,
                                      .typed_max = 100},
                                     value);
        if (change == Change::kNone) return;
        std::vector<double> numbers = here;
        numbers[which] = value;
        std::vector<Lamp> changed = lamps;
        set_numbers(changed[index], c.view.frame, std::move(numbers));
        const SetRegionParameter set{ref, "light.lamps", std::move(changed)};
        if (change == Change::kDone)
            c.edit(set);
        else
            c.emit(TryEdit{set});
    };
    if (lamp.kind == LampKind::kGradient) {
        gain("Start", 4);
        gain("End", 5);
    } else {
        gain("Brightness", here.size() - 1);
    }
    const float half = std::floor((ImGui::GetContentRegionAvail().x - c.theme.gap) / 2);
    if (button(c, "Add keyframe##lamp",
               {.icon = icons::kKeyframe,
                .tip = "Animates this lamp; later changes set a keyframe on the "
                       "current frame",
                .width = half})) {
        std::vector<Lamp> changed = lamps;
        changed[index].numbers.set(c.view.frame, here);
        c.edit(SetRegionParameter{ref, "light.lamps", std::move(changed)});
    }
    ImGui::SameLine();
    if (button(c, "Remove##lamp", {.icon = icons::kTrash, .width = half})) {
        std::vector<Lamp> changed = lamps;
        changed.erase(changed.begin() + c.state.lamp);
        c.edit(SetRegionParameter{ref, "light.lamps", std::move(changed)});
    }
}

// The source of the texture, for licences and for rendering again.
void provenance_section(Ctx& c, const Region& region) {
    if (!section(c, "Source", false)) return;
    const PanelName panel(c, "Provenance");
    const bool plane = !region.texture.plane.empty();
    const std::string& path = plane ? region.texture.plane : region.texture.sample;
    if (path.empty()) {
        wrapped(c, "No texture is chosen yet.", c.theme.quiet);
        section_gap(c);
        return;
    }
    info_row(c, plane ? "Picture" : "Sample", std::filesystem::path(path).filename().string(),
             path.c_str());
    // Library textures are named by their id.
    TextureCard card;
    card.path = library_name_of(path);
    if (!card.path.empty()) {
        const TextureCard known = c.textures.details(card);
        info_row(c, "Material", known.material.empty() ? "…" : known.material);
        info_row(c, "Author", known.author.empty() ? "not stated" : known.author);
        info_row(c, "Licence", known.licence.empty() ? "not stated" : known.licence);
        info_row(c, "Source", known.source.empty() ? "not stated" : known.source);
    } else {
        info_row(c, "Licence", "Your file", "No credits are stored with this file");
    }
    if (!plane) {
        info_row(c, "Seed", std::to_string(c.view.project.settings.seed));
        info_row(c, "Overlap", std::to_string(region.synthesis.overlap_px) + " px");
    }
    info_row(c, "Backend", c.view.backend);
    if (button(c, "Copy as text", {.icon = icons::kCopy, .width = -1}))
        c.pictures.set_clipboard(region.name + ": " + path + ", seed " +
                                 std::to_string(c.view.project.settings.seed) + ", frame " +
                                 std::to_string(c.view.frame) + " of " + c.view.plate.path);
    section_gap(c);
}

void time_section(Ctx& c, const Region& region) {
    if (!section(c, "Temporal mode")) return;
    const PanelName panel(c, "Time");
    region_parameter(c, region, "temporal.mode", "Mode");
    if (region.temporal.mode == TemporalMode::kPaper) {
        region_parameter(c, region, "temporal.blend");
        region_parameter(c, region, "temporal.weight");
    }
    section_gap(c);
}

}  // namespace weft::ui
