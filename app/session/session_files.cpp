// The files of the document: saving, collecting, relinking, and where it renders to.
#include <cstdlib>
#include <filesystem>

#include "app/exchange/collect.h"
#include "app/exchange/relink.h"
#include "app/project/codec/project_file.h"
#include "app/session/session.h"
#include "engine/media/sequence_pattern.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// "shot_v007" → "shot_" and 7; "shot" → "shot_" and 1.
std::pair<std::string, int> versioned(const std::string& stem) {
    const std::size_t at = stem.rfind("_v");
    if (at != std::string::npos && at + 2 < stem.size() && stem.size() - at < 8 &&
        stem.find_first_not_of("0123456789", at + 2) == std::string::npos)
        return {stem.substr(0, at + 1), std::stoi(stem.substr(at + 2))};
    return {stem + "_", 1};
}

std::string version_text(int version) {
    const std::string digits = std::to_string(version);
    return "v" + std::string(digits.size() < 3 ? 3 - digits.size() : 0, '0') + digits;
}

std::string files_text(std::size_t count) {
    return std::to_string(count) + (count == 1 ? " file" : " files");
}

}  // namespace

// A project among the frames of a sequence is easily taken for one of them, and plates are often
// write-protected or replaced.
bool Session::is_plate_folder(const std::string& folder) const {
    const std::string plate = resolve_path(project_dir(path_), document().plate.path);
    if (plate.empty()) return false;
    std::error_code none;
    const auto pattern = SequencePattern::parse(plate);
    const bool sequence = pattern && !pattern->is_single();
    if (!sequence && !fs::is_directory(plate, none)) return false;
    const fs::path frames = sequence ? fs::path(plate).parent_path() : fs::path(plate);
    return fs::weakly_canonical(folder, none) == fs::weakly_canonical(frames, none);
}

void Session::save(const std::string& path) {
    if (!open_) return;
    if (path.empty()) {
        notify(NoticeKind::kWarning, "Choose where to save this project.");
        return;
    }
    end_stroke();
    const std::string whole = fs::absolute(path).lexically_normal().string();
    if (whole != path_ && is_plate_folder(project_dir(whole))) {
        notify(NoticeKind::kError, project_dir(whole) +
                                       " holds the plate's frames. Save the project in another "
                                       "folder.");
        return;
    }
    const std::string unsaved = (fs::path(options_.state_folder) / "unsaved").string() + "/";
    view_.saving = true;
    file_tasks_.start([this, whole, unsaved, from = path_, project = history_.current(),
                       serial = history_.serial(), document = document_id_]() mutable -> Finish {
        shelf_.flush();
        Status written;
        MovedFiles moved;
        if (whole != from) {
            auto copied = copy_own_files(project, from, whole, unsaved);
            if (copied) {
                moved = std::move(*copied);
                project = rebased(project, from, whole, moved);
            } else {
                written = tl::unexpected<Error>(copied.error());
            }
        }
        if (written) written = save_project(whole, project, in_place());
        return [this, whole, from, serial, written, document, moved = std::move(moved),
                project = std::move(project)] {
            view_.saving = false;
            if (!written) {
                notify(NoticeKind::kError, written.error().text());
                return;
            }
            remember_recent(whole);
            notify(NoticeKind::kGood, "Saved " + fs::path(whole).filename().string() + ".");
            // Another project may have been opened in the meantime.
            if (document != document_id_ || path_ != from) return;
            if (whole != from) {
                saved_as(project, whole, moved);
            } else {
                history_.mark_saved(serial);
            }
            if (!history_.modified()) recovery_.clear();
            trust_saved();
            ++document_version_;
        };
    });
}

// The document has a path now; changes made while it was being written are still unsaved, and all
// earlier states name their files from the new place.
void Session::saved_as(const Project& written, const std::string& path, const MovedFiles& moved) {
    const std::string from = path_;
    history_.change_all([&](const Project& state) { return rebased(state, from, path, moved); });
    path_ = path;
    find_render_folder();
    const bool same = history_.current() == written;
    document_changed();
    if (same) history_.mark_saved();
}

void Session::save_version() {
    if (!open_) return;
    if (path_.empty()) {
        notify(NoticeKind::kWarning, "Save the project first; then its versions are counted.");
        return;
    }
    const auto [stem, version] = versioned(fs::path(path_).stem().string());
    std::error_code none;
    fs::path next;
    for (int k = version + 1; next.empty() || fs::exists(next, none); ++k)
        next = fs::path(project_dir(path_)) / (stem + version_text(k) + ".weft");
    save(next.string());
}

// One at a time. It goes on when another shot is opened: its files were named when it began.
void Session::collect(const std::string& folder) {
    if (!open_) return;
    if (collecting_)
        return notify(
            NoticeKind::kWarning,
            "Files are still being collected. Wait until they are, or cancel that first.");
    end_stroke();
    const std::string name = view_.title;
    const CollectRun run((fs::path(folder) / name).string());
    collecting_ = run;
    file_tasks_.start([this, name, run, project = resolved(), path = path_]() -> Finish {
        shelf_.flush();
        WriteLimits limits;
        if (!path.empty()) limits.reads.push_back(path);
        const auto collected =
            collect_project(project, name + ".weft", run.folder, options_.texture_library, limits,
                            run.cancel, [&](const ProgressEvent& event) { run.note(event); });
        return [this, collected, run] {
            collecting_.reset();
            if (run.cancel.cancelled() && !collected)
                return notify(NoticeKind::kInfo,
                              "Nothing was collected; the copied files were removed again.");
            if (!collected) return notify(NoticeKind::kError, collected.error().text());
            notify(NoticeKind::kGood, "Collected the project and " +
                                          files_text(static_cast<std::size_t>(collected->files)) +
                                          " in " + run.folder + ".");
        };
    });
}

void Session::cancel_collect() {
    if (collecting_) collecting_->cancel.cancel();
}

void Session::look_for_missing_files() {
    start_for_document([this, project = resolved()]() -> Finish {
        shelf_.flush();
        return [this, missing = missing_inputs(project)] { view_.missing = missing; };
    });
}

// One step of the history for everything that is found.
void Session::relink(const std::string& folder) {
    if (!open_) return;
    end_stroke();
    start_for_document([this, folder, project = resolved(), state = history_.serial()]() -> Finish {
        shelf_.flush();
        const auto linked = relink_inputs(project, folder, CancelToken());
        return [this, linked, folder, state] {
            if (!linked) return notify(NoticeKind::kError, linked.error().text());
            if (state != history_.serial())
                return notify(NoticeKind::kWarning,
                              "The project was changed meanwhile. Relink its files again.");
            if (linked->found.empty() && linked->missing.empty())
                return notify(NoticeKind::kInfo, "No file is missing.");
            if (linked->found.empty())
                return notify(NoticeKind::kWarning, "None of the missing files is in " + folder +
                                                        ". Choose another "
                                                        "folder.");
            const std::string dir = project_dir(path_);
            view_.missing = linked->missing;
            commit(map_paths(linked->project,
                             [&](const std::string& path) { return relative_to(dir, path); }),
                   "Relink " + files_text(linked->found.size()));
            notify(linked->missing.empty() ? NoticeKind::kGood : NoticeKind::kWarning,
                   "Relinked " + files_text(linked->found.size()) +
                       (linked->missing.empty()
                            ? "."
                            : "; " + files_text(linked->missing.size()) + " still missing."));
        };
    });
}

// A saved project renders beside itself under its own name. Shots that were never saved share a
// folder by name: each takes a version that is not there yet.
void Session::find_render_folder() {
    const auto folder = [](const fs::path& base, int version) {
        return base.string() + "render_" + version_text(version);
    };
    if (!path_.empty()) {
        const fs::path own(path_);
        view_.render_folder = folder(own.parent_path() / (own.stem().string() + "_"), 1);
        return;
    }
    const char* home = std::getenv("HOME");
    const std::string name = document().name.empty() ? "Untitled" : document().name;
    const fs::path base = fs::path(home && *home ? home : "/tmp") / "weft" / name / "";
    view_.render_folder = folder(base, 1);
    start_for_document([this, base, folder]() -> Finish {
        int version = 1;
        std::error_code none;
        while (fs::exists(folder(base, version), none))
            ++version;
        return [this, found = folder(base, version)] {
            if (path_.empty()) view_.render_folder = found;
        };
    });
}

}  // namespace weft
