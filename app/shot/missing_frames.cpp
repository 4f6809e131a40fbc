#include "app/shot/missing_frames.h"

#include <algorithm>

namespace weft {
namespace {

class HeldPlate final : public FrameReader {
  public:
    HeldPlate(std::shared_ptr<const FrameReader> plate, std::vector<int> frames)
        : plate_(std::move(plate)), frames_(std::move(frames)) {}

    const std::vector<int>& frames() const override { return frames_; }
    Size size() const override { return plate_->size(); }
    double fps() const override { return plate_->fps(); }
    PixelDepth depth() const override { return plate_->depth(); }
    bool display_encoded() const override { return plate_->display_encoded(); }
    FileColor color() const override { return plate_->color(); }
    double pixel_aspect() const override { return plate_->pixel_aspect(); }
    std::vector<std::string> warnings() const override { return plate_->warnings(); }
    std::string path_of(int frame) const override { return plate_->path_of(shown_frame(frame)); }
    Expected<PlateFrame> read(int frame) const override { return plate_->read(shown_frame(frame)); }
    Expected<Hash128> stamp(int frame) const override { return plate_->stamp(shown_frame(frame)); }

    int shown_frame(int frame) const override {
        const auto& present = plate_->frames();
        const auto after = std::upper_bound(present.begin(), present.end(), frame);
        return after == present.begin() ? present.front() : *(after - 1);
    }

  private:
    std::shared_ptr<const FrameReader> plate_;
    std::vector<int> frames_;
};

}  // namespace

std::shared_ptr<const FrameReader> with_missing_frames(std::shared_ptr<const FrameReader> plate,
                                                       MissingFrames policy,
                                                       const std::vector<int>& wanted) {
    const std::vector<int>& present = plate->frames();
    if (policy == MissingFrames::kError || present.empty()) return plate;
    // Do not fill gaps of stills, or between distant frame numbers.
    constexpr int kMost = 1 << 20;
    if (present.back() - present.front() >= kMost) return plate;
    std::vector<int> all = wanted;
    for (int frame = present.front(); frame <= present.back(); ++frame)
        all.push_back(frame);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    if (all == present) return plate;
    return std::make_shared<HeldPlate>(std::move(plate), std::move(all));
}

}  // namespace weft
