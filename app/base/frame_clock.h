#pragma once
// Which part of a frame of the interface took how long: the watchdog behind "nothing on the
// window's thread takes longer than 30 ms".

#include <string>
#include <vector>

namespace weft {

/// Belongs to one thread. Costs two clock readings a part, and nothing while it is off.
class FrameClock {
  public:
    struct Part {
        const char* name = "";
        double wall_ms = 0;
        double processor_ms = 0;  ///< Of this thread: what is missing to `wall_ms` it waited.
    };

    explicit FrameClock(bool on) : on_(on) {}
    [[nodiscard]] bool on() const { return on_; }
    void begin();
    /// What comes until the next call, or end(), counts under this name (a literal).
    void enter(const char* part);
    void end();
    /// Of the frame that has ended, in the order of the first entries.
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
