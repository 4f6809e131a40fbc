#include "bench/baselines/dis_chain.h"

#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace weft {
namespace {

cv::Mat as_mat(ViewU8x3 v) {
    return {v.height(), v.width(), CV_8UC3, const_cast<std::uint8_t*>(v.data()),
            static_cast<std::size_t>(v.stride())};
}

cv::Mat grey_of(ViewU8x3 frame) {
    cv::Mat grey;
    cv::cvtColor(as_mat(frame), grey, cv::COLOR_RGB2GRAY);
    return grey;
}

// OpenCV as its users have it: elsewhere Weft switches its dispatch off for the sake of equal bits.
class Optimized {
  public:
    Optimized() { cv::setUseOptimized(true); }
    ~Optimized() { cv::setUseOptimized(before_); }
    Optimized(const Optimized&) = delete;
    Optimized& operator=(const Optimized&) = delete;

  private:
    bool before_ = cv::useOptimized();
};

}  // namespace

struct DisChain::State {
    cv::Ptr<cv::DISOpticalFlow> dis;
    cv::Mat last, picture;
    cv::Mat first_from_last;  // places, CV_32FC2
};

DisChain::DisChain(ViewU8x3 first, ViewU8x3 picture) : state_(std::make_unique<State>()) {
    const Optimized optimized;
    state_->dis = cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM);
    state_->last = grey_of(first);
    state_->picture = as_mat(picture).clone();
    state_->first_from_last.create(first.height(), first.width(), CV_32FC2);
    for (int y = 0; y < first.height(); ++y) {
        for (int x = 0; x < first.width(); ++x) {
            state_->first_from_last.at<cv::Vec2f>(y, x) = {static_cast<float>(x),
                                                           static_cast<float>(y)};
        }
    }
}

DisChain::~DisChain() = default;
DisChain::DisChain(DisChain&&) noexcept = default;
DisChain& DisChain::operator=(DisChain&&) noexcept = default;

ImageU8x3 DisChain::next(ViewU8x3 frame, ViewU8x1 matte) {
    const Optimized optimized;
    State& s = *state_;
    const cv::Mat now = grey_of(frame);
    cv::Mat places, chained, texture;
    s.dis->calc(now, s.last, places);
    for (int y = 0; y < places.rows; ++y) {
        auto* row = places.ptr<cv::Vec2f>(y);
        for (int x = 0; x < places.cols; ++x)
            row[x] += cv::Vec2f(static_cast<float>(x), static_cast<float>(y));
    }
    cv::remap(s.first_from_last, chained, places, {}, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    cv::remap(s.picture, texture, chained, {}, cv::INTER_LINEAR, cv::BORDER_WRAP);
    ImageU8x3 out(frame.size());
    for (int y = 0; y < out.height(); ++y) {
        const std::uint8_t *old = frame.row(y), *coverage = matte.row(y);
        const auto* fresh = texture.ptr<std::uint8_t>(y);
        std::uint8_t* to = out.row(y);
        for (int k = 0; k < 3 * out.width(); ++k) {
            const int a = coverage[k / 3];
            to[k] = static_cast<std::uint8_t>((a * fresh[k] + (255 - a) * old[k] + 127) / 255);
        }
    }
    s.last = now;
    s.first_from_last = chained;
    return out;
}

}  // namespace weft
