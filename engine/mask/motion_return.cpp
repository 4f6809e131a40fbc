#include "engine/mask/motion_return.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/mask/signed_distance.h"

namespace weft {
namespace {

constexpr double kLost = 0.1, kSeen = 0.3, kBack = 0.8;  // shares of the usual area
constexpr double kFollowArea = 0.1;                      // of that area, from frame to frame
constexpr double kSmallest = 0.2, kLargest = 2.5;        // shares of it that a piece may have
constexpr double kAhead = 1.5;                           // of any other piece
constexpr double kOverlap = 0.3;                         // with the piece of the frame before
constexpr int kFramesInRow = 3, kTaken = 10;             // in a row, and afterwards
constexpr float kMostMotion = 3, kMostColor = 2;         // log odds
constexpr double kLeastMotion = 0.5;                     // log odds, mean of a piece
constexpr float kSpread_px = 4;                          // of the evidence, at 854×480
constexpr int kEvidenceStep = 2;                         // px: it is gathered on each such pixel

// Log odds, averaged near by.
cv::Mat evidence(const MotionReturnInput& in) {
    const Size size = in.frame.size();
    cv::Mat odds((size.height + kEvidenceStep - 1) / kEvidenceStep,
                 (size.width + kEvidenceStep - 1) / kEvidenceStep, CV_32F);
    parallel_rows(odds.rows, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < odds.cols; ++x) {
                const float motion = in.departs.row(y * kEvidenceStep)[x * kEvidenceStep];
                const float color =
                    in.palette.odds(in.frame.pixel(x * kEvidenceStep, y * kEvidenceStep));
                odds.at<float>(y, x) = std::clamp(motion, -kMostMotion, kMostMotion) +
                                       std::clamp(color, -kMostColor, kMostColor);
            }
        }
    });
    const int r =
        std::max(1, static_cast<int>(std::lround(kSpread_px * in.unit_px / kEvidenceStep)));
    cv::boxFilter(odds, odds, CV_32F, cv::Size(2 * r + 1, 2 * r + 1));
    return odds;
}

// Which piece each of the pixels is of, 0: none. Pieces that nearly touch are one.
cv::Mat pieces_in(const cv::Mat& odds, float unit_px) {
    const int r = std::max(1, static_cast<int>(std::lround(kSpread_px * unit_px / kEvidenceStep)));
    const cv::Mat disc =
        cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(2 * r + 1, 2 * r + 1));
    cv::Mat over = odds > 0, labels;
    cv::morphologyEx(over, over, cv::MORPH_CLOSE, disc);
    cv::connectedComponents(over, labels, 8, CV_32S);
    return labels;
}

}  // namespace

void MotionReturn::Extent::add(int x, int y) {
    middle += Vec2(x, y);
    side += 1;
}

void MotionReturn::Extent::finish() {
    if (side > 0) middle /= side;
    side = std::sqrt(side);
}

MotionReturn::MotionReturn(ViewF1 key_phi) : usual_px_(area_of(key_phi)) {
    for (int y = 0; y < key_phi.height(); ++y) {
        for (int x = 0; x < key_phi.width(); ++x)
            if (key_phi.row(y)[x] > 0) key_.add(x, y);
    }
    key_.finish();
}

bool MotionReturn::lost(ViewF1 phi) const {
    return area_of(phi) < kLost * usual_px_;
}

Vec2 MotionReturn::key_place(int x, int y) const {
    return key_.middle + (Vec2(x, y) - found_.middle) * (key_.side / std::max(1.0f, found_.side));
}

// 0 if there is none, or if another is nearly as good.
int MotionReturn::best_of(const std::vector<Piece>& pieces) const {
    int best = 0;
    double most = 0, next = 0;
    for (std::size_t i = 1; i < pieces.size(); ++i) {
        const Piece& piece = pieces[i];
        if (piece.area_px < kSmallest * usual_px_ || piece.area_px > kLargest * usual_px_) continue;
        // Colour alone is not enough: another board may hang where the first one was.
        if (piece.motion * kEvidenceStep * kEvidenceStep < kLeastMotion * piece.area_px) continue;
        if (piece.weight > most) {
            next = std::exchange(most, piece.weight);
            best = static_cast<int>(i);
        } else {
            next = std::max(next, piece.weight);
        }
    }
    return most < kAhead * next ? 0 : best;
}

// Whether what was found has been there for some frames, by its own motion.
bool MotionReturn::stays(const Matte& found, const FlowField& flow) {
    std::int64_t area = 0, common = 0;
    for (int y = 0; y < found.height(); ++y) {
        for (int x = 0; x < found.width(); ++x) {
            if (found.at(x, y) == 0) continue;
            ++area;
            if (candidate_.empty()) continue;
            const float* d = flow.d.pixel(x, y);
            const int u = x + static_cast<int>(std::lround(d[0]));
            const int v = y + static_cast<int>(std::lround(d[1]));
            common += rect_of(found.size()).contains(u, v) && candidate_.at(u, v) != 0;
        }
    }
    const bool same = static_cast<double>(common) >= kOverlap * static_cast<double>(area);
    frames_ = same ? frames_ + 1 : 1;
    return frames_ >= kFramesInRow;
}

Matte MotionReturn::returned(const MotionReturnInput& in) {
    const double seen = area_of(in.phi);
    if (seen >= kLost * usual_px_ && taken_ == 0) {
        if (seen >= kSeen * usual_px_) usual_px_ += kFollowArea * (seen - usual_px_);
        candidate_ = {};
        frames_ = 0;
        return {};
    }
    // A piece that was taken goes on where the surface was found, another must have the most
    // evidence.
    const bool goes_on = taken_ > 0;
    const cv::Mat odds = evidence(in), labels = pieces_in(odds, in.unit_px);
    double highest = 0;
    cv::minMaxIdx(labels, nullptr, &highest);
    std::vector<Piece> pieces(static_cast<std::size_t>(highest) + 1);
    for (int y = 0; y < labels.rows; ++y) {
        for (int x = 0; x < labels.cols; ++x) {
            Piece& piece = pieces[static_cast<std::size_t>(labels.at<int>(y, x))];
            piece.area_px += kEvidenceStep * kEvidenceStep;
            piece.motion += double{in.departs.row(y * kEvidenceStep)[x * kEvidenceStep]};
            const bool was_found = in.phi.row(y * kEvidenceStep)[x * kEvidenceStep] > 0;
            piece.weight += goes_on ? (was_found ? 1.0 : 0.0) : double{odds.at<float>(y, x)};
        }
    }
    if (goes_on) taken_ = seen > kBack * usual_px_ ? 0 : taken_ - 1;
    const int best = best_of(pieces);
    if (best == 0) {
        candidate_ = {};
        frames_ = 0;
        return {};
    }
    Matte found(in.frame.size());
    found_ = {};
    for (int y = 0; y < found.height(); ++y) {
        for (int x = 0; x < found.width(); ++x) {
            if (labels.at<int>(y / kEvidenceStep, x / kEvidenceStep) != best) continue;
            found.at(x, y) = 255;
            found_.add(x, y);
        }
    }
    found_.finish();
    if (goes_on) return found;
    const bool is_there = stays(found, in.flow);
    candidate_ = is_there ? Matte() : found;
    if (!is_there) return {};
    frames_ = 0;
    taken_ = kTaken;
    return found;
}

}  // namespace weft
