#pragma once
// Views of codes as OpenCV takes them.

#include "engine/core/image.h"

namespace cv {
class Mat;
}

namespace weft {

/// The same pixels, which OpenCV must not write.
[[nodiscard]] cv::Mat as_mat(ViewU8x1 view);
[[nodiscard]] cv::Mat as_mat(ViewU8x3 view);
[[nodiscard]] cv::Mat as_mat(const Matte& matte);

}  // namespace weft
