#include "engine/mask/left_behind.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "engine/mask/nearest_pixel.h"
#include "engine/mask/signed_distance.h"

namespace weft {
namespace {

constexpr float kAsBackground_px = 0.8f, kAsBackgroundShare = 0.05f;  // of the motion
// The shares of pixels that do: of davis_dance-twirl's larger islands 0.97 to 1 (one 0.65 on its
// first frame), of the dancer 0 to 0.28.
constexpr float kStayShare = 0.9f, kMoveShare = 0.5f;
constexpr int kFewestKnown = 12;  // pixels whose motion is known
constexpr float kStayedFrames = 3;
constexpr float kClearly_px = 2;  // outside, on the frame before
constexpr float kNoPast = 0.8f;   // the share of an island that came from there
// Log odds of the palette. Pieces of a coat that a shade had left, taken for a sleeve, have -0.2
// and 0.3; what comes back from behind something 1.3 (a ball) and 3.5 to 3.8 (a drawn banner).
constexpr double kOwnColors = 1;
constexpr float kCell_px = 4;          // in which places of the keyframe are counted
constexpr float kMissingShare = 0.5f;  // of an island's pixels; with less missing it is another's
// 8-bit levels of difference from the keyframe. Those islands have 16 to 250; what was painted and
// is only cut off by something in front of it looks as it did.
constexpr float kChanged_levels = 10;

// A connected part of the matte.
struct Part {
    int size = 0, known = 0, with_background = 0, from_outside = 0, newcomers = 0;
    float frames = 0;       // that it has stayed, the most of any of its pixels
    double odds = 0;        // of the palette, for the surface, sum
    double difference = 0;  // from the keyframe, sum, if it is doubtful
    bool missed = true;     // may be a part of the surface that is missing

    [[nodiscard]] bool is_measured() const { return known >= kFewestKnown; }
    [[nodiscard]] float share() const {
        return static_cast<float>(with_background) / static_cast<float>(known);
    }
    [[nodiscard]] bool has_stayed() const { return frames >= kStayedFrames; }
    [[nodiscard]] bool mostly(int pixels) const {
        return size >= kFewestKnown &&
               static_cast<float>(pixels) >= kNoPast * static_cast<float>(size);
    }
    [[nodiscard]] bool came() const { return mostly(newcomers); }
    [[nodiscard]] bool has_no_past() const {
        return (mostly(from_outside) && odds < kOwnColors * size) || (came() && !missed);
    }
    [[nodiscard]] bool is_doubtful() const { return has_stayed() || has_no_past(); }
    [[nodiscard]] bool is_foreign() const {
        return is_doubtful() && difference > static_cast<double>(kChanged_levels) * size;
    }
};

// Difference of a pixel and the most similar one around its place on the keyframe; where that is
// not the surface, as much as there can be.
double key_difference(const IslandInput& in, int x, int y) {
    const float* k = in.key_from_cur.pixel(x, y);
    const int kx = static_cast<int>(std::lround(k[0])), ky = static_cast<int>(std::lround(k[1]));
    const std::uint8_t* c = in.frame.pixel(x, y);
    int least = 3 * 255;
    for (int v = std::max(0, ky - 1); v <= std::min(in.key_frame.height() - 1, ky + 1); ++v) {
        for (int u = std::max(0, kx - 1); u <= std::min(in.key_frame.width() - 1, kx + 1); ++u) {
            if (in.key_phi.row(v)[u] <= 0) continue;
            const std::uint8_t* p = in.key_frame.pixel(u, v);
            least = std::min(least,
                             std::abs(c[0] - p[0]) + std::abs(c[1] - p[1]) + std::abs(c[2] - p[2]));
        }
    }
    return least / 3.0;
}

bool moves_with_background(const IslandInput& in, int x, int y) {
    const float *d = in.flow.d.pixel(x, y), *b = in.background_motion.pixel(x, y);
    return std::hypot(d[0] - b[0], d[1] - b[1]) <
           kAsBackground_px * in.unit_px + kAsBackgroundShare * std::hypot(b[0], b[1]);
}

// Labels from 1 on; 0 is outside.
int label_parts(ViewF1 phi, cv::Mat& labels) {
    cv::Mat inside(phi.height(), phi.width(), CV_8U);
    for (int y = 0; y < phi.height(); ++y) {
        for (int x = 0; x < phi.width(); ++x)
            inside.at<std::uint8_t>(y, x) = phi.row(y)[x] > 0 ? 1 : 0;
    }
    return cv::connectedComponents(inside, labels, 4, CV_32S);
}

// How many pixels of this frame the painted surface would fill beyond those that are seen of it.
float missing_pixels(const IslandInput& in) {
    const int cell = std::max(2, static_cast<int>(std::lround(kCell_px * in.unit_px)));
    const int w = (in.key_phi.width() + cell - 1) / cell;
    const int h = (in.key_phi.height() + cell - 1) / cell;
    cv::Mat seen(h, w, CV_8U, cv::Scalar(0));
    int seen_px = 0;
    for (int y = 0; y < in.phi.height(); ++y) {
        for (int x = 0; x < in.phi.width(); ++x) {
            if (in.phi.row(y)[x] <= 0 || in.entered.at(x, y) != 0) continue;
            ++seen_px;
            const float* k = in.key_from_cur.pixel(x, y);
            const Vec2i at = nearest_pixel({k[0], k[1]}) / cell;
            if (at.x >= 0 && at.y >= 0 && at.x < w && at.y < h)
                seen.at<std::uint8_t>(at.y, at.x) = 1;
        }
    }
    // What is only stretched is not missing.
    cv::morphologyEx(seen, seen, cv::MORPH_CLOSE, cv::Mat());
    int painted = 0, found = 0;
    for (int j = 0; j < h; ++j) {
        for (int i = 0; i < w; ++i) {
            const int x = std::min(i * cell + cell / 2, in.key_phi.width() - 1);
            const int y = std::min(j * cell + cell / 2, in.key_phi.height() - 1);
            if (in.key_phi.row(y)[x] <= 0) continue;
            ++painted;
            found += seen.at<std::uint8_t>(j, i);
        }
    }
    if (found == 0) return static_cast<float>(painted * cell * cell);
    return static_cast<float>(painted - found) * static_cast<float>(seen_px) /
           static_cast<float>(found);
}

// `frames`: of the frame before.
std::vector<Part> measure(const IslandInput& in, const cv::Mat& labels, int count, ViewF1 frames) {
    std::vector<Part> parts(static_cast<std::size_t>(count));
    for (int y = 0; y < labels.rows; ++y) {
        for (int x = 0; x < labels.cols; ++x) {
            const int label = labels.at<int>(y, x);
            if (label == 0) continue;
            Part& part = parts[static_cast<std::size_t>(label)];
            ++part.size;
            const float* d = in.flow.d.pixel(x, y);
            if (!frames.empty()) {
                part.frames =
                    std::max(part.frames, sample_bilinear(frames, static_cast<float>(x) + d[0],
                                                          static_cast<float>(y) + d[1]));
            }
            part.odds += static_cast<double>(in.palette.odds(in.frame.pixel(x, y)));
            // Where it was, as far as motion can be told: an island that appears has none.
            const float was = sample_bilinear(in.prev_phi, static_cast<float>(x) + d[0],
                                              static_cast<float>(y) + d[1]);
            part.from_outside += was < -kClearly_px * in.unit_px;
            part.newcomers += in.entered.at(x, y) != 0;
            if (in.flow.valid.row(y)[x] == 0) continue;
            ++part.known;
            part.with_background += moves_with_background(in, x, y);
        }
    }
    return parts;
}

void compare_with_key(const IslandInput& in, const cv::Mat& labels, std::vector<Part>& parts) {
    for (int y = 0; y < labels.rows; ++y) {
        for (int x = 0; x < labels.cols; ++x) {
            Part& part = parts[static_cast<std::size_t>(labels.at<int>(y, x))];
            if (part.is_doubtful()) part.difference += key_difference(in, x, y);
        }
    }
}

}  // namespace

Matte LeftBehind::advance(const IslandInput& in) {
    cv::Mat labels;
    const int count = label_parts(in.phi, labels);
    if (count <= 2) {  // in one piece, or not there
        frames_ = {};
        return {};
    }
    std::vector<Part> parts = measure(in, labels, count, frames_);
    const auto largest = std::max_element(
        parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.size < b.size; });
    const bool apart = largest->is_measured() && largest->share() < kMoveShare;
    for (Part& part : parts) {
        if (apart && part.is_measured())
            part.frames = part.share() > kStayShare ? part.frames + 1 : 0;
    }
    largest->frames = 0;
    largest->from_outside = largest->newcomers = 0;
    if (std::any_of(parts.begin(), parts.end(), [](const Part& p) { return p.came(); })) {
        const float missing = missing_pixels(in);
        for (Part& part : parts)
            part.missed = missing >= kMissingShare * static_cast<float>(part.size);
    }
    if (std::any_of(parts.begin(), parts.end(), [](const Part& p) { return p.is_doubtful(); }))
        compare_with_key(in, labels, parts);
    const bool any =
        std::any_of(parts.begin(), parts.end(), [](const Part& p) { return p.is_foreign(); });
    frames_ = ImageF1(in.phi.size());
    Matte out(any ? in.phi.size() : Size{});
    for (int y = 0; y < labels.rows; ++y) {
        for (int x = 0; x < labels.cols; ++x) {
            const Part& part = parts[static_cast<std::size_t>(labels.at<int>(y, x))];
            frames_.at(x, y) = part.frames;
            if (part.is_foreign()) out.at(x, y) = 255;
        }
    }
    return out;
}

}  // namespace weft
