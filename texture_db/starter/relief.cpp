#include "texture_db/starter/relief.h"

#include <algorithm>

namespace weft::starter {
namespace {

float linear(float v) {
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

float encoded(float v) {
    v = clamp01(v);
    return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
}

// Means over squares of side 2r+1, clamped at the border: two passes of running sums.
std::vector<float> box_mean(const std::vector<float>& in, int side, int r) {
    const auto index = [side](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
               static_cast<std::size_t>(x);
    };
    std::vector<float> across(in.size()), out(in.size());
    const float k = 1.0f / static_cast<float>(2 * r + 1);
    for (int y = 0; y < side; ++y) {
        float sum = 0;
        for (int d = -r; d <= r; ++d)
            sum += in[index(std::clamp(d, 0, side - 1), y)];
        for (int x = 0; x < side; ++x) {
            across[index(x, y)] = sum * k;
            sum += in[index(std::min(x + r + 1, side - 1), y)] - in[index(std::max(x - r, 0), y)];
        }
    }
    for (int x = 0; x < side; ++x) {
        float sum = 0;
        for (int d = -r; d <= r; ++d)
            sum += across[index(x, std::clamp(d, 0, side - 1))];
        for (int y = 0; y < side; ++y) {
            out[index(x, y)] = sum * k;
            sum += across[index(x, std::min(y + r + 1, side - 1))] -
                   across[index(x, std::max(y - r, 0))];
        }
    }
    return out;
}

}  // namespace

Relief::Relief(int side_px)
    : side_px_(side_px),
      fine_((side_px + 2 * kBorder_px) * kFine),
      texels_(static_cast<std::size_t>(fine_) * static_cast<std::size_t>(fine_)) {}

ImageU8x3 Relief::photograph(const Light& light, std::uint32_t seed) const {
    static const std::array<float, 1024> kLinear = [] {
        std::array<float, 1024> table{};
        for (std::size_t i = 0; i < table.size(); ++i)
            table[i] = linear(static_cast<float>(i) / 1023.0f);
        return table;
    }();
    static const std::array<float, 4096> kEncoded = [] {
        std::array<float, 4096> table{};
        for (std::size_t i = 0; i < table.size(); ++i)
            table[i] = encoded(static_cast<float>(i) / 4095.0f);
        return table;
    }();
    std::vector<float> height(texels_.size());
    for (std::size_t i = 0; i < height.size(); ++i)
        height[i] = texels_[i].height * light.relief;
    const std::vector<float> near = box_mean(height, fine_, 3), far = box_mean(height, fine_, 8);
    const float azimuth = light.azimuth_deg * 0.01745329f;
    const float elevation = light.elevation_deg * 0.01745329f;
    const float lx = std::cos(elevation) * std::cos(azimuth);
    const float ly = -std::cos(elevation) * std::sin(azimuth), lz = std::sin(elevation);
    // Half way between the light and the viewer, who looks straight down.
    const float hn = 1 / std::sqrt(lx * lx + ly * ly + (lz + 1) * (lz + 1));
    const float hx = lx * hn, hy = ly * hn, hz = (lz + 1) * hn;
    const auto side = static_cast<std::size_t>(fine_);
    ImageU8x3 out(side_px_, side_px_);
    for (int py = 0; py < side_px_; ++py) {
        for (int px = 0; px < side_px_; ++px) {
            Rgb sum;
            for (int s = 0; s < kFine * kFine; ++s) {
                const auto x = static_cast<std::size_t>((px + kBorder_px) * kFine + s % kFine);
                const auto y = static_cast<std::size_t>((py + kBorder_px) * kFine + s / kFine);
                const std::size_t i = y * side + x;
                // Central differences over two fine texels, in heights per sample pixel.
                const float gx = (height[i + 1] - height[i - 1]) * (0.5f * kFine);
                const float gy = (height[i + side] - height[i - side]) * (0.5f * kFine);
                const float n = 1 / std::sqrt(gx * gx + gy * gy + 1);
                const float facing = std::max(0.0f, (-gx * lx - gy * ly + lz) * n);
                const float hollow = std::max(0.0f, near[i] - height[i]) * 0.6f +
                                     std::max(0.0f, far[i] - height[i]) * 0.35f;
                const float open = 1 / (1 + light.occlusion * hollow);
                const float diffuse = (light.ambient + (1 - light.ambient) * facing / lz) * open;
                const Texel& t = texels_[i];
                float glint = 0;
                if (t.shine > 0) {
                    const float h = std::max(0.0f, (-gx * hx - gy * hy + hz) * n);
                    glint = t.shine * light.highlight * std::pow(h, light.gloss) * open;
                }
                const auto lin = [&](float c) {
                    return kLinear[static_cast<std::size_t>(clamp01(c) * 1023)] * diffuse + glint;
                };
                sum = sum + Rgb{lin(t.color.r), lin(t.color.g), lin(t.color.b)};
            }
            const float grain =
                light.grain * (hash01(seed, px, py, 7) + hash01(seed, px, py, 8) - 1);
            const float k = 1.0f / (kFine * kFine);
            std::uint8_t* p = out.pixel(px, py);
            const std::array<float, 3> v{sum.r * k, sum.g * k, sum.b * k};
            for (std::size_t c = 0; c < 3; ++c) {
                const float e = kEncoded[static_cast<std::size_t>(clamp01(v[c]) * 4095)] + grain;
                p[c] = static_cast<std::uint8_t>(clamp01(e) * 255 + 0.5f);
            }
        }
    }
    return out;
}

void draw(Relief& relief, const Strand& s) {
    const float step = 0.6f;
    const int steps = std::max(2, static_cast<int>(s.length / step));
    float x = s.x, y = s.y;
    for (int i = 0; i <= steps; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(steps);
        const float angle = s.angle + s.bend * t;
        const float dx = std::cos(angle), dy = std::sin(angle);
        const float half = 0.5f * s.width * (1 - s.taper * t * t);
        const float reach = half + 0.5f;
        const auto low = [](float v) {
            return floor_int((v + Relief::kBorder_px) * Relief::kFine);
        };
        const int x0 = std::max(0, low(x - reach)),
                  x1 = std::min(relief.fine() - 1, low(x + reach));
        const int y0 = std::max(0, low(y - reach)),
                  y1 = std::min(relief.fine() - 1, low(y + reach));
        const Rgb color = mix(s.root, s.tip, t);
        for (int fy = y0; fy <= y1; ++fy) {
            for (int fx = x0; fx <= x1; ++fx) {
                const float ox = Relief::place(fx) - x, oy = Relief::place(fy) - y;
                const float along = ox * dx + oy * dy, across = -ox * dy + oy * dx;
                if (std::abs(along) > step)
                    continue;  // a little more than half a step: no gaps in bends
                const float a = std::abs(across) / std::max(half, 0.25f);
                if (a > 1.25f) continue;
                const float cover = clamp01((1.25f - a) * 2.5f) * std::min(1.0f, half / 0.3f);
                Texel& texel = relief.at(fx, fy);
                const float round =
                    std::sqrt(std::max(0.0f, 1 - std::min(a, 1.0f) * std::min(a, 1.0f)));
                texel.color = mix(texel.color, color, cover);
                texel.height += (s.base + s.lift * t + 0.6f * half * round - texel.height) * cover;
            }
        }
        x += dx * s.length / static_cast<float>(steps);
        y += dy * s.length / static_cast<float>(steps);
    }
}

void scatter(const Relief& relief, float spacing, float reach,
             const std::function<void(int, int)>& make) {
    const float low = -Relief::kBorder_px - reach;
    const float high = static_cast<float>(relief.side_px()) + Relief::kBorder_px + reach;
    const int first = floor_int(low / spacing), last = floor_int(high / spacing) + 1;
    for (int j = first; j <= last; ++j) {
        for (int i = first; i <= last; ++i)
            make(i, j);
    }
}

}  // namespace weft::starter
