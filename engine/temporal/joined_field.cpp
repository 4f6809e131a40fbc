#include "engine/temporal/joined_field.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace weft {
namespace {

// Everywhere the owner of the nearest pixel that has one; without any, 0.
Image<std::uint8_t, 1> nearest_owner(const Image<std::uint8_t, 1>& owner) {
    const Size size = owner.size();
    const cv::Mat of(size.height, size.width, CV_8UC1, const_cast<std::uint8_t*>(owner.data()));
    cv::Mat distance, nearest;
    cv::distanceTransform(of == kNobody, distance, nearest, cv::DIST_L2, 5, cv::DIST_LABEL_PIXEL);
    std::vector<std::uint8_t> named(
        static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) + 1, 0);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            if (owner.at(x, y) != kNobody)
                named[static_cast<std::size_t>(nearest.at<int>(y, x))] = owner.at(x, y);
        }
    }
    Image<std::uint8_t, 1> out(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x)
            out.at(x, y) = named[static_cast<std::size_t>(nearest.at<int>(y, x))];
    }
    return out;
}

}  // namespace

LatticeField joined_field(const std::vector<LatticeField>& fields,
                          const Image<std::uint8_t, 1>& owner, int spacing_px) {
    const Image<std::uint8_t, 1> nearest = nearest_owner(owner);
    std::vector<LatticeField> fine;
    fine.reserve(fields.size());
    for (const LatticeField& field : fields)
        fine.push_back(field.resampled(spacing_px));
    LatticeField out(owner.size(), spacing_px);
    for (int j = 0; j < out.nodes().height(); ++j) {
        for (int i = 0; i < out.nodes().width(); ++i) {
            const Vec2 p = out.node_position(i, j);
            const int x = std::clamp(static_cast<int>(p.x), 0, owner.width() - 1);
            const int y = std::clamp(static_cast<int>(p.y), 0, owner.height() - 1);
            out.set_node(i, j, fine[nearest.at(x, y)].node(i, j));
        }
    }
    return out;
}

}  // namespace weft
