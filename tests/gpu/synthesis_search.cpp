// engine/synthesis behind the interface of the device searches.
#include "engine/synthesis/placement_search.h"
#include "tests/gpu/search_cases.h"

namespace weft::test {
namespace {

class SynthesisSearch final : public PlaneSearch {
  public:
    SynthesisSearch(const PlaneSearchSetup& setup, SearchMethod method)
        : setup_(setup), method_(method), pixels_(setup.canvas), filled_(setup.canvas, 0) {}

    Status update(const Recti& rect, ViewU8x3 pixels, ViewU8x1 filled) override {
        for (int y = 0; y < rect.height(); ++y) {
            std::copy_n(pixels.row(y), 3 * rect.width(), pixels_.pixel(rect.x0, rect.y0 + y));
            std::copy_n(filled.row(y), rect.width(), filled_.pixel(rect.x0, rect.y0 + y));
        }
        return {};
    }

    Expected<PlaneSearchResult> find(const PlaneSearchRequest& r) override {
        const ImageU8x3 pixels = block_of<3>(pixels_.view(), r.block);
        const Image<std::uint8_t, 1> filled = block_of<1>(filled_.view(), r.block);
        MatchTarget target{pixels, filled, {}, {}, setup_.fill_weight, setup_.guide_weight};
        ImageU8x3 guide;
        Image<std::uint8_t, 1> known;
        if (!setup_.guide.empty()) {
            guide = block_of<3>(setup_.guide, r.block);
            known = block_of<1>(setup_.guide_known, r.block);
            target.guide = guide;
            target.guide_known = known;
        }
        const int row = r.hi.x - r.lo.x + 1;
        std::vector<Vec2i> forbidden;
        for (std::size_t i = 0; i < r.allowed.size(); ++i) {
            if (!r.allowed[i])
                forbidden.push_back(r.lo +
                                    Vec2i{static_cast<int>(i) % row, static_cast<int>(i) / row});
        }
        PlacementSearch search(setup_.samples[static_cast<std::size_t>(r.sample)].crop(r.window),
                               r.block.size(), r.lo, r.hi);
        const Shortlist list = search.find(target, forbidden, method_);
        const auto index = [&](Vec2i t) {
            return static_cast<std::uint32_t>((t.y - r.lo.y) * row + t.x - r.lo.x);
        };
        PlaneSearchResult result;
        result.best = index(list.best);
        result.best_cost = {list.best_cost.ssd, list.best_cost.weight};
        for (const Vec2i t : list.good)
            result.good.push_back(index(t));
        return result;
    }

  private:
    template <int C>
    Image<std::uint8_t, C> block_of(ImageView<const std::uint8_t, C> from, const Recti& r) const {
        Image<std::uint8_t, C> out(r.size(), 0);
        const Size canvas = setup_.canvas;
        for (int y = 0; y < r.height(); ++y) {
            for (int x = 0; x < r.width(); ++x) {
                int cx = r.x0 + x, cy = r.y0 + y;
                if (setup_.torus) {
                    cx = (cx + canvas.width) % canvas.width;
                    cy = (cy + canvas.height) % canvas.height;
                }
                if (!rect_of(canvas).contains(cx, cy)) continue;
                std::copy_n(from.pixel(cx, cy), C, out.pixel(x, y));
            }
        }
        return out;
    }

    PlaneSearchSetup setup_;
    SearchMethod method_;
    ImageU8x3 pixels_;
    Image<std::uint8_t, 1> filled_;
};

}  // namespace

std::unique_ptr<PlaneSearch> make_synthesis_search(const PlaneSearchSetup& setup,
                                                   SynthesisMethod method) {
    return std::make_unique<SynthesisSearch>(
        setup, method == SynthesisMethod::kFft ? SearchMethod::kFft : SearchMethod::kDirect);
}

}  // namespace weft::test
