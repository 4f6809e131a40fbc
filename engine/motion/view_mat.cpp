#include "engine/motion/view_mat.h"

#include <opencv2/core.hpp>

namespace weft {
namespace {

template <int C>
cv::Mat mat_of_view(ImageView<const std::uint8_t, C> v) {
    return {v.height(), v.width(), CV_8UC(C), const_cast<std::uint8_t*>(v.data()),
            static_cast<std::size_t>(v.stride())};
}

}  // namespace

cv::Mat as_mat(ViewU8x1 view) {
    return mat_of_view(view);
}

cv::Mat as_mat(ViewU8x3 view) {
    return mat_of_view(view);
}

cv::Mat as_mat(const Matte& matte) {
    return mat_of_view(ViewU8x1(matte));
}

}  // namespace weft
