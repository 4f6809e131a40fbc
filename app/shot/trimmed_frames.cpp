#include "app/shot/trimmed_frames.h"

#include <algorithm>
#include <set>
#include <vector>

#include "app/exchange/region_matte_sources.h"
#include "app/shot/frame_plan.h"

namespace weft {
namespace {

class Trimmer {
  public:
    explicit Trimmer(const std::vector<int>& frames)
        : first_(frames.front()), last_(frames.back()) {}

    void trim(Region& region) {
        change_matte_sources(region, [&](MatteSource& matte) { trim(matte); });
        trim_map(region.corrections);
        if (std::any_of(region.reference_frames.begin(), region.reference_frames.end(),
                        [&](int frame) { return !trimmed(frame); }))
            trim_list(region.reference_frames);
    }

    [[nodiscard]] std::vector<int> left_out() const { return {left_out_.begin(), left_out_.end()}; }

  private:
    [[nodiscard]] bool trimmed(int frame) const { return frame < first_ || frame > last_; }

    bool leave_out(int frame) {
        if (trimmed(frame)) left_out_.insert(frame);
        return trimmed(frame);
    }
    void trim_list(std::vector<int>& frames) {
        std::erase_if(frames, [&](int frame) { return leave_out(frame); });
    }
    template <class Map>
    void trim_map(Map& by_frame) {
        std::erase_if(by_frame, [&](const auto& entry) { return leave_out(entry.first); });
    }
    void trim(MatteSource& matte) {
        if (std::all_of(matte.keyframes.begin(), matte.keyframes.end(),
                        [&](const auto& entry) { return trimmed(entry.first); }))
            return;
        trim_map(matte.keyframes);
        trim_map(matte.confirmed);
        trim_list(matte.frozen);
    }

    int first_, last_;
    std::set<int> left_out_;
};

}  // namespace

std::string leave_out_trimmed(Region& region, const FrameReader& plate) {
    if (plate.frames().empty()) return {};
    Trimmer trimmer(plate.frames());
    trimmer.trim(region);
    const std::vector<int> frames = trimmer.left_out();
    if (frames.empty()) return {};
    return "Region '" + region.name + "': what is set for frames " + frames_list(frames) +
           " is left out, because the plate has only " + frames_list(plate.frames()) +
           ". It counts again if the plate has those frames again.";
}

}  // namespace weft
