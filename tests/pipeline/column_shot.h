#pragma once
// A shot of a column, and regions with its form.

#include <cmath>
#include <utility>
#include <vector>

#include "tests/pipeline/memory_shot.h"

namespace weft {

/// A column whose axis is upright: it turns away to both sides of x = 80 on frame 1, and pans with
/// the wall.
class Column : public MemoryShot {
  public:
    Column() : MemoryShot(make_wall()) {}
    bool constant = false;
    int missing = 0;  // a frame without the pass

    [[nodiscard]] Expected<ImageF3> positions(int region, int frame) const override {
        if (frame == missing) return MemoryShot::positions(region, frame);
        const Vec2 panned = wall_moved({0, 0}, frame) - wall_moved({0, 0}, kFirst);
        ImageF3 out(kShotSize, 1.0f);
        for (int y = 0; !constant && y < kShotSize.height; ++y) {
            for (int x = 0; x < kShotSize.width; ++x) {
                const float s = (static_cast<float>(x) + 0.5f - panned.x - 80) / 80;
                float* p = out.pixel(x, y);
                p[0] = s, p[1] = (static_cast<float>(y) - panned.y) / 80;
                p[2] = std::sqrt(1 - s * s);  // NaN beyond the column
            }
        }
        return out;
    }
};

inline RegionPlan formed(std::vector<int> evidence = {kFirst}) {
    RegionPlan region = make_region(flat_texture({0.5f, 0.5f, 0.5f}));
    region.form_from = RegionPlan::FormFrom::kPositions;
    region.form_evidence = std::move(evidence);
    return region;
}

/// The same with a drawn form.
inline RegionPlan drawn(FormGuide guide) {
    RegionPlan region = formed();
    region.form_from = RegionPlan::FormFrom::kShape;
    region.form_fov_deg = 5;  // almost without perspective
    region.form_guides = {std::move(guide)};
    return region;
}

}  // namespace weft
