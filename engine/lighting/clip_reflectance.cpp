#include "engine/lighting/clip_reflectance.h"

#include <algorithm>
#include <cmath>

#include "engine/core/parallel.h"
#include "engine/lighting/bilateral_grid.h"
#include "engine/lighting/masked_filters.h"
#include "engine/lighting/median.h"

namespace weft {
namespace {

constexpr int kFewestFrames = 3;
constexpr float kSplatKnown = 0.2f;     // of a pixel's weight
constexpr int kDetailRadius = 3;        // small pixels: what is finer is compared
constexpr int kWindow = 12;             // in which the frame is compared with the reflectance
constexpr float kDoubts = 0.35f, kTrusts = 0.7f;  // share of the detail's energy that it explains
constexpr float kMinEnergy = 1e-5f;     // ln² of detail: less is noise
constexpr float kFineSigma = 1.0f, kFineSpace = 3.0f, kFineRange = 0.08f;
constexpr int kFineRollings = 2;

// The box of positions that a sample's pixels have on the reference frame.
Recti mapped_box(const SurfaceSample& s, const ImageF2& ref_from_cur) {
    float x0 = 1e9f, y0 = 1e9f, x1 = -1e9f, y1 = -1e9f;
    for (int y = 0; y < s.box.height(); ++y) {
        for (int x = 0; x < s.box.width(); ++x) {
            if (s.weight.row(y)[x] == 0) continue;
            const float* d = ref_from_cur.pixel(x, y);
            const float u = static_cast<float>(x + s.box.x0) + d[0];
            const float v = static_cast<float>(y + s.box.y0) + d[1];
            if (!std::isfinite(u + v)) continue;
            x0 = std::min(x0, u), x1 = std::max(x1, u);
            y0 = std::min(y0, v), y1 = std::max(y1, v);
        }
    }
    // Beyond once the frame's size in each direction nothing comes back into the picture soon.
    const Size small = reduced_size(s.full, s.downscale);
    const Recti limit{-small.width, -small.height, 2 * small.width, 2 * small.height};
    if (x0 > x1) return {};
    const auto whole = [](float v, float low, float high) {
        return static_cast<int>(std::floor(std::clamp(v, low, high)));
    };
    const float far = 4.0f * static_cast<float>(std::max(small.width, small.height));
    return Recti{whole(x0, -far, far), whole(y0, -far, far), whole(x1, -far, far) + 2,
                 whole(y1, -far, far) + 2}
        .intersected(limit);
}

ImageF1 box_mean(const ImageF1& plane, const ImageF1& weight, const ImageF1& total, int radius) {
    ImageF1 mean = weighted(plane, weight);
    box_blur(mean, radius);
    for (std::size_t i = 0; i < mean.size_bytes() / sizeof(float); ++i)
        mean.data()[i] /= std::max(total.data()[i], 1e-4f);
    return mean;
}

ImageF1 detail_of(const ImageF1& plane, const ImageF1& weight, const ImageF1& total) {
    ImageF1 detail = box_mean(plane, weight, total, kDetailRadius);
    for (std::size_t i = 0; i < detail.size_bytes() / sizeof(float); ++i)
        detail.data()[i] = plane.data()[i] - detail.data()[i];
    return detail;
}

// Bilinear lookup of a canvas; false where any corner is unknown.
bool lookup(const ClipReflectance& r, float u, float v, float& value, float& trust) {
    u -= static_cast<float>(r.box.x0), v -= static_cast<float>(r.box.y0);
    if (!(u >= 0 && v >= 0 && u < static_cast<float>(r.box.width() - 1) &&
          v < static_cast<float>(r.box.height() - 1)))
        return false;
    const int x = static_cast<int>(u), y = static_cast<int>(v);
    const float fx = u - static_cast<float>(x), fy = v - static_cast<float>(y);
    const float* t0 = r.trust.pixel(x, y);
    const float* t1 = r.trust.pixel(x, y + 1);
    trust = std::min(std::min(t0[0], t0[1]), std::min(t1[0], t1[1]));
    if (!(trust > 0)) return false;
    const float* a = r.value.pixel(x, y);
    const float* b = r.value.pixel(x, y + 1);
    const float top = a[0] + fx * (a[1] - a[0]), low = b[0] + fx * (b[1] - b[0]);
    value = top + fy * (low - top);
    return true;
}

// The reflectance as this frame shows it, and where it is known.
struct Seen {
    ImageF1 value, known;
};

Seen moved_here(const SurfaceSample& s, const ClipReflectance& r, const ImageF2& ref_from_cur) {
    Seen seen{ImageF1(s.box.size()), ImageF1(s.box.size())};
    parallel_rows(s.box.height(), 8, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < s.box.width(); ++x) {
                if (s.weight.row(y)[x] == 0) continue;
                const float* d = ref_from_cur.pixel(x, y);
                float value = 0, trust = 0;
                if (!lookup(r, static_cast<float>(x + s.box.x0) + d[0],
                            static_cast<float>(y + s.box.y0) + d[1], value, trust))
                    continue;
                seen.value.row(y)[x] = value;
                seen.known.row(y)[x] = s.weight.row(y)[x] * trust;
            }
        }
    });
    return seen;
}

float smooth_step(float x, float low, float high) {
    const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

// How much of the frame's detail the reflectance explains, 0 to 1, in windows. Only detail is
// compared: a shadow's edge is in it along a line, the pattern everywhere.
ImageF1 agreement(const SurfaceSample& s, const Seen& seen) {
    ImageF1 total = seen.known;
    box_blur(total, kDetailRadius);
    const ImageF1 mine = detail_of(s.luma, seen.known, total);
    const ImageF1 clip = detail_of(seen.value, seen.known, total);
    ImageF1 left(s.box.size()), whole(s.box.size());
    for (std::size_t i = 0; i < left.size_bytes() / sizeof(float); ++i) {
        const float rest = mine.data()[i] - clip.data()[i];
        left.data()[i] = seen.known.data()[i] * rest * rest;
        whole.data()[i] = seen.known.data()[i] * mine.data()[i] * mine.data()[i];
    }
    ImageF1 share(s.box.size());
    ImageF1 weight = seen.known;
    for (ImageF1* plane : {&left, &whole, &weight})
        box_blur(*plane, kWindow);
    for (std::size_t i = 0; i < share.size_bytes() / sizeof(float); ++i) {
        if (!(seen.known.data()[i] > 0)) continue;
        const float energy = whole.data()[i] + kMinEnergy * weight.data()[i];
        share.data()[i] = smooth_step(1.0f - left.data()[i] / energy, kDoubts, kTrusts);
    }
    return share;
}

// Takes the noise, and what a small error of the motion leaves of the pattern, out of light whose
// edges are its own.
ImageF1 without_noise(const ImageF1& luma, const ImageF1& weight) {
    ImageF1 guide = weighted(luma, weight), total = weight;
    gaussian_blur(guide, kFineSigma);
    gaussian_blur(total, kFineSigma);
    for (std::size_t i = 0; i < guide.size_bytes() / sizeof(float); ++i) {
        guide.data()[i] = total.data()[i] > 1e-3f ? guide.data()[i] / total.data()[i]
                                                  : luma.data()[i];
    }
    const ImageF1 values = weighted(luma, weight);
    for (int i = 0; i < kFineRollings; ++i)
        guide = joint_bilateral(values, weight, guide, {kFineSpace, kFineRange});
    return guide;
}

}  // namespace

void ReflectanceGatherer::add(const SurfaceSample& s, const ImageF2& ref_from_cur) {
    if (s.box.empty()) return;
    Part part;
    part.box = mapped_box(s, ref_from_cur);
    if (part.box.empty()) return;
    const ImageF1 light = log_shading(s, options_);
    part.residue = part.light = part.weight = ImageF1(part.box.size());
    // A splat is a scatter: one thread, so that sums come in one order.
    for (int y = 0; y < s.box.height(); ++y) {
        for (int x = 0; x < s.box.width(); ++x) {
            const float w = s.weight.row(y)[x];
            if (w == 0) continue;
            const float* d = ref_from_cur.pixel(x, y);
            const float u = static_cast<float>(x + s.box.x0) + d[0] - static_cast<float>(part.box.x0);
            const float v = static_cast<float>(y + s.box.y0) + d[1] - static_cast<float>(part.box.y0);
            if (!(u >= 0 && v >= 0 && u < static_cast<float>(part.box.width() - 1) &&
                  v < static_cast<float>(part.box.height() - 1)))
                continue;
            const int i = static_cast<int>(u), j = static_cast<int>(v);
            const float fx = u - static_cast<float>(i), fy = v - static_cast<float>(j);
            const float l = light.row(y)[x], r = s.luma.row(y)[x] - l;
            const auto put = [&](int a, int b, float share) {
                share *= w;
                part.weight.row(b)[a] += share;
                part.residue.row(b)[a] += share * r;
                part.light.row(b)[a] += share * l;
            };
            put(i, j, (1 - fx) * (1 - fy)), put(i + 1, j, fx * (1 - fy));
            put(i, j + 1, (1 - fx) * fy), put(i + 1, j + 1, fx * fy);
        }
    }
    parts_.push_back(std::move(part));
}

ClipReflectance ReflectanceGatherer::finish() {
    ClipReflectance out;
    if (static_cast<int>(parts_.size()) < kFewestFrames) return out;
    for (const Part& part : parts_)
        out.box = out.box.united(part.box);
    out.value = out.trust = ImageF1(out.box.size());
    parallel_rows(out.box.height(), 8, [&](int y0, int y1) {
        std::vector<float> values;
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < out.box.width(); ++x) {
                values.clear();
                for (const Part& part : parts_) {
                    const int u = x + out.box.x0 - part.box.x0, v = y + out.box.y0 - part.box.y0;
                    if (u < 0 || v < 0 || u >= part.box.width() || v >= part.box.height()) continue;
                    const float w = part.weight.row(v)[u];
                    if (w > kSplatKnown) values.push_back(part.residue.row(v)[u] / w);
                }
                if (static_cast<int>(values.size()) < kFewestFrames) continue;
                out.trust.row(y)[x] = 1;
                out.value.row(y)[x] = median_of(values, 0.0f);
            }
        }
    });
    return out;
}

Shading shading_with(const SurfaceSample& sample, const ClipReflectance& reflectance,
                     const ImageF2& ref_from_cur, const ShadingOptions& options) {
    if (sample.box.empty()) return shading_from_log(ImageF1(), sample);
    ImageF1 light = log_shading(sample, options);
    if (!reflectance.box.empty()) {
        const Seen seen = moved_here(sample, reflectance, ref_from_cur);
        const ImageF1 share = agreement(sample, seen);
        ImageF1 lit = sample.luma;
        for (std::size_t i = 0; i < lit.size_bytes() / sizeof(float); ++i)
            lit.data()[i] -= seen.value.data()[i];
        const ImageF1 fine = without_noise(lit, seen.known);
        for (std::size_t i = 0; i < lit.size_bytes() / sizeof(float); ++i)
            light.data()[i] += share.data()[i] * (fine.data()[i] - light.data()[i]);
    }
    return shading_from_log(light, sample);
}

}  // namespace weft
