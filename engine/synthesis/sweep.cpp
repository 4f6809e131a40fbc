#include "engine/synthesis/sweep.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/synthesis/contact.h"

namespace weft {
namespace {

constexpr int kLeastOverlap = 12;
constexpr int kLargestPatch = 200;
constexpr int kLargestWindow = 488;  // With the slack of the default overlap a transform of 512.
constexpr std::uint32_t kWeightUnit = 256;

std::int64_t step_key(Vec2i d) {
    if (d.y < 0 || (d.y == 0 && d.x < 0)) d = {-d.x, -d.y};
    return static_cast<std::int64_t>(d.y) * (std::int64_t{1} << 32) + d.x;
}

}  // namespace

SweepAxis make_sweep_axis(int sample_px, int plane_px, bool torus, int overlap_px) {
    SweepAxis a;
    a.window = std::min(sample_px, kLargestWindow);
    a.overlap = std::min(overlap_px, sample_px / 2);
    int patch = std::min(a.window, kLargestPatch);
    if (torus) {
        patch = std::min(patch, std::max(1, plane_px - 2));
        a.overlap = std::min(a.overlap, patch / 3);
    }
    a.min_overlap = a.overlap >= 2 * kLeastOverlap
                        ? kLeastOverlap
                        : std::min(a.overlap, std::max(4, a.overlap / 2));
    int slack = a.overlap - a.min_overlap;
    a.block = patch + slack;
    if (torus && a.block > plane_px - 2) {
        slack = std::clamp(plane_px - 2 - patch, 0, slack);
        a.block = patch + slack;
    }
    a.lo = a.block - slack - a.window;
    a.hi = a.overlap - a.min_overlap;
    const int room = sample_px - a.window;
    const int windows = room == 0 ? 1 : 1 + (2 * room + a.window - 1) / a.window;
    for (int i = 0; i < windows; ++i) {
        a.window_starts.push_back(windows == 1 ? 0 : room * i / (windows - 1));
    }
    return a;
}

Sweep::Sweep(ViewU8x3 sample, const PlaneOptions& options, Canvas& canvas, PlaneStats& stats)
    : sample_(sample),
      options_(options),
      canvas_(canvas),
      stats_(stats),
      x_(make_sweep_axis(sample.width(), options.size.width, options.tileable, options.overlap_px)),
      y_(make_sweep_axis(sample.height(), options.size.height, options.tileable,
                         options.overlap_px)),
      searches_(x_.window_starts.size() * y_.window_starts.size()) {}

// At the border of a plane there is nothing to overlap, so the block starts there and only leaves
// room for the sample's freedom.
Block Sweep::next_block(Vec2i first) const {
    const bool torus = canvas_.torus();
    const int x0 = first.x - (first.x == 0 && !torus ? x_.hi : x_.overlap);
    const int y0 = first.y - (first.y == 0 && !torus ? y_.hi : y_.overlap);
    return copy_block(canvas_, {x0, y0, x0 + x_.block, y0 + y_.block});
}

Sweep::GuideBlock Sweep::copy_guide(const Recti& rect) const {
    GuideBlock out{ImageU8x3(rect.size()), Image<std::uint8_t, 1>(rect.size(), 0)};
    for (int y = 0; y < rect.height(); ++y) {
        for (int x = 0; x < rect.width(); ++x) {
            const auto p = canvas_.resolve(rect.x0 + x, rect.y0 + y);
            if (!p || !options_.guide->known.at(p->x, p->y)) continue;
            out.known.at(x, y) = 1;
            for (int c = 0; c < 3; ++c) {
                out.pixels.at(x, y, c) = options_.guide->target.at(p->x, p->y, c);
            }
        }
    }
    return out;
}

// Besides copies: translations with more thin contact than need be.
std::vector<Vec2i> Sweep::forbidden(const Block& block, Vec2i to_canvas) const {
    std::vector<Vec2i> out = congruent(to_canvas);
    const std::vector<std::uint32_t> thin =
        thin_contacts(canvas_, block, {x_.window, y_.window}, {x_.lo, y_.lo}, {x_.hi, y_.hi},
                      {x_.min_overlap, y_.min_overlap});
    const std::uint32_t limit = 2 * *std::min_element(thin.begin(), thin.end());
    std::size_t i = 0;
    for (int ty = y_.lo; ty <= y_.hi; ++ty) {
        for (int tx = x_.lo; tx <= x_.hi; ++tx, ++i) {
            if (thin[i] > limit) out.push_back({tx, ty});
        }
    }
    return out;
}

// Translations at which the sample would only continue an earlier placement: no new texture comes
// of them, and their error is 0. On a torus a whole turn is the same translation.
std::vector<Vec2i> Sweep::congruent(Vec2i to_canvas) const {
    std::vector<Vec2i> out;
    const int turns = canvas_.torus() ? 1 : 0;
    const Vec2i turn{options_.size.width, options_.size.height};
    for (const Vec2i origin : origins_) {
        for (int ky = -turns; ky <= turns; ++ky) {
            for (int kx = -turns; kx <= turns; ++kx) {
                out.push_back(origin + Vec2i{kx, ky} * turn - to_canvas);
            }
        }
    }
    return out;
}

// Whether the step from a neighbouring placement has been made before: equal steps are what an eye
// sees as a grid of repeats.
bool Sweep::repeats_a_step(Vec2i origin) const {
    return std::any_of(origins_.begin(), origins_.end(), [&](Vec2i o) {
        const Vec2i d = origin - o;
        return std::abs(d.x) < sample_.width() && std::abs(d.y) < sample_.height() &&
               steps_.count(step_key(d)) != 0;
    });
}

void Sweep::remember(Vec2i origin) {
    for (const Vec2i o : origins_) {
        const Vec2i d = origin - o;
        if (std::abs(d.x) < sample_.width() && std::abs(d.y) < sample_.height()) {
            steps_.insert(step_key(d));
        }
    }
    origins_.push_back(origin);
}

Vec2i Sweep::pick(const Shortlist& list, Vec2i to_canvas, Rng& rng) const {
    std::vector<Vec2i> fresh;
    std::copy_if(list.good.begin(), list.good.end(), std::back_inserter(fresh),
                 [&](Vec2i t) { return !repeats_a_step(t + to_canvas); });
    const std::vector<Vec2i>& from = fresh.empty() ? list.good : fresh;
    return from[rng.below(from.size())];
}

Sweep::Choice Sweep::choose(Vec2i first, Rng& rng) {
    Choice choice;
    choice.block = next_block(first);
    const Block& block = choice.block;
    const auto wx = static_cast<std::size_t>(rng.below(x_.window_starts.size()));
    const auto wy = static_cast<std::size_t>(rng.below(y_.window_starts.size()));
    const Vec2i start{x_.window_starts[wx], y_.window_starts[wy]};
    choice.window = {start.x, start.y, start.x + x_.window, start.y + y_.window};
    auto& search = searches_[wy * x_.window_starts.size() + wx];
    if (!search) {
        search.emplace(sample_.crop(choice.window), block.rect.size(), Vec2i{x_.lo, y_.lo},
                       Vec2i{x_.hi, y_.hi});
    }

    MatchTarget target{block.pixels, block.filled, {}, {}, 1, 0};
    GuideBlock guide;
    if (options_.guide) {
        guide = copy_guide(block.rect);
        target.guide = guide.pixels;
        target.guide_known = guide.known;
        target.fill_weight = kWeightUnit;
        target.guide_weight =
            static_cast<std::uint32_t>(std::lround(options_.guide->weight * kWeightUnit));
    }
    const Vec2i to_canvas = Vec2i{block.rect.x0, block.rect.y0} - start;
    const Shortlist list = search->find(target, forbidden(block, to_canvas));
    choice.origin = pick(list, to_canvas, rng) + to_canvas;
    return choice;
}

bool Sweep::step() {
    const auto first = canvas_.first_unfilled();
    if (!first) return false;
    Rng rng(options_.seed, options_.region, options_.frame,
            static_cast<std::uint64_t>(stats_.placements));
    Choice choice;
    {
        const StageTimer timer(stats_.search_s);
        choice = choose(*first, rng);
    }
    const Recti& w = choice.window;
    Patch patch{choice.block.rect.intersected({choice.origin.x + w.x0, choice.origin.y + w.y0,
                                               choice.origin.x + w.x1, choice.origin.y + w.y1}),
                choice.origin};
    if (!canvas_.torus()) patch.rect = patch.rect.intersected(rect_of(canvas_.size()));
    {
        const StageTimer timer(stats_.seam_s);
        const std::size_t bytes = lay_patch(canvas_, choice.block, sample_, patch, options_.seam,
                                            options_.guide ? &*options_.guide : nullptr);
        stats_.peak_graph_bytes = std::max(stats_.peak_graph_bytes, bytes);
    }
    remember(patch.origin);
    ++stats_.placements;
    return true;
}

}  // namespace weft
