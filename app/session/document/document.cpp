#include "app/session/document/document.h"

#include <filesystem>
#include <utility>

#include "app/project/validate.h"

namespace weft {

Document::Document(const std::string& recovery_folder, std::function<void()> before_snapshot,
                   DocumentFollower& follower, Notices& notices)
    : follower_(follower),
      notices_(notices),
      recovery_(recovery_folder, std::move(before_snapshot)) {}

std::string Document::title() const {
    if (!path_.empty()) return std::filesystem::path(path_).stem().string();
    return project().name.empty() ? "Untitled" : project().name;
}

void Document::changed() {
    ++version_;
    follower_.document_changed();
}

bool Document::edit(const Edit& what) {
    if (!open_) return false;
    auto made = apply_edit(committed(), what);
    std::string label = made ? edit_label(committed(), what) : std::string();
    return keep(std::move(made), std::move(label));
}

bool Document::commit(const Edit& what, std::string label) {
    return keep(apply_edit(committed(), what), std::move(label));
}

bool Document::commit(const std::vector<Edit>& edits, std::string label) {
    return keep(apply_edits(committed(), edits), std::move(label));
}

bool Document::keep(Expected<Project> made, std::string label) {
    if (made)
        commit(std::move(*made), std::move(label));
    else
        notices_.add(NoticeKind::kError, made.error().text());
    return made.has_value();
}

void Document::commit(Project project, std::string label) {
    tried_.reset();
    history_.push(std::move(project), std::move(label));
    ++made_;
    changed();
    note_recovery();
}

void Document::try_edit(const Edit& what) {
    if (open_) keep_tried(apply_edit(committed(), what));
}

void Document::try_edits(const std::vector<Edit>& edits) {
    keep_tried(apply_edits(committed(), edits));
}

void Document::keep_tried(Expected<Project> made) {
    if (!made) return notices_.add(NoticeKind::kError, made.error().text());
    tried_ = std::move(*made);
    changed();
}

bool Document::go(const std::function<bool()>& move) {
    tried_.reset();
    if (!move()) return false;
    changed();
    note_recovery();
    return true;
}

void Document::start(Project project, std::string path) {
    ++id_;
    tried_.reset();
    path_ = std::move(path);
    on_disk_.reset();
    history_ = History(std::move(project));
    open_ = true;
    follower_.document_replaced();
    changed();
}

void Document::moved_to(const std::string& path, const MovedFiles& moved, const Project& written) {
    history_.change_all([&](const Project& state) { return rebased(state, path_, path, moved); });
    path_ = path;
    const bool same = committed() == written;
    changed();
    if (same) mark_saved();
}

void Document::show(SessionView& view) {
    view.open = open_;
    view.document = id_;
    view.modified = modified();
    view.undo_label = history_.undo_label();
    view.redo_label = history_.redo_label();
    if (shown_version_ == version_) return;
    shown_version_ = version_;
    view.project = project();
    view.path = path_;
    view.title = title();
    view.history = history_.labels();
    view.history_position = history_.position();
    view.issues = validate(project());
    view.unready.clear();
    for (const Leaf<Region>& region : project().regions) {
        if (region->matte->empty()) {
            view.unready[region->id] = "Paint its matte on the frame";
        } else if (region->texture.sample.empty() && region->texture.plane.empty()) {
            view.unready[region->id] = "Choose a texture for it";
        }
    }
}

}  // namespace weft
