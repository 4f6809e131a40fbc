#include "engine/mask/part_return.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/mask/signed_distance.h"

namespace weft {
namespace {

// Shares of the usual area: below the first too little is seen, above the second enough.
constexpr double kPartLost = 0.1, kPartWhole = 0.6;
// Of that area, from frame to frame. Slower, and a surface that turns or goes away passes for half
// hidden; so only a sudden loss counts.
constexpr double kFollowArea = 0.1;
constexpr double kLargestPart = 1.2;      // share of it that a piece may have
constexpr double kMostOfSeen = 0.6;       // of what is seen lies in the piece
constexpr double kLeastPartMotion = 0.5;  // log odds, mean of a piece
constexpr int kPartFramesInRow = 3;
// The higher the odds, the closer a piece lies to the surface: measured motion spreads over edges.
constexpr int kOddsSteps = 8;
constexpr float kOddsStep = 0.5f;

// Whether the surface leaves the picture: what is beyond the border is not lost.
bool leaves(ViewF1 phi) {
    constexpr double kOfBorder = 0.02;
    const int w = phi.width(), h = phi.height();
    int inside = 0;
    for (int x = 0; x < w; ++x)
        inside += (phi.row(0)[x] > 0) + (phi.row(h - 1)[x] > 0);
    for (int y = 0; y < h; ++y)
        inside += (phi.row(y)[0] > 0) + (phi.row(y)[w - 1] > 0);
    return inside > kOfBorder * (w + h);
}

struct Piece {
    double area_px = 0, found_px = 0;
    double motion = 0;  // sum of the log odds of its motion
};

std::vector<Piece> measure(const MotionReturnInput& in, const PieceLabels& labels) {
    constexpr int kStep = kMotionEvidenceStep;
    std::vector<Piece> pieces(1);
    for (int y = 0; y < labels.height(); ++y) {
        for (int x = 0; x < labels.width(); ++x) {
            const auto label = static_cast<std::size_t>(labels.at(x, y));
            if (label >= pieces.size()) pieces.resize(label + 1);
            Piece& piece = pieces[label];
            piece.area_px += kStep * kStep;
            piece.motion += kStep * kStep * double{in.departs.row(y * kStep)[x * kStep]};
            piece.found_px += in.phi.row(y * kStep)[x * kStep] > 0 ? kStep * kStep : 0;
        }
    }
    return pieces;
}

Matte of_piece(const PieceLabels& labels, std::int32_t piece, Size frame) {
    Matte out(frame);
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            if (labels.at(x / kMotionEvidenceStep, y / kMotionEvidenceStep) == piece)
                out.at(x, y) = 255;
        }
    }
    return out;
}

// The largest piece around what is seen that is not larger than the surface; empty: there is none.
Matte piece_around(const MotionReturnInput& in, double seen_px, double usual_px) {
    const ImageF1 odds = motion_evidence(in);
    for (int step = 0; step < kOddsSteps; ++step) {
        const float least = static_cast<float>(step) * kOddsStep;
        const PieceLabels labels = motion_pieces(odds, least, in.unit_px);
        const std::vector<Piece> pieces = measure(in, labels);
        if (pieces.size() < 2) return {};
        const auto around = std::max_element(
            pieces.begin() + 1, pieces.end(),
            [](const Piece& a, const Piece& b) { return a.found_px < b.found_px; });
        if (around->found_px < kMostOfSeen * seen_px) return {};
        if (around->area_px > kLargestPart * usual_px) continue;
        if (around->motion < kLeastPartMotion * around->area_px) return {};
        return of_piece(labels, static_cast<std::int32_t>(around - pieces.begin()),
                        in.frame.size());
    }
    return {};
}

}  // namespace

PartReturn::PartReturn(ViewF1 key_phi) : usual_px_(area_of(key_phi)) {}

Matte PartReturn::returned(const MotionReturnInput& in) {
    const double seen = area_of(in.phi);
    const bool leaving = leaves(in.phi);
    const bool in_part = seen > kPartLost * usual_px_ && seen < kPartWhole * usual_px_ && !leaving;
    const double usual = usual_px_;
    usual_px_ += (leaving ? 1 : kFollowArea) * (seen - usual_px_);
    Matte rest = in_part ? piece_around(in, seen, usual) : Matte();
    frames_ = rest.empty() ? 0 : frames_ + 1;
    return frames_ >= kPartFramesInRow ? std::move(rest) : Matte();
}

}  // namespace weft
