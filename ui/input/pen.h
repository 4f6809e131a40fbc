#pragma once
// Pen pressure of a tablet, from any source.

#include <map>
#include <memory>
#include <optional>

namespace weft {

/// Queried once per frame from the window's thread.
class PenSource {
  public:
    virtual ~PenSource() = default;
    /// Pressure, 0–1; nothing if no pen touches the tablet.
    [[nodiscard]] virtual std::optional<float> pressure() = 0;
};

/// Converts raw device values to pressure.
class PenDevices {
  public:
    /// Registers that `device` reports pressure as value `number`, from `least` to `most`.
    void add(int device, int number, double least, double most);
    void clear() { pens_.clear(), now_.reset(); }
    [[nodiscard]] bool empty() const { return pens_.empty(); }
    /// Reports changed values of a device. Devices that are not pens are ignored.
    void report(int device, const std::map<int, double>& values);
    /// As PenSource::pressure().
    [[nodiscard]] std::optional<float> pressure() const { return now_; }

  private:
    struct Pen {
        int number = 0;
        double least = 0, most = 1;
    };
    std::map<int, Pen> pens_;
    std::optional<float> now_;
};

}  // namespace weft
