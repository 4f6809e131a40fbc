#pragma once
// The messages to the user.

#include <string>
#include <vector>

#include "app/session/session_view.h"

namespace weft {

/// Belongs to one thread.
class Notices {
  public:
    /// A repeated notice replaces the earlier one; the oldest of too many are dropped.
    void add(NoticeKind kind, std::string text);
    /// Says that something cannot be done as things are: on this frame, with this region.
    void refuse(std::string text);
    /// Removes the refusals of another state of things than `now`, whatever it is a name of; those
    /// that are new are of this one. Call it in every update.
    void keep_refusals_of(const std::string& now);
    void dismiss(int notice);
    /// Sets the time of the notices that follow, s.
    void set_time(double now_s) { now_s_ = now_s; }
    /// Removes those that were shown long enough. Errors stay until they are dismissed.
    void expire();
    [[nodiscard]] const std::vector<Notice>& all() const { return all_; }

  private:
    std::vector<Notice> all_;
    int last_ = 0;
    double now_s_ = 0;
};

}  // namespace weft
