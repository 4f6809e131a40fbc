// The part of the mask inspector for roto shapes.
#include <array>
#include <filesystem>

#include "ui/base/icons.h"
#include "ui/mask/sections.h"
#include "ui/widgets/widgets.h"

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

}  // namespace weft::ui
