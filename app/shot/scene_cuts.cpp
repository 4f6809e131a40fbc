#include "app/shot/scene_cuts.h"

#include <algorithm>
#include <cmath>

#include "engine/core/luma.h"

namespace weft {
namespace {

constexpr float kLeastPlace = 0.10f;  // mean difference of the cells, relative to white
constexpr float kLeastShare = 0.30f;  // share of the histogram that changes
constexpr float kOverOthers = 3.0f;   // multiple of the median change

}  // namespace

void CutWatch::look_at(int frame, ViewF3 plate, bool display_encoded) {
    {
        const std::lock_guard lock(mutex_);
        if (looks_.contains(frame)) return;
    }
    Look look;
    std::array<int, kColumns * kRows> counts{};
    const int step = std::max(1, plate.width() / 160);
    float total = 0;
    for (int y = step / 2; y < plate.height(); y += step) {
        for (int x = step / 2; x < plate.width(); x += step) {
            const float* p = plate.pixel(x, y);
            float luma = luma_709(p);
            luma = luma > 0 ? std::min(luma, 1.0f) : 0.0f;  // NaN becomes 0
            if (!display_encoded) luma = std::sqrt(luma);
            const auto cell = static_cast<std::size_t>(y * kRows / plate.height() * kColumns +
                                                       x * kColumns / plate.width());
            look.means[cell] += luma;
            ++counts[cell];
            const int bin = std::min(kBins - 1, static_cast<int>(luma * kBins));
            look.shares[static_cast<std::size_t>(bin)] += 1;
            total += 1;
        }
    }
    for (std::size_t k = 0; k < counts.size(); ++k)
        look.means[k] /= static_cast<float>(std::max(1, counts[k]));
    for (float& share : look.shares)
        share /= std::max(1.0f, total);
    const std::lock_guard lock(mutex_);
    looks_.emplace(frame, look);
}

std::vector<int> CutWatch::cuts() const {
    const std::lock_guard lock(mutex_);
    struct Step {
        int frame;
        float place, share;
    };
    std::vector<Step> steps;
    for (auto at = looks_.begin(); at != looks_.end(); ++at) {
        const auto before = looks_.find(at->first - 1);
        if (before == looks_.end()) continue;
        Step step{at->first, 0, 0};
        for (std::size_t k = 0; k < at->second.means.size(); ++k)
            step.place += std::abs(at->second.means[k] - before->second.means[k]);
        step.place /= static_cast<float>(at->second.means.size());
        for (std::size_t k = 0; k < at->second.shares.size(); ++k)
            step.share += std::abs(at->second.shares[k] - before->second.shares[k]) / 2;
        steps.push_back(step);
    }
    if (steps.empty()) return {};
    std::vector<float> places;
    for (const Step& step : steps)
        places.push_back(step.place);
    const auto middle = places.begin() + static_cast<std::ptrdiff_t>((places.size() - 1) / 2);
    std::nth_element(places.begin(), middle, places.end());
    const float usual = places.size() > 2 ? *middle : 0.0f;
    std::vector<int> out;
    for (const Step& step : steps) {
        if (step.place > kLeastPlace && step.share > kLeastShare &&
            step.place > kOverOthers * usual)
            out.push_back(step.frame);
    }
    return out;
}

}  // namespace weft
