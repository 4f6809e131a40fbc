#include "engine/mask/background_motion.h"

#include <array>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/mask/piece_motion.h"
#include "engine/mask/signed_distance.h"

namespace weft {
namespace {

constexpr int kSampleStep = 4;                  // motion is sampled at every fourth pixel
constexpr std::array<int, 2> kRadii = {3, 12};  // of local corrections, in steps
constexpr std::array<float, 2> kSay = {1.0f, 0.05f};
constexpr float kPlaneWeight = 0.01f;  // weight of "no correction" against them

std::vector<PlacePair> samples_of(ViewF1 phi, const FlowField& flow, float clearance_px) {
    std::vector<PlacePair> samples;
    for (int y = kSampleStep / 2; y < phi.height(); y += kSampleStep) {
        for (int x = kSampleStep / 2; x < phi.width(); x += kSampleStep) {
            if (flow.valid.row(y)[x] == 0) continue;
            const float* d = flow.d.pixel(x, y);
            if (sample_bilinear(phi, static_cast<float>(x) + d[0], static_cast<float>(y) + d[1]) >
                -clearance_px) {
                continue;
            }
            samples.push_back(pair_at(flow, x, y));
        }
    }
    return samples;
}

// What the plane misses, averaged near by, on a grid of every kSampleStep-th pixel.
ImageF2 local_corrections(const glm::dmat3& plane, const std::vector<PlacePair>& samples,
                          Size size) {
    const int w = (size.width + kSampleStep - 1) / kSampleStep,
              h = (size.height + kSampleStep - 1) / kSampleStep;
    cv::Mat misses(h, w, CV_32FC3, cv::Scalar::all(0));
    for (const PlacePair& s : samples) {
        const Vec2 miss = s.to - mapped(plane, s.from);
        misses.at<cv::Vec3f>(static_cast<int>(s.from.y) / kSampleStep,
                             static_cast<int>(s.from.x) / kSampleStep) =
            cv::Vec3f(1, miss.x, miss.y);
    }
    ImageF2 corrections(w, h);
    std::array<cv::Mat, kRadii.size()> means;
    for (std::size_t i = 0; i < kRadii.size(); ++i) {
        const int side = 2 * kRadii[i] + 1;
        cv::boxFilter(misses, means[i], CV_32F, cv::Size(side, side), cv::Point(-1, -1), true,
                      cv::BORDER_REPLICATE);
    }
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            cv::Vec3f sum(kPlaneWeight, 0, 0);
            for (std::size_t i = 0; i < kRadii.size(); ++i)
                sum += kSay[i] * means[i].at<cv::Vec3f>(y, x);
            corrections.pixel(x, y)[0] = sum[1] / sum[0];
            corrections.pixel(x, y)[1] = sum[2] / sum[0];
        }
    }
    return corrections;
}

}  // namespace

ImageF2 background_motion(ViewF1 prev_phi, const FlowField& prev_from_cur, float clearance_px) {
    const Size size = prev_phi.size();
    const std::vector<PlacePair> samples = samples_of(prev_phi, prev_from_cur, clearance_px);
    const glm::dmat3 plane = fit_piece(samples);
    const ImageF2 corrections = local_corrections(plane, samples, size);
    ImageF2 motion(size);
    parallel_rows(size.height, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < size.width; ++x) {
                const Vec2 d =
                    moved_by(plane, Vec2(x, y)) +
                    sample_bilinear(corrections, static_cast<float>(x) / kSampleStep - 0.5f,
                                    static_cast<float>(y) / kSampleStep - 0.5f);
                motion.pixel(x, y)[0] = d.x;
                motion.pixel(x, y)[1] = d.y;
            }
        }
    });
    return motion;
}

}  // namespace weft
