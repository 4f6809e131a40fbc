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
