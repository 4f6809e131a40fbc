#include "engine/synthesis/refine.h"

#include <algorithm>
#include <cmath>

#include "engine/seam/seam_cost.h"
#include "engine/synthesis/plane_energy.h"
#include "engine/synthesis/sweep.h"

namespace weft {
namespace {

constexpr int kBlock = 48;              // Texels; a block covers about one seam's length.
constexpr int kLargestWindow = 192;     // Of a larger sample only a window is searched for a block.
constexpr double kShareOfBlocks = 0.5;  // Blocks with less energy than this many of them wait.

int block_side(int sample_px, int plane_px) {
    return std::max(1, std::min({kBlock, 2 * sample_px / 3, plane_px - 2}));
}

std::vector<int> starts(int sample_px, int window_px) {
    std::vector<int> out{0};
    while (out.back() + window_px < sample_px) {
        out.push_back(std::min(out.back() + window_px / 2, sample_px - window_px));
    }
    return out;
}

// Colours of the three pictures at both pixels of a pair: the patch that p shows, the one that q
// shows, and the new one.
struct PairColours {
    const std::uint8_t *p[3], *q[3];
};
enum Picture { kOfP, kOfQ, kOfNew };

double distance(const std::uint8_t* a, const std::uint8_t* b) {
    int sum = 0;
    for (int c = 0; c < 3; ++c)
        sum += (a[c] - b[c]) * (a[c] - b[c]);
    return std::sqrt(static_cast<double>(sum));
}

// The seam cost between two of the pictures, as fill_seam_costs() has it.
std::int32_t pair_cost(const PairColours& k, Picture a, Picture b) {
    const double sum = distance(k.p[a], k.p[b]) + distance(k.q[a], k.q[b]);
    const double gradient = distance(k.p[a], k.q[a]) + distance(k.p[b], k.q[b]);
    return static_cast<std::int32_t>(
        std::lround(sum / (gradient + static_cast<double>(kGradientFloor)) * kSeamCostScale));
}

void add_unary(SeamProblem& problem, int x, int y, std::int32_t cost_of_new) {
    if (cost_of_new > 0) problem.new_cost.at(x, y) += cost_of_new;
    if (cost_of_new < 0) problem.old_cost.at(x, y) -= cost_of_new;
}

}  // namespace

Refiner::Refiner(ViewU8x3 sample, const PlaneOptions& options, Canvas& canvas, PlaneStats& stats)
    : sample_(sample),
      options_(options),
      canvas_(canvas),
      stats_(stats),
      block_{block_side(sample.width(), options.size.width),
             block_side(sample.height(), options.size.height)},
      window_{std::min(sample.width(), kLargestWindow), std::min(sample.height(), kLargestWindow)} {
    for (const int y : starts(sample.height(), window_.height)) {
        for (const int x : starts(sample.width(), window_.width))
            window_starts_.push_back({x, y});
    }
    searches_.resize(window_starts_.size());
}

double Refiner::pass(int index) {
    double gained = 0;
    std::uint64_t n = 0;
    for (const Vec2i at : worst_blocks()) {
        // A stream of its own, apart from the sweep's.
        Rng rng(mix64(options_.seed + 1), options_.region, options_.frame,
                (static_cast<std::uint64_t>(index) << 32) + n++);
        gained += refine_block({at.x, at.y, at.x + block_.width, at.y + block_.height}, rng);
    }
    return gained;
}

// The upper left corners of overlapping blocks, the ones with most energy first.
std::vector<Vec2i> Refiner::worst_blocks() const {
    struct Scored {
        double energy;
        Vec2i at;
    };
    std::vector<Scored> blocks;
    const Size plane = canvas_.size();
    const auto last = [&](int plane_px, int block_px) {
        return canvas_.torus() ? plane_px - 1 : std::max(0, plane_px - block_px);
    };
    for (int y = 0; y <= last(plane.height, block_.height); y += std::max(1, block_.height / 2)) {
        for (int x = 0; x <= last(plane.width, block_.width); x += std::max(1, block_.width / 2)) {
            const Recti middle{x + block_.width / 4, y + block_.height / 4,
                               x + 3 * block_.width / 4, y + 3 * block_.height / 4};
            blocks.push_back({energy_around(middle), {x, y}});
        }
    }
    std::stable_sort(blocks.begin(), blocks.end(),
                     [](const Scored& a, const Scored& b) { return a.energy > b.energy; });
    std::vector<Vec2i> out;
    const auto most =
        static_cast<std::size_t>(std::ceil(kShareOfBlocks * static_cast<double>(blocks.size())));
    for (const Scored& b : blocks) {
        if (out.size() < most && b.energy > 0) out.push_back(b.at);
    }
    return out;
}

double Refiner::energy_around(const Recti& rect) const {
    double sum = 0;
    for (int y = rect.y0 - 1; y < rect.y1; ++y) {
        for (int x = rect.x0 - 1; x < rect.x1; ++x) {
            const auto p = canvas_.resolve(x, y);
            if (p) sum += texel_energy(sample_, canvas_.source(), *p, canvas_.torus()).energy;
        }
    }
    return sum;
}

// The best place of the sample for the block, other than what the block shows already.
std::optional<Vec2i> Refiner::find_origin(const Block& block, Rng& rng) {
    const auto which = static_cast<std::size_t>(rng.below(window_starts_.size()));
    const Vec2i start = window_starts_[which];
    const Vec2i lo{block_.width - window_.width, block_.height - window_.height};
    auto& search = searches_[which];
    if (!search) {
        search.emplace(
            sample_.crop({start.x, start.y, start.x + window_.width, start.y + window_.height}),
            block_, lo, Vec2i{0, 0});
    }
    std::vector<Vec2i> shown;
    for (int y = 0; y < block_.height; ++y) {
        for (int x = 0; x < block_.width; ++x) {
            const auto p = canvas_.resolve(block.rect.x0 + x, block.rect.y0 + y);
            if (!p) continue;
            const std::int32_t* s = canvas_.source().pixel(p->x, p->y);
            const Vec2i t{x - s[0] + start.x, y - s[1] + start.y};
            if (shown.empty() || shown.back() != t) shown.push_back(t);
        }
    }
    const auto same = [&](Vec2i t) {
        return std::find(shown.begin(), shown.end(), t) != shown.end();
    };
    const Shortlist list = search->find({block.pixels, block.filled, {}, {}, 1, 0}, shown);
    if (same(list.best)) return std::nullopt;
    return list.best + Vec2i{block.rect.x0, block.rect.y0} - start;
}

// With x = 1 where the new picture shows, a pair that is an old seam of cost a costs
//   a·(1−xp)(1−xq) + b·(1−xp)xq + c·xp(1−xq),
// b between the new picture and what p shows, c and what q shows. For a ≤ b + c that is, doubled
// and up to a constant, (c−a−b)·xp + (b−c−a)·xq + (b+c−a)·|xp−xq|: a symmetric arc and data terms,
// so the old seam's node of Kwatra et al. needs no node of its own. Other pairs have a = 0 and b =
// c.
SeamProblem Refiner::problem_for(const Block& block, Vec2i origin) const {
    const int w = block_.width, h = block_.height;
    SeamProblem problem;
    problem.cells = Image<SeamCell, 1>(w, h, SeamCell::kFree);
    problem.right = problem.down = problem.old_cost = problem.new_cost =
        Image<std::int32_t, 1>(w, h, 0);
    const auto sample_at = [&](Vec2i s) {
        return sample_.pixel(std::clamp(s.x, 0, sample_.width() - 1),
                             std::clamp(s.y, 0, sample_.height() - 1));
    };
    const auto source_at = [&](int x, int y) {
        const auto p = canvas_.resolve(block.rect.x0 + x, block.rect.y0 + y);
        const std::int32_t* s = canvas_.source().pixel(p->x, p->y);
        return Vec2i{s[0], s[1]};
    };
    const Vec2i offset = Vec2i{block.rect.x0, block.rect.y0} - origin;
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            const bool border = x == 0 || y == 0 || x == w - 1 || y == h - 1;
            if (border) problem.cells.at(x, y) = SeamCell::kOld;
            const Vec2i p = source_at(x, y), new_p = Vec2i{x, y} + offset;
            const auto pair = [&](Vec2i step, std::int32_t& arc) {
                const Vec2i q = source_at(x + step.x, y + step.y);
                const PairColours k{{sample_at(p), sample_at(q - step), sample_at(new_p)},
                                    {sample_at(p + step), sample_at(q), sample_at(new_p + step)}};
                const std::int32_t b = pair_cost(k, kOfP, kOfNew), c = pair_cost(k, kOfNew, kOfQ);
                const std::int32_t a =
                    q == p + step ? 0 : std::min(pair_cost(k, kOfP, kOfQ), b + c);
                arc = b + c - a;
                add_unary(problem, x, y, c - a - b);
                add_unary(problem, x + step.x, y + step.y, b - c - a);
            };
            if (x + 1 < w) pair({1, 0}, problem.right.at(x, y));
            if (y + 1 < h) pair({0, 1}, problem.down.at(x, y));
        }
    }
    return problem;
}

double Refiner::refine_block(const Recti& rect, Rng& rng) {
    const Block block = copy_block(canvas_, rect);
    std::optional<Vec2i> origin;
    {
        const StageTimer timer(stats_.search_s);
        origin = find_origin(block, rng);
    }
    if (!origin) return 0;
    const StageTimer timer(stats_.seam_s);
    const SeamResult seam = solve_grid_maxflow(problem_for(block, *origin));
    stats_.peak_graph_bytes = std::max(stats_.peak_graph_bytes, seam.graph_bytes);

    struct Undo {
        Vec2i at, from;
    };
    std::vector<Undo> undo;
    const double before = energy_around(rect);
    for (int y = 0; y < block_.height; ++y) {
        for (int x = 0; x < block_.width; ++x) {
            if (!seam.labels.at(x, y)) continue;
            const Vec2i p = *canvas_.resolve(rect.x0 + x, rect.y0 + y);
            const std::int32_t* s = canvas_.source().pixel(p.x, p.y);
            undo.push_back({p, {s[0], s[1]}});
            const Vec2i from = Vec2i{rect.x0 + x, rect.y0 + y} - *origin;
            canvas_.set(p, sample_.pixel(from.x, from.y), from);
        }
    }
    const double gained = before - energy_around(rect);
    if (undo.empty() || gained > 0) {
        stats_.placements += undo.empty() ? 0 : 1;
        return gained;
    }
    for (const Undo& u : undo)
        canvas_.set(u.at, sample_.pixel(u.from.x, u.from.y), u.from);
    return 0;
}

}  // namespace weft
