#include "tests/gpu/search_cases.h"

#include <algorithm>

#include "engine/core/rng.h"

namespace weft::test {
namespace {

// Few levels make many equal costs.
ImageU8x3 noise(Size size, std::uint64_t seed, std::uint64_t levels) {
    Rng rng(seed);
    ImageU8x3 out(size);
    for (std::size_t i = 0; i < out.size_bytes(); ++i)
        out.data()[i] = static_cast<std::uint8_t>(rng.below(levels) * 255 / (levels - 1));
    return out;
}

Image<std::uint8_t, 1> holes(Size size, std::uint64_t seed) {
    Rng rng(seed);
    Image<std::uint8_t, 1> out(size);
    for (std::size_t i = 0; i < out.size_bytes(); ++i)
        out.data()[i] = rng.below(3) != 0;
    return out;
}

// What a sweep leaves: everything above a row, and of the rows below what is left of a column.
Image<std::uint8_t, 1> sweep_front(Size size, int row, int column) {
    Image<std::uint8_t, 1> out(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x)
            out.at(x, y) = y < row || (y < row + 60 && x < column);
    }
    return out;
}

SearchCase base(const std::string& name, Size canvas, Size sample) {
    SearchCase c;
    c.name = name;
    c.canvas = canvas;
    c.pixels = noise(canvas, 1, 256);
    c.filled = sweep_front(canvas, canvas.height / 3, canvas.width / 3);
    c.samples.push_back(noise(sample, 2, 256));
    c.request.window = rect_of(sample);
    c.request.want_costs = true;
    return c;
}

void forbid(SearchCase& c, const std::vector<std::size_t>& indices) {
    c.allowed.assign(c.request.count(), 1);
    for (const std::size_t i : indices)
        c.allowed[i] = 0;
}

// Sizes and positions.
void add_shapes(std::vector<SearchCase>& cases) {
    SearchCase c = base("FirstSweep", {150, 150}, {96, 96});
    c.request.block = {14, 14, 134, 134};
    c.request.hi = {24, 24};
    cases.push_back(c);

    c = base("OverTheBorderOfAPlane", {70, 60}, {48, 40});
    c.request.block = {-9, -7, 46, 41};
    c.request.hi = {7, 8};
    cases.push_back(c);
    c.name = "AroundATorus";
    c.torus = true;
    cases.push_back(c);
    c.name = "AroundATorusAtItsEnd";
    c.request.block = {40, 31, 95, 79};
    cases.push_back(c);

    c = base("InsideABlock", {64, 64}, {80, 70});
    c.filled = Image<std::uint8_t, 1>(c.canvas, 1);
    c.request.block = {5, 6, 53, 54};
    c.request.lo = {-32, -22};
    cases.push_back(c);

    c = base("WindowOfASample", {90, 90}, {100, 90});
    c.samples.push_back(noise({61, 77}, 5, 256));
    c.request.sample = 1;
    c.request.window = {7, 9, 53, 66};
    c.request.block = {20, 20, 81, 79};
    c.request.lo = {-3, -5};
    c.request.hi = {12, 9};
    cases.push_back(c);

    c = base("MostlyBesideTheBlock", {64, 64}, {20, 24});
    c.request.block = {4, 4, 60, 60};
    c.request.lo = {-25, -30};
    c.request.hi = {60, 70};
    cases.push_back(c);

    c = base("OneTranslation", {40, 40}, {33, 35});
    c.request.block = {3, 3, 36, 38};
    cases.push_back(c);

    c = base("OneColumnOfTranslations", {70, 90}, {33, 45});
    c.request.block = {3, 3, 36, 60};
    c.request.lo = {0, -40};
    c.request.hi = {0, 41};
    cases.push_back(c);

    c = base("MoreThanABlockOfTranslations", {40, 24}, {760, 20});
    c.request.block = {2, 2, 38, 22};
    c.request.lo = {-724, -1};
    c.request.hi = {0, 1};
    cases.push_back(c);
}

// Values, weights, equal costs.
void add_values(std::vector<SearchCase>& cases) {
    SearchCase c = base("ManyEqualCosts", {80, 80}, {60, 60});
    c.pixels = noise(c.canvas, 7, 2);
    c.samples[0] = ImageU8x3(60, 60, 0);
    for (int y = 0; y < 60; ++y) {
        for (int x = 0; x < 60; ++x)
            c.samples[0].at(x, y, 1) = static_cast<std::uint8_t>(x % 4 < 2 ? 255 : 0);
    }
    c.request.block = {10, 10, 78, 78};
    c.request.hi = {8, 8};
    cases.push_back(c);

    c = base("HolesEverywhere", {75, 68}, {50, 50});
    c.filled = holes(c.canvas, 3);
    c.request.block = {3, 2, 66, 61};
    c.request.lo = {-2, -4};
    c.request.hi = {13, 11};
    cases.push_back(c);
    c.name = "WithAGuide";
    c.guide = noise(c.canvas, 11, 256);
    c.guide_known = holes(c.canvas, 12);
    c.fill_weight = 256;
    c.guide_weight = 77;
    cases.push_back(c);
    c.name = "WithAGuideAlone";
    c.filled = Image<std::uint8_t, 1>(c.canvas, 0);
    cases.push_back(c);

    c = base("NothingFilled", {50, 50}, {40, 40});
    c.filled = Image<std::uint8_t, 1>(c.canvas, 0);
    c.request.block = {2, 2, 46, 46};
    c.request.hi = {4, 4};
    cases.push_back(c);

    // Sums beyond 32 bits: 200² pixels at the greatest distance there is.
    c = base("SumsBeyond32Bits", {210, 210}, {200, 200});
    c.pixels = ImageU8x3(c.canvas, 255);
    c.filled = Image<std::uint8_t, 1>(c.canvas, 1);
    c.samples[0] = ImageU8x3(200, 200, 0);
    c.samples[0].at(100, 100, 2) = 1;
    c.request.block = {5, 5, 206, 207};
    c.request.hi = {1, 2};
    cases.push_back(c);

    c = base("ProductsBeyond64Bits", {80, 80}, {60, 60});
    c.fill_weight = 256'000;
    c.request.block = {6, 7, 70, 72};
    c.request.hi = {4, 5};
    cases.push_back(c);

    c = base("WhiteOnWhite", {60, 60}, {40, 40});
    c.pixels = ImageU8x3(c.canvas, 255);
    c.samples[0] = ImageU8x3(40, 40, 255);
    c.request.block = {3, 3, 48, 49};
    c.request.hi = {5, 6};
    cases.push_back(c);
}

void add_choices(std::vector<SearchCase>& cases) {
    SearchCase c = base("AWindowOfGoodOnes", {90, 90}, {60, 60});
    c.request.block = {9, 9, 78, 78};
    c.request.hi = {9, 9};
    cases.push_back(c);
    c.name = "TheBestOnesForbidden";
    const auto plain = make_plain_search(c.setup());
    (void)plain->update(rect_of(c.canvas), c.pixels, c.filled).has_value();
    c.request.want_costs = false;
    const PlaneSearchResult found = *plain->find(c.request);
    forbid(c, {found.good.begin(), found.good.end()});
    c.request.want_costs = true;
    cases.push_back(c);
    c.name = "AllForbidden";
    c.allowed.assign(c.request.count(), 0);
    cases.push_back(c);
    c.name = "OnlyTheLastAllowed";
    c.allowed.back() = 1;
    cases.push_back(c);
}

class PlainSearch final : public PlaneSearch {
  public:
    explicit PlainSearch(const PlaneSearchSetup& setup)
        : setup_(setup), pixels_(setup.canvas), filled_(setup.canvas, 0) {}

    Status update(const Recti& rect, ViewU8x3 pixels, ViewU8x1 filled) override {
        for (int y = 0; y < rect.height(); ++y) {
            std::copy_n(pixels.row(y), 3 * rect.width(), pixels_.pixel(rect.x0, rect.y0 + y));
            std::copy_n(filled.row(y), rect.width(), filled_.pixel(rect.x0, rect.y0 + y));
        }
        return {};
    }

    Expected<PlaneSearchResult> find(const PlaneSearchRequest& r) override {
        PlaneSearchResult result;
        std::vector<SearchCost> costs;
        for (int ty = r.lo.y; ty <= r.hi.y; ++ty) {
            for (int tx = r.lo.x; tx <= r.hi.x; ++tx)
                costs.push_back(cost(r, tx, ty));
        }
        const bool none = std::find(r.allowed.begin(), r.allowed.end(), 1) == r.allowed.end();
        const auto allowed = [&](std::size_t i) { return none || r.allowed[i] != 0; };
        std::size_t best = costs.size();
        for (std::size_t i = 0; i < costs.size(); ++i) {
            if (allowed(i) && (best == costs.size() || !at_most(costs[best], costs[i], 1, 1)))
                best = i;
        }
        for (std::uint32_t i = 0; i < costs.size(); ++i) {
            if (allowed(i) && at_most(costs[i], costs[best], r.good_numerator, r.good_denominator))
                result.good.push_back(i);
        }
        result.best = best;
        result.best_cost = costs[best];
        if (r.want_costs) result.costs = std::move(costs);
        return result;
    }

  private:
    static bool at_most(SearchCost a, SearchCost b, std::uint32_t numerator,
                        std::uint32_t denominator) {
        using Wide = unsigned __int128;
        const std::uint64_t wa = std::max<std::uint64_t>(1, a.weight),
                            wb = std::max<std::uint64_t>(1, b.weight);
        return Wide{a.ssd} * wb * denominator <= Wide{b.ssd} * wa * numerator;
    }

    [[nodiscard]] SearchCost cost(const PlaneSearchRequest& r, int tx, int ty) const {
        const ViewU8x3 sample = setup_.samples[static_cast<std::size_t>(r.sample)].crop(r.window);
        SearchCost sum;
        const auto add = [&](ViewU8x3 picture, int cx, int cy, int sx, int sy,
                             std::uint64_t weight) {
            for (int c = 0; c < 3; ++c) {
                const int d = picture.at(cx, cy, c) - sample.at(sx, sy, c);
                sum.ssd += weight * static_cast<std::uint64_t>(d * d);
            }
            sum.weight += weight;
        };
        for (int y = 0; y < r.block.height(); ++y) {
            for (int x = 0; x < r.block.width(); ++x) {
                const int sx = x - tx, sy = y - ty;
                if (!rect_of(sample.size()).contains(sx, sy)) continue;
                int cx = r.block.x0 + x, cy = r.block.y0 + y;
                if (setup_.torus) {
                    cx = (cx + setup_.canvas.width) % setup_.canvas.width;
                    cy = (cy + setup_.canvas.height) % setup_.canvas.height;
                }
                if (!rect_of(setup_.canvas).contains(cx, cy)) continue;
                if (filled_.at(cx, cy)) add(pixels_, cx, cy, sx, sy, setup_.fill_weight);
                if (!setup_.guide.empty() && setup_.guide_known.at(cx, cy))
                    add(setup_.guide, cx, cy, sx, sy, setup_.guide_weight);
            }
        }
        return sum;
    }

    PlaneSearchSetup setup_;
    ImageU8x3 pixels_;
    Image<std::uint8_t, 1> filled_;
};

}  // namespace

PlaneSearchSetup SearchCase::setup() const {
    PlaneSearchSetup s;
    s.canvas = canvas;
    s.torus = torus;
    for (const ImageU8x3& sample : samples)
        s.samples.emplace_back(sample.view());
    if (!guide.empty()) {
        s.guide = guide;
        s.guide_known = guide_known;
    }
    s.fill_weight = fill_weight;
    s.guide_weight = guide_weight;
    return s;
}

std::vector<SearchCase> search_cases() {
    std::vector<SearchCase> cases;
    add_shapes(cases);
    add_values(cases);
    add_choices(cases);
    return cases;
}

std::unique_ptr<PlaneSearch> make_plain_search(const PlaneSearchSetup& setup) {
    return std::make_unique<PlainSearch>(setup);
}

PlaneSearchSetup growing(SearchCase& owner, bool torus, bool guided) {
    owner.canvas = {130, 110};
    owner.torus = torus;
    owner.samples = {noise({48, 44}, 21, 40), noise({52, 48}, 22, 40)};
    if (guided) {
        owner.guide = noise(owner.canvas, 23, 256);
        owner.guide_known = holes(owner.canvas, 24);
        owner.fill_weight = 256;
        owner.guide_weight = 100;
    }
    return owner.setup();
}

std::vector<PlaneSearchResult> grow_with(PlaneSearch& search, const PlaneSearchSetup& setup) {
    constexpr int kOverlap = 14, kSlack = 6, kPatch = 44;
    const Size size = setup.canvas;
    ImageU8x3 pixels(size);
    Image<std::uint8_t, 1> filled(size, 0);
    std::vector<PlaneSearchResult> out;
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            if (filled.at(x, y)) continue;
            PlaneSearchRequest r;
            const int x0 = x - kOverlap, y0 = y - kOverlap;
            r.block = {x0, y0, x0 + kPatch + kSlack, y0 + kPatch + kSlack};
            r.sample = static_cast<int>(out.size() % setup.samples.size());
            r.window = rect_of(setup.samples[static_cast<std::size_t>(r.sample)].size());
            r.lo = {kPatch - r.window.width(), kPatch - r.window.height()};
            r.hi = {kSlack, kSlack};
            const auto found = search.find(r);
            if (!found) return out;
            out.push_back(*found);
            const int row = r.hi.x - r.lo.x + 1, best = static_cast<int>(found->best);
            const Recti patch = Recti{x0 + r.lo.x + best % row, y0 + r.lo.y + best / row, 0, 0};
            for (int sy = 0; sy < r.window.height(); ++sy) {
                for (int sx = 0; sx < r.window.width(); ++sx) {
                    int px = patch.x0 + sx, py = patch.y0 + sy;
                    if (setup.torus) {
                        px = (px + size.width) % size.width;
                        py = (py + size.height) % size.height;
                    }
                    if (!rect_of(size).contains(px, py)) continue;
                    const ViewU8x3 from = setup.samples[static_cast<std::size_t>(r.sample)];
                    std::copy_n(from.pixel(sx, sy), 3, pixels.pixel(px, py));
                    filled.at(px, py) = 1;
                }
            }
            // On a torus what changed wraps around: the rows in two parts.
            const int top = std::max(0, patch.y0), bottom = std::min(size.height, y0 + 60);
            for (const Recti part : {Recti{0, 0, size.width, setup.torus ? 12 : 0},
                                     Recti{0, top, size.width, bottom}}) {
                if (part.empty()) continue;
                if (!search.update(part, pixels.view().crop(part), filled.view().crop(part)))
                    return out;
            }
            if (setup.torus &&
                !search.update({0, size.height - 60, size.width, size.height},
                               pixels.view().crop({0, size.height - 60, size.width, size.height}),
                               filled.view().crop({0, size.height - 60, size.width, size.height})))
                return out;
        }
    }
    return out;
}

}  // namespace weft::test
