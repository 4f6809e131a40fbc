#pragma once
// What the panels remember from frame to frame: where one looks and what is unfolded. None of it is
// part of the document.

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/session/action.h"
#include "app/textures/texture_shelf.h"
#include "ui/picture_host.h"

namespace weft {

enum class Workspace : std::uint8_t { kMask, kTexture, kMotion, kLight, kReview, kJobs };
inline constexpr int kWorkspaceCount = 6;
[[nodiscard]] const char* workspace_name(Workspace workspace);

enum class Tool : std::uint8_t {
    kPan,
    kBrush,
    kEraser,
    kLasso,
    kPolygon,
    kShape,
    kFlood,
    kScribble,
    kPlace,
    kSimilar,
    kPin,
    kLamp,
    kMeasure,
    kKeep,   ///< Locks or regenerates patches of the texture.
    kCrypto  ///< Picks objects of a Cryptomatte.
};

enum class Compare : std::uint8_t { kResult, kPlate, kWipe, kDifference, kSideBySide, kFourUp };

struct ViewerState {
    bool fit = true;
    float zoom = 1;         ///< Screen pixels of a plate pixel.
    float aspect = 1;       ///< Width of a plate pixel over its height.
    std::string aspect_of;  ///< The plate that it was taken from; the artist may change it then.
    Vec2 center{0, 0};      ///< Plate pixel in the middle of the view.
    Compare compare = Compare::kResult;
    float wipe = 0.5f;
    bool hold_original = false;
    bool mattes_shown = true;
    DisplaySettings display;
    std::optional<Vec2i> pixel;  ///< Under the mouse.
    Vec3 value{0, 0, 0};
    std::vector<std::string> provenance;  ///< Of that pixel, as it is read out; empty: not asked.
    bool dragging_wipe = false;
};

struct BrushState {
    Brush brush;
    int tolerance = 24;
    std::optional<Vec2> line_from;  ///< Where the last stroke ended: Shift draws a line from there.
    std::vector<Vec2> outline;      ///< Of a lasso or polygon under way.
    bool painting = false, lassoing = false;
    bool resizing = false;
};

/// Lines of the scribble tool; they belong to one frame of one region.
struct ScribbleState {
    int frame = 0;
    RegionId region = 0;
    std::vector<std::vector<Vec2>> keep, drop;
    bool drawing = false, dropping = false;
};

/// What the drawer shows, kept while nothing changes: going through 15,000 cards takes longer than
/// a frame has.
struct DrawerCache {
    std::shared_ptr<const std::vector<TextureCard>> cards;  ///< That it was made from.
    std::shared_ptr<const std::vector<std::string>>
        answered;     ///< The library's answer to the words.
    std::string key;  ///< The conditions.
    std::vector<const TextureCard*> shown;
    std::map<std::string, int> materials;
};

struct DrawerState {
    DrawerCache cache;
    std::string search;
    std::string material;  ///< Empty: all.
    bool favourites_only = false, recent_only = false;
    std::string origin, licence, look;            ///< Further conditions; empty: any.
    std::shared_ptr<const TextureAnswer> answer;  ///< To words and conditions.
    std::string collection;                       ///< Name of the one that is shown; empty: none.
    std::string new_collection;
    std::string similar_key;  ///< Of the rectangle or picture that similar ones were asked for by.
    int similar_frame = 0;
    std::string similar_file;    ///< The picture; empty: a rectangle of `similar_frame`.
    std::string picked;          ///< Path of the texture in the large preview.
    bool together = false;       ///< Suggestions for all regions at once.
    std::vector<RegionId> kept;  ///< Regions whose texture stays then.
    int together_first = 0;      ///< The first one that is shown.
    bool large_shown = false, large_pending = false;  ///< The preview; it is to open in a moment.
};

/// A folder of the artist's own textures that is to be added.
struct AddingState {
    bool open = false;
    std::string folder, author, licence;
    int how = 0;  ///< 0: into the library; 1: the folder is only shown.
    bool keep_originals = false;
    bool asked = false;  ///< The import was begun here.
};

struct BrowserState {
    enum class Purpose : std::uint8_t {
        kNone,
        kOpen,
        kSaveProject,
        kTexture,
        kMatte,
        kHoldout,
        kMotion,
        kOutput,
        kTextureFolder,
        kTrack,
        kPlate,
        kExportMattes,
        kSimilar
    };
    Purpose purpose = Purpose::kNone;
    std::string folder, name, filter;
    int selected = -1;
    bool just_opened = false;
};

struct ExportState {
    std::string frames, output, movie;
    int range = 0;  ///< 0: whole shot, 1: marked range, 2: every nth.
    int step = 10;
    int format = 0;
    int existing = 0;  ///< 0: refuse, 1: skip, 2: overwrite.
    bool with_movie = true;
    bool filled = false;
    std::vector<LayerKind> layers;  ///< For compositing.
    bool layers_apart = false;      ///< Into files of their own.
};

struct UiState {
    Workspace workspace = Workspace::kMask;
    Tool tool = Tool::kBrush;
    ViewerState viewer;
    BrushState brush;
    DrawerState drawer;
    BrowserState browser;
    AddingState adding;
    ExportState output;
    float inspector_w = 320, timeline_h = 112, drawer_h = 320, review_h = 240;  ///< Unscaled.
    float strip_h = 176;
    float sheet_h = 430;  ///< Of the strip as a contact sheet.
    bool panels_hidden = false;
    bool palette_open = false, shortcuts_open = false, settings_open = false, history_open = false;
    bool shot_open = false;
    bool about_open = false;
    std::string palette_text;
    int palette_at = 0;
    bool leave_asked = false;  ///< The window was asked to close.
    bool leave = false;        ///< … and may.
    bool leave_when_saved = false;
    std::string leave_then;  ///< "": quit; else a path to open after the question.
    int tour_step = -1;      ///< −1: no tour.
    bool placing = false;    ///< The texture is being moved on the canvas.
    Placement placing_from;
    std::string placing_key;
    ParameterValue placing_value;
    std::string handle_held;          ///< Id of the handle that is being dragged.
    Vec2 handle_offset{0, 0};         ///< From the mouse to its middle.
    std::vector<CorrectionPin> pins;  ///< Of this frame, while one is being dragged.
    int lamp = 0;                     ///< The one whose numbers stand in the inspector.
    RotoShape shape;                  ///< As it is being drawn or changed.
    bool shape_drawing = false;
    ScribbleState scribbles;
    std::optional<Vec2> rectangle_from;
    bool keep_overlay = false;                    ///< Tool::kKeep has turned the pieces on.
    bool keep_again = false, keep_seams = false;  ///< What Tool::kKeep does, and to what.
    std::optional<float> pen_pressure;  ///< Of the tablet's pen, 0–1; unset: none is down.
    int worst_by = 0;                   ///< Of the report: flicker, seams, drift, matte.
    std::optional<std::pair<Vec2, Vec2>> measured;  ///< Line of the ruler, plate pixels.
    int measured_count = 4;                         ///< … and how many bricks it is long.
    StripKind strip = StripKind::kKeyframes;
    std::vector<std::string> strip_textures;
    std::set<int> calibrated_jobs;  ///< Whose time was taken into the settings.
    bool strip_over_time = false;   ///< Each setting on several frames.
    /// The strip is a contact sheet now.
    [[nodiscard]] bool sheet() const { return strip_over_time && compares_settings(strip); }
    RegionId renaming = 0;
    std::string rename_text;
    std::string typing;  ///< Name of the value that is being typed.
    std::string typing_text;
    double drag_start = 0;  ///< Value of the slider that is being dragged, before.
    double drag_value = 0;  ///< What the drag has come to; the view may lag behind.
    bool drag_moved = false;
    std::string rebinding;  ///< Command whose key is being changed.
    int open_log = 0;       ///< Job whose log is unfolded.
    std::string region_dragged;
    std::string status;  ///< What the mouse is over, for the status bar.
    /// Where the mouse went since the last frame while the left button was down; empty where that
    /// is not known, and then MousePos is all there is.
    std::vector<ImVec2> mouse_path;
};

/// Goes there, with the tool that one expects there.
void set_workspace(UiState& state, Workspace workspace);

}  // namespace weft
