// Opening, editing, saving and recovering the document.
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "app/base/background.h"
#include "app/project/codec/project_file.h"
#include "app/session/session.h"
#include "engine/color/color_space.h"
#include "engine/media/atomic_file.h"
#include "engine/media/plates.h"
#include "texture_db/library/library.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// Paths below the project's folder are stored relative to it, so that the folder can be moved.
std::string relative_to(const std::string& dir, const std::string& path) {
    if (dir.empty() || !path.starts_with('/')) return path;
    const fs::path relative = fs::path(path).lexically_relative(dir);
    if (relative.empty() || relative.begin()->string() == "..") return path;
    return relative.string();
}

Expected<Project> project_for_plate(const std::string& path) {
    Project project;
    project.plate.path = path;
    // A display name: the folder's if the file name is only a number or a pattern.
    const fs::path named(path);
    const bool numbered =
        named.stem().string().find_first_not_of("0123456789#%d@") == std::string::npos;
    project.name =
        (numbered && named.has_parent_path() ? named.parent_path() : named).filename().string();
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

// The document for saving to another place: paths below its folder become relative, and files
// painted or fetched before the first save are copied beside it.
Status move_to(const std::string& path, const std::string& unsaved, const std::string& from_dir,
               Project& project, std::map<std::string, std::string>& moved) {
    const std::string dir = project_dir(path), stem = fs::path(path).stem().string();
    Status failed;
    project = map_paths(resolve_paths(project, from_dir), [&](const std::string& from) {
        if (!from.starts_with(unsaved)) return relative_to(dir, from);
        const bool texture = from.find("/textures/") != std::string::npos;
        const fs::path to = fs::path(dir) / (stem + (texture ? "_textures" : "_mattes")) /
                            fs::path(from).filename();
        Status copied = make_folder_of(to.string(), WriteRule::own());
        if (copied) copied = copy_file_atomically(from, to.string(), WriteRule::own());
        // Copies the credits (author, licence) too; the user's own textures have none.
        std::error_code none;
        const std::string credit = texture_credit_path(from);
        if (copied && fs::exists(credit, none)) {
            copied =
                copy_file_atomically(credit, texture_credit_path(to.string()), WriteRule::own());
        }
        if (!copied && failed)
            failed = fail_in(copied.error(), from + " cannot be copied beside the project");
        return moved[from] = relative_to(dir, to.string());
    });
    return failed;
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
    recovery_.note(resolved(), path_);
}

void Session::document_changed() {
    ++document_version_;
    request_pending_ = true;
    open_plate_in_background();
    if (!region_by_id(document(), selected_))
        selected_ = document().regions.empty() ? 0 : document().regions.back()->id;
}

void Session::start_document(Project project, std::string path) {
    preview_.clear();
    painting_.cancel();
    tried_.reset();
    shown_mattes_.clear();
    last_result_.reset();
    playback_.reset();
    solo_ = 0;
    locked_.clear();
    path_ = std::move(path);
    history_ = History(std::move(project));
    open_ = true;
    selected_ = 0;
    opener_.forget();
    update_trust(!path_.empty());
    document_changed();
}

void Session::open_project(const std::string& path) {
    auto project = load_project(path);
    if (!project) {
        notify(NoticeKind::kError, project.error().text());
        return;
    }
    recovery_.clear();
    start_document(std::move(*project), fs::absolute(path).string());
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

void Session::save(const std::string& path) {
    if (!open_) return;
    if (path.empty()) {
        notify(NoticeKind::kWarning, "Choose where to save this project.");
        return;
    }
    end_stroke();
    const std::string whole = fs::absolute(path).string();
    const std::string unsaved = (fs::path(options_.state_folder) / "unsaved").string() + "/";
    view_.saving = true;
    file_tasks_.start([this, whole, unsaved, from = path_, project = history_.current(),
                       serial = history_.serial()]() mutable -> Finish {
        shelf_.flush();
        Status written;
        std::map<std::string, std::string> moved;
        if (whole != from) written = move_to(whole, unsaved, project_dir(from), project, moved);
        if (written) written = save_project(whole, project, in_place());
        return [this, whole, from, serial, written, moved = std::move(moved),
                project = std::move(project)] {
            view_.saving = false;
            if (!written) {
                notify(NoticeKind::kError, written.error().text());
                return;
            }
            // Another project may have been opened in the meantime.
            if (path_ != from) return;
            if (whole != from) {
                saved_as(project, whole, moved);
            } else {
                history_.mark_saved(serial);
            }
            if (!history_.modified()) recovery_.clear();
            remember_recent(path_);
            trust_saved();
            ++document_version_;
            notify(NoticeKind::kGood, "Saved " + fs::path(path_).filename().string() + ".");
        };
    });
}

// The document has a path now; changes made while it was being written are still unsaved.
void Session::saved_as(const Project& written, const std::string& path,
                       const std::map<std::string, std::string>& moved) {
    const std::string dir = project_dir(path);
    Project now =
        map_paths(resolve_paths(history_.current(), project_dir(path_)), [&](const std::string& p) {
            const auto found = moved.find(p);
            return found == moved.end() ? relative_to(dir, p) : found->second;
        });
    path_ = path;
    const bool same = now == written;
    history_.push(std::move(now), "Save as " + fs::path(path).filename().string());
    document_changed();
    if (same) history_.mark_saved();
}

void Session::remember_recent(const std::string& path) {
    auto& recent = settings_->recent;
    std::erase(recent, path);
    recent.insert(recent.begin(), path);
    constexpr std::size_t kMost = 12;
    if (recent.size() > kMost) recent.resize(kMost);
}

void Session::recover(bool accept) {
    if (recoverable_.empty()) return;
    const RecoveredProject found = recoverable_.front();
    std::error_code error;
    if (accept) {
        const std::string dir = project_dir(found.project_path);
        const Project project =
            map_paths(found.project, [&](const std::string& p) { return relative_to(dir, p); });
        Project saved;
        if (!found.project_path.empty()) {
            if (auto loaded = load_project(found.project_path)) saved = std::move(*loaded);
        }
        start_document(std::move(saved), found.project_path);
        commit(project, "Recover unsaved work");
        recovery_.flush();  // before the old snapshot is deleted
    }
    fs::remove(found.file, error);
    recoverable_.erase(recoverable_.begin());
}

void Session::close_cleanly() {
    end_stroke();
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
    playback_.close();
    view_.plate = {};
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
    player_ = std::make_shared<PlatePlayer>(reader_, opened->srgb, opened->linear,
                                            options_.plate_budget_bytes);
    view_.plate.space = opened->space;
    playback_.open(reader_->frames());
    request_pending_ = true;
    ++document_version_;
}

}  // namespace weft
