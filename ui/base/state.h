#pragma once
// State of the panels between frames, such as zoom and open sections. Not part of the document.

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/project/key_rows.h"
#include "app/session/action.h"
#include "app/textures/texture_shelf.h"
#include "ui/base/picture_host.h"
#include "ui/base/placement_numbers.h"

namespace weft {

enum class Workspace : std::uint8_t { kMask, kTexture, kMotion, kLight, kReview, kJobs };
inline constexpr int kWorkspaceCount = 6;
[[nodiscard]] const char* workspace_name(Workspace workspace);

enum class Tool : std::uint8_t {
    kPan,
    kBrush,
    kEraser,
    kConfirm,  ///< Says where a propagated matte is right.
    kLasso,
    kPolygon,
    kShape,
    kFlood,
    kScribble,
    kPlace,
    kWarp,  ///< Drags the points of a grid warp.
    kSimilar,
    kPin,
    kLamp,
    kMeasure,
    kForm,   ///< Draws a shape or strokes that show the surface's form.
    kKeep,   ///< Locks or regenerates patches of the texture.
    kCrypto  ///< Picks objects of a Cryptomatte.
};

/// Whether strokes of the brush are drawn with it.
[[nodiscard]] constexpr bool paints(Tool tool) {
    return tool == Tool::kBrush || tool == Tool::kEraser || tool == Tool::kConfirm;
}

enum class Compare : std::uint8_t { kResult, kPlate, kWipe, kDifference, kSideBySide, kFourUp };

struct ViewerState {
    bool fit = true;
    float zoom = 1;                        ///< Screen pixels per plate pixel, vertically.
    float aspect = 1;                      ///< Width of a plate pixel on screen over its height.
    bool squeezed = false;                 ///< Shows the plate's pixels as squares.
    std::optional<double> aspect_dragged;  ///< While the setting is being dragged.
    Vec2 center{0, 0};                     ///< Plate pixel at the centre of the view.
    Compare compare = Compare::kResult;
    float wipe = 0.5f;
    bool hold_original = false;
    bool mattes_shown = true;
    DisplaySettings display;
    std::optional<Vec2i> pixel;  ///< Plate pixel under the mouse.
    Vec3 value{0, 0, 0};
    /// Provenance of that pixel as text; empty: not requested.
    std::vector<std::string> provenance;
    bool dragging_wipe = false;
};

/// What the result is compared with.
struct CompareState {
    enum class With : std::uint8_t { kPlate, kVersion, kStored };
    With with = With::kPlate;
    std::string pattern;  ///< Of the finished render.
    PicturePtr stored;    ///< A result that was kept,
    int frame = 0;        ///< of this frame.
};

/// A smaller brush covers no pixel as a whole, so that a stroke would leave nothing.
inline constexpr float kLeastBrush_px = 1;

struct BrushState {
    Brush brush;
    int tolerance = 24;
    std::optional<Vec2> line_from;  ///< End of the last stroke; Shift draws a line from it.
    std::vector<Vec2> outline;      ///< Points of an unfinished lasso or polygon.
    bool outline_subtracts = false;
    bool painting = false, lassoing = false;
    bool resizing = false;
};

struct Scribble {
    std::vector<Vec2> line;
    bool outside = false;
    /// The step of the history that has it, once that is there; undoing it takes the line away.
    int step = 0;
    bool settled = false;
};
/// The scribbles of one frame of one region, and those of others, until their mattes are painted
/// otherwise.
struct ScribbleState {
    int frame = 0;
    RegionId region = 0;
    std::vector<Scribble> lines;
    std::string matte;  ///< What is painted there since the last of them.
    struct Kept {
        std::vector<Scribble> lines;
        std::string matte;
    };
    std::map<std::pair<RegionId, int>, Kept> kept;
    bool drawing = false;
};

/// Cached contents of the drawer, because filtering 15,000 cards takes longer than a frame.
struct DrawerCache {
    std::shared_ptr<const std::vector<TextureCard>> cards;  ///< Cards that it was made from.
    std::shared_ptr<const std::vector<std::string>>
        answered;     ///< Result of the library for the search words.
    std::string key;  ///< Key of the conditions.
    std::vector<const TextureCard*> shown;
    std::map<std::string, int> materials;
};

struct DrawerState {
    DrawerCache cache;
    std::string search;
    std::string material;  ///< Empty: all.
    bool favourites_only = false, recent_only = false;
    std::string origin, licence, look;            ///< Further filters; empty: any.
    std::shared_ptr<const TextureAnswer> answer;  ///< Result for words and filters.
    std::string collection;                       ///< Name of the shown collection; empty: none.
    std::string new_collection;
    /// Key of the rectangle or image of the last search for similar textures.
    std::string similar_key;
    int similar_frame = 0;
    std::string similar_file;    ///< The image; empty: a rectangle of `similar_frame`.
    std::string picked;          ///< Texture in the large preview.
    bool together = false;       ///< Suggests sets for all regions.
    std::vector<RegionId> kept;  ///< Regions that keep their texture in a set.
    int together_first = 0;      ///< First set shown.
};

/// A folder of textures to add.
struct AddingState {
    bool open = false;
    std::string folder, author, licence;
    int how = 0;  ///< 0: import into the library; 1: browse only.
    bool keep_originals = false;
    bool asked = false;  ///< The import was started here.
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
        kShapeTrack,
        kPlate,
        kExportMattes,
        kSimilar,
        kCollect,
        kRelink
    };
    Purpose purpose = Purpose::kNone;
    std::string folder, name, filter;
    std::string listed;       ///< The folder or file that is read: not every one that is typed.
    double typed_at_s = -1;   ///< When `folder` was typed in last.
    bool open_typed = false;  ///< Enter was pressed: opens what was typed, if it is a file.
    int selected = -1;
    bool just_opened = false;
};

struct ExportState {
    std::string frames, output, movie;
    int range = 0;  ///< 0: whole shot, 1: marked range, 2: every nth frame.
    int step = 10;
    int format = 0;
    int existing = 0;  ///< If files exist. 0: fail, 1: skip, 2: overwrite.
    bool with_movie = true;
    std::string proposed;           ///< What was proposed for `output`.
    std::vector<LayerKind> layers;  ///< Layers for compositing.
    bool layers_apart = false;      ///< Write them to separate files.
};

/// Drawing the form of the selected region, and correcting what was drawn.
struct FormToolState {
    FormGuideKind kind = FormGuideKind::kPlane;
    std::vector<FormGuide> shape, strokes;  ///< Of the region, while a handle is dragged.
    std::optional<Vec2> from;               ///< Where a drag began that draws one.
    RegionId region = 0;                    ///< Which `parallel` belongs to.
    /// The first parallel stroke, which shows a plane only with a second one.
    std::optional<FormGuide> parallel;
    /// The form on which a region's corner pin began, in words.
    std::map<RegionId, std::string> pinned_on;
};

/// The transform box of the selected region.
struct TransformState {
    enum class Drag : std::uint8_t { kNone, kMove, kScale, kRotate };
    Drag drag = Drag::kNone;
    PlacementNumbers from;           ///< When the drag began,
    Vec2 mouse{0, 0};                ///< there, on the plate.
    std::optional<Vec2> pivot;       ///< On the plate; unset: the middle of the box.
    RegionId region = 0;             ///< Which it belongs to,
    int frame = 0;                   ///< on which frame.
    std::optional<Quad<float>> box;  ///< Around the matte, along the texture's axes.
    std::uint64_t box_version = 0;   ///< RegionMatteView::version that it was made from,
    double box_angle = 0;            ///< with this rotation.
    /// Where the placement acts, as last known: a picture in progress says nothing.
    std::shared_ptr<const SurfacePlaces> places;
};

/// The box around a roto shape.
struct ShapeBoxState {
    RegionId region = 0;            ///< Which it belongs to,
    int frame = 0;                  ///< on which frame.
    std::optional<Vec2> pivot;      ///< On the plate; unset: the middle of the box.
    std::optional<RotoShape> from;  ///< The shape when the drag began,
    Vec2 start{0, 0};               ///< the handle then,
    Vec2 inside_at{0, 0};           ///< the mouse in the frame before, while it drags the inside,
    float scale = 1, radians = 0;   ///< and how far it has gone.
};

/// The keys area below the timeline.
struct KeysState {
    enum class Drag : std::uint8_t { kNone, kKeys, kBox, kPan };
    bool open = false;
    int view = 0;  ///< 0: rows of keys, 1: curves.
    float scroll_y = 0;
    RegionId region = 0;  ///< Which the selection belongs to.
    KeySet selected;
    std::optional<KeyRef> active;   ///< Of the selected keys the one pressed last,
    std::size_t active_number = 0;  ///< which of its numbers.
    std::vector<CopiedKey> copied;
    bool menu_asked = false;    ///< The menu of the right button is to be opened.
    bool focused = false;       ///< The last press of the mouse was here.
    std::set<KeyRowId> curves;  ///< Shown as curves; empty: all.
    Drag drag = Drag::kNone;
    ImVec2 from{0, 0};                                ///< Where the drag began,
    std::optional<Region> before;                     ///< what the region was,
    bool adds = false;                                ///< whether it adds to the selection,
    bool was_selected = false;                        ///< whether its key was selected;
    int by = 0;                                       ///< how far it is now, in frames
    double by_value = 0;                              ///< and in value.
    std::optional<std::pair<double, double>> frames;  ///< Visible; unset: the whole shot.
    std::optional<std::pair<double, double>> values;  ///< Visible; unset: to be fitted.
};

/// The grid warp of the selected region.
struct WarpToolState {
    RegionId region = 0;             ///< Which it belongs to.
    std::set<std::size_t> selected;  ///< Points.
    std::optional<GridWarp> before;  ///< When a drag began; set while there is one.
    std::size_t held = 0;            ///< The point that the mouse has,
    int side = -1;                   ///< or one of its handles: left, right, up, down.
    std::optional<Vec2> box_from;    ///< Where a drag began that selects, on the plate.
    /// The grid that would be laid, while the region has none.
    std::optional<GridWarp> proposed;
    int frame = 0;
    /// As TransformState::places.
    std::shared_ptr<const SurfacePlaces> places;
};

/// What the document gives way to.
struct LeaveFor {
    enum class Kind { kQuit, kNew, kDemo, kBrowse, kClose, kPath };
    Kind kind = Kind::kQuit;
    std::string path;  ///< Of kPath.
};

/// A control that a message is about: it is marked, and brought into view.
struct PointedSetting {
    std::string section, name;  ///< Empty: of any section; none.
    double until_s = 0;         ///< Of SessionView::now_s.
    bool found = false;         ///< It was drawn since.
    ImGuiID found_in = 0;       ///< The section that is opened for it; 0: none.
    std::string in_section;     ///< The one being drawn,
    ImGuiID in_section_id = 0;  ///< its id.
};

struct UiState {
    std::uint64_t document = 0;  ///< SessionView::document that the rest belongs to.
    Workspace workspace = Workspace::kMask;
    Tool tool = Tool::kBrush;
    Tool mask_tool = Tool::kBrush;  ///< That was in hand when the Mask workspace was left.
    ViewerState viewer;
    CompareState compare_with;
    BrushState brush;
    DrawerState drawer;
    BrowserState browser;
    AddingState adding;
    ExportState output;
    float inspector_w = 320, timeline_h = 112, drawer_h = 320, review_h = 240;  ///< Unscaled.
    float strip_h = 176;
    float keys_h = 168;
    KeysState keys;
    float sheet_h = 430;  ///< Height of the contact sheet.
    bool panels_hidden = false;
    bool palette_open = false, shortcuts_open = false, settings_open = false, history_open = false;
    bool shot_open = false;
    bool about_open = false;
    bool keys_taken = false;   ///< A dialog or menu in front of the picture takes the keys.
    std::string open_menu;     ///< Name of the open menu; empty: none.
    ImGuiID closed_popup = 0;  ///< Id of the pop-up that the last press of the mouse closed.
    std::string palette_text;
    int palette_at = 0;
    bool leave_asked = false;  ///< Closing was requested.
    bool leave = false;        ///< Closing is confirmed.
    bool leave_when_saved = false;
    LeaveFor leave_then;
    int tour_step = -1;  ///< −1: no tour.
    TransformState transform;
    WarpToolState warp;
    bool snap = false;  ///< What is dragged snaps to edges of the plate; Ctrl turns it around.
    std::string handle_held;          ///< Id of the handle being dragged.
    Vec2 handle_offset{0, 0};         ///< Offset from the mouse to its centre.
    std::vector<CorrectionPin> pins;  ///< Pins of this frame while one is being dragged.
    int lamp = 0;                     ///< Index of the lamp shown in the inspector.
    RotoShape shape;                  ///< Shape being drawn or edited.
    bool shape_drawing = false;
    ShapeBoxState shape_box;
    ScribbleState scribbles;
    FormToolState form;
    std::optional<Vec2> rectangle_from;
    bool keep_overlay = false;  ///< Tool::kKeep has turned on the source map overlay.
    /// Tool::kKeep: regenerate instead of lock; seams instead of patches.
    bool keep_again = false, keep_seams = false;
    std::optional<float> pen_pressure;  ///< Pen pressure, 0–1; unset: no pen is down.
    int worst_by = 0;  ///< Measure of the worst frames: flicker, seams, drift, matte, pops.
    std::optional<std::pair<Vec2, Vec2>> measured;  ///< Reference line, plate px.
    int measured_count = 4;                         ///< Repeats along the reference line.
    StripKind strip = StripKind::kKeyframes;
    std::vector<std::string> strip_textures;
    bool strip_over_time = false;  ///< Contact sheet: each setting on several frames.
    /// Returns true if the strip is shown as a contact sheet.
    [[nodiscard]] bool sheet() const { return strip_over_time && compares_settings(strip); }
    RegionId renaming = 0;
    std::string rename_text;
    std::string typing;  ///< Name of the value being typed.
    std::string typing_text;
    double drag_start = 0;  ///< Value of the dragged slider before the drag.
    double drag_value = 0;  ///< Value reached by the drag; the view may lag behind.
    bool drag_moved = false;
    std::string rebinding;           ///< Command whose shortcut is being changed.
    int open_log = 0;                ///< Job whose log is open.
    bool missing_dismissed = false;  ///< The question about missing files was answered.
    std::string region_dragged;
    PointedSetting pointed;
    std::string status;  ///< Status bar text for the item under the mouse.
    /// Path of the mouse since the last frame while the left button was down; empty if unknown,
    /// then only MousePos is available.
    std::vector<ImVec2> mouse_path;
};

/// Forgets what belongs to the document before: its output, view, drawer, and unfinished work of
/// the tools. Workspace, tool, brush and the sizes of panels stay.
void begin_document(UiState& state, std::uint64_t document);

/// Switches the workspace and selects its default tool.
void set_workspace(UiState& state, Workspace workspace);

}  // namespace weft
