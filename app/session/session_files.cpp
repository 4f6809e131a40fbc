// The files of the document: saving, collecting, relinking, and where it renders to.
#include <cstdlib>
#include <filesystem>

#include "app/exchange/collect.h"
#include "app/exchange/relink.h"
#include "app/exchange/save_document.h"
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

// What was saved, and what became of the work of others.
std::string saved_text(const std::string& path, const DocumentSaved& done) {
    std::string text = "Saved " + fs::path(path).filename().string() + ".";
    for (std::size_t k = 0; k < done.merged.size(); ++k)
        text += (k == 0 ? " Merged what another program changed meanwhile: " : ", ") +
                done.merged[k] + (k + 1 == done.merged.size() ? "." : "");
    if (!done.backup.empty())
        text += " What was replaced is kept in " + fs::path(done.backup).filename().string() + ".";
    return text;
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

void Session::save(const std::string& path, const std::optional<SaveAnswer>& answer,
                   bool new_only) {
    if (!open_) return;
    if (path.empty()) {
        notify(NoticeKind::kWarning, "Choose where to save this project.");
        return;
    }
    end_stroke();
    std::error_code none;
    const bool same_file = path == path_ || fs::equivalent(path, path_, none);
    const std::string whole = same_file ? path_ : fs::absolute(path).lexically_normal().string();
    if (whole != path_ && is_plate_folder(project_dir(whole))) {
        notify(NoticeKind::kError, project_dir(whole) +
                                       " holds the plate's frames. Save the project in another "
                                       "folder.");
        return;
    }
    view_.saving = true;
    view_.save_question.reset();
    DocumentSave what;
    what.path = whole;
    what.from = path_;
    what.project = history_.current();
    what.known = on_disk_;
    what.unsaved = (fs::path(options_.state_folder) / "unsaved").string() + "/";
    what.answer = answer;
    what.new_only = new_only;
    file_tasks_.start([this, what = std::move(what), serial = history_.serial(),
                       document = document_id_]() mutable -> Finish {
        shelf_.flush();
        auto done = save_document(what);
        return [this, what = std::move(what), done = std::move(done), serial, document] {
            view_.saving = false;
            if (!done) return notify(NoticeKind::kError, done.error().text());
            // Another project may have been opened in the meantime.
            const bool here = document == document_id_ && path_ == what.from;
            if (!done->conflicts.empty()) {
                if (here) ask_about(what, *done);
                return;
            }
            remember_recent(what.path);
            notify(NoticeKind::kGood, saved_text(what.path, *done));
            if (here) take_saved(what, *done, serial);
        };
    });
}

void Session::ask_about(const DocumentSave& what, const DocumentSaved& found) {
    view_.save_question = SaveQuestion{what.path, found.now.hash, found.conflicts, found.merged};
}

void Session::answer_save(const AnswerSave& answer) {
    const auto question = std::exchange(view_.save_question, std::nullopt);
    if (question && answer.wins) save(path_, SaveAnswer{*answer.wins, question->theirs});
}

// Changes made while the document was being written are still unsaved.
void Session::take_saved(const DocumentSave& what, const DocumentSaved& done,
                         std::uint64_t serial) {
    if (what.path != what.from) {
        saved_as(done.now.project, what.path, done.moved);
    } else if (done.merged.empty()) {
        history_.mark_saved(serial);
    } else {
        auto merged = with_merged(what.project, history_.current(), done);
        if (!merged) return notify(NoticeKind::kError, merged.error().text());
        if (const auto id = done.renumbered.find(selected_); id != done.renumbered.end())
            selected_ = id->second;
        commit(std::move(*merged), "Merge changes of the file");
        if (history_.current() == done.now.project) history_.mark_saved();
    }
    on_disk_ = done.now;
    if (history_.modified())
        recovery_.note({resolved(), path_, on_disk_});
    else
        recovery_.clear();
    trust_saved();
    ++document_version_;
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
    save(next.string(), {}, true);
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
        return [this, first = folder(base, 1), found = folder(base, version)] {
            // Not if the project was saved or took another name meanwhile.
            if (view_.render_folder == first) view_.render_folder = found;
        };
    });
}

}  // namespace weft
