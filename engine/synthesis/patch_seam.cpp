#include "engine/synthesis/patch_seam.h"

#include "engine/seam/seam_cost.h"

namespace weft {
namespace {

// The patch's part of the sample.
ViewU8x3 new_picture(ViewU8x3 sample, const Patch& patch) {
    const Recti r = patch.rect;
    return sample.crop({r.x0 - patch.origin.x, r.y0 - patch.origin.y, r.x1 - patch.origin.x,
                        r.y1 - patch.origin.y});
}

Image<SeamCell, 1> tie_overlap(const Canvas& canvas, ViewU8x1 filled, ViewU8x1 inside,
                               const Recti& rect) {
    const int w = rect.width(), h = rect.height();
    Image<SeamCell, 1> cells(w, h, SeamCell::kOutside);
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            if (!filled.at(x, y)) continue;
            bool old_outside = false, empty_inside = false;
            for (const Vec2i d : {Vec2i{1, 0}, Vec2i{-1, 0}, Vec2i{0, 1}, Vec2i{0, -1}}) {
                const int nx = x + d.x, ny = y + d.y;
                if (nx >= 0 && ny >= 0 && nx < w && ny < h) {
                    empty_inside |= inside.at(nx, ny) != 0 && filled.at(nx, ny) == 0;
                } else {
                    old_outside |= canvas.filled(rect.x0 + nx, rect.y0 + ny);
                }
            }
            cells.at(x, y) = old_outside    ? SeamCell::kOld
                             : empty_inside ? SeamCell::kNew
                                            : SeamCell::kFree;
        }
    }
    return cells;
}

Recti within(const Block& block, const Recti& rect) {
    return {rect.x0 - block.rect.x0, rect.y0 - block.rect.y0, rect.x1 - block.rect.x0,
            rect.y1 - block.rect.y0};
}

SeamResult solve_by(SeamMethod method, const SeamProblem& problem) {
    switch (method) {
        case SeamMethod::kDynamicProgramming:
            return solve_min_error_boundary(problem);
        case SeamMethod::kNone:
            return solve_direct(problem);
        default:
            return solve_seam(problem);
    }
}

}  // namespace

SeamProblem overlap_problem(const Canvas& canvas, const Block& block, ViewU8x3 sample,
                            const Patch& patch, const PlaneGuide* guide) {
    const Recti local = within(block, patch.rect);
    SeamProblem problem;
    problem.cells = tie_overlap(canvas, block.filled.view().crop(local),
                                block.inside.view().crop(local), patch.rect);
    const ViewU8x3 a = block.pixels.view().crop(local), b = new_picture(sample, patch);
    fill_seam_costs(a, b, problem);
    if (guide) {
        ImageU8x3 target(patch.rect.size());
        Matte known(patch.rect.size(), 0);
        for (int y = 0; y < target.height(); ++y) {
            for (int x = 0; x < target.width(); ++x) {
                const auto p = canvas.resolve(patch.rect.x0 + x, patch.rect.y0 + y);
                if (!p || !guide->known.at(p->x, p->y)) continue;
                known.at(x, y) = 255;
                for (int c = 0; c < 3; ++c)
                    target.at(x, y, c) = guide->target.at(p->x, p->y, c);
            }
        }
        fill_data_costs(a, b, target, known, guide->weight, problem);
    }
    return problem;
}

std::size_t lay_patch(Canvas& canvas, const Block& block, ViewU8x3 sample, const Patch& patch,
                      SeamMethod method, const PlaneGuide* guide) {
    const SeamProblem problem = overlap_problem(canvas, block, sample, patch, guide);
    const SeamResult seam = solve_by(method, problem);
    for (int y = patch.rect.y0; y < patch.rect.y1; ++y) {
        for (int x = patch.rect.x0; x < patch.rect.x1; ++x) {
            const int lx = x - patch.rect.x0, ly = y - patch.rect.y0;
            if (problem.cells.at(lx, ly) != SeamCell::kOutside && !seam.labels.at(lx, ly)) continue;
            const auto p = canvas.resolve(x, y);
            if (!p) continue;
            const Vec2i from{x - patch.origin.x, y - patch.origin.y};
            canvas.set(*p, sample.pixel(from.x, from.y), from);
        }
    }
    return seam.graph_bytes;
}

}  // namespace weft
