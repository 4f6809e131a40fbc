#pragma once
// What the panels ask of the window: pictures on the screen. Nothing else of it is known here.

#include <imgui.h>

#include "app/session/session_view.h"

namespace weft {

/// How a picture is shown; no pixel that is written is touched by it.
struct DisplaySettings {
    float exposure = 0;  ///< Stops.
    float gamma = 1;
    enum class Channel : int { kColor, kRed, kGreen, kBlue, kLuma };
    Channel channel = Channel::kColor;
    enum class Curve : int { kSrgb, kVideo, kRaw };
    Curve curve = Curve::kSrgb;  ///< From linear light to the screen; kVideo: BT.1886.
    std::shared_ptr<const ScreenView> screen;  ///< In place of `curve`, unless it is null.
    bool operator==(const DisplaySettings&) const = default;
};

/// As the artist set it, through the screen's view that the session has ready.
[[nodiscard]] inline DisplaySettings on_screen(DisplaySettings display, const SessionView& view) {
    display.screen = view.screen;
    display.curve = view.screen_name.view == kScreenVideo ? DisplaySettings::Curve::kVideo
                    : view.screen_name.view == kScreenRaw ? DisplaySettings::Curve::kRaw
                                                          : DisplaySettings::Curve::kSrgb;
    return display;
}

/// A picture, or a comparison of two, to be drawn at a place on the screen.
struct PictureDraw {
    PicturePtr a, b;  ///< b: what `a` is compared with.
    enum class Mode : int { kSingle, kWipe, kDifference };
    Mode mode = Mode::kSingle;
    int pane =
        0;  ///< Which place of the screen; until a large picture has come, it keeps the last.
    ImVec2 min{0, 0}, max{0, 0};            ///< Where the whole picture lies, in screen pixels.
    ImVec2 clip_min{0, 0}, clip_max{0, 0};  ///< What of it may be painted.
    float wipe = 0.5f;                      ///< Left of this part of the picture is `a`.
    bool smooth = true;                     ///< Interpolate when magnified.
    DisplaySettings display;
};

/// A matte in a colour over the picture, or values as heat.
struct MatteDraw {
    ViewU8x1 pixels;
    std::uint64_t key = 0;      ///< Of the texture that holds it.
    std::uint64_t version = 0;  ///< Another number: other pixels.
    Recti changed;              ///< What differs from the version before; empty: everything.
    ViewU8x1 where;             ///< For heat: where it holds. Empty: everywhere.
    bool heat = false;
    ImVec2 min{0, 0}, max{0, 0}, clip_min{0, 0}, clip_max{0, 0};
    ImU32 color = 0;
    float opacity = 0.4f;
    bool outline = false;  ///< A line along the edge.
};

/// Draws in the order of the draw list that it is given. One thread.
class PictureHost {
  public:
    virtual ~PictureHost() = default;
    /// A texture for ImGui's own drawing (thumbnails); null when there is none to be had.
    [[nodiscard]] virtual ImTextureID texture(const PicturePtr& picture) = 0;
    virtual void draw(ImDrawList& list, const PictureDraw& draw) = 0;
    virtual void draw(ImDrawList& list, const MatteDraw& draw) = 0;
    virtual void set_clipboard(const std::string& text) = 0;
    /// Shows a folder in the desktop's file manager.
    virtual void reveal(const std::string& path) = 0;
    virtual void toggle_fullscreen() = 0;
    /// A window of its own for the picture alone, on another screen where there is one.
    virtual void toggle_second_window() {}
};

}  // namespace weft
