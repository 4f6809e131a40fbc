#include "engine/mask/motion_return.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "engine/mask/motion_evidence.h"
#include "engine/mask/signed_distance.h"

namespace weft {
namespace {

constexpr double kLost = 0.1, kSeen = 0.3, kBack = 0.8;  // shares of the usual area
constexpr double kGrow = 0.1, kShrink = 0.03;            // of that area, from frame to frame
constexpr double kSmallest = 0.2, kLargest = 2.5;        // shares of it that a piece may have
constexpr double kAhead = 1.5;                           // of any other piece
constexpr double kOverlap = 0.3;                         // with the piece of the frame before
constexpr int kFramesInRow = 3, kTaken = 10;             // in a row, and afterwards
constexpr double kLeastMotion = 0.5;                     // log odds, mean of a piece
constexpr int kEvidenceStep = kMotionEvidenceStep;       // px

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
        if (seen >= kSeen * usual_px_)
            usual_px_ += (seen > usual_px_ ? kGrow : kShrink) * (seen - usual_px_);
        candidate_ = {};
        frames_ = 0;
        return {};
    }
    // A piece that was taken goes on where the surface was found, another must have the most
    // evidence.
    const bool goes_on = taken_ > 0;
    const ImageF1 odds = motion_evidence(in);
    const PieceLabels labels = motion_pieces(odds, 0, in.unit_px);
    const std::int32_t* first = labels.data();
    const std::int32_t highest =
        *std::max_element(first, first + labels.size_bytes() / sizeof(*first));
    std::vector<Piece> pieces(static_cast<std::size_t>(highest) + 1);
    for (int y = 0; y < labels.height(); ++y) {
        for (int x = 0; x < labels.width(); ++x) {
            Piece& piece = pieces[static_cast<std::size_t>(labels.at(x, y))];
            piece.area_px += kEvidenceStep * kEvidenceStep;
            piece.motion += double{in.departs.row(y * kEvidenceStep)[x * kEvidenceStep]};
            const bool was_found = in.phi.row(y * kEvidenceStep)[x * kEvidenceStep] > 0;
            piece.weight += goes_on ? (was_found ? 1.0 : 0.0) : double{odds.at(x, y)};
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
            if (labels.at(x / kEvidenceStep, y / kEvidenceStep) != best) continue;
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
