#include "texture_db/recommend/region_look.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/parallel.h"
#include "texture_db/describe/features.h"
#include "texture_db/describe/sample_codec.h"

namespace weft {
namespace {

constexpr int kSide = 96;
constexpr int kPatches = 4;
constexpr std::uint8_t kInside = 128;
constexpr float kNeutral = 8;  // chroma below which a colour has no meaningful hue

float hue_deg_of(const LabColor& c) {
    return std::atan2(c.b, c.a) * 180 / std::numbers::pi_v<float>;
}

// The smallest angle between two hues.
float turn_deg(float a, float b) {
    const float turn = std::abs(a - b);
    return turn > 180 ? 360 - turn : turn;
}

struct Shape {
    Recti box;
    double area = 0;
};

Shape shape_of(ViewU8x1 matte) {
    Shape s;
    s.box = {matte.width(), matte.height(), 0, 0};
    for (int y = 0; y < matte.height(); ++y) {
        for (int x = 0; x < matte.width(); ++x) {
            if (matte.at(x, y) < kInside) continue;
            s.area += 1;
            s.box.x0 = std::min(s.box.x0, x);
            s.box.y0 = std::min(s.box.y0, y);
            s.box.x1 = std::max(s.box.x1, x + 1);
            s.box.y1 = std::max(s.box.y1, y + 1);
        }
    }
    return s;
}

// Sums of coverage from the top left: a square's coverage takes four lookups.
class Coverage {
  public:
    explicit Coverage(ViewU8x1 matte)
        : width_(matte.width() + 1),
          sums_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(matte.height() + 1)) {
        for (int y = 0; y < matte.height(); ++y) {
            std::uint32_t row = 0;
            for (int x = 0; x < matte.width(); ++x) {
                row += matte.at(x, y) >= kInside ? 1u : 0u;
                at(x + 1, y + 1) = at(x + 1, y) + row;
            }
        }
    }
    [[nodiscard]] double share(const Recti& r) const {
        const double inside =
            static_cast<double>(at(r.x1, r.y1)) - at(r.x0, r.y1) - at(r.x1, r.y0) + at(r.x0, r.y0);
        return inside / (static_cast<double>(r.width()) * r.height());
    }

  private:
    std::uint32_t& at(int x, int y) {
        return sums_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                     static_cast<std::size_t>(x)];
    }
    [[nodiscard]] const std::uint32_t& at(int x, int y) const {
        return const_cast<Coverage*>(this)->at(x, y);
    }
    int width_;
    std::vector<std::uint32_t> sums_;
};

// Squares inside the region, of 96 px or as large as the region allows, with little overlap.
std::vector<Recti> patches_of(const Shape& shape, const Coverage& coverage) {
    for (int side = kSide; side >= 16; side = side * 3 / 4) {
        std::vector<std::pair<double, Recti>> found;
        const int step = std::max(4, side / 6);
        for (int y = shape.box.y0; y + side <= shape.box.y1; y += step) {
            for (int x = shape.box.x0; x + side <= shape.box.x1; x += step) {
                const Recti r{x, y, x + side, y + side};
                const double share = coverage.share(r);
                if (share >= 0.94) found.emplace_back(-share, r);
            }
        }
        std::stable_sort(found.begin(), found.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        std::vector<Recti> chosen;
        for (const auto& candidate : found) {
            const Recti& r = candidate.second;
            const bool apart = std::none_of(chosen.begin(), chosen.end(), [&](const Recti& c) {
                const Recti both = c.intersected(r);
                return !both.empty() && both.width() * both.height() * 3 > side * side;
            });
            if (apart) chosen.push_back(r);
            if (chosen.size() == kPatches) break;
        }
        if (!chosen.empty()) return chosen;
    }
    // Thinner than 16 px everywhere: its whole box.
    return {shape.box};
}

LabColor lab_of(const std::uint8_t* p) {
    const auto linear = [](std::uint8_t v) {
        const float e = static_cast<float>(v) / 255.0f;
        return e <= 0.04045f ? e / 12.92f : std::pow((e + 0.055f) / 1.055f, 2.4f);
    };
    const float r = linear(p[0]), g = linear(p[1]), b = linear(p[2]);
    const auto f = [](float t) { return t > 0.008856f ? std::cbrt(t) : 7.787f * t + 16.0f / 116; };
    const float x = f((0.4124f * r + 0.3576f * g + 0.1805f * b) / 0.9505f);
    const float y = f(0.2126f * r + 0.7152f * g + 0.0722f * b);
    const float z = f((0.0193f * r + 0.1192f * g + 0.9505f * b) / 1.089f);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

float distance2(const LabColor& a, const LabColor& b) {
    const float l = a.l - b.l, u = a.a - b.a, v = a.b - b.b;
    return l * l + u * u + v * v;
}

// Five main colours by k-means (Lloyd 1982) from seeds spread over the lightness: no randomness.
std::vector<WeightedColor> main_colors(std::vector<LabColor> colors) {
    std::vector<WeightedColor> means;
    if (colors.empty()) return means;
    std::sort(colors.begin(), colors.end(), [](const LabColor& a, const LabColor& b) {
        return a.l != b.l ? a.l < b.l : a.a != b.a ? a.a < b.a : a.b < b.b;
    });
    constexpr std::size_t kColors = 5;
    for (std::size_t k = 0; k < kColors; ++k)
        means.push_back({colors[(2 * k + 1) * colors.size() / (2 * kColors)], 0});
    for (int round = 0; round < 8; ++round) {
        std::vector<std::array<double, 4>> sums(kColors, {0, 0, 0, 0});
        for (const LabColor& c : colors) {
            std::size_t best = 0;
            for (std::size_t k = 1; k < kColors; ++k) {
                if (distance2(c, means[k].color) < distance2(c, means[best].color)) best = k;
            }
            sums[best][0] += c.l;
            sums[best][1] += c.a;
            sums[best][2] += c.b;
            sums[best][3] += 1;
        }
        for (std::size_t k = 0; k < kColors; ++k) {
            const double n = sums[k][3];
            if (n > 0) {
                means[k].color = {static_cast<float>(sums[k][0] / n),
                                  static_cast<float>(sums[k][1] / n),
                                  static_cast<float>(sums[k][2] / n)};
            }
            means[k].weight = static_cast<float>(n / static_cast<double>(colors.size()));
        }
    }
    std::erase_if(means, [](const WeightedColor& m) { return m.weight < 0.02f; });
    return means;
}

void look_around(ViewU8x3 plate, ViewU8x1 matte, RegionLook& look) {
    const int step = std::max(2, std::min(plate.width(), plate.height()) / 60);
    std::vector<LabColor> colors;
    double l = 0, squares = 0, chroma = 0, fine = 0;
    for (int y = step; y + 1 < plate.height(); y += step) {
        for (int x = step; x + 1 < plate.width(); x += step) {
            if (matte.at(x, y) >= kInside) continue;
            const LabColor c = lab_of(plate.pixel(x, y));
            colors.push_back(c);
            l += c.l;
            squares += static_cast<double>(c.l) * c.l;
            chroma += std::hypot(c.a, c.b);
            fine += std::abs(static_cast<int>(plate.at(x, y, 1)) * 2 - plate.at(x - 1, y, 1) -
                             plate.at(x + 1, y, 1));
        }
    }
    const auto n = static_cast<double>(std::max<std::size_t>(colors.size(), 1));
    look.rest_contrast =
        static_cast<float>(std::sqrt(std::max(0.0, squares / n - l * l / (n * n))) / 25);
    look.rest_saturation = static_cast<float>(chroma / n / 60);
    look.rest_roughness = static_cast<float>(std::min(1.0, fine / n / 30));
    look.surroundings = main_colors(std::move(colors));
}

}  // namespace

float hue_difference_deg(const LabColor& a, const LabColor& b) {
    if (std::hypot(a.a, a.b) < kNeutral || std::hypot(b.a, b.b) < kNeutral) return 0;
    return turn_deg(hue_deg_of(a), hue_deg_of(b));
}

ColourHarmony::ColourHarmony(const std::vector<WeightedColor>& others) : loudest_(12) {
    for (const WeightedColor& other : others) {
        const float chroma = std::hypot(other.color.a, other.color.b);
        others_.push_back({chroma, hue_deg_of(other.color), other.weight});
        weight_ += other.weight;
        loudest_ = std::max(loudest_, chroma);
    }
}

float ColourHarmony::with(const LabColor& color) const {
    return with(std::hypot(color.a, color.b), hue_deg_of(color));
}

float ColourHarmony::with(float chroma, float hue_deg) const {
    if (weight_ <= 0) return 0.7f;
    float sum = 0;
    for (const Other& other : others_) {
        // Two strong colours must agree in hue; the weaker either is, the less it matters.
        const float matters = std::min({chroma, other.chroma, 30.0f}) / 30.0f;
        const bool neutral = chroma < kNeutral || other.chroma < kNeutral;
        const float turn = neutral ? 0.0f : turn_deg(hue_deg, other.hue_deg);
        const float apart = turn - 180;
        // The two bells do not overlap, so the nearer one is the larger.
        const float fit = turn < 95 ? std::exp(-turn * turn / (2 * 24 * 24))
                                    : 0.85f * std::exp(-apart * apart / (2 * 22 * 22));
        sum += other.weight * (0.85f * (1 - matters) + fit * matters);
    }
    // A colour much stronger than its surroundings is seldom wanted.
    const float loud = std::max(0.0f, chroma - 1.3f * loudest_) / 40;
    return std::clamp(sum / weight_ - loud, 0.0f, 1.0f);
}

Expected<RegionLook> look_at_region(ViewU8x3 plate, const RegionRequest& region,
                                    const DescriptorModel* model) {
    if (region.matte.size() != plate.size()) {
        return fail(ErrorCode::kUsage,
                    "The matte of region '" + region.name + "' and the plate have different sizes.",
                    "Both must be of one frame.");
    }
    const Shape shape = shape_of(region.matte);
    if (shape.area < 16) {
        return fail(ErrorCode::kUsage,
                    "The matte of region '" + region.name + "' is empty on this frame.",
                    "Choose a frame that shows it.");
    }
    RegionLook look;
    look.place = place_of_region(region.matte);
    look.area_px = static_cast<float>(shape.area);
    look.short_side_px =
        std::min(static_cast<float>(std::sqrt(shape.area)),
                 static_cast<float>(std::min(shape.box.width(), shape.box.height())));
    const std::vector<Recti> patches = patches_of(shape, Coverage(region.matte));
    std::vector<MeasuredTexture> measured(patches.size());
    look.descriptors.resize(model ? patches.size() : 0);
    parallel_for(patches.size(), [&](std::size_t i) {
        const ImageU8x3 sample = middle_sample(plate.crop(patches[i]));
        measured[i] = measure_texture(sample);
        if (model) look.descriptors[i] = model->describe(texture_features(sample));
    });
    const float k = 1.0f / static_cast<float>(patches.size());
    for (const MeasuredTexture& m : measured) {
        for (std::size_t a = 0; a < kTextureAttributes; ++a)
            look.inside.attributes.values[a] += k * m.attributes.values[a];
        look.inside.mean = {look.inside.mean.l + k * m.mean.l, look.inside.mean.a + k * m.mean.a,
                            look.inside.mean.b + k * m.mean.b};
    }
    look.squares = patches;
    look.inside.accent = measured.front().accent;
    look_around(plate, region.matte, look);
    return look;
}

}  // namespace weft
