#pragma once
// What an artist can ask the session to do. Panels and scripts emit these; Session::act() carries
// them out. Changes of the document travel as edits, so that there is one undo history.

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "app/exchange/merge_project.h"
#include "app/preview/playback.h"
#include "app/preview/preview.h"
#include "app/project/edit.h"
#include "app/session/matte_actions.h"
#include "engine/color/screen_view.h"

namespace weft {

// ---- the document ----
/// An edit, as one step of the history.
struct DoEdit {
    Edit edit;
    bool operator==(const DoEdit&) const = default;
};
/// Several edits as one step.
struct DoEdits {
    std::vector<Edit> edits;
    std::string label;  ///< In the history.
    bool operator==(const DoEdits&) const = default;
};
/// The same while a control is being dragged: shown, but no step of the history until DoEdit.
struct TryEdit {
    Edit edit;
    bool operator==(const TryEdit&) const = default;
};
/// Several at once, likewise.
struct TryEdits {
    std::vector<Edit> edits;
    bool operator==(const TryEdits&) const = default;
};
struct Undo {
    bool operator==(const Undo&) const = default;
};
struct Redo {
    bool operator==(const Redo&) const = default;
};
struct GoToHistory {
    std::size_t position = 0;
    bool operator==(const GoToHistory&) const = default;
};
struct NewProject {
    bool operator==(const NewProject&) const = default;
};
struct OpenProject {
    std::string path;
    bool operator==(const OpenProject&) const = default;
};
struct OpenDemo {
    bool operator==(const OpenDemo&) const = default;
};
/// A folder, a pattern, a movie, a picture or a project file, as it was dropped or chosen.
struct OpenAny {
    std::string path;
    bool operator==(const OpenAny&) const = default;
};
struct Save {
    bool operator==(const Save&) const = default;
};
struct SaveAs {
    std::string path;
    bool operator==(const SaveAs&) const = default;
};
/// Saves under the next free version of the name: shot.weft, shot_v002.weft, shot_v003.weft.
struct SaveVersion {
    bool operator==(const SaveVersion&) const = default;
};
/// Answers SessionView::save_question: whose values are saved; unset: nothing is.
struct AnswerSave {
    std::optional<MergeSide> wins;
    bool operator==(const AnswerSave&) const = default;
};
/// Copies the project with all of its inputs into a new folder below this one.
struct CollectProject {
    std::string folder;
    bool operator==(const CollectProject&) const = default;
};
/// Stops CollectProject and removes what it has copied.
struct CancelCollect {
    bool operator==(const CancelCollect&) const = default;
};
/// Looks for the document's missing files in a folder and its subfolders.
struct RelinkFiles {
    std::string folder;
    bool operator==(const RelinkFiles&) const = default;
};
struct CloseProject {
    bool operator==(const CloseProject&) const = default;
};
struct Recover {
    bool accept = true;
    bool operator==(const Recover&) const = default;
};

/// Answers SessionView::trust.
struct TrustFolder {
    bool trust = true;
    bool operator==(const TrustFolder&) const = default;
};

// ---- where the artist is ----
struct SelectRegion {
    RegionId region = 0;
    bool operator==(const SelectRegion&) const = default;
};
/// Only this region is shown in the preview; 0: all.
struct SoloRegion {
    RegionId region = 0;
    bool operator==(const SoloRegion&) const = default;
};
struct LockRegion {
    RegionId region = 0;
    bool locked = false;
    bool operator==(const LockRegion&) const = default;
};
struct GoToFrame {
    int frame = 0;
    bool operator==(const GoToFrame&) const = default;
};
/// By so many frames of the plate.
struct StepFrames {
    int count = 1;
    bool operator==(const StepFrames&) const = default;
};
/// To the previous (−1) or next (1) key of anything of the selected region (key_rows()).
struct StepKeyframe {
    int direction = 1;
    bool operator==(const StepKeyframe&) const = default;
};
/// 1 forwards, −1 backwards, 0 stop.
struct Play {
    int direction = 1;
    bool operator==(const Play&) const = default;
};
struct SetPlayMode {
    PlayMode mode = PlayMode::kLoop;
    bool operator==(const SetPlayMode&) const = default;
};
/// The marked range; unset ends are the shot's.
struct MarkRange {
    std::optional<int> in, out;
    bool operator==(const MarkRange&) const = default;
};

// ---- textures, preview ----
/// Scales the texture so that so many of its bricks fit on a line over the plate.
struct ScaleByLine {
    Vec2 from{0, 0}, to{0, 0};
    double count = 1;
    bool operator==(const ScaleByLine&) const = default;
};
/// To a region (0: the selected one).
struct ApplyTexture {
    std::string path;
    RegionId region = 0;
    bool operator==(const ApplyTexture&) const = default;
};
/// Textures for several regions in one step of the history.
struct ApplyTextures {
    std::vector<std::pair<RegionId, std::string>> textures;  ///< Region and path.
    bool operator==(const ApplyTextures&) const = default;
};
/// Takes the larger picture that the region's sample was cut from; the size on the plate stays.
struct UseLargerOriginal {
    RegionId region = 0;
    bool operator==(const UseLargerOriginal&) const = default;
};
/// What the strip of small results compares.
enum class StripKind : std::uint8_t {
    kNone,
    kKeyframes,
    kTextures,
    kScale,
    kLight,
    kSeams,
    kSuggested
};
/// Compares settings of the region, which can also be seen over time.
[[nodiscard]] constexpr bool compares_settings(StripKind kind) {
    return kind == StripKind::kScale || kind == StripKind::kLight || kind == StripKind::kSeams;
}
struct ShowStrip {
    StripKind kind = StripKind::kNone;
    std::vector<std::string> textures;  ///< Files or "db:ID", for kTextures and kSuggested.
    /// Each setting on several frames: a contact sheet. Where compares_settings().
    bool over_time = false;
    bool operator==(const ShowStrip&) const = default;
};
/// Goes to the card's frame, or makes its setting the region's.
struct ChooseFromStrip {
    int card = 0;
    bool operator==(const ChooseFromStrip&) const = default;
};
struct ShowOverlay {
    Overlay overlay = Overlay::kNone;
    bool operator==(const ShowOverlay&) const = default;
};
/// The pictures of the steps before the final one, too.
struct ShowStages {
    bool shown = false;
    bool operator==(const ShowStages&) const = default;
};
/// Shows one of the layers for compositing in place of the result; unset: the result.
struct ShowLayer {
    std::optional<LayerKind> layer;
    bool operator==(const ShowLayer&) const = default;
};
/// What the screen is shown through: a view of the OpenColorIO config, or with an empty display one
/// of the built-in ones, kScreenSrgb and so on.
struct ChooseScreen {
    ScreenName name;
    bool operator==(const ChooseScreen&) const = default;
};
inline constexpr const char* kScreenSrgb = "sRGB";
inline constexpr const char* kScreenVideo = "Video";  ///< BT.1886.
inline constexpr const char* kScreenRaw = "Raw";      ///< Linear light as it is.
struct SetPreviewQuality {
    Quality quality = Quality::kDraft;
    bool operator==(const SetPreviewQuality&) const = default;
};

// ---- jobs ----
struct SubmitJob {
    std::string frames;  ///< As in a frame list; empty: all.
    std::string output, movie;
    bool overwrite = false, skip_existing = false;
    std::vector<LayerKind> layers = {};  ///< As Output's.
    std::string layers_path = {};
    double estimated_s = 0;  ///< As RenderRequest's.
    bool operator==(const SubmitJob&) const = default;
};
/// kEarlier, kLater: before or after its neighbour of the jobs that wait.
enum class JobCommand : std::uint8_t {
    kCancel,
    kPause,
    kResume,
    kRetry,
    kRemove,
    kEarlier,
    kLater
};
struct CommandJob {
    int id = 0;
    JobCommand command = JobCommand::kCancel;
    bool operator==(const CommandJob&) const = default;
};
/// Writes a region's surface as one still picture, makes that its texture, and opens it in a paint
/// program; a region that shows a picture already is only opened.
struct PaintFlat {
    RegionId region = 0;
    std::string command;  ///< What starts the program.
    bool operator==(const PaintFlat&) const = default;
};
/// Ends the writing of PaintFlat.
struct StopPaintFlat {
    bool operator==(const StopPaintFlat&) const = default;
};
/// Measures the finished frames of an output against the plate, for the review.
struct MeasureResult {
    std::string pattern;
    bool operator==(const MeasureResult&) const = default;
};

using Action =
    std::variant<DoEdit, DoEdits, TryEdit, TryEdits, Undo, Redo, GoToHistory, NewProject,
                 OpenProject, OpenDemo, OpenAny, Save, SaveAs, SaveVersion, AnswerSave,
                 CollectProject, CancelCollect, RelinkFiles, CloseProject, Recover, TrustFolder,
                 SelectRegion, SoloRegion, LockRegion, GoToFrame, StepFrames, StepKeyframe, Play,
                 SetPlayMode, MarkRange, ShowOnionSkin, BeginStroke, ContinueStroke, EndStroke,
                 SelectMatteLayer, FillPolygon, FloodSelect, ScribbleSelect, TryScribble, SetShape,
                 FollowShape, DetachShape, ShowStrip, ChooseFromStrip, GrowMatte, FeatherMatte,
                 ClearMatte, KeyMatteHere, CopyKeyframe, PaintInstead, ExportMattes, FreezeMattes,
                 ScaleByLine, PauseAnalysis, ApplyTexture, ApplyTextures, UseLargerOriginal,
                 PickCryptomatte, ShowLayer, ShowOverlay, ShowStages, ChooseScreen,
                 SetPreviewQuality, SubmitJob, CommandJob, MeasureResult, PaintFlat, StopPaintFlat>;

}  // namespace weft
