#include "engine/synthesis/refine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "engine/core/parallel.h"
#include "engine/seam/seam_cost.h"
#include "engine/synthesis/plane_energy.h"

namespace weft {
namespace {

constexpr int kBlock = 48;  // Texels; a block covers about one seam's length.
// Of a larger sample only a window is searched for each block.
constexpr int kLargestWindow = 192;
// Blocks are taken, the worst first, until they hold this share of it.
constexpr double kShareOfEnergy = 0.9;
constexpr int kApart_px = 2;

int block_side(int page_px, int plane_px) {
    return std::max(1, std::min({kBlock, 2 * page_px / 3, plane_px - 2}));
}

std::vector<int> starts(int page_px, int window_px) {
    std::vector<int> out{0};
    while (out.back() + window_px < page_px) {
        out.push_back(std::min(out.back() + window_px / 2, page_px - window_px));
    }
    return out;
}

// Colours of the three pictures at both pixels of a pair: the patch of p, the patch of q, and the
// new one.
struct PairColours {
    std::array<const std::uint8_t*, 3> p, q;
};
enum Picture : std::size_t { kOfP, kOfQ, kOfNew };

float pixel_distance(const std::uint8_t* a, const std::uint8_t* b) {
    int sum = 0;
    for (int c = 0; c < 3; ++c)
        sum += (a[c] - b[c]) * (a[c] - b[c]);
    return std::sqrt(static_cast<float>(sum));
}

// The seam cost between two of the pictures, as in fill_seam_costs().
std::int32_t pair_cost(const PairColours& k, Picture a, Picture b) {
    const float sum = pixel_distance(k.p[a], k.p[b]) + pixel_distance(k.q[a], k.q[b]);
    const float gradient = pixel_distance(k.p[a], k.q[a]) + pixel_distance(k.p[b], k.q[b]);
    const float v = sum / (gradient + kRefineGradientFloor) * static_cast<float>(kSeamCostScale);
    return static_cast<std::int32_t>(v + 0.5f);
}

void add_unary(SeamProblem& problem, int x, int y, std::int32_t cost_of_new) {
    if (cost_of_new > 0) problem.new_cost.at(x, y) += cost_of_new;
    if (cost_of_new < 0) problem.old_cost.at(x, y) -= cost_of_new;
}

}  // namespace

Refiner::Refiner(const SampleAtlas& atlas, const PlaneOptions& options, const PlaneLattice& lattice,
                 Canvas& canvas, DeviceSearch& device)
    : atlas_(atlas), options_(options), lattice_(lattice), canvas_(canvas), device_(device) {
    Size least = atlas.pages().front().rect.size();
    for (const SampleAtlas::Page& page : atlas.pages()) {
        least.width = std::min(least.width, page.rect.width());
        least.height = std::min(least.height, page.rect.height());
    }
    block_ = {block_side(least.width, options.size.width),
              block_side(least.height, options.size.height)};
    for (const SampleAtlas::Page& page : atlas.pages()) {
        const Size w{std::min(page.rect.width(), kLargestWindow),
                     std::min(page.rect.height(), kLargestWindow)};
        for (const int y : starts(page.rect.height(), w.height)) {
            for (const int x : starts(page.rect.width(), w.width)) {
                const Vec2i at{page.rect.x0 + x, page.rect.y0 + y};
                const Recti rect{at.x, at.y, at.x + w.width, at.y + w.height};
                const Vec2i lo{block_.width - w.width, block_.height - w.height};
                windows_.push_back({rect, lo,
                                    std::make_unique<PlacementSearch>(atlas.pixels().crop(rect),
                                                                      block_, lo, Vec2i{0, 0})});
            }
        }
    }
}

double Refiner::pass(int index, PlaneStats& stats) {
    const std::vector<Vec2i> corners = apart(worst_blocks(
        {index * 5 % std::max(1, block_.width / 4), index * 7 % std::max(1, block_.height / 4)}));
    std::vector<Outcome> outcomes(corners.size());
    parallel_for(corners.size(), [&](std::size_t i) {
        const Vec2i at = corners[i];
        // A stream of its own, separate from the sweep's.
        const Rng rng(mix64(options_.seed + 1), options_.region, options_.frame,
                      (static_cast<std::uint64_t>(index) << 32) + i);
        outcomes[i] = refine_block({at.x, at.y, at.x + block_.width, at.y + block_.height}, rng);
    });
    double gained = 0;
    for (const Outcome& o : outcomes) {
        gained += o.gained;
        stats.refinements += o.laid;
        stats.peak_graph_bytes = std::max(stats.peak_graph_bytes, o.graph_bytes);
    }
    return gained;
}

// The top left corners of overlapping blocks, those with most energy first. Each round shifts the
// blocks a little.
std::vector<Vec2i> Refiner::worst_blocks(Vec2i shift) const {
    struct Scored {
        double energy;
        Vec2i at;
    };
    // Energies of cells of a quarter of a block, so that a block's middle is 2×2 cells.
    const Size cell{std::max(1, block_.width / 4), std::max(1, block_.height / 4)};
    const Size plane = canvas_.size();
    Image<double, 1> cells(plane.width / cell.width + 1, plane.height / cell.height + 1, 0.0);
    parallel_for(static_cast<std::size_t>(cells.height()), [&](std::size_t row) {
        const int cy = static_cast<int>(row);
        for (int y = cy * cell.height; y < std::min(plane.height, (cy + 1) * cell.height); ++y) {
            for (int x = 0; x < plane.width; ++x) {
                cells.at(x / cell.width, cy) +=
                    texel_energy(atlas_, canvas_.source(), {x, y}, canvas_.torus()).energy;
            }
        }
    });
    std::vector<Scored> blocks;
    double total = 0;
    for (int cy = 0; cy + 4 <= cells.height(); ++cy) {
        for (int cx = 0; cx + 4 <= cells.width(); ++cx) {
            const Vec2i at{cx * cell.width + shift.x, cy * cell.height + shift.y};
            if (!canvas_.torus() &&
                (at.x + block_.width > plane.width || at.y + block_.height > plane.height)) {
                continue;
            }
            const double energy = cells.at(cx + 1, cy + 1) + cells.at(cx + 2, cy + 1) +
                                  cells.at(cx + 1, cy + 2) + cells.at(cx + 2, cy + 2);
            if (energy > 0) blocks.push_back({energy, at});
            total += energy;
        }
    }
    std::stable_sort(blocks.begin(), blocks.end(),
                     [](const Scored& a, const Scored& b) { return a.energy > b.energy; });
    std::vector<Vec2i> out;
    double sum = 0;
    for (const Scored& b : blocks) {
        if (sum > kShareOfEnergy * total) break;
        sum += b.energy;
        out.push_back(b.at);
    }
    return out;
}

// The first of these, in order, that keep their distance from those before (on a torus in all
// directions).
std::vector<Vec2i> Refiner::apart(const std::vector<Vec2i>& corners) const {
    std::vector<Vec2i> out;
    const Size plane = canvas_.size();
    const Size least{block_.width + kApart_px, block_.height + kApart_px};
    const auto far = [&](int d, int plane_px, int least_px) {
        d = std::abs(d);
        return (canvas_.torus() ? std::min(d, plane_px - d) : d) >= least_px;
    };
    for (const Vec2i c : corners) {
        if (std::all_of(out.begin(), out.end(), [&](Vec2i o) {
                return far(c.x - o.x, plane.width, least.width) ||
                       far(c.y - o.y, plane.height, least.height);
            })) {
            out.push_back(c);
        }
    }
    return out;
}

double Refiner::energy_around(const Recti& rect) const {
    double sum = 0;
    for (int y = rect.y0 - 1; y < rect.y1; ++y) {
        for (int x = rect.x0 - 1; x < rect.x1; ++x) {
            const auto p = canvas_.resolve(x, y);
            if (p) sum += texel_energy(atlas_, canvas_.source(), *p, canvas_.torus()).energy;
        }
    }
    return sum;
}

Vec2i Refiner::source_at(int x, int y) const {
    const auto p = canvas_.resolve(x, y);
    const std::int32_t* s = canvas_.source().pixel(p->x, p->y);
    return {s[0], s[1]};
}

void Refiner::forbid_off_lattice(const Window& window, Vec2i to_canvas,
                                 std::vector<Vec2i>& forbidden) const {
    const Size size{1 - window.lo.x, 1 - window.lo.y};
    const Image<std::uint8_t, 1> held = lattice_.held(window.lo + to_canvas, size);
    forbidden.reserve(forbidden.size() + held.size_bytes());
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            if (!held.at(x, y)) forbidden.push_back(window.lo + Vec2i{x, y});
        }
    }
}

// The best place in one window of the atlas for the block, other than what the block already shows.
std::optional<Vec2i> Refiner::find_origin(const Block& block, Rng& rng) {
    const Window& window = windows_[rng.below(windows_.size())];
    const Vec2i start{window.rect.x0, window.rect.y0};
    std::vector<Vec2i> shown;
    for (int y = 0; y < block_.height; ++y) {
        for (int x = 0; x < block_.width; ++x) {
            const Vec2i t = Vec2i{x, y} - source_at(block.rect.x0 + x, block.rect.y0 + y) + start;
            if (shown.empty() || shown.back() != t) shown.push_back(t);
        }
    }
    const Vec2i to_canvas = Vec2i{block.rect.x0, block.rect.y0} - start;
    std::vector<Vec2i> forbidden = shown;
    if (!lattice_.empty()) forbid_off_lattice(window, to_canvas, forbidden);
    auto found = device_.find(block.rect, window.rect, window.lo, {0, 0}, forbidden);
    const Shortlist list =
        found ? *std::move(found)
              : window.search->find({block.pixels, block.filled, {}, {}, 1, 0}, forbidden);
    if (std::find(shown.begin(), shown.end(), list.best) != shown.end()) return std::nullopt;
    if (!lattice_.holds(list.best + to_canvas)) return std::nullopt;
    return list.good[rng.below(list.good.size())] + to_canvas;
}

// With x = 1 where the new picture shows, a pair that is an old seam of cost a costs
//   a·(1−xp)(1−xq) + b·(1−xp)xq + c·xp(1−xq),
// b between the new picture and what p shows, c and what q shows. For a ≤ b + c that is, doubled
// and up to a constant, (c−a−b)·xp + (b−c−a)·xq + (b+c−a)·|xp−xq|: a symmetric arc and data terms,
// so the old seam's node of Kwatra et al. needs no node of its own. Other pairs have a = 0 and
// b = c.
SeamProblem Refiner::problem_for(const Block& block, Vec2i origin) const {
    const int w = block_.width, h = block_.height;
    SeamProblem problem;
    problem.cells = Image<SeamCell, 1>(w, h, SeamCell::kFree);
    for (int x = 0; x < w; ++x)
        problem.cells.at(x, 0) = problem.cells.at(x, h - 1) = SeamCell::kOld;
    for (int y = 0; y < h; ++y)
        problem.cells.at(0, y) = problem.cells.at(w - 1, y) = SeamCell::kOld;
    problem.old_cost = problem.new_cost = Image<std::int32_t, 1>(w, h, 0);
    const Vec2i offset = Vec2i{block.rect.x0, block.rect.y0} - origin;
    fill_seam_costs(block.pixels,
                    atlas_.pixels().crop({offset.x, offset.y, offset.x + w, offset.y + h}), problem,
                    kRefineGradientFloor);
    for (Image<std::int32_t, 1>* arcs : {&problem.right, &problem.down}) {
        for (int y = 0; y < h; ++y) {
            for (int x = 0; x < w; ++x)
                arcs->at(x, y) *= 2;
        }
    }
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            if (canvas_.locked(block.rect.x0 + x, block.rect.y0 + y)) {
                problem.cells.at(x, y) = SeamCell::kOld;
            }
            const Vec2i p = source_at(block.rect.x0 + x, block.rect.y0 + y);
            const Vec2i n = Vec2i{x, y} + offset;
            const auto pair = [&](Vec2i step, std::int32_t& arc) {
                const Vec2i q = source_at(block.rect.x0 + x + step.x, block.rect.y0 + y + step.y);
                if (q == p + step) return;
                const PairColours k{
                    {atlas_.continued(p, p), atlas_.continued(q - step, q), atlas_.continued(n, n)},
                    {atlas_.continued(p + step, p), atlas_.continued(q, q),
                     atlas_.continued(n + step, n)}};
                const std::int32_t b = pair_cost(k, kOfP, kOfNew), c = pair_cost(k, kOfNew, kOfQ);
                const std::int32_t a = std::min(pair_cost(k, kOfP, kOfQ), b + c);
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

Refiner::Outcome Refiner::refine_block(const Recti& rect, Rng rng) {
    Outcome outcome;
    const Block block = copy_block(canvas_, rect);
    const std::optional<Vec2i> origin = find_origin(block, rng);
    if (!origin) return outcome;
    const SeamResult seam = solve_grid_maxflow(problem_for(block, *origin));
    outcome.graph_bytes = seam.graph_bytes;

    struct Undo {
        Vec2i at, from;
    };
    std::vector<Undo> undo;
    const double before = energy_around(rect);
    for (int y = 0; y < block_.height; ++y) {
        for (int x = 0; x < block_.width; ++x) {
            if (!seam.labels.at(x, y)) continue;
            const Vec2i p = *canvas_.resolve(rect.x0 + x, rect.y0 + y);
            undo.push_back({p, source_at(p.x, p.y)});
            const Vec2i from = Vec2i{rect.x0 + x, rect.y0 + y} - *origin;
            canvas_.set(p, atlas_.pixels().pixel(from.x, from.y), from);
        }
    }
    if (undo.empty()) return outcome;
    outcome.gained = before - energy_around(rect);
    if (outcome.gained > 0) {
        outcome.laid = 1;
        device_.show(canvas_, rect);
        return outcome;
    }
    for (const Undo& u : undo)
        canvas_.set(u.at, atlas_.pixels().pixel(u.from.x, u.from.y), u.from);
    outcome.gained = 0;
    return outcome;
}

}  // namespace weft
