#include "app/session/session.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/project/project_file.h"
#include "app/session/background.h"
#include "app/session/kept_textures.h"
#include "app/session/matte_layer.h"
#include "app/session/session_measuring.h"
#include "texture_db/library.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr double kToastSeconds = 6;

template <class... F>
struct Overloaded : F... {
    using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

}  // namespace

Session::Session(SessionOptions options, EditorSettings* settings)
    : options_(std::move(options)),
      settings_(settings ? settings : &own_settings_),
      history_(Project{}),
      preview_(options_.cache, options_.texture_library),
      recovery_((fs::path(options_.state_folder) / "recovery").string(),
                [this] { shelf_.flush(); }),
      jobs_(options_.program, (fs::path(options_.state_folder) / "jobs").string()) {
    if (options_.offer_recovery)
        recoverable_ = find_recoverable((fs::path(options_.state_folder) / "recovery").string());
    look_for_screens();
}

Session::~Session() {
    measuring_.reset();
}

void Session::act(const Action& action) {
    std::visit(
        Overloaded{
            [&](const DoEdit& a) { edit(a.edit, true); },
            [&](const TryEdit& a) { edit(a.edit, false); },
            [&](const Undo&) {
                end_stroke();
                tried_.reset();
                if (history_.undo()) {
                    document_changed();
                    recovery_.note(resolved(), path_);
                }
            },
            [&](const Redo&) {
                if (history_.redo()) {
                    document_changed();
                    recovery_.note(resolved(), path_);
                }
            },
            [&](const GoToHistory& a) {
                end_stroke();
                tried_.reset();
                if (history_.go_to(a.position)) {
                    document_changed();
                    recovery_.note(resolved(), path_);
                }
            },
            [&](const NewProject&) {
                recovery_.clear();
                start_document(Project{}, "");
            },
            [&](const OpenProject& a) { open_project(a.path); },
            [&](const OpenDemo&) { open_demo(); },
            [&](const OpenAny& a) { open_any(a.path); },
            [&](const Save&) { save(path_); },
            [&](const SaveAs& a) { save(a.path); },
            [&](const CloseProject&) {
                end_stroke();
                recovery_.clear();
                start_document(Project{}, "");
                open_ = false;
            },
            [&](const Recover& a) { recover(a.accept); },
            [&](const SelectRegion& a) {
                end_stroke();
                if (selected_ != a.region) layer_ = 0;
                selected_ = a.region;
                ++document_version_;
                request_due_ = true;
            },
            [&](const SoloRegion& a) {
                solo_ = a.region;
                request_due_ = true;
            },
            [&](const LockRegion& a) {
                if (a.locked)
                    locked_.insert(a.region);
                else
                    locked_.erase(a.region);
            },
            [&](const GoToFrame& a) {
                playing_ = 0;
                go_to(a.frame);
            },
            [&](const StepFrames& a) {
                playing_ = 0;
                if (!reader_) return;
                const int last = static_cast<int>(reader_->frames().size()) - 1;
                const int at = std::clamp(index_of(frame_) + a.count, 0, last);
                go_to(reader_->frames()[static_cast<std::size_t>(at)]);
            },
            [&](const StepKeyframe& a) { step_keyframe(a.direction); },
            [&](const Play& a) {
                end_stroke();
                playing_ = reader_ && reader_->frames().size() > 1 ? a.direction : 0;
                frame_at_s_ = fps_shown_at_s_ = now_s_;
                frames_shown_ = 0;
                request_due_ = true;
            },
            [&](const MarkRange& a) {
                mark_in_ = a.in;
                mark_out_ = a.out;
                strip_version_ = 0;  // its frames lie in the range
                if (mark_in_ && mark_out_ && *mark_in_ > *mark_out_) std::swap(mark_in_, mark_out_);
                request_due_ = true;
            },
            [&](const SelectMatteLayer& a) {
                end_stroke();
                const Region* region = painted_region();
                layer_ =
                    region ? std::clamp(a.layer, 0, static_cast<int>(region->holdouts->size()) + 1)
                           : 0;
            },
            [&](const BeginStroke& a) { begin_stroke(a); },
            [&](const ContinueStroke& a) {
                if (!painting_) return;
                painting_->changed = painting_->changed.united(
                    painting_->stroke->move_to(a.at, a.pressure, painting_->canvas));
                painting_->version = next_picture_id();
            },
            [&](const EndStroke&) { end_stroke(); },
            [&](const FillPolygon& a) {
                change_matte([a](const Matte& m) { return fill_polygon(m, a.points, a.subtract); },
                             a.subtract ? "Cut a shape" : "Fill a shape");
            },
            [&](const FloodSelect& a) {
                const PicturePtr picture = view_.plate_picture;
                if (!picture) return;
                change_matte(
                    [a, picture](const Matte& m) {
                        return flood_select(m, shrink(*picture, 1 << 20), a.at, a.tolerance,
                                            a.subtract);
                    },
                    a.subtract ? "Take away a colour" : "Select a colour");
            },
            [&](const ScribbleSelect& a) { scribble(a); },
            [&](const SetShape& a) { set_shape(a.shape); },
            [&](const FillBetweenShapes&) { fill_between_shapes(); },
            [&](const ShowStrip& a) {
                strip_kind_ = a.kind;
                strip_textures_ = a.textures;
                strip_over_time_ = a.over_time;
                strip_version_ = 0;
            },
            [&](const ChooseFromStrip& a) { choose_from_strip(a.card); },
            [&](const GrowMatte& a) {
                change_matte([a](const Matte& m) { return grow_matte(m, a.px); },
                             a.px > 0 ? "Grow the matte" : "Shrink the matte");
            },
            [&](const FeatherMatte& a) {
                change_matte([a](const Matte& m) { return feather_matte(m, a.px); },
                             "Feather the matte");
            },
            [&](const ClearMatte&) {
                change_matte([](const Matte& m) { return Matte(m.size()); }, "Clear the matte");
            },
            [&](const KeyMatteHere&) {
                change_matte([](const Matte& m) { return m; }, "Key the matte");
            },
            [&](const CopyKeyframe& a) { copy_keyframe(a.from, a.to); },
            [&](const PaintInstead&) { paint_instead(); },
            [&](const ExportMattes& a) { export_mattes(a.pattern); },
            [&](const FreezeMattes& a) { freeze_mattes(a.frozen); },
            [&](const ScaleByLine& a) { scale_by_line(a); },
            [&](const PauseAnalysis& a) { a.paused ? preview_.pause() : preview_.resume(); },
            [&](const ApplyTexture& a) { apply_texture(a.path, a.region ? a.region : selected_); },
            [&](const ApplyTextures& a) { apply_textures(a); },
            [&](const UseLargerOriginal& a) {
                use_larger_original(a.region ? a.region : selected_);
            },
            [&](const PickCryptomatte& a) { pick_cryptomatte(a); },
            [&](const ShowLayer& a) {
                layer_name_ = a.name;
                request_due_ = true;
            },
            [&](const ShowOverlay& a) {
                overlay_ = a.overlay;
                request_due_ = true;
            },
            [&](const ShowStages& a) {
                stages_ = a.shown;
                request_due_ = true;
            },
            [&](const ChooseScreen& a) { choose_screen(a.name, true); },
            [&](const SetPreviewQuality& a) {
                preview_quality_ = a.quality;
                request_due_ = true;
            },
            [&](const SubmitJob& a) { submit(a); },
            [&](const CommandJob& a) { command(a); },
            [&](const MeasureResult& a) { measure(a.pattern); },
        },
        action);
}

// ---- frames ----------------------------------------------------------------------------------

int Session::index_of(int frame) const {
    if (!reader_) return 0;
    const auto& frames = reader_->frames();
    const auto at = std::lower_bound(frames.begin(), frames.end(), frame);
    return static_cast<int>(std::min<std::ptrdiff_t>(
        at - frames.begin(), static_cast<std::ptrdiff_t>(frames.size()) - 1));
}

std::pair<int, int> Session::played_range() const {
    if (!reader_) return {0, 0};
    int first = 0, last = static_cast<int>(reader_->frames().size()) - 1;
    if (mark_in_) first = std::clamp(index_of(*mark_in_), first, last);
    if (mark_out_) last = std::clamp(index_of(*mark_out_), first, last);
    return {first, last};
}

void Session::go_to(int frame) {
    if (!reader_) return;
    const int now = reader_->frames()[static_cast<std::size_t>(index_of(frame))];
    if (now == frame_) return;
    end_stroke();
    frame_ = now;
    request_due_ = true;
}

void Session::step_keyframe(int direction) {
    const Region* region = region_by_id(document(), selected_);
    if (!region) return;
    std::set<int> stops(region->reference_frames.begin(), region->reference_frames.end());
    for (const auto& [frame, key] : layer_source(*region, layer_).keyframes)
        stops.insert(frame);
    if (direction > 0) {
        if (const auto next = stops.upper_bound(frame_); next != stops.end()) go_to(*next);
    } else {
        const auto next = stops.lower_bound(frame_);
        if (next != stops.begin()) go_to(*std::prev(next));
    }
}

void Session::advance_playback(double now_s) {
    now_s_ = now_s;
    if (playing_ == 0 || !player_) return;
    const double fps = view_.plate.fps > 0 ? view_.plate.fps : 24;
    const auto [first, last] = played_range();
    const auto& frames = reader_->frames();
    constexpr int kMostAtOnce = 4;
    for (int k = 0; k < kMostAtOnce && now_s - frame_at_s_ >= 1.0 / fps; ++k) {
        int next = index_of(frame_) + playing_;
        if (next > last || next < first) next = playing_ > 0 ? first : last;
        const int frame = frames[static_cast<std::size_t>(next)];
        // The first time round it waits for what is not decoded yet; then it runs in real time.
        const auto& states = plate_reading_.states;
        if (states.empty() ||
            states[static_cast<std::size_t>(next)] == PlatePlayer::State::kEmpty) {
            frame_at_s_ = now_s;
            break;
        }
        frame_ = frame;
        frame_at_s_ += 1.0 / fps;
        ++frames_shown_;
    }
    if (now_s - frame_at_s_ > 0.5) frame_at_s_ = now_s;
    if (now_s - fps_shown_at_s_ > 0.5) {
        view_.play_fps = frames_shown_ / (now_s - fps_shown_at_s_);
        fps_shown_at_s_ = now_s;
        frames_shown_ = 0;
    }
}

void Session::want_frames() {
    if (!player_) return;
    const auto& frames = reader_->frames();
    const auto [first, last] = played_range();
    std::vector<int> wanted{frame_};
    const int at = index_of(frame_), step = playing_ < 0 ? -1 : 1;
    const int count = std::min(last - first + 1, 2000);
    int next = at;
    for (int k = 1; k < count; ++k) {
        next += step;
        if (next > last) next = first;
        if (next < first) next = last;
        wanted.push_back(frames[static_cast<std::size_t>(next)]);
    }
    (void)player_->try_want(wanted);  // else the next frame asks again
}

// ---- the preview -----------------------------------------------------------------------------

Project Session::project_to_preview(bool& any) const {
    Project project = resolved();
    project.settings.quality = preview_quality_;
    for (Leaf<Region>& region : project.regions) {
        const bool hidden = !region->enabled || (solo_ != 0 && solo_ != region->id);
        const bool unready = region->matte->empty() ||
                             (region->texture.sample.empty() && region->texture.plane.empty());
        if (hidden || unready) {
            region = region.with([](Region& r) { r.enabled = false; });
        } else {
            any = true;
        }
    }
    return project;
}

void Session::request_preview() {
    if (!request_due_ || painting_) return;
    if (!reader_) {
        request_due_ = false;
        return;
    }
    // It reads the painted mattes from the disk.
    if (shelf_.writing()) return;
    PreviewRequest request;
    bool any = false;
    request.project = project_to_preview(any);
    if (!any) {
        request_due_ = false;
        preview_.clear();
        preview_reading_ = {};
        view_.result_wanted = false;
        return;
    }
    view_.result_wanted = true;
    const auto& frames = reader_->frames();
    request.frame = frame_;
    request.range = frames;
    request.stages = stages_;
    request.layer = layer_name_;
    request.overlay = overlay_;
    request.overlay_region = selected_;
    request.cards = strip_wishes_;
    request.hurried = playing_ != 0;
    // The marked range, or as much around the playhead as a look needs.
    constexpr int kAround = 24;
    const auto [first, last] = played_range();
    const bool marked = mark_in_ || mark_out_;
    const int at = index_of(frame_);
    const int from = marked ? first : std::max(first, at - (playing_ ? 0 : kAround / 4));
    const int to = marked ? last : std::min(last, at + kAround);
    for (int k = std::clamp(at, from, to); k <= to; ++k)
        request.fill.push_back(frames[static_cast<std::size_t>(k)]);
    for (int k = from; k < std::min(at, to); ++k)
        request.fill.push_back(frames[static_cast<std::size_t>(k)]);
    if (!preview_.try_request(request)) return;  // the next frame asks again
    request_due_ = false;
    preview_reading_.frame = {};
    preview_reading_.there.clear();
}

void Session::apply_texture(const std::string& path, RegionId region) {
    const Region* target = region_by_id(document(), region);
    if (!target) {
        notify(NoticeKind::kWarning, "Select the region that is to get this texture.");
        return;
    }
    if (names_library_texture(path)) return fetch_texture(path, region);
    TextureSource texture = target->texture;
    texture.sample = path;
    texture.plane.clear();
    edit(SetTexture{{region, {}}, texture}, true);
    auto& recent = settings_->recent_textures;
    std::erase(recent, path);
    recent.insert(recent.begin(), path);
    constexpr std::size_t kMost = 24;
    if (recent.size() > kMost) recent.resize(kMost);
}

// A texture of the library becomes a file beside the project, so that the project needs no library.
void Session::fetch_texture(const std::string& path, RegionId region) {
    const fs::path folder = path_.empty()
                                ? fs::path(options_.state_folder) / "unsaved" / "textures"
                                : fs::path(project_dir(path_)) / kept_textures_name(path_);
    fetching_.emplace();
    fetching_->region = region;
    fetching_->path =
        in_background([path, folder = texture_folder(), library = options_.texture_library,
                       excluded = licence_list(
                           document().settings.excluded_licences)]() -> Expected<std::string> {
            WEFT_TRY(texture, resolve_texture(library, path));
            WEFT_CHECK_OK(check_licences({texture.credit}, excluded));
            return keep_texture(texture, folder);
        });
}

void Session::take_texture() {
    if (!fetching_ ||
        fetching_->path.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return;
    Fetching done = std::move(*fetching_);
    fetching_.reset();
    const auto path = done.path.get();
    if (!path) {
        notify(NoticeKind::kError, path.error().text());
        return;
    }
    const std::string dir = project_dir(path_);
    apply_texture(dir.empty() ? *path : fs::path(*path).lexically_relative(dir).string(),
                  done.region);
}

// ---- notices and time ------------------------------------------------------------------------

void Session::notify(NoticeKind kind, std::string text) {
    // The same again replaces the older one.
    std::erase_if(notices_, [&](const Notice& n) { return n.text == text; });
    notices_.push_back({++last_notice_, kind, std::move(text), now_s_});
    constexpr std::size_t kMost = 5;
    if (notices_.size() > kMost) notices_.erase(notices_.begin());
}

void Session::dismiss(int notice) {
    std::erase_if(notices_, [&](const Notice& n) { return n.id == notice; });
}

void Session::flush() {
    end_stroke();
    shelf_.flush();
    finish_chores(true);
    recovery_.flush();
}

bool Session::busy() const {
    return playing_ != 0 || painting_ || changing_ || fetching_ || opening_.valid() ||
           !chores_.empty() || request_due_ ||
           (measuring_ && view_.report.state == QualityReport::State::kMeasuring);
}

std::uint64_t Session::news() const {
    return shelf_.arrivals() + preview_.news() + jobs_.changes() +
           (player_ ? player_->arrivals() : 0);
}

void Session::update(double now_s) {
    const auto part = [&](const char* name) {
        if (clock_) clock_->enter(name);
    };
    part("files");
    finish_chores(false);
    part("plate");
    take_plate();
    advance_playback(now_s);
    want_frames();
    part("mattes");
    take_changed_matte();
    take_texture();
    part("preview");
    request_preview();
    part("notices");
    if (const std::string error = shelf_.take_write_error(); !error.empty())
        notify(NoticeKind::kError, error);
    if (const std::string error = recovery_.take_error(); !error.empty())
        notify(NoticeKind::kError, "The recovery file cannot be written. " + error);
    std::erase_if(notices_, [&](const Notice& n) {
        return n.kind != NoticeKind::kError && now_s - n.at_s > kToastSeconds;
    });
    part("document");
    show_document();
    part("plate");
    show_plate();
    part("mattes");
    show_mattes();
    part("preview");
    show_result();
    part("strip");
    show_shape();
    show_strip();
    part("marks");
    show_marks();
    part("jobs");
    view_.jobs = jobs_.views();
    watch_jobs();
    view_.notices = notices_;
    if (painting_) painting_->changed = {};
}

}  // namespace weft
