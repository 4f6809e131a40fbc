#include "engine/synthesis/sweep.h"

#include <algorithm>
#include <chrono>
#include <climits>
#include <mutex>

#include "engine/core/parallel.h"
#include "engine/core/stopwatch.h"
#include "engine/synthesis/contact.h"

namespace weft {
namespace {

constexpr std::size_t kPagesPerStep = 2;
constexpr double kAlignTolerance_px = 2;

}  // namespace

Sweep::Sweep(const SampleAtlas& atlas, const PlaneOptions& options, const PlaneStructure& structure,
             Canvas& canvas, DeviceSearch& device)
    : atlas_(atlas),
      options_(options),
      canvas_(canvas),
      device_(device),
      lattice_(structure.lattice),
      period_(structure.period) {
    const Size plane = options.size;
    if (canvas.torus() && (!period_.holds({plane.width, 0}, kAlignTolerance_px) ||
                           !period_.holds({0, plane.height}, kAlignTolerance_px))) {
        period_ = {};
    }
    make_axes();
    make_places();
    make_bands();
}

Sweep::~Sweep() = default;

void Sweep::make_axes() {
    Size common = atlas_.pages().front().rect.size();
    for (const SampleAtlas::Page& page : atlas_.pages()) {
        common.width = std::min(common.width, page.rect.width());
        common.height = std::min(common.height, page.rect.height());
    }
    if (const auto axes = make_lattice_axes(lattice_, common, options_.size, canvas_.torus(),
                                            options_.overlap_px)) {
        x_ = axes->x, y_ = axes->y;
        return;
    }
    lattice_ = {};
    const Size period = period_.axis_px();
    x_ = make_sweep_axis(common.width, options_.size.width, canvas_.torus(), options_.overlap_px,
                         period.width);
    y_ = make_sweep_axis(common.height, options_.size.height, canvas_.torus(), options_.overlap_px,
                         period.height);
}

void Sweep::make_places() {
    for (std::size_t i = 0; i < atlas_.pages().size(); ++i) {
        const Recti& page = atlas_.pages()[i].rect;
        for (const int y : window_starts(page.height(), y_.window)) {
            for (const int x : window_starts(page.width(), x_.window)) {
                Place place;
                place.page = i;
                place.window = {page.x0 + x, page.y0 + y, page.x0 + x + x_.window,
                                page.y0 + y + y_.window};
                place.search = std::make_unique<PlacementSearch>(
                    atlas_.pixels().crop(place.window), Size{x_.block, y_.block},
                    Vec2i{x_.lo, y_.lo}, Vec2i{x_.hi, y_.hi});
                places_.push_back(std::move(place));
            }
        }
    }
}

// At the border of a plane there is nothing to overlap, so the block starts there and only leaves
// room for the sample's freedom.
void Sweep::make_bands() {
    const int height = canvas_.size().height;
    for (int y = 0; y < height;) {
        Band& band = bands_.emplace_back();
        const int back = y == 0 && !canvas_.torus() ? y_.hi : y_.overlap;
        band.block_y0 = y - back;
        band.y0 = y;
        y += y_.advance + y_.overlap - back;
        band.y1 = std::min(y, height);
        band.placed.reserve(static_cast<std::size_t>(canvas_.size().width / x_.advance) + 2);
    }
}

bool Sweep::run(PlaneStats& stats, const CancelToken& cancel, const ProgressFn& progress) {
    const auto start = Clock::now();
    cancel_ = &cancel;
    std::mutex progress_mutex;
    const Size size = canvas_.size();
    const auto area = static_cast<std::int64_t>(size.width) * size.height;
    std::int64_t done = 0;
    for_each_band([&](std::size_t i) {
        grow_band(i);
        if (!progress || stopped_) return;
        const std::lock_guard lock(progress_mutex);
        done += static_cast<std::int64_t>(bands_[i].y1 - bands_[i].y0) * size.width;
        progress({WorkStage::kSynthesise, done, area, 0, 0});
    });
    double search_s = 0, seam_s = 0, busy_s = 0;
    for (const Band& band : bands_) {
        search_s += band.search_s, seam_s += band.seam_s, busy_s += band.busy_s;
        stats.placements += band.count;
        stats.peak_graph_bytes = std::max(stats.peak_graph_bytes, band.peak_bytes);
    }
    const double share = busy_s > 0 ? std::min(1.0, seconds_since(start) / busy_s) : 0;
    stats.search_s += search_s * share;
    stats.seam_s += seam_s * share;
    stats.period = period_;
    stats.lattice = lattice_;
    return !stopped_;
}

// Runs the bands in any number of threads, each behind the one above. Bands start in order, so that
// the band that others wait for is always running.
template <class GrowBand>
void Sweep::for_each_band(GrowBand grow) {
    const auto run = [&](std::size_t i) {
        std::atomic<int>& done_x = bands_[i].done_x;
        const auto finish = [&] {
            done_x.store(INT_MAX, std::memory_order_release);
            done_x.notify_all();
        };
        try {
            grow(i);
        } catch (...) {
            stopped_ = true;
            finish();
            throw;
        }
        finish();
    };
    // On a torus the last band meets the first, so a band must be complete before the next one
    // starts.
    if (canvas_.torus()) {
        for (std::size_t i = 0; i < bands_.size(); ++i)
            run(i);
    } else {
        parallel_for(bands_.size(), run);
    }
}

bool Sweep::cut_again(Canvas& canvas, float gradient_floor, PlaneStats& stats,
                      const CancelToken& cancel) {
    cancel_ = &cancel;
    for (Band& band : bands_)
        band.done_x = INT_MIN;
    for_each_band([&](std::size_t i) { lay_band_again(i, canvas, gradient_floor); });
    for (const Band& band : bands_)
        stats.peak_graph_bytes = std::max(stats.peak_graph_bytes, band.peak_bytes);
    return !stopped_;
}

void Sweep::lay_band_again(std::size_t index, Canvas& canvas, float gradient_floor) {
    Band& band = bands_[index];
    for (const Placed& p : band.placed) {
        if (!canvas.torus()) wait_for(index, p.rect.x1 + 1);
        if (cancel_->cancelled()) stopped_ = true;
        if (stopped_) return;
        const std::size_t bytes = lay_patch(canvas, copy_block(canvas, p.rect), atlas_.pixels(),
                                            {p.rect, p.origin}, options_, gradient_floor);
        band.peak_bytes = std::max(band.peak_bytes, bytes);
        // The next patch may start left of this patch's right end.
        band.done_x.store(p.rect.x1 - x_.overlap - 1, std::memory_order_release);
        band.done_x.notify_all();
    }
    // If the band above has filled this band's right end too, the last patch lies before it. The
    // band below must not start there while the band above is still running.
    if (!canvas.torus()) wait_for(index, INT_MAX);
}

void Sweep::grow_band(std::size_t index) {
    Band& band = bands_[index];
    for (int x = 0; x < canvas_.size().width; ++x) {
        // The band above must be done here before this band can find its unfilled columns.
        if (!canvas_.torus()) wait_for(index, x - x_.overlap + x_.block + x_.window);
        if (cancel_->cancelled()) stopped_ = true;
        if (stopped_) break;
        if (column_filled(band, x)) continue;
        const ScopeTimer busy(band.busy_s);
        x = lay(index, x) - 1;
        band.done_x.store(x - x_.overlap, std::memory_order_release);
        band.done_x.notify_all();
    }
}

bool Sweep::column_filled(const Band& band, int x) const {
    for (int y = band.y0; y < band.y1; ++y) {
        if (!canvas_.filled(x, y)) return false;
    }
    return true;
}

// Returns when the band above no longer reads or writes left of x.
void Sweep::wait_for(std::size_t index, int x) {
    if (index == 0) return;
    const std::atomic<int>& done_x = bands_[index - 1].done_x;
    constexpr int kSpins = 2000;  // A placement takes some 100 µs; waking a thread costs 50.
    for (int i = 0; i < kSpins && done_x.load(std::memory_order_acquire) < x; ++i) {
    }
    for (int seen = done_x.load(std::memory_order_acquire); seen < x;
         seen = done_x.load(std::memory_order_acquire)) {
        done_x.wait(seen, std::memory_order_acquire);
    }
}

Block Sweep::next_block(const Band& band, int x) const {
    const int x0 = x - (x == 0 && !canvas_.torus() ? x_.hi : x_.overlap);
    return copy_block(canvas_, {x0, band.block_y0, x0 + x_.block, band.block_y0 + y_.block});
}

Sweep::GuideBlock Sweep::copy_guide(const Recti& rect) const {
    GuideBlock out{ImageU8x3(rect.size()), Image<std::uint8_t, 1>(rect.size(), 0)};
    for (int y = 0; y < rect.height(); ++y) {
        for (int x = 0; x < rect.width(); ++x) {
            const auto p = canvas_.resolve(rect.x0 + x, rect.y0 + y);
            if (!p || !options_.guide->known.at(p->x, p->y)) continue;
            out.known.at(x, y) = 1;
            std::copy_n(options_.guide->target.pixel(p->x, p->y), 3, out.pixels.pixel(x, y));
        }
    }
    return out;
}

// The placements that the block's candidates are compared with. From bands above: those that start
// within a window's width of its right end, which wait_for() guarantees to be finished.
PlacementMemory Sweep::memory(std::size_t index, const Recti& block) const {
    std::vector<Placed> out;
    const Recti reach{block.x0 - 2 * x_.window, block.y0 - 2 * y_.window, block.x1 + x_.window,
                      block.y1};
    const int turns = canvas_.torus() ? 1 : 0;
    const Size plane = canvas_.size();
    for (std::size_t i = 0; i <= index; ++i) {
        if (turns == 0 && bands_[i].block_y0 + y_.block < reach.y0) continue;
        const int count = bands_[i].count.load(std::memory_order_acquire);
        for (int k = 0; k < count; ++k) {
            const Placed& p = bands_[i].placed[static_cast<std::size_t>(k)];
            for (int ky = -turns; ky <= turns; ++ky) {
                for (int kx = -turns; kx <= turns; ++kx) {
                    const Vec2i d{kx * plane.width, ky * plane.height};
                    const Recti r{p.rect.x0 + d.x, p.rect.y0 + d.y, p.rect.x1 + d.x,
                                  p.rect.y1 + d.y};
                    if (r.x0 > reach.x1 || r.x1 < reach.x0 || r.y1 < reach.y0) continue;
                    out.push_back({p.origin + d, r});
                }
            }
        }
    }
    return PlacementMemory(std::move(out), {x_.window, y_.window});
}

// Forbidden translations: the sample would only continue an earlier placement (no new texture, with
// an error of 0), is not aligned with the rows, or only touches its surroundings. Each rule keeps
// some of the translations that the rules before it left.
std::vector<Vec2i> Sweep::forbidden(const Block& block, Vec2i to_canvas,
                                    const PlacementMemory& memory) const {
    const int columns = x_.hi - x_.lo + 1, rows = y_.hi - y_.lo + 1;
    Image<std::uint8_t, 1> bad(columns, rows, 0);
    for (const Placed& p : memory.earlier()) {
        const Vec2i t = p.origin - to_canvas - Vec2i{x_.lo, y_.lo};
        if (rect_of(bad.size()).contains(t.x, t.y)) bad.at(t.x, t.y) = 1;
    }
    if (!lattice_.empty()) {
        forbid_off_lattice(to_canvas, bad);
    } else if (period_.count > 0) {
        forbid_misaligned(block.rect, to_canvas, memory, bad);
    }
    // Bands keep the overlap above and to the left. Only on a torus, or beside locked texels, can a
    // patch touch filled pixels on the other side.
    if (canvas_.torus() || canvas_.any_locked()) forbid_thin_contacts(block, bad);
    std::vector<Vec2i> out;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            if (bad.at(x, y)) out.push_back({x + x_.lo, y + y_.lo});
        }
    }
    return out;
}

// The axes make sure that a point of the lattice is in reach, so the rule has no exception; one
// that continues an earlier placement is better than one beside the lattice.
void Sweep::forbid_off_lattice(Vec2i to_canvas, Image<std::uint8_t, 1>& bad) const {
    const Image<std::uint8_t, 1> held = lattice_.held(Vec2i{x_.lo, y_.lo} + to_canvas, bad.size());
    bool any = false;
    for (std::size_t i = 0; i < held.size_bytes(); ++i)
        any |= held.data()[i] && !bad.data()[i];
    for (std::size_t i = 0; i < held.size_bytes(); ++i) {
        const bool earlier = any && bad.data()[i];
        bad.data()[i] = !held.data()[i] || earlier;
    }
}

// Aligned with the placements that the block overlaps. Farther placements are not used, because the
// error of the period, found on a small sample, would add up.
void Sweep::forbid_misaligned(const Recti& block, Vec2i to_canvas, const PlacementMemory& memory,
                              Image<std::uint8_t, 1>& bad) const {
    Image<std::uint8_t, 1> out = bad;
    for (const Placed& p : memory.earlier()) {
        if (p.rect.intersected(block).empty()) continue;
        const Vec2i first = Vec2i{x_.lo, y_.lo} + to_canvas - p.origin;
        const Image<std::uint8_t, 1> aligned = period_.held(first, bad.size(), kAlignTolerance_px);
        for (std::size_t i = 0; i < out.size_bytes(); ++i)
            out.data()[i] |= aligned.data()[i] ^ 1u;
    }
    const bool any =
        std::find(out.data(), out.data() + out.size_bytes(), 0) != out.data() + out.size_bytes();
    if (any) bad = std::move(out);
}

void Sweep::forbid_thin_contacts(const Block& block, Image<std::uint8_t, 1>& bad) const {
    const std::vector<std::uint32_t> thin =
        thin_contacts(canvas_, block, {x_.window, y_.window}, {x_.lo, y_.lo}, {x_.hi, y_.hi},
                      {x_.min_overlap, y_.min_overlap});
    std::uint32_t least = ~std::uint32_t{0};
    for (std::size_t i = 0; i < thin.size(); ++i) {
        if (!bad.data()[i]) least = std::min(least, thin[i]);
    }
    for (std::size_t i = 0; i < thin.size(); ++i) {
        if (thin[i] > 2 * least) bad.data()[i] = 1;
    }
}

Shortlist Sweep::find(const Place& place, const Block& block, const PlacementMemory& earlier) {
    const Vec2i to_canvas{block.rect.x0 - place.window.x0, block.rect.y0 - place.window.y0};
    const std::vector<Vec2i> bad = forbidden(block, to_canvas, earlier);
    if (auto found = device_.find(block.rect, place.window, {x_.lo, y_.lo}, {x_.hi, y_.hi}, bad)) {
        return *std::move(found);
    }
    MatchTarget target{block.pixels, block.filled, {}, {}, 1, 0};
    GuideBlock guide;
    if (options_.guide) {
        guide = copy_guide(block.rect);
        target.guide = guide.pixels;
        target.guide_known = guide.known;
        target.fill_weight = PlaneGuide::kFillWeight;
        target.guide_weight = options_.guide->guide_weight();
    }
    return place.search->find(
        target, bad, options_.plain_solvers ? SearchMethod::kDirect : SearchMethod::kFastest);
}

Sweep::Choice Sweep::choose(std::size_t index, int x, Rng& rng) {
    Choice choice;
    choice.block = next_block(bands_[index], x);
    const Block& block = choice.block;
    const PlacementMemory earlier = memory(index, block.rect);
    Shortlist best;
    const Place* where = nullptr;
    const std::size_t tries = std::min(kPagesPerStep, atlas_.pages().size());
    for (std::size_t i = 0; i < tries; ++i) {
        const Place& place = places_[rng.below(places_.size())];
        Shortlist list = find(place, block, earlier);
        if (where && at_most(best.best_cost, list.best_cost)) continue;
        best = std::move(list);
        where = &place;
    }
    const Vec2i to_canvas{block.rect.x0 - where->window.x0, block.rect.y0 - where->window.y0};
    for (Vec2i& t : best.good)
        t += to_canvas;
    const std::vector<Vec2i> good = earlier.least_repetitive(best.good, block.rect);
    choice.origin = good[rng.below(good.size())];
    const Recti& w = where->window;
    choice.window = {choice.origin.x + w.x0, choice.origin.y + w.y0, choice.origin.x + w.x1,
                     choice.origin.y + w.y1};
    return choice;
}

// Returns the x at which the band continues.
int Sweep::lay(std::size_t index, int x) {
    Band& band = bands_[index];
    const int number = band.count.load(std::memory_order_relaxed);
    Rng rng(options_.seed, options_.region, options_.frame,
            (static_cast<std::uint64_t>(index) << 32) + static_cast<std::uint64_t>(number));
    Choice choice;
    {
        const ScopeTimer timer(band.search_s);
        choice = choose(index, x, rng);
    }
    Patch patch{choice.block.rect.intersected(choice.window), choice.origin};
    if (!canvas_.torus()) patch.rect = patch.rect.intersected(rect_of(canvas_.size()));
    {
        const ScopeTimer timer(band.seam_s);
        const std::size_t bytes =
            lay_patch(canvas_, choice.block, atlas_.pixels(), patch, options_);
        band.peak_bytes = std::max(band.peak_bytes, bytes);
    }
    device_.show(canvas_, patch.rect);
    band.placed.push_back({patch.origin, patch.rect});
    band.count.store(number + 1, std::memory_order_release);
    return patch.rect.x1;
}

}  // namespace weft
