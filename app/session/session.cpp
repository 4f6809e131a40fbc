#include "app/session/session.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/base/background.h"
#include "app/exchange/kept_textures.h"
#include "app/mattes/matte_layer.h"
#include "app/project/codec/project_file.h"
#include "app/project/key_rows.h"
#include "app/session/session_measuring.h"
#include "texture_db/library/library.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr double kToastSeconds = 6;

// The indices first … last, those next to `at` first; while playing, in the order of playback.
std::vector<int> fill_order(int at, int first, int last, bool playing) {
    std::vector<int> out;
    for (int k = at; k <= last; ++k)
        out.push_back(k);
    for (int k = first; k < at; ++k)
        out.push_back(k);
    if (!playing)
        std::stable_sort(out.begin(), out.end(),
                         [&](int a, int b) { return std::abs(a - at) < std::abs(b - at); });
    return out;
}

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

// ---- frames ----------------------------------------------------------------------------------

void Session::go_to(int frame) {
    if (!playback_.go_to(frame)) return;
    end_stroke();
    request_pending_ = true;
}

void Session::step_keyframe(int direction) {
    const Region* region = region_by_id(document(), selected_);
    if (!region) return;
    std::set<int> stops;
    for (const KeyRow& row : key_rows(*region))
        for (const KeyMark& key : row.keys)
            stops.insert(key.frame);
    if (direction > 0) {
        const auto next = stops.upper_bound(playback_.frame());
        if (next != stops.end()) go_to(*next);
    } else {
        const auto next = stops.lower_bound(playback_.frame());
        if (next != stops.begin()) go_to(*std::prev(next));
    }
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

// Painted mattes are carried to the other frames before a texture is chosen.
void Session::carry_mattes() {
    Project project = resolved();
    project.settings.quality = preview_quality_;
    for (Leaf<Region>& region : project.regions) {
        const bool waits = region->enabled && !region->matte->keyframes.empty() &&
                           region->texture.sample.empty() && region->texture.plane.empty();
        region = region.with([&](Region& r) { r.enabled = waits; });
    }
    preview_.carry(project, shelf_.unwritten(), playback_.frame());
}

// While a setting is dragged, the next request waits for the picture of the one before. It would
// cancel that one, and nothing would be seen until the mouse rests.
bool Session::awaits_dragged_picture() const {
    constexpr double kPatienceS = 2;
    const PicturePtr& shown =
        preview_reading_.frame.stages[static_cast<std::size_t>(Stage::kFinal)];
    return tried_ && !shown && dragged_at_s_ && now_s_ - *dragged_at_s_ < kPatienceS &&
           view_.preview.state != PreviewView::State::kFailed;
}

void Session::request_preview() {
    if (!request_pending_ || painting_.active() || awaits_dragged_picture()) return;
    if (!reader_) {
        request_pending_ = false;
        return;
    }
    carry_mattes();
    PreviewRequest request;
    bool any = false;
    request.document = document_id_;
    request.project = project_to_preview(any);
    if (!any) {
        request_pending_ = false;
        preview_.clear();
        preview_reading_ = {};
        view_.result_wanted = false;
        return;
    }
    view_.result_wanted = true;
    const auto& frames = playback_.frames();
    request.frame = playback_.frame();
    request.range = frames;
    request.painted = shelf_.unwritten();
    request.stages = stages_;
    request.layer = shown_layer_;
    request.overlay = overlay_;
    request.overlay_region = selected_;
    if (const auto cards = strip_.cards()) request.cards = cards->requests;
    request.interactive = playback_.direction() != 0;
    // The marked range, or else this many frames around the playhead.
    constexpr int kAround = 24;
    const auto [first, last] = playback_.range();
    const int at = playback_.index();
    const int before = playback_.direction() != 0 ? 0 : kAround / 4;
    const int from = playback_.marked() ? first : std::max(first, at - before);
    const int to = playback_.marked() ? last : std::min(last, at + kAround);
    for (const int k : fill_order(std::clamp(at, from, to), from, to, request.interactive))
        request.fill.push_back(frames[static_cast<std::size_t>(k)]);
    if (!preview_.try_request(request)) return;  // retried in the next frame
    request_pending_ = false;
    dragged_at_s_ = tried_ ? std::optional(now_s_) : std::nullopt;
    preview_reading_.frame = {};
    preview_reading_.rendered.clear();
}

void Session::apply_texture(const std::string& path, RegionId region) {
    const Region* target = region_by_id(document(), region);
    if (!target) {
        notify(NoticeKind::kWarning, "Select a region for this texture.");
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

// Copies a library texture beside the project, so that the project does not need the library.
void Session::fetch_texture(const std::string& path, RegionId region) {
    Fetching copy;
    copy.region = region;
    copy.path =
        in_background([path, folder = texture_folder(), library = options_.texture_library,
                       excluded = licence_list(
                           document().settings.excluded_licences)]() -> Expected<std::string> {
            WEFT_TRY(texture, resolve_texture(library, path));
            WEFT_CHECK_OK(check_licences({texture.credit}, excluded));
            return keep_texture(texture, folder);
        });
    fetching_ = std::move(copy);
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
    // A repeated notice replaces the earlier one.
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
    file_tasks_.finish(true);
    recovery_.flush();
}

bool Session::busy() const {
    return playback_.direction() != 0 || painting_.active() || changing_ || fetching_ ||
           opener_.busy() || !file_tasks_.empty() || request_pending_ || strip_.busy() ||
           (measuring_ && view_.report.state == QualityReport::State::kMeasuring);
}

std::uint64_t Session::changes() const {
    return shelf_.changes() + preview_.changes() + jobs_.changes() +
           (player_ ? player_->changes() : 0);
}

void Session::update(double now_s) {
    const auto part = [&](const char* name) {
        if (clock_) clock_->enter(name);
    };
    part("files");
    file_tasks_.finish(false);
    part("plate");
    take_plate();
    now_s_ = now_s;
    if (first_update_s_ < 0) first_update_s_ = now_s;
    find_more_recoverable();
    if (player_) {
        playback_.advance(now_s, view_.plate.fps > 0 ? view_.plate.fps : 24, plate_reading_.states);
        (void)player_->try_want(playback_.upcoming());  // if it fails, retried in the next frame
    }
    part("mattes");
    painting_.update();
    take_changed_matte();
    // Results from in-memory mattes may now be filed under the names of their files.
    const bool unwritten = shelf_.writing();
    request_pending_ |= mattes_unwritten_ && !unwritten;
    mattes_unwritten_ = unwritten;
    take_texture();
    part("preview");
    request_preview();
    part("notices");
    if (const std::string error = shelf_.take_write_error(); !error.empty())
        notify(NoticeKind::kError, error);
    if (const std::string error = recovery_.take_error(); !error.empty())
        notify(NoticeKind::kError, "Cannot write the autosave. " + error);
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
    mark_confirmed();
    part("jobs");
    watch_jobs();
    view_.notices = notices_;
    painting_.shown();
}

}  // namespace weft
