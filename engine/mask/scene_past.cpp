#include "engine/mask/scene_past.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

#include "engine/mask/hidden_part.h"
#include "engine/mask/scene_picture.h"
#include "engine/mask/scene_places.h"
#include "engine/motion/plane_fit.h"

namespace weft {
namespace {

// The block of `size` that a place, px, lies in; empty beyond the frame.
std::optional<Vec2i> block_at(Vec2 place, const SceneScale& scale) {
    const Vec2 b = glm::floor((place + 0.5f) / static_cast<float>(scale.step));
    if (!(b.x >= 0 && b.y >= 0 && b.x < static_cast<float>(scale.size.width) &&
          b.y < static_cast<float>(scale.size.height)))
        return std::nullopt;
    return Vec2i(b);
}

// Whether a block's colour is, to `levels`, that of a block of another picture or of one beside it.
bool is_near(const ImageF3& picture, Vec2i block, const ImageF3& other, Vec2i at, float levels) {
    const Vec3 color = color_at(picture, block.x, block.y);
    if (color_difference(color, color_at(other, at.x, at.y)) < levels) return true;
    for (int y = std::max(0, at.y - 1); y <= std::min(at.y + 1, other.height() - 1); ++y)
        for (int x = std::max(0, at.x - 1); x <= std::min(at.x + 1, other.width() - 1); ++x)
            if (color_difference(color, color_at(other, x, y)) < levels) return true;
    return false;
}

// Steps between frames are right to about a block; but a thin thing that only one of both shows is
// a difference.
bool shows_the_same(const ImageF3& a, Vec2i in_a, const ImageF3& b, Vec2i in_b, float levels) {
    return is_near(a, in_a, b, in_b, levels) && is_near(b, in_b, a, in_a, levels);
}

// Pieces that reach nowhere far from what was found go: there the boundary has been found better
// than by blocks.
void keep_deep(Matte& pieces, const Matte& found) {
    constexpr float kDeep_blocks = 2.5f;
    const cv::Size size(pieces.width(), pieces.height());
    cv::Mat view(size, CV_8U, pieces.data()), outside(size, CV_8U), far, labels;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            outside.at<std::uint8_t>(y, x) = found.at(x, y) == 0 ? 255 : 0;
    cv::distanceTransform(outside, far, cv::DIST_L2, cv::DIST_MASK_5);
    const int count = cv::connectedComponents(view, labels, 8, CV_32S);
    std::vector<bool> deep(static_cast<std::size_t>(count));
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            if (far.at<float>(y, x) > kDeep_blocks)
                deep[static_cast<std::size_t>(labels.at<int>(y, x))] = true;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            if (!deep[static_cast<std::size_t>(labels.at<int>(y, x))]) pieces.at(x, y) = 0;
}

}  // namespace

std::vector<Matte> ScenePast::advance(SceneView now, const SceneScale& scale, float same_levels) {
    std::vector<Matte> late;
    Matte shown = now.sure;  // what all frames so far have shown
    for (SceneView& then : views_) {
        const glm::dmat3 then_from_now = glm::inverse(then.key_from_frame) * now.key_from_frame;
        Matte missing(scale.size);
        for (int y = 0; y < scale.size.height; ++y) {
            for (int x = 0; x < scale.size.width; ++x) {
                if (shown.at(x, y) == 0) continue;
                const auto at = block_at(mapped(then_from_now, scale.middle(x, y)), scale);
                const bool same =
                    at && shows_the_same(now.colors, {x, y}, then.colors, *at, same_levels);
                if (!same) {
                    shown.at(x, y) = 0;
                } else if (then.inside.at(at->x, at->y) == 0) {
                    missing.at(at->x, at->y) = 255;
                }
            }
        }
        // With what has been found so before.
        missing = either_of(then.late, missing);
        keep_deep(missing, then.inside);
        late.push_back(missing == then.late ? Matte() : missing);
        then.late = std::move(missing);
    }
    views_.push_front(std::move(now));
    if (views_.size() > kFrames) views_.pop_back();
    return late;
}

}  // namespace weft
