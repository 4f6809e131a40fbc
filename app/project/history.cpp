#include "app/project/history.h"

#include <utility>

namespace weft {

History::History(Project project, std::size_t max_bytes) : max_bytes_(max_bytes) {
    add({std::move(project), "Open", next_serial_++});
}

void History::push(Project project, std::string label) {
    if (project == current()) return;
    while (can_redo()) {
        count(entries_.back(), -1);
        entries_.pop_back();
    }
    add({std::move(project), std::move(label), next_serial_++});
    at_ = entries_.size() - 1;
    trim();
}

bool History::undo() {
    return can_undo() && go_to(at_ - 1);
}
bool History::redo() {
    return can_redo() && go_to(at_ + 1);
}

std::vector<std::string> History::labels() const {
    std::vector<std::string> out;
    for (const Entry& entry : entries_)
        out.push_back(entry.label);
    return out;
}

bool History::go_to(std::size_t position) {
    if (position >= entries_.size()) return false;
    at_ = position;
    return true;
}

void History::change_all(const std::function<Project(const Project&)>& change) {
    std::deque<Entry> before = std::exchange(entries_, {});
    bytes_ = 0;
    leaf_uses_.clear();
    for (std::size_t k = 0; k < before.size(); ++k) {
        Entry changed = before[k];
        changed.project = change(before[k].project);
        auto& regions = changed.project.regions;
        for (std::size_t r = 0; k > 0 && r < regions.size(); ++r) {
            const auto& one = before[k].project.regions;
            const auto& other = before[k - 1].project.regions;
            const auto& made = entries_.back().project.regions;
            if (r < one.size() && r < other.size() && r < made.size() &&
                one[r].identity() == other[r].identity())
                regions[r] = made[r];
        }
        add(std::move(changed));
    }
    trim();
}

void History::add(Entry entry) {
    count(entry, +1);
    entries_.push_back(std::move(entry));
}

void History::count(const Entry& entry, int sign) {
    const std::size_t own = own_bytes(entry.project) + entry.label.size() + sizeof entry;
    bytes_ = sign > 0 ? bytes_ + own : bytes_ - own;
    for (const Leaf<Region>& region : entry.project.regions) {
        count_leaf(region.identity(), own_bytes(*region), sign);
        count_leaf(region->matte.identity(), own_bytes(*region->matte), sign);
        std::size_t holdout_bytes = 0;
        for (const MatteSource& holdout : *region->holdouts)
            holdout_bytes += own_bytes(holdout);
        count_leaf(region->holdouts.identity(), holdout_bytes, sign);
        count_leaf(region->zones.identity(), own_bytes(*region->zones), sign);
        count_leaf(region->amendments.identity(), own_bytes(*region->amendments), sign);
    }
}

void History::count_leaf(const void* identity, std::size_t leaf_bytes, int sign) {
    int& uses = leaf_uses_[identity];
    uses += sign;
    if (sign > 0 && uses == 1) bytes_ += leaf_bytes;
    if (uses > 0) return;
    bytes_ -= leaf_bytes;
    leaf_uses_.erase(identity);
}

void History::trim() {
    while (bytes_ > max_bytes_ && at_ > 0) {
        count(entries_.front(), -1);
        entries_.pop_front();
        --at_;
    }
}

}  // namespace weft
