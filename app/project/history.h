#pragma once
// Undo and redo: snapshots of the project that share unchanged data, limited in bytes.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

#include "app/project/project.h"

namespace weft {

/// Not thread-safe; belongs to the session. Returned snapshots are values and may be used by any
/// thread.
class History {
  public:
    static constexpr std::size_t kDefaultMaxBytes = std::size_t{64} << 20;

    /// Starts with `project` as the saved state. Beyond `max_bytes` the oldest snapshots are
    /// dropped, but never the current one.
    explicit History(Project project, std::size_t max_bytes = kDefaultMaxBytes);

    [[nodiscard]] const Project& current() const { return entries_[at_].project; }

    /// Adds a new state and drops the redo states. Does nothing if it equals the current one.
    /// `label` says what was done ("Set placement.scale of wall").
    void push(Project project, std::string label);

    [[nodiscard]] bool can_undo() const { return at_ > 0; }
    [[nodiscard]] bool can_redo() const { return at_ + 1 < entries_.size(); }
    /// Returns false if there is nothing to undo or redo.
    bool undo();
    bool redo();
    /// Labels of the next undo and redo; empty if there is none.
    [[nodiscard]] std::string undo_label() const {
        return can_undo() ? entries_[at_].label : std::string();
    }
    [[nodiscard]] std::string redo_label() const {
        return can_redo() ? entries_[at_ + 1].label : std::string();
    }

    /// Labels of all states, from the oldest one to the last redo.
    [[nodiscard]] std::vector<std::string> labels() const;
    [[nodiscard]] std::size_t position() const {
        return at_;
    }  ///< Position of the current state in labels().
    /// Goes to that state. Returns false if there is no such state.
    bool go_to(std::size_t position);

    /// Replaces every state, for instance when all paths get another origin. Labels, serials and
    /// what is saved stay, and so does what the states share.
    void change_all(const std::function<Project(const Project&)>& change);

    /// Marks the current state as saved.
    void mark_saved() { saved_ = entries_[at_].serial; }
    /// Marks an earlier state as saved, by its serial().
    void mark_saved(std::uint64_t serial) { saved_ = serial; }
    /// Unique number of the current state.
    [[nodiscard]] std::uint64_t serial() const { return entries_[at_].serial; }
    [[nodiscard]] bool modified() const { return entries_[at_].serial != saved_; }

    /// Estimated memory of all snapshots, shared parts counted once.
    [[nodiscard]] std::size_t bytes() const { return bytes_; }

  private:
    struct Entry {
        Project project;
        std::string label;
        std::uint64_t serial = 0;
    };
    void add(Entry entry);
    void count(const Entry& entry, int sign);
    void count_leaf(const void* identity, std::size_t leaf_bytes, int sign);
    void trim();

    std::deque<Entry> entries_;
    std::size_t at_ = 0;
    std::size_t max_bytes_;
    std::size_t bytes_ = 0;
    std::unordered_map<const void*, int> leaf_uses_;  // number of snapshots that hold a leaf
    std::uint64_t next_serial_ = 0, saved_ = 0;
};

}  // namespace weft
