#include "engine/pipeline/region_shapes.h"

#include <algorithm>
#include <limits>

#include "engine/core/parallel.h"
#include "engine/mask/shape_matte.h"

namespace weft {
namespace {

constexpr double kLeastAreaPx = 12;

Expected<OutlinedFrame> outlined(const RegionMotion& motion, const ShapedFrame& frame,
                                 const ShapedFrame& last, const ShapedFrame& reference) {
    OutlinedFrame out;
    if (!frame.empty) {
        WEFT_TRY(matte, motion.visible(frame.shown));
        out.outlines = outlines_of_matte(matte, kLeastAreaPx);
        if (out.outlines.empty()) out.outlines = outlines_of_matte(matte, 0);
    }
    WEFT_TRY(from_last, motion.between(last.shown, frame.shown));
    out.from_last = std::move(from_last);
    WEFT_TRY(from_reference, motion.between(reference.shown, frame.shown));
    out.from_reference = std::move(from_reference);
    return out;
}

// The distances from an outline's points to the shapes of a frame, added up.
struct ShapeDistance {
    double sum = 0;
    std::size_t count = 0;
    [[nodiscard]] float mean() const {
        return count > 0 ? static_cast<float>(sum / static_cast<double>(count)) : 0.0f;
    }
};

ShapeDistance distance_to_shapes(const std::vector<MatteOutline>& outlines,
                                 const std::vector<MatteShape>& shapes, int frame, Size picture) {
    std::vector<OutlinePath> drawn;
    for (const MatteShape& shape : shapes)
        if (const auto key = shape.keys.find(frame); key != shape.keys.end())
            drawn.emplace_back(outline_of(key->second));
    ShapeDistance out;
    for (const MatteOutline& outline : outlines) {
        for (const Vec2 p : outline.path.points()) {
            // What lies outside of the picture nobody sees.
            if (p.x < 0 || p.y < 0 || p.x > static_cast<float>(picture.width) ||
                p.y > static_cast<float>(picture.height))
                continue;
            float least = std::numeric_limits<float>::infinity();
            for (const OutlinePath& path : drawn)
                least = std::min(least, path.nearest(p).distance_px);
            out.sum += static_cast<double>(least);
            ++out.count;
        }
    }
    return out;
}

}  // namespace

Expected<RegionShapes> region_shapes(const RegionMotion& motion, const ShapedFrame& reference,
                                     const std::vector<ShapedFrame>& frames) {
    std::vector<ShapedFrame> all = frames;
    const auto place =
        std::lower_bound(all.begin(), all.end(), reference.frame,
                         [](const ShapedFrame& entry, int frame) { return entry.frame < frame; });
    const auto start = static_cast<std::size_t>(place - all.begin());
    const bool extra = place == all.end() || place->frame != reference.frame;
    if (extra) all.insert(place, reference);
    std::vector<OutlinedFrame> outlines(all.size());
    WEFT_CHECK_OK(parallel_try(all.size(), [&](std::size_t k) -> Status {
        const std::size_t last = k == start ? k : k > start ? k - 1 : k + 1;
        WEFT_TRY(found, outlined(motion, all[k], all[last], reference));
        outlines[k] = std::move(found);
        return {};
    }));
    RegionShapes out;
    for (MatteShape& found : matte_shapes(outlines, start, motion.size())) {
        MatteShape shape;
        shape.level = found.level;
        for (auto& [k, key] : found.keys) {
            const auto at = static_cast<std::size_t>(k);
            if (!(extra && at == start)) shape.keys[all[at].frame] = std::move(key);
        }
        if (!shape.keys.empty()) out.shapes.push_back(std::move(shape));
    }
    if (out.shapes.empty())
        return fail(ErrorCode::kRenderFailed, "No frame of the export shows it.");
    std::stable_sort(out.shapes.begin(), out.shapes.end(), [](const auto& a, const auto& b) {
        return a.level != b.level ? a.level < b.level
                                  : a.keys.begin()->first < b.keys.begin()->first;
    });
    std::vector<ShapeDistance> off(all.size());
    parallel_for(all.size(), [&](std::size_t k) {
        if (!(extra && k == start))
            off[k] =
                distance_to_shapes(outlines[k].outlines, out.shapes, all[k].frame, motion.size());
    });
    ShapeDistance sum;
    for (const ShapeDistance& each : off) {
        sum.sum += each.sum;
        sum.count += each.count;
        out.off_worst_px = std::max(out.off_worst_px, each.mean());
    }
    out.off_mean_px = sum.mean();
    return out;
}

}  // namespace weft
