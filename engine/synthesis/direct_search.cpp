// Σ |C(p) − S(p−t)|² = Σ |C|² + Σ (|S|² − 256 Σ S) − 2 Σ (C − 128)·S over the filled pixels p that
// the sample reaches. The first two sums come from integral images, because the filled area is a
// few rectangles. The third multiplies signed by unsigned bytes, the processor's fastest
// multiplication. All values are integers.

#include "engine/synthesis/direct_search.h"

#include <algorithm>
#include <array>

#include "engine/synthesis/correlate_rows.h"
#include "engine/synthesis/rectangle_sums.h"

namespace weft {

std::vector<Recti> rectangles_of(ViewU8x1 mask) {
    std::vector<Recti> done, open;
    std::vector<Recti> row;
    for (int y = 0; y <= mask.height(); ++y) {
        row.clear();
        for (int x = 0; y < mask.height() && x < mask.width();) {
            const std::uint8_t* m = mask.row(y);
            while (x < mask.width() && !m[x])
                ++x;
            const int start = x;
            while (x < mask.width() && m[x])
                ++x;
            if (x > start) row.push_back({start, y, x, y + 1});
        }
        const bool same =
            std::equal(row.begin(), row.end(), open.begin(), open.end(),
                       [](const Recti& a, const Recti& b) { return a.x0 == b.x0 && a.x1 == b.x1; });
        if (!same) {
            done.insert(done.end(), open.begin(), open.end());
            open = row;
        }
        for (Recti& r : open)
            r.y1 = y + 1;
    }
    done.insert(done.end(), open.begin(), open.end());
    return done;
}

std::vector<TranslationGroup> group_translations(const std::vector<std::uint8_t>& allowed,
                                                 int columns) {
    const auto width = static_cast<std::size_t>(columns);
    const int rows = static_cast<int>(allowed.size() / width);
    const auto row = [&](int y) {
        return allowed.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y) * width);
    };
    const auto used = [&](int y) { return std::find(row(y), row(y + 1), 1) != row(y + 1); };
    std::vector<TranslationGroup> out;
    for (int y = 0; y < rows; ++y) {
        if (!used(y)) continue;
        int end = y + 1;
        while (end < rows && used(end))
            ++end;
        const int groups = (end - y + kCorrelationGroup - 1) / kCorrelationGroup;
        for (int g = 0; g < groups; ++g) {
            TranslationGroup group{y, (end - y + groups - g - 1) / (groups - g), {}};
            for (int x = 0; x < columns; ++x) {
                bool any = false;
                for (int k = 0; k < group.rows; ++k)
                    any |= row(y + k)[x] != 0;
                if (any) group.columns.push_back(x);
            }
            y += group.rows;
            out.push_back(std::move(group));
        }
    }
    return out;
}

DirectSearch::DirectSearch(ViewU8x3 sample, Size block, Vec2i lo, Vec2i hi)
    : sample_size_(sample.size()), block_(block), lo_(lo), hi_(hi) {
    // The sample's position p − t is p − t + hi in the padded sample.
    const Size padded{block.width + hi.x - lo.x, block.height + hi.y - lo.y};
    row_bytes_ = 3 * static_cast<std::size_t>(padded.width);
    padded_.assign(row_bytes_ * static_cast<std::size_t>(padded.height) + kCorrelationChunk, 0);
    const Recti inside =
        Recti{hi.x, hi.y, hi.x + sample.width(), hi.y + sample.height()}.intersected(
            rect_of(padded));
    lengths_ = Image<std::int64_t, 1>(padded.width + 1, padded.height + 1, 0);
    for (int y = 0; y < padded.height; ++y) {
        const bool covered = y >= inside.y0 && y < inside.y1;
        if (covered) {
            const std::uint8_t* from = sample.pixel(inside.x0 - hi.x, y - hi.y);
            std::copy_n(from, 3 * inside.width(), &padded_[padded_index(inside.x0, y)]);
        }
        std::int64_t run = 0;
        for (int x = 0; x < padded.width; ++x) {
            const std::uint8_t* s = &padded_[padded_index(x, y)];
            for (int c = 0; covered && c < 3; ++c)
                run += s[c] * (s[c] - 256);
            lengths_.row(y + 1)[x + 1] = lengths_.row(y)[x + 1] + run;
        }
    }
}

std::vector<OverlapCost> DirectSearch::costs(const MatchTarget& target,
                                             const std::vector<std::uint8_t>& allowed) const {
    const std::vector<TranslationGroup> groups = group_translations(allowed, hi_.x - lo_.x + 1);
    std::vector<OverlapCost> out(allowed.size());
    add_layer(target.pixels, target.filled, target.fill_weight, allowed, groups, out);
    if (!target.guide.empty()) {
        add_layer(target.guide, target.guide_known, target.guide_weight, allowed, groups, out);
    }
    return out;
}

void DirectSearch::add_layer(ViewU8x3 picture, ViewU8x1 mask, std::uint32_t weight,
                             const std::vector<std::uint8_t>& allowed,
                             const std::vector<TranslationGroup>& groups,
                             std::vector<OverlapCost>& costs) const {
    const int w = block_.width, h = block_.height;
    const int count_x = hi_.x - lo_.x + 1;
    // C − 128 where the mask is set, 0 elsewhere and in the rows above and below that a group of
    // translations may reach; which columns of a row are set; |C|² and counts.
    const auto chunk = static_cast<std::size_t>(kCorrelationChunk);
    const std::size_t stride = (3 * static_cast<std::size_t>(w) + chunk - 1) / chunk * chunk;
    SignedPlane plane(current_isa(), stride,
                      static_cast<std::size_t>(h) + 2 * std::size_t{kCorrelationGroup});
    std::vector<Hull> hulls(static_cast<std::size_t>(h));
    RectangleSums lengths(block_), counts(block_);
    for (int y = 0; y < h; ++y) {
        const std::uint8_t *m = mask.row(y), *c = picture.row(y);
        const std::size_t row = static_cast<std::size_t>(y + kCorrelationGroup) * stride;
        Hull& hull = hulls[static_cast<std::size_t>(y)];
        for (int x = 0; x < w; ++x) {
            if (!m[x]) continue;
            hull.join({x, x + 1});
            for (int i = 3 * x; i < 3 * x + 3; ++i)
                plane.set(row + static_cast<std::size_t>(i), c[i] - 128);
        }
        lengths.set_row(y, [&](int x) {
            const std::uint8_t* p = c + 3 * x;
            return m[x] ? p[0] * p[0] + p[1] * p[1] + p[2] * p[2] : 0;
        });
        counts.set_row(y, [&](int x) { return m[x] ? 1 : 0; });
    }

    // Σ (C − 128)·S for groups of translations that differ in y only.
    std::vector<std::int64_t> products(costs.size());
    std::vector<CorrelationRow> rows;
    for (const TranslationGroup& group : groups) {
        rows_of_group(hulls, stride, lo_.y + group.row, group.rows, rows);
        for (const int column : group.columns) {
            std::array<std::int64_t, kCorrelationGroup> sums;
            plane.correlate(
                rows, padded_.data() + 3 * static_cast<std::ptrdiff_t>(hi_.x - lo_.x - column),
                group.rows, sums.data());
            for (int k = 0; k < group.rows; ++k) {
                products[static_cast<std::size_t>((group.row + k) * count_x + column)] =
                    sums[static_cast<std::size_t>(k)];
            }
        }
    }

    const std::vector<Recti> filled = rectangles_of(mask);
    std::size_t i = 0;
    for (int ty = lo_.y; ty <= hi_.y; ++ty) {
        for (int tx = lo_.x; tx <= hi_.x; ++tx, ++i) {
            const Recti reach = rect_of(block_).intersected(
                {tx, ty, tx + sample_size_.width, ty + sample_size_.height});
            if (!allowed[i] || reach.empty()) continue;
            std::int64_t ssd = lengths.sum(reach) - 2 * products[i];
            for (const Recti& r : filled) {
                const std::int64_t* top = lengths_.row(r.y0 - ty + hi_.y) - tx + hi_.x;
                const std::int64_t* bottom = lengths_.row(r.y1 - ty + hi_.y) - tx + hi_.x;
                ssd += bottom[r.x1] - bottom[r.x0] - top[r.x1] + top[r.x0];
            }
            costs[i].ssd += static_cast<std::uint64_t>(ssd) * weight;
            costs[i].weight += static_cast<std::uint64_t>(counts.sum(reach)) * weight;
        }
    }
}

// The rows s of the sample that meet the block's rows s + first_ty … s + first_ty + size − 1, if
// any of these is set.
void DirectSearch::rows_of_group(const std::vector<Hull>& hulls, std::size_t stride, int first_ty,
                                 int size, std::vector<CorrelationRow>& rows) const {
    rows.clear();
    const int h = block_.height;
    const auto chunk = static_cast<std::size_t>(kCorrelationChunk);
    const int last_s = std::min(sample_size_.height, h - first_ty);
    for (int s = std::max(0, 1 - size - first_ty); s < last_s; ++s) {
        Hull hull;
        for (int y = std::max(0, s + first_ty); y < std::min(h, s + first_ty + size); ++y)
            hull.join(hulls[static_cast<std::size_t>(y)]);
        if (hull.empty()) continue;
        const std::size_t first = 3 * static_cast<std::size_t>(hull.first) / chunk;
        const std::size_t last = (3 * static_cast<std::size_t>(hull.last) + chunk - 1) / chunk;
        rows.push_back(
            {static_cast<std::size_t>(s + first_ty + kCorrelationGroup) * stride + first * chunk,
             static_cast<std::size_t>(s + hi_.y) * row_bytes_ + first * chunk,
             static_cast<int>(last - first)});
    }
}

}  // namespace weft
