#include "engine/synthesis/patch_seam.h"

#include <algorithm>

#include "engine/seam/seam_cost.h"

namespace weft {
namespace {

// The patch's part of the atlas.
ViewU8x3 new_picture(ViewU8x3 atlas, const Patch& patch) {
    const Recti r = patch.rect;
    return atlas.crop({r.x0 - patch.origin.x, r.y0 - patch.origin.y, r.x1 - patch.origin.x,
                       r.y1 - patch.origin.y});
}

// Ties by the four neighbours; the outermost pixels of the patch use the canvas's pixels.
Image<SeamCell, 1> tie_overlap(const Canvas& canvas, ViewU8x1 filled, ViewU8x1 inside,
                               const Recti& rect) {
    const int w = rect.width(), h = rect.height();
    Image<SeamCell, 1> cells(w, h, SeamCell::kOutside);
    // 1 where a pixel of the patch is still unfilled.
    Image<std::uint8_t, 1> empty(w + 2, h + 2, 0);
    for (int y = 0; y < h; ++y) {
        const std::uint8_t *f = filled.row(y), *in = inside.row(y);
        std::uint8_t* e = empty.pixel(1, y + 1);
        for (int x = 0; x < w; ++x)
            e[x] = static_cast<std::uint8_t>(in[x] & (f[x] ^ 1));
    }
    for (int y = 0; y < h; ++y) {
        const std::uint8_t* f = filled.row(y);
        const std::uint8_t *above = empty.pixel(1, y), *e = empty.pixel(1, y + 1),
                           *below = empty.pixel(1, y + 2);
        SeamCell* out = cells.row(y);
        for (int x = 0; x < w; ++x) {
            const bool beside_empty = (above[x] | below[x] | e[x - 1] | e[x + 1]) != 0;
            out[x] = !f[x] ? SeamCell::kOutside : beside_empty ? SeamCell::kNew : SeamCell::kFree;
        }
    }
    const auto tie_to_outside = [&](int x, int y, int dx, int dy) {
        if (filled.row(y)[x] && canvas.filled(rect.x0 + x + dx, rect.y0 + y + dy)) {
            cells.at(x, y) = SeamCell::kOld;
        }
    };
    for (int x = 0; x < w; ++x)
        tie_to_outside(x, 0, 0, -1), tie_to_outside(x, h - 1, 0, 1);
    for (int y = 0; y < h; ++y)
        tie_to_outside(0, y, -1, 0), tie_to_outside(w - 1, y, 1, 0);
    for (int y = 0; y < h && canvas.any_locked(); ++y) {
        for (int x = 0; x < w; ++x) {
            if (canvas.locked(rect.x0 + x, rect.y0 + y)) cells.at(x, y) = SeamCell::kOld;
        }
    }
    return cells;
}

Recti within(const Block& block, const Recti& rect) {
    return {rect.x0 - block.rect.x0, rect.y0 - block.rect.y0, rect.x1 - block.rect.x0,
            rect.y1 - block.rect.y0};
}

SeamResult solve_by(const PlaneOptions& options, const SeamProblem& problem) {
    switch (options.seam) {
        case SeamMethod::kDynamicProgramming:
            return solve_min_error_boundary(problem);
        case SeamMethod::kNone:
            return solve_direct(problem);
        default:
            return options.plain_solvers ? solve_grid_maxflow(problem) : solve_seam(problem);
    }
}

}  // namespace

SeamProblem overlap_problem(const Canvas& canvas, const Block& block, ViewU8x3 atlas,
                            const Patch& patch, const PlaneOptions& options, float gradient_floor) {
    const Recti local = within(block, patch.rect);
    SeamProblem problem;
    problem.cells = tie_overlap(canvas, block.filled.view().crop(local),
                                block.inside.view().crop(local), patch.rect);
    const ViewU8x3 a = block.pixels.view().crop(local), b = new_picture(atlas, patch);
    ImageU8x3 target;
    Matte known;
    if (options.guide) {
        target = ImageU8x3(patch.rect.size());
        known = Matte(patch.rect.size(), 0);
        for (int y = 0; y < target.height(); ++y) {
            for (int x = 0; x < target.width(); ++x) {
                const auto p = canvas.resolve(patch.rect.x0 + x, patch.rect.y0 + y);
                if (!p || !options.guide->known.at(p->x, p->y)) continue;
                known.at(x, y) = 255;
                std::copy_n(options.guide->target.pixel(p->x, p->y), 3, target.pixel(x, y));
            }
        }
        fill_data_costs(a, b, target, known, options.guide->weight, problem);
    }
    if (options.seam_cost == SeamCost::kPaper) {
        fill_paper_costs(a, b, target, known, problem);
    } else {
        fill_seam_costs(a, b, problem, gradient_floor);
    }
    return problem;
}

std::size_t lay_patch(Canvas& canvas, const Block& block, ViewU8x3 atlas, const Patch& patch,
                      const PlaneOptions& options, float gradient_floor) {
    const SeamProblem problem =
        overlap_problem(canvas, block, atlas, patch, options, gradient_floor);
    const SeamResult seam = solve_by(options, problem);
    const Recti& r = patch.rect;
    const auto shows_new = [&](int x, int y) {
        return problem.cells.row(y)[x] == SeamCell::kOutside || seam.labels.row(y)[x] != 0;
    };
    for (int y = 0; y < r.height(); ++y) {
        for (int x = 0; x < r.width();) {
            if (!shows_new(x, y)) {
                ++x;
                continue;
            }
            const int start = x;
            while (x < r.width() && shows_new(x, y))
                ++x;
            const Vec2i from{r.x0 + start - patch.origin.x, r.y0 + y - patch.origin.y};
            canvas.set_run({r.x0 + start, r.y0 + y}, x - start, atlas.pixel(from.x, from.y), from);
        }
    }
    return seam.graph_bytes;
}

}  // namespace weft
