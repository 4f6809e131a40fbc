#pragma once
// Interface from the panels to the window, for drawing pictures.

#include <imgui.h>

#include "app/session/session_view.h"

namespace weft {

/// Display settings; they do not affect rendered files.
struct DisplaySettings {
    float exposure = 0;  ///< Stops.
    float gamma = 1;
    enum class Channel : int { kColor, kRed, kGreen, kBlue, kLuma };
    Channel channel = Channel::kColor;
    enum class Curve : int { kSrgb, kVideo, kRaw };
    Curve curve = Curve::kSrgb;                ///< Display curve; kVideo: BT.1886.
    std::shared_ptr<const ScreenView> screen;  ///< Replaces `curve` if not null.
    bool operator==(const DisplaySettings&) const = default;
};

/// The settings with the session's current view transform.
[[nodiscard]] inline DisplaySettings on_screen(DisplaySettings display, const SessionView& view) {
    display.screen = view.screen;
    display.curve = view.screen_name.view == kScreenVideo ? DisplaySettings::Curve::kVideo
                    : view.screen_name.view == kScreenRaw ? DisplaySettings::Curve::kRaw
                                                          : DisplaySettings::Curve::kSrgb;
    return display;
}

/// A picture, or a comparison of two, to draw on screen.
struct PictureDraw {
    PicturePtr a, b;  ///< b: compared with `a`; may be null
    enum class Mode : int { kSingle, kWipe, kDifference };
    Mode mode = Mode::kSingle;
    int pane = 0;  ///< Slot on screen; it keeps the last picture until a large one is uploaded.
    ImVec2 min{0, 0}, max{0, 0};            ///< Rectangle of the whole picture, screen px.
    ImVec2 clip_min{0, 0}, clip_max{0, 0};  ///< Clip rectangle.
    float wipe = 0.5f;                      ///< Wipe position, 0–1; `a` is on the left.
    bool smooth = true;                     ///< Interpolate when magnified.
    DisplaySettings display;
};

/// A coloured matte, or a heat map, over the picture.
struct MatteDraw {
    ViewU8x1 pixels;
    std::uint64_t key = 0;      ///< Key of its texture.
    std::uint64_t version = 0;  ///< Changes with the pixels.
    Recti changed;              ///< Changed part since the previous version; empty: everything.
    ViewU8x1 where;             ///< For heat: mask of valid pixels; empty: all.
    bool heat = false;
    ImVec2 min{0, 0}, max{0, 0}, clip_min{0, 0}, clip_max{0, 0};
    ImU32 color = 0;
    float opacity = 0.4f;
    bool outline = false;  ///< Draws the edge as a line.
};

/// Draws in the order of the given draw list. Belongs to one thread.
class PictureHost {
  public:
    virtual ~PictureHost() = default;
    /// A texture for ImGui (thumbnails); null if unavailable.
    [[nodiscard]] virtual ImTextureID texture(const PicturePtr& picture) = 0;
    virtual void draw(ImDrawList& list, const PictureDraw& draw) = 0;
    virtual void draw(ImDrawList& list, const MatteDraw& draw) = 0;
    virtual void set_clipboard(const std::string& text) = 0;
    /// Shows a folder in the desktop's file manager.
    virtual void reveal(const std::string& path) = 0;
    virtual void toggle_fullscreen() = 0;
    /// Opens or closes a second window with the picture only, on another monitor if there is one.
    virtual void toggle_second_window() {}
};

}  // namespace weft
