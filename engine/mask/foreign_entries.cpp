#include "engine/mask/foreign_entries.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/mask/nearest_pixel.h"
#include "engine/mask/signed_distance.h"

namespace weft {
namespace {

constexpr float kPool_px = 2;          // colours are judged together within this …
constexpr float kBeside_px = 32;       // … and the surface's own within that
constexpr float kForeignEntry = 1.5f;  // log odds by which what enters is farther from the surface
constexpr float kRarestShare = 0.1f;   // of the surface: colours as foreign as these are its own
constexpr float kLeastEntry_px = 30;   // square
constexpr float kWasOutside_px = 2;
constexpr std::ptrdiff_t kMostOfSurface = 3;  // a third: more than that is a flash or a black frame

bool contains(const Recti& box, Vec2i p) {
    return box.contains(p.x, p.y);
}

constexpr std::uint8_t kFound = 255;

// What a pixel would be by the surface's motion, and whether it has a past there.
enum EntryKind : std::uint8_t { kElse = 0, kSurface = 1, kNoPast = 2 };

Matte kinds_of(const EntriesInput& in) {
    const Recti all = rect_of(in.prev_phi.size());
    Matte out(in.area.size());
    parallel_rows(out.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < out.width(); ++x) {
                const Vec2 here(in.area.x0 + x, in.area.y0 + y);
                const float* s = in.surface_motion.pixel(x, y);
                const Vec2 expected = here + Vec2(s[0], s[1]);
                if (sample_bilinear(in.prev_phi, expected.x, expected.y) <= 0) continue;
                const float* d = in.flow.d.pixel(in.area.x0 + x, in.area.y0 + y);
                const Vec2 measured = here + Vec2(d[0], d[1]);
                const bool lie_in = contains(all, nearest_pixel(measured)) &&
                                    contains(all, nearest_pixel(expected));
                const bool was_outside = sample_bilinear(in.prev_phi, measured.x, measured.y) <
                                         -kWasOutside_px * in.unit_px;
                const bool valid = in.flow.valid.row(in.area.y0 + y)[in.area.x0 + x] != 0;
                out.at(x, y) = valid && lie_in && !was_outside ? kSurface : kNoPast;
            }
        }
    });
    return out;
}

// The palette's mean log odds in windows, of the pixels of one kind; the second channel is how much
// of the window they are.
cv::Mat pooled_odds(const EntriesInput& in, const Matte& kinds, EntryKind kind, float reach_px) {
    cv::Mat sums(in.area.height(), in.area.width(), CV_32FC2, cv::Scalar::all(0));
    parallel_rows(sums.rows, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < sums.cols; ++x) {
                if (kinds.at(x, y) == kind)
                    sums.at<cv::Vec2f>(y, x) = {in.palette.odds(in.frame.pixel(x, y)), 1};
            }
        }
    });
    const int side = 2 * std::max(1, static_cast<int>(std::lround(reach_px * in.unit_px))) + 1;
    cv::boxFilter(sums, sums, -1, {side, side}, {-1, -1}, true, cv::BORDER_CONSTANT);
    return sums;
}

Matte foreign_pixels(const EntriesInput& in, const Matte& kinds) {
    const cv::Mat entering = pooled_odds(in, kinds, kNoPast, kPool_px);
    const cv::Mat beside = pooled_odds(in, kinds, kSurface, kBeside_px);
    const float rarest = std::min(0.0f, in.palette.own_odds(kRarestShare));
    Matte out(kinds.size());
    parallel_rows(out.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < out.width(); ++x) {
                if (kinds.at(x, y) != kNoPast) continue;
                const auto& e = entering.at<cv::Vec2f>(y, x);
                const auto& b = beside.at<cv::Vec2f>(y, x);
                const float usual = b[1] > 0 ? std::min(rarest, b[0] / b[1]) : rarest;
                if (e[0] / e[1] < usual - kForeignEntry) out.at(x, y) = kFound;
            }
        }
    });
    return out;
}

// Of the pieces that were found, those that are joined to what is outside, or to the picture's
// border, and are not just specks.
Matte joined_to_outside(Matte& found, const Matte& kinds, const EntriesInput& in) {
    const cv::Mat view(found.height(), found.width(), CV_8U, found.data(),
                       static_cast<std::size_t>(found.stride()));
    cv::Mat labels, stats, centres;
    const int count = cv::connectedComponentsWithStats(view, labels, stats, centres, 8, CV_32S);
    std::vector<bool> joined(static_cast<std::size_t>(count), false);
    const Recti frame = rect_of(in.prev_phi.size()), area = rect_of(kinds.size());
    for (int y = 0; y < kinds.height(); ++y) {
        for (int x = 0; x < kinds.width(); ++x) {
            const auto label = static_cast<std::size_t>(labels.at<int>(y, x));
            if (label == 0) continue;
            for (const Vec2i step : {Vec2i(1, 0), Vec2i(-1, 0), Vec2i(0, 1), Vec2i(0, -1)}) {
                const Vec2i to = Vec2i(x, y) + step;
                if (!contains(frame, Vec2i(in.area.x0, in.area.y0) + to) ||
                    (contains(area, to) && kinds.at(to.x, to.y) == kElse))
                    joined[label] = true;
            }
        }
    }
    Matte out(found.size());
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            const int label = labels.at<int>(y, x);
            const auto area_px = static_cast<float>(stats.at<int>(label, cv::CC_STAT_AREA));
            if (joined[static_cast<std::size_t>(label)] &&
                area_px >= kLeastEntry_px * in.unit_px * in.unit_px)
                out.at(x, y) = kFound;
        }
    }
    return out;
}

}  // namespace

Matte foreign_entries(const EntriesInput& in) {
    const Matte kinds = kinds_of(in);
    Matte found = foreign_pixels(in, kinds);
    const std::uint8_t* codes = kinds.data();
    const auto other = std::count(codes, codes + kinds.size_bytes(), std::uint8_t{kElse});
    const auto surface = static_cast<std::ptrdiff_t>(kinds.size_bytes()) - other;
    const auto foreign = std::count(found.data(), found.data() + found.size_bytes(), kFound);
    if (kMostOfSurface * foreign > surface) return Matte(kinds.size());
    return joined_to_outside(found, kinds, in);
}

}  // namespace weft
