#include "engine/metrics/sequence_diff.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/core/text.h"

namespace weft {
namespace {

double difference(float a, float b) {
    if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
    const double d = std::abs(static_cast<double>(a) - static_cast<double>(b));
    return std::isnan(d) ? std::numeric_limits<double>::infinity() : d;
}

struct RowDiff {
    std::array<double, 3> max_abs{}, sum_abs{};
    double squared = 0;
    std::int64_t pixels = 0, differing = 0;
    Recti box;
};

RowDiff diff_row(ViewF3 a, ViewF3 b, const ViewU8x1* where, int y) {
    RowDiff r;
    for (int x = 0; x < a.width(); ++x) {
        if (where != nullptr && where->row(y)[x] != 0) continue;
        ++r.pixels;
        bool same = true;
        for (std::size_t c = 0; c < 3; ++c) {
            const double d = difference(a.pixel(x, y)[c], b.pixel(x, y)[c]);
            same = same && d == 0;
            r.max_abs[c] = std::max(r.max_abs[c], d);
            r.sum_abs[c] += d;
            r.squared += d * d;
        }
        if (same) continue;
        ++r.differing;
        r.box = r.box.united({x, y, x + 1, y + 1});
    }
    return r;
}

Expected<FrameDiff> diff(ViewF3 a, ViewF3 b, const ViewU8x1* where) {
    if (!(a.size() == b.size())) {
        return fail(ErrorCode::kDiffers, "The frames differ in size: " + size_text(a.size()) +
                                             " and " + size_text(b.size()) + ".");
    }
    if (where != nullptr && !(where->size() == a.size())) {
        return fail(ErrorCode::kUnreadable,
                    "The matte is " + size_text(where->size()) + " but the frame is " +
                        size_text(a.size()) + ".",
                    "Give a matte of the frame's size.");
    }
    std::vector<RowDiff> rows(static_cast<std::size_t>(a.height()));
    parallel_for(rows.size(),
                 [&](std::size_t y) { rows[y] = diff_row(a, b, where, static_cast<int>(y)); });
    FrameDiff out;
    double squared = 0;
    for (std::size_t y = 0; y < rows.size(); ++y) {
        const RowDiff& r = rows[y];
        for (std::size_t c = 0; c < 3; ++c) {
            out.max_abs[c] = std::max(out.max_abs[c], r.max_abs[c]);
            out.mean_abs[c] += r.sum_abs[c];
        }
        squared += r.squared;
        out.pixels += r.pixels;
        out.differing += r.differing;
        if (!out.first && !r.box.empty()) out.first = Vec2i(r.box.x0, r.box.y0);
        out.box = out.box.united(r.box);
    }
    out.equal = out.differing == 0;
    const double n = static_cast<double>(out.pixels);
    for (double& m : out.mean_abs)
        m = out.pixels > 0 ? m / n : 0;
    if (!out.equal) out.psnr_db = -10.0 * std::log10(squared / (3.0 * n));
    return out;
}

}  // namespace

Expected<FrameDiff> diff_frames(ViewF3 a, ViewF3 b) {
    return diff(a, b, nullptr);
}

Expected<FrameDiff> diff_outside(ViewF3 a, ViewF3 b, ViewU8x1 where) {
    return diff(a, b, &where);
}

void SequenceDiff::add(int frame, const FrameDiff& d) {
    ++frames;
    if (d.equal) return;
    ++differing_frames;
    if (!first_differing_frame) first_differing_frame = frame;
    for (const double m : d.max_abs)
        max_abs = std::max(max_abs, m);
    if (d.psnr_db) least_psnr_db = std::min(least_psnr_db.value_or(*d.psnr_db), *d.psnr_db);
}

}  // namespace weft
