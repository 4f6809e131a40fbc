#include "engine/synthesis/amend_canvas.h"

#include <algorithm>
#include <optional>

#include "engine/core/rng.h"
#include "engine/synthesis/grow_canvas.h"

namespace weft {
namespace {

// The rim around kept texels is wide enough for a seam.
constexpr int kLeastRim_px = 12;
// Regenerated texels may move their seams a little outwards.
constexpr int kAgainRim_px = 6;

class Amender {
  public:
    Amender(const SampleAtlas& atlas, const PlaneOptions& options, const PlaneStructure& structure,
            Canvas& canvas)
        : atlas_(atlas),
          options_(options),
          structure_(structure),
          canvas_(canvas),
          kept_(canvas.size(), 0) {}

    [[nodiscard]] bool carry_out(const PlaneAmendment& amendment, std::size_t index,
                                 PlaneStats& stats, const CancelToken& cancel) {
        Image<std::uint8_t, 1> open(canvas_.size(), 0);
        const bool keeps = amendment.kind == PlaneAmendment::Kind::kKeep;
        if (keeps ? !keep(amendment, open) : !clear(amendment, open)) return true;
        return grow(open, keeps ? 0 : amendment.seed + 1, index, stats, cancel);
    }

  private:
    // Shows the kept texels and opens a rim around them. False if the plane already shows all of
    // them.
    [[nodiscard]] bool keep(const PlaneAmendment& amendment, Image<std::uint8_t, 1>& open) {
        bool changed = false;
        std::vector<Vec2i> texels;
        for (const TexelRun& run : amendment.runs) {
            for (int k = 0; k < run.count; ++k) {
                const auto at = canvas_.resolve(run.x + k, run.y);
                const auto from = place_of(run, k);
                if (!at || !from) continue;
                const std::int32_t* now = canvas_.source().pixel(at->x, at->y);
                changed |= now[0] != from->x || now[1] != from->y;
                canvas_.set(*at, atlas_.pixels().pixel(from->x, from->y), *from);
                kept_.at(at->x, at->y) = 1;
                texels.push_back(*at);
            }
        }
        if (changed) open_around(texels, std::max(kLeastRim_px, options_.overlap_px), open);
        return changed;
    }

    // Opens the places themselves. False if there are none.
    [[nodiscard]] bool clear(const PlaneAmendment& amendment, Image<std::uint8_t, 1>& open) {
        std::vector<Vec2i> texels;
        for (const TexelRun& run : amendment.runs)
            for (int k = 0; k < run.count; ++k)
                if (const auto at = canvas_.resolve(run.x + k, run.y)) texels.push_back(*at);
        open_around(texels, kAgainRim_px, open);
        return std::find(open.data(), open.data() + open.size_bytes(), 1) !=
               open.data() + open.size_bytes();
    }

    void open_around(const std::vector<Vec2i>& texels, int rim_px, Image<std::uint8_t, 1>& open) {
        // Squares around the texels, rows first and then columns, at a cost of 2·rim per texel.
        Image<std::uint8_t, 1> rows(canvas_.size(), 0);
        for (const Vec2i p : texels)
            for (int d = -rim_px; d <= rim_px; ++d)
                if (const auto q = canvas_.resolve(p.x + d, p.y)) rows.at(q->x, q->y) = 1;
        for (int y = 0; y < rows.height(); ++y) {
            for (int x = 0; x < rows.width(); ++x) {
                if (!rows.at(x, y)) continue;
                for (int d = -rim_px; d <= rim_px; ++d) {
                    const auto q = canvas_.resolve(x, y + d);
                    if (q && !kept_.at(q->x, q->y)) open.at(q->x, q->y) = 1;
                }
            }
        }
    }

    // The place in the atlas that the run's k-th texel comes from.
    [[nodiscard]] std::optional<Vec2i> place_of(const TexelRun& run, int k) const {
        const auto page = std::find_if(
            atlas_.pages().begin(), atlas_.pages().end(), [&](const SampleAtlas::Page& p) {
                return p.sample == run.sample && p.orientation == run.orientation;
            });
        if (page == atlas_.pages().end()) return std::nullopt;
        const Vec2i first =
            atlas_.position_of({run.sample, run.orientation, {run.from_x, run.from_y}});
        const Vec2i at{first.x + k, first.y};
        return page->rect.contains(at.x, at.y) ? std::optional<Vec2i>(at) : std::nullopt;
    }

    // Grows what is open, with everything else locked. `salt` 0: with the plane's own seed.
    [[nodiscard]] bool grow(const Image<std::uint8_t, 1>& open, std::uint64_t salt,
                            std::size_t index, PlaneStats& stats, const CancelToken& cancel) {
        Canvas fresh(canvas_.size(), canvas_.torus());
        for (int y = 0; y < open.height(); ++y) {
            for (int x = 0; x < open.width(); ++x) {
                if (open.at(x, y)) continue;
                const std::int32_t* from = canvas_.source().pixel(x, y);
                fresh.set({x, y}, canvas_.pixels().pixel(x, y), {from[0], from[1]});
                fresh.lock({x, y});
            }
        }
        PlaneOptions options = options_;
        options.amendments.clear();
        options.guide.reset();
        // The first round of refinement cuts all seams again; further rounds would search the whole
        // plane.
        options.refine_passes = std::min(options.refine_passes, 1);
        if (salt != 0) options.seed = mix64(options.seed + mix64(salt + (index << 32)));
        PlaneStats part;
        const bool done = grow_canvas(atlas_, options, structure_, fresh, part, cancel, {});
        stats.search_s += part.search_s, stats.seam_s += part.seam_s;
        stats.refine_s += part.refine_s;
        stats.peak_graph_bytes = std::max(stats.peak_graph_bytes, part.peak_graph_bytes);
        if (done) canvas_ = std::move(fresh);
        return done;
    }

    const SampleAtlas& atlas_;
    const PlaneOptions& options_;
    const PlaneStructure& structure_;
    Canvas& canvas_;
    Image<std::uint8_t, 1> kept_;
};

}  // namespace

bool amend_canvas(const SampleAtlas& atlas, const PlaneOptions& options,
                  const PlaneStructure& structure, Canvas& canvas, PlaneStats& stats,
                  const CancelToken& cancel) {
    if (options.amendments.empty()) return true;
    Amender amender(atlas, options, structure, canvas);
    for (std::size_t k = 0; k < options.amendments.size(); ++k)
        if (!amender.carry_out(options.amendments[k], k, stats, cancel)) return false;
    return true;
}

}  // namespace weft
