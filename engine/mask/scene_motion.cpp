#include "engine/mask/scene_motion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "engine/core/block_means.h"
#include "engine/core/geometry.h"
#include "engine/core/parallel.h"
#include "engine/motion/photometric_register.h"
#include "engine/motion/plane_fit.h"

namespace weft {
namespace {

constexpr std::size_t kFewest = 24;  // places

// Whether a plane leads more than a share `most` of the places to within `near` pixels.
SceneMotion motion_of(const std::vector<PlacePair>& pairs, const glm::dmat3& plane, float near,
                      double most) {
    if (pairs.size() < kFewest) return SceneMotion::kUnknown;
    const auto hits = std::count_if(pairs.begin(), pairs.end(), [&](const PlacePair& pair) {
        return glm::length(mapped(plane, pair.from) - pair.to) < near;
    });
    const bool rests = static_cast<double>(hits) > most * static_cast<double>(pairs.size());
    return rests ? SceneMotion::kRests : SceneMotion::kMoves;
}

Matte moving_blocks(const FlowField& flow, const glm::dmat3& plane, float near,
                    const SceneScale& scale) {
    constexpr int kMajority = 5;
    cv::Mat moving(scale.size.height, scale.size.width, CV_8U);
    parallel_rows(scale.size.height, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < scale.size.width; ++x) {
                const Vec2i at = scale.pixel(x, y);
                const float* d = flow.d.pixel(at.x, at.y);
                const Vec2 p(at);
                const float off = glm::length(mapped(plane, p) - p - Vec2(d[0], d[1]));
                const bool moves = flow.valid.at(at.x, at.y) != 0 && off > near;
                moving.at<std::uint8_t>(y, x) = moves ? 255 : 0;
            }
        }
    });
    Matte out(scale.size);
    cv::Mat smooth(moving.rows, moving.cols, CV_8U, out.data());
    cv::medianBlur(moving, smooth, kMajority);
    return out;
}

Matte codes_of(const ImageF1& luma) {
    Matte out(luma.size());
    std::transform(luma.data(), luma.data() + luma.size_bytes() / sizeof(float), out.data(),
                   [](float v) { return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 255.0f)); });
    return out;
}

}  // namespace

SceneScale::SceneScale(Size frame)
    : step(std::max(1, static_cast<int>(std::lround(frame.width / 427.0)))),
      size(blocks_of(frame, step)),
      unit_px(static_cast<float>(frame.width) / 854.0f) {}

Vec2 SceneScale::middle(int x, int y) const {
    return static_cast<float>(step) * Vec2(x, y) + 0.5f * static_cast<float>(step - 1);
}

// The last block may be cut off, but begins in the frame.
Vec2i SceneScale::pixel(int x, int y) const {
    return {step * x, step * y};
}

SceneStep scene_step(const FlowField& prev_from_cur, ViewF1 phi, const SceneScale& scale) {
    constexpr double kOfSurface = 0.6, kOfSurroundings = 0.4;
    constexpr float kStill_px = 1, kClear_px = 2;
    const int stride = 4 * scale.step;
    std::vector<PlacePair> surface, around;
    for (int y = stride / 2; y < phi.height(); y += stride) {
        for (int x = stride / 2; x < phi.width(); x += stride) {
            const float depth = phi.row(y)[x];
            if (std::abs(depth) < kClear_px || prev_from_cur.valid.at(x, y) == 0) continue;
            const float* d = prev_from_cur.d.pixel(x, y);
            const Vec2 p(x, y);
            (depth > 0 ? surface : around).push_back({p, p + Vec2(d[0], d[1])});
        }
    }
    SceneStep out;
    std::vector<PlacePair> all = surface;
    all.insert(all.end(), around.begin(), around.end());
    if (all.size() < kFewest) return out;
    out.prev_from_cur = fit_plane(all);
    const float near = kStill_px * scale.unit_px;
    out.surface = motion_of(surface, out.prev_from_cur, near, kOfSurface);
    out.around = motion_of(around, out.prev_from_cur, near, kOfSurroundings);
    out.moving = moving_blocks(prev_from_cur, out.prev_from_cur, near, scale);
    return out;
}

std::optional<glm::dmat3> expected_from_cur(const ImageF1& expected, const ImageF1& luma,
                                            const Matte& known, const SceneScale& scale) {
    constexpr int kLattice_px = 16, kSamples = 12000;
    constexpr double kAgrees = 0.6;
    RegistrationOptions options;
    options.samples = kSamples;
    const PlanarRegistration found =
        register_planar(registration_picture(codes_of(expected), known),
                        registration_picture(codes_of(luma), known),
                        LatticeField(scale.size, kLattice_px), options);
    if (!found.found || found.fit.share < kAgrees) return std::nullopt;
    std::vector<PlacePair> pairs;
    const auto step = static_cast<float>(scale.step);
    for (int y = 0; y < scale.size.height; y += kLattice_px) {
        for (int x = 0; x < scale.size.width; x += kLattice_px) {
            const Vec2 p = Vec2(x, y) + 0.5f;
            pairs.push_back({p * step - 0.5f, (p + found.anchor_from_cur.at(p)) * step - 0.5f});
        }
    }
    return fit_plane(pairs);
}

}  // namespace weft
