#pragma once
// The open document: the project with its history, its place on the disk and its recovery snapshot.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/base/recovery.h"
#include "app/exchange/move_project.h"
#include "app/project/codec/project_file.h"
#include "app/project/codec/update_project.h"
#include "app/project/edit.h"
#include "app/project/history.h"
#include "app/session/document/notices.h"
#include "app/session/session_view.h"

namespace weft {

/// Who depends on the document and is told at once.
class DocumentFollower {
  public:
    /// Another document has taken the place of the one before. document_changed() follows.
    virtual void document_replaced() = 0;
    /// The document, or what is tried on it, has changed.
    virtual void document_changed() = 0;

  protected:
    ~DocumentFollower() = default;
};

/// Belongs to one thread. Edits that fail are reported as notices.
class Document {
  public:
    /// `before_snapshot`: as RecoveryWriter's `before_writing`. The references must stay.
    Document(const std::string& recovery_folder, std::function<void()> before_snapshot,
             DocumentFollower& follower, Notices& notices);

    // ---- what it is ----
    [[nodiscard]] bool is_open() const { return open_; }
    /// Another number after another one was opened, also of the same file.
    [[nodiscard]] std::uint64_t id() const { return id_; }
    /// Increases with every change of what is shown of it.
    [[nodiscard]] std::uint64_t version() const { return version_; }
    /// Including an edit that is being dragged.
    [[nodiscard]] const Project& project() const { return tried_ ? *tried_ : committed(); }
    [[nodiscard]] const Project& committed() const { return history_.current(); }
    /// An edit is being dragged.
    [[nodiscard]] bool trying() const { return tried_.has_value(); }
    /// project() with absolute paths.
    [[nodiscard]] Project resolved() const { return resolve_paths(project(), folder()); }
    /// The project file; empty: never saved.
    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] std::string folder() const { return project_dir(path_); }
    /// Its name for the user.
    [[nodiscard]] std::string title() const;
    /// Of the committed state, as History has it.
    [[nodiscard]] std::uint64_t serial() const { return history_.serial(); }
    [[nodiscard]] bool modified() const { return history_.modified(); }

    // ---- changing it ----
    /// One step of the history. Returns false if it failed or no document is open.
    bool edit(const Edit& what);
    bool commit(const Edit& what, std::string label);
    bool commit(const std::vector<Edit>& edits, std::string label);
    void commit(Project project, std::string label);
    /// Shown, but no step of the history.
    void try_edit(const Edit& what);
    void try_edits(const std::vector<Edit>& edits);
    void drop_tried() { tried_.reset(); }
    /// These return false if there is no such state. What was tried is dropped before.
    bool undo() {
        return go([&] { return history_.undo(); });
    }
    bool redo() {
        return go([&] { return history_.redo(); });
    }
    bool go_to(std::size_t position) {
        return go([&] { return history_.go_to(position); });
    }
    /// Number of states that redo() can bring back, and of those that were ever made.
    [[nodiscard]] std::size_t redos() const {
        return history_.labels().size() - 1 - history_.position();
    }
    [[nodiscard]] std::uint64_t made() const { return made_; }
    /// Makes all who look at version() look again.
    void touch() { ++version_; }

    // ---- its place ----
    /// Starts another document; nothing is known of its file yet.
    void start(Project project, std::string path);
    void close() { open_ = false; }
    /// It was saved under another name: all states name their files from the new place.
    /// `written`: what is in that file.
    void moved_to(const std::string& path, const MovedFiles& moved, const Project& written);
    void mark_saved() { history_.mark_saved(); }
    void mark_saved(std::uint64_t serial) { history_.mark_saved(serial); }
    /// What path() held when it was opened or last saved.
    [[nodiscard]] const std::optional<ProjectOnDisk>& on_disk() const { return on_disk_; }
    void set_on_disk(std::optional<ProjectOnDisk> held) { on_disk_ = std::move(held); }

    // ---- its recovery snapshot ----
    void note_recovery() { recovery_.note({resolved(), path_, on_disk_}); }
    void clear_recovery() { recovery_.clear(); }
    void flush_recovery() { recovery_.flush(); }
    [[nodiscard]] std::string take_recovery_error() { return recovery_.take_error(); }

    void show(SessionView& view);

  private:
    void changed();
    bool keep(Expected<Project> made, std::string label);
    void keep_tried(Expected<Project> made);
    bool go(const std::function<bool()>& move);

    DocumentFollower& follower_;
    Notices& notices_;
    bool open_ = false;
    std::string path_;
    std::optional<ProjectOnDisk> on_disk_;
    History history_{Project{}};
    std::optional<Project> tried_;
    std::uint64_t id_ = 0, version_ = 1, shown_version_ = 0, made_ = 0;
    RecoveryWriter recovery_;
};

}  // namespace weft
