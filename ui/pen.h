#pragma once
// The pressure of a tablet's pen, from whatever tells it.

#include <map>
#include <memory>
#include <optional>

namespace weft {

/// Asked once a frame, from the window's thread.
class PenSource {
  public:
    virtual ~PenSource() = default;
    /// 0 – 1; nothing while no pen touches the tablet, or there is none.
    [[nodiscard]] virtual std::optional<float> pressure() = 0;
};

/// Makes pressures of what pens report: numbered values of numbered devices.
class PenDevices {
  public:
    /// `device` reports its pressure as value `number`, between `least` and `most`.
    void add(int device, int number, double least, double most);
    void clear() { pens_.clear(), now_.reset(); }
    [[nodiscard]] bool empty() const { return pens_.empty(); }
    /// The values of a device that have changed. Devices that are not pens are skipped.
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
