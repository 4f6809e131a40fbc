#pragma once
// Measures how long each part of an interface frame takes. It enforces the rule that nothing on the
// window's thread takes longer than 30 ms.

#include <string>
#include <vector>

namespace weft {

/// Belongs to one thread. Costs two clock readings per part, and nothing while disabled.
class FrameClock {
  public:
    struct Part {
        const char* name = "";
        double wall_ms = 0;
        double processor_ms = 0;  ///< CPU time of this thread; the rest of `wall_ms` it waited.
    };

    explicit FrameClock(bool on) : on_(on) {}
    [[nodiscard]] bool on() const { return on_; }
    void begin();
    /// Counts the time until the next call or end() under this name (a string literal).
    void enter(const char* part);
    void end();
    /// The parts of the last completed frame, in the order in which they were first entered.
    [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }
    [[nodiscard]] double wall_ms() const;
    /// "A frame took 51 ms: texture drawer 40 ms (3 ms of work), …": the parts above a millisecond,
    /// the longest first.
    [[nodiscard]] std::string text() const;

  private:
    void close();

    bool on_;
    std::vector<Part> parts_;
    int open_ = -1;
    double wall_from_ms_ = 0, processor_from_ms_ = 0;
};

}  // namespace weft
