#include "engine/mask/outline_lives.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/mask/outline_fit.h"
#include "engine/mask/outline_follow.h"

namespace weft {
namespace {

constexpr float kLeastReachPx = 4;
constexpr float kReachShare = 0.025f;  // of the diagonal
constexpr float kMovedAlongPx = 2;
constexpr double kBendPx = 1.5;
constexpr double kDirectionPx = 3;

// An outline's life so far.
struct OutlineLife {
    int level = 0;
    bool from_reference = false;
    std::map<std::size_t, PlacedPoints> on;  // by frame
};

// A pair of a life and an outline of the next frame.
struct Continuation {
    float distance_px;
    std::size_t life, outline;
};

class OutlineWalk {
  public:
    OutlineWalk(const std::vector<OutlinedFrame>& frames, std::size_t reference, Size picture)
        : frames_(frames), reference_(reference) {
        const auto w = static_cast<float>(picture.width), h = static_cast<float>(picture.height);
        reach_px_ = std::max(kLeastReachPx, kReachShare * std::sqrt(w * w + h * h));
    }

    std::vector<OutlineLife> lives() {
        std::vector<std::size_t> first;
        for (const MatteOutline& outline : frames_[reference_].outlines) {
            first.push_back(lives_.size());
            begin(outline, reference_);
        }
        std::vector<std::size_t> live = first;
        for (std::size_t k = reference_ + 1; k < frames_.size(); ++k)
            live = go_on(live, k - 1, k);
        live = first;
        for (std::size_t k = reference_; k-- > 0;)
            live = go_on(live, k + 1, k);
        return std::move(lives_);
    }

  private:
    void begin(const MatteOutline& outline, std::size_t frame) {
        OutlineLife life;
        life.level = outline.level;
        life.from_reference = frame == reference_;
        life.on[frame] = {&outline.path, bend_places(outline.path, kBendPx)};
        lives_.push_back(std::move(life));
    }

    // Those that live on frame `to`.
    std::vector<std::size_t> go_on(const std::vector<std::size_t>& live, std::size_t from,
                                   std::size_t to) {
        const std::vector<MatteOutline>& outlines = frames_[to].outlines;
        std::vector<Continuation> pairs;
        for (const std::size_t life : live) {
            const std::vector<Vec2> carried = carried_outline(lives_[life], from, to);
            for (std::size_t k = 0; k < outlines.size(); ++k) {
                if (outlines[k].level != lives_[life].level) continue;
                const SameOutline same = same_outline(carried, outlines[k].path, reach_px_);
                if (same.same) pairs.push_back({same.distance_px, life, k});
            }
        }
        std::stable_sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) {
            return a.distance_px < b.distance_px;
        });
        std::vector<std::optional<std::size_t>> taken_by(outlines.size());
        std::vector<std::size_t> gone_on;
        for (const Continuation& pair : pairs) {
            const bool used = std::find(gone_on.begin(), gone_on.end(), pair.life) != gone_on.end();
            if (used || taken_by[pair.outline]) continue;
            taken_by[pair.outline] = pair.life;
            gone_on.push_back(pair.life);
        }
        std::vector<std::size_t> out;
        for (std::size_t k = 0; k < outlines.size(); ++k) {
            out.push_back(taken_by[k].value_or(lives_.size()));
            if (taken_by[k])
                follow(lives_[*taken_by[k]], outlines[k].path, from, to);
            else
                begin(outlines[k], to);
        }
        return out;
    }

    [[nodiscard]] std::vector<Vec2> carried_outline(const OutlineLife& life, std::size_t from,
                                                    std::size_t to) const {
        std::vector<Vec2> out = life.on.at(from).path->points();
        for (Vec2& p : out)
            p += frames_[to].from_last.at(p);
        return out;
    }

    void follow(OutlineLife& life, const OutlinePath& outline, std::size_t from,
                std::size_t to) const {
        const PlacedPoints& last = life.on.at(from);
        const PlacedPoints* first = life.from_reference ? &life.on.at(reference_) : nullptr;
        std::vector<CarriedPoint> points;
        for (std::size_t k = 0; k < last.places.size(); ++k) {
            const Vec2 here = last.path->at(last.places[k]);
            CarriedPoint point{here + frames_[to].from_last.at(here),
                               last.path->direction(last.places[k], 1, kDirectionPx),
                               last.places[k] / last.path->length()};
            if (first) {
                const Vec2 there = first->path->at(first->places[k]);
                const Vec2 moved = there + frames_[to].from_reference.at(there);
                if (outline.nearest(moved, point.along).distance_px <= kMovedAlongPx)
                    point.at = moved;
            }
            points.push_back(point);
        }
        life.on[to] = {&outline, followed_places(outline, points, reach_px_)};
    }

    const std::vector<OutlinedFrame>& frames_;
    std::size_t reference_;
    float reach_px_ = 0;
    std::vector<OutlineLife> lives_;
};

}  // namespace

std::vector<MatteShape> matte_shapes(const std::vector<OutlinedFrame>& frames,
                                     std::size_t reference, Size picture) {
    std::vector<MatteShape> out;
    for (const OutlineLife& life : OutlineWalk(frames, reference, picture).lives()) {
        std::vector<PlacedPoints> placed;
        for (const auto& [frame, points] : life.on)
            placed.push_back(points);
        std::vector<RotoShape> shapes = fitted_shapes(std::move(placed));
        MatteShape shape;
        shape.level = life.level;
        std::size_t k = 0;
        for (const auto& [frame, points] : life.on)
            shape.keys[static_cast<int>(frame)] = std::move(shapes[k++]);
        out.push_back(std::move(shape));
    }
    return out;
}

}  // namespace weft
