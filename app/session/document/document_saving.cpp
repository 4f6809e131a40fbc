#include "app/session/document/document_saving.h"

#include <filesystem>
#include <utility>

#include "app/project/codec/project_file.h"
#include "app/session/document/recent_projects.h"
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
bool DocumentSaving::is_plate_folder(const std::string& folder) const {
    const std::string plate =
        resolve_path(use_.document.folder(), use_.document.project().plate.path);
    if (plate.empty()) return false;
    std::error_code none;
    const auto pattern = SequencePattern::parse(plate);
    const bool sequence = pattern && !pattern->is_single();
    if (!sequence && !fs::is_directory(plate, none)) return false;
    const fs::path frames = sequence ? fs::path(plate).parent_path() : fs::path(plate);
    return fs::weakly_canonical(folder, none) == fs::weakly_canonical(frames, none);
}

DocumentSave DocumentSaving::request(const Wanted& wanted, const std::string& whole) const {
    DocumentSave what;
    what.path = whole;
    what.from = use_.document.path();
    what.project = use_.document.committed();
    what.known = use_.document.on_disk();
    what.unsaved = (fs::path(use_.state_folder) / "unsaved").string() + "/";
    what.answer = wanted.answer;
    what.new_only = wanted.new_only;
    return what;
}

void DocumentSaving::begin(const Wanted& wanted) {
    const Document& document = use_.document;
    if (!document.is_open()) return;
    if (wanted.path.empty()) {
        use_.notices.add(NoticeKind::kWarning, "Choose where to save this project.");
        return;
    }
    use_.end_stroke();
    std::error_code none;
    const bool same_file =
        wanted.path == document.path() || fs::equivalent(wanted.path, document.path(), none);
    const std::string whole =
        same_file ? document.path() : fs::absolute(wanted.path).lexically_normal().string();
    if (whole != document.path() && is_plate_folder(project_dir(whole))) {
        use_.notices.add(
            NoticeKind::kError,
            project_dir(whole) + " holds the plate's frames. Save the project in another folder.");
        return;
    }
    saving_ = true;
    question_.reset();
    use_.tasks.start([this, what = request(wanted, whole), serial = document.serial(),
                      id = document.id()]() mutable -> DocumentTasks::Finish {
        use_.shelf.flush();
        auto done = save_document(what);
        return [this, what = std::move(what), done = std::move(done), serial, id] {
            // Another project may have been opened in the meantime.
            finish(what, done, serial,
                   id == use_.document.id() && use_.document.path() == what.from);
        };
    });
}

void DocumentSaving::finish(const DocumentSave& what, const Expected<DocumentSaved>& done,
                            std::uint64_t serial, bool here) {
    saving_ = false;
    if (!done) return use_.notices.add(NoticeKind::kError, done.error().text());
    if (!done->conflicts.empty()) {
        if (here)
            question_ = SaveQuestion{what.path, done->now.hash, done->conflicts, done->merged};
        return;
    }
    remember_recent(use_.settings, what.path);
    use_.notices.add(NoticeKind::kGood, saved_text(what.path, *done));
    if (here) take(what, *done, serial);
}

void DocumentSaving::answer(const AnswerSave& answer) {
    const auto question = std::exchange(question_, std::nullopt);
    if (question && answer.wins)
        begin({use_.document.path(), SaveAnswer{*answer.wins, question->theirs}, false});
}

// Changes made while the document was being written are still unsaved.
void DocumentSaving::take(const DocumentSave& what, const DocumentSaved& done,
                          std::uint64_t serial) {
    Document& document = use_.document;
    if (what.path != what.from) {
        document.moved_to(what.path, done.moved, done.now.project);
        use_.files.find_render_folder();
    } else if (done.merged.empty()) {
        document.mark_saved(serial);
    } else {
        auto merged = with_merged(what.project, document.committed(), done);
        if (!merged) return use_.notices.add(NoticeKind::kError, merged.error().text());
        use_.selection.renumber(done.renumbered);
        document.commit(std::move(*merged), "Merge changes of the file");
        if (document.committed() == done.now.project) document.mark_saved();
    }
    document.set_on_disk(done.now);
    if (document.modified())
        document.note_recovery();
    else
        document.clear_recovery();
    use_.trust.trust_saved();
    document.touch();
}

void DocumentSaving::save_version() {
    const Document& document = use_.document;
    if (!document.is_open()) return;
    if (document.path().empty()) {
        use_.notices.add(NoticeKind::kWarning,
                         "Save the project first; then its versions are counted.");
        return;
    }
    const auto [stem, version] = versioned(fs::path(document.path()).stem().string());
    std::error_code none;
    fs::path next;
    for (int k = version + 1; next.empty() || fs::exists(next, none); ++k)
        next = fs::path(document.folder()) / (stem + version_text(k) + ".weft");
    begin({next.string(), {}, true});
}

void DocumentSaving::show(SessionView& view) const {
    view.saving = saving_;
    view.save_question = question_;
}

}  // namespace weft
