// Opening, editing and recovering the document; session_files.cpp saves it.
#include <algorithm>
#include <filesystem>
#include <set>

#include "app/base/background.h"
#include "app/exchange/move_project.h"
#include "app/project/codec/project_file.h"
#include "app/session/session.h"
#include "app/session/session_measuring.h"
#include "engine/color/color_space.h"
#include "engine/core/text.h"
#include "engine/media/plates.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// A display name: the first name, from the file upwards, that is not only a number, a pattern or
// what every shot calls the folder of its frames.
std::string shot_name(const std::string& path) {
    static const std::set<std::string> kCommon{"frames", "frame",  "plate",  "plates", "images",
                                               "image",  "png",    "exr",    "jpg",    "jpeg",
                                               "rgb",    "beauty", "footage"};
    const fs::path whole(path);
    const std::string own = whole.filename().string();
    for (fs::path at = whole; at.has_relative_path(); at = at.parent_path()) {
        const std::string stem = at.stem().string();
        const bool numbered = stem.find_first_not_of("0123456789#%d@") == std::string::npos;
        if (!numbered && !kCommon.contains(lower_case(stem))) return at.filename().string();
    }
    return own;
}

Expected<Project> project_for_plate(const std::string& path) {
    Project project;
    project.plate.path = path;
    project.name = shot_name(path);
    if (fs::is_directory(path)) {
        WEFT_TRY(sequence, find_sequence(path));
        project.plate.path = sequence.text();
    } else if (!has_movie_extension(path) && fs::exists(path)) {
        // One image of a sequence selects the whole sequence.
        if (auto sequence = find_sequence(fs::path(path).parent_path().string());
            sequence && sequence->frame_of(path)) {
            project.plate.path = sequence->text();
        }
    }
    return project;
}

}  // namespace

Project Session::resolved() const {
    return resolve_paths(document(), project_dir(path_));
}

void Session::edit(const Edit& what, bool final) {
    if (!open_) return;
    auto changed = apply_edit(history_.current(), what);
    if (!changed) {
        notify(NoticeKind::kError, changed.error().text());
        return;
    }
    if (!final) {
        tried_ = std::move(*changed);
        document_changed();
        return;
    }
    commit(std::move(*changed), edit_label(history_.current(), what));
    if (const auto* added = std::get_if<AddRegion>(&what)) {
        const auto& regions = document().regions;
        if (!regions.empty())
            selected_ = added->index && *added->index < static_cast<int>(regions.size())
                            ? regions[static_cast<std::size_t>(*added->index)]->id
                            : regions.back()->id;
    }
}

void Session::commit(Project project, std::string label) {
    tried_.reset();
    history_.push(std::move(project), std::move(label));
    document_changed();
    recovery_.note({resolved(), path_, on_disk_});
}

void Session::document_changed() {
    ++document_version_;
    request_pending_ = true;
    open_plate_in_background();
    if (!region_by_id(document(), selected_))
        selected_ = document().regions.empty() ? 0 : document().regions.back()->id;
}

// Nothing of the document before is kept: no picture, no unfinished change, no target.
void Session::start_document(Project project, std::string path) {
    ++document_id_;
    preview_.forget(document_id_);
    preview_reading_ = {};
    painting_.cancel();
    (void)abandon_change();
    abandon(fetching_, [](Fetching& one) { return std::move(one.path); });
    tried_.reset();
    shown_mattes_.clear();
    missed_mattes_.clear();
    last_result_.reset();
    last_result_frame_ = 0;
    playback_.reset();
    solo_ = 0;
    layer_ = 0;
    begun_zone_ = {};
    locked_.clear();
    strip_.show(StripKind::kNone, {}, false);
    stages_ = false;
    shown_layer_.reset();
    overlay_ = Overlay::kNone;
    end_measuring();
    view_.report = {};
    view_.missing.clear();
    view_.save_question.reset();
    path_ = std::move(path);
    on_disk_.reset();
    history_ = History(std::move(project));
    open_ = true;
    selected_ = 0;
    opener_.forget();
    update_trust(!path_.empty());
    document_changed();
    look_for_missing_files();
    find_render_folder();
}

void Session::open_project(const std::string& path) {
    auto file = read_project(path);
    if (!file) {
        notify(NoticeKind::kError, file.error().text());
        return;
    }
    recovery_.clear();
    start_document(file->project, fs::absolute(path).string());
    on_disk_ = std::move(*file);
    remember_recent(path_);
}

void Session::open_demo() {
    const std::string path = (fs::path(options_.assets) / "demo" / "demo.weft").string();
    auto project = load_project(path);
    if (!project) {
        notify(NoticeKind::kError, project.error().text());
        return;
    }
    // Opens a copy, so that the demo itself is never changed.
    recovery_.clear();
    start_document(resolve_paths(*project, project_dir(fs::absolute(path).string())), "");
}

void Session::open_any(const std::string& given) {
    const std::string path = fs::absolute(given).string();
    if (path.ends_with(".weft")) return open_project(path);
    auto project = project_for_plate(path);
    if (!project) {
        notify(NoticeKind::kError, project.error().text());
        return;
    }
    if (open_ && document().plate.path.empty()) {
        edit(SetPlate{project->plate}, true);
        return;
    }
    recovery_.clear();
    start_document(std::move(*project), "");
}

void Session::remember_recent(const std::string& path) {
    auto& recent = settings_->recent;
    std::erase(recent, path);
    recent.insert(recent.begin(), path);
    constexpr std::size_t kMost = 12;
    if (recent.size() > kMost) recent.resize(kMost);
}

// An editor that is being killed may take seconds to go, so another look follows after 1, 2, 4 and
// 8 s.
void Session::find_more_recoverable() {
    constexpr double kLastLook_s = 8;
    if (!options_.offer_recovery || now_s_ - first_update_s_ < look_for_recovery_s_ ||
        look_for_recovery_s_ > kLastLook_s)
        return;
    look_for_recovery_s_ *= 2;
    file_tasks_.start([this]() -> Finish {
        auto found = find_recoverable((fs::path(options_.state_folder) / "recovery").string());
        return [this, found = std::move(found)] {
            for (const RecoveredProject& one : found) {
                std::error_code none;
                const bool known = std::any_of(
                    recoverable_.begin(), recoverable_.end(),
                    [&](const RecoveredProject& other) { return other.file == one.file; });
                if (!known && fs::exists(one.file, none)) recoverable_.push_back(one);
            }
        };
    });
}

void Session::recover(bool accept) {
    if (recoverable_.empty()) return;
    const RecoveredProject found = recoverable_.front();
    std::error_code error;
    if (accept) {
        const std::string dir = project_dir(found.project_path);
        const Project project =
            map_paths(found.project, [&](const std::string& p) { return relative_to(dir, p); });
        // As it was when it was opened: what others have saved since is merged on saving.
        auto known = found.known;
        if (!known && !found.project_path.empty()) {
            if (auto loaded = read_project(found.project_path)) known = std::move(*loaded);
        }
        start_document(known ? known->project : Project(), found.project_path);
        on_disk_ = std::move(known);
        commit(project, "Recover unsaved work");
        find_render_folder();  // by the name that came with it
        recovery_.flush();     // before the old snapshot is deleted
    }
    fs::remove(found.file, error);
    recoverable_.erase(recoverable_.begin());
}

void Session::close_cleanly() {
    end_stroke();
    cancel_collect();
    shelf_.flush();
    file_tasks_.finish(true);
    recovery_.clear();
    recovery_.flush();
}

void Session::open_plate_in_background() {
    Plate plate = document().plate;
    plate.path = resolve_path(project_dir(path_), plate.path);
    if (!opener_.open(plate)) return;
    end_player();
    reader_.reset();
    drawn_.reset();
    playback_.close();
    view_.plate = {};
    // The new plate may open at once, and its first frame be decoded later.
    view_.plate_picture.reset();
}

// Waits in the background, because a worker may be decoding a large frame.
void Session::end_player() {
    plate_reading_ = {};
    if (player_)
        shutdowns_.push_back(in_background(
            [player = std::exchange(player_, nullptr)]() mutable { player.reset(); }));
}

void Session::take_plate() {
    std::erase_if(shutdowns_, [](const std::future<void>& future) {
        return future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    });
    const auto taken = opener_.take();
    if (!taken) return;
    const Expected<OpenedPlate>& opened = *taken;
    if (!opened) {
        view_.plate.state = PlateView::State::kFailed;
        view_.plate.error = opened.error().text();
        return;
    }
    reader_ = opened->reader;
    drawn_ = std::make_shared<const DrawnMattes>(reader_->size(), reader_->frames().front());
    player_ = std::make_shared<PlatePlayer>(reader_, opened->srgb, opened->linear,
                                            options_.plate_budget_bytes);
    view_.plate.space = opened->space;
    playback_.open(reader_->frames());
    request_pending_ = true;
    ++document_version_;
}

}  // namespace weft
