#pragma once
// Undo and redo: snapshots of the project that share what they have in common, bounded in bytes.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <unordered_map>
#include <vector>

#include "app/project/project.h"

namespace weft {

/// Not thread-safe: belongs to the session. Snapshots that it returns are values and may go
/// anywhere.
class History {
  public:
    static constexpr std::size_t kDefaultMaxBytes = std::size_t{64} << 20;

    /// Starts with `project` as the saved state. More than `max_bytes` of snapshots make the oldest
    /// be forgotten; the current one always stays.
    explicit History(Project project, std::size_t max_bytes = kDefaultMaxBytes);

    [[nodiscard]] const Project& current() const { return entries_[at_].project; }

    /// A new state; what was undone before it is forgotten. Nothing happens when it equals the
    /// current one. `label`: what was done ("Set placement.scale of wall").
    void push(Project project, std::string label);

    [[nodiscard]] bool can_undo() const { return at_ > 0; }
    [[nodiscard]] bool can_redo() const { return at_ + 1 < entries_.size(); }
    /// False when there is nothing to undo or redo.
    bool undo();
    bool redo();
    /// What undo() would take back and redo() do again; empty when they would do nothing.
    [[nodiscard]] std::string undo_label() const {
        return can_undo() ? entries_[at_].label : std::string();
    }
    [[nodiscard]] std::string redo_label() const {
        return can_redo() ? entries_[at_ + 1].label : std::string();
    }

    /// Labels from the oldest state that is kept (its own label: how it came to be) to the last
    /// redo.
    [[nodiscard]] std::vector<std::string> labels() const;
    [[nodiscard]] std::size_t position() const {
        return at_;
    }  ///< Of the current state in labels().
    /// Goes there. False when there is no such state.
    bool go_to(std::size_t position);

    /// The current state is what is on disk.
    void mark_saved() { saved_ = entries_[at_].serial; }
    /// Likewise of an earlier state, by its serial().
    void mark_saved(std::uint64_t serial) { saved_ = serial; }
    /// A number of the current state that no other has.
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
    std::unordered_map<const void*, int> leaf_uses_;  // how many snapshots hold a leaf
    std::uint64_t next_serial_ = 0, saved_ = 0;
};

}  // namespace weft
