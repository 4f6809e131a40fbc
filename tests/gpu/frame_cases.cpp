#include "tests/gpu/frame_cases.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "engine/color/grade.h"
#include "engine/composite/composite.h"
#include "engine/compute/plane_sampler.h"
#include "engine/core/rng.h"
#include "engine/lighting/shading.h"

namespace weft::test {
namespace {

ImageF3 linear_noise(Size size, std::uint64_t seed, float highest) {
    Rng rng(seed);
    ImageF3 out(size);
    for (int k = 0; k < 3 * size.width * size.height; ++k)
        out.data()[k] = highest * static_cast<float>(rng.uniform());
    return out;
}

ImageF2 mapped(Size size, const std::function<Vec2(Vec2)>& map) {
    ImageF2 out(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const Vec2 u = map({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
            out.pixel(x, y)[0] = u.x, out.pixel(x, y)[1] = u.y;
        }
    }
    return out;
}

// A disc with a soft rim of some pixels.
Matte disc(Size size, float radius) {
    Matte out(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const float dx = static_cast<float>(x) - 0.5f * static_cast<float>(size.width),
                        dy = static_cast<float>(y) - 0.5f * static_cast<float>(size.height);
            const float inside = (radius - std::sqrt(dx * dx + dy * dy)) / 4;
            out.at(x, y) = static_cast<std::uint8_t>(std::clamp(255 * inside, 0.0f, 255.0f));
        }
    }
    return out;
}

ImageF1 light(Size size, std::uint64_t seed, float highest) {
    Rng rng(seed);
    ImageF1 out(size);
    for (int k = 0; k < size.width * size.height; ++k)
        out.data()[k] = 0.01f + highest * static_cast<float>(rng.uniform());
    return out;
}

FrameLayer layer(Size box, WrapMode wrap, const std::function<Vec2(Vec2)>& map, int finer = 0) {
    FrameLayer l;
    l.plane = PlanePyramid(linear_noise({75, 61}, 5, 1.0f), wrap, finer);
    l.coords = mapped(box, map);
    l.matte = disc(box, 0.45f * static_cast<float>(std::min(box.width, box.height)));
    return l;
}

Vec2 turned(Vec2 p) {
    return {0.8f * p.x - 0.6f * p.y + 3.3f, 0.6f * p.x + 0.8f * p.y - 20.0f};
}
Vec2 squeezed(Vec2 p) {
    return {7.0f * p.x - 130.0f, 0.7f * p.y + 0.2f * p.x * p.x};
}
Vec2 far_away(Vec2 p) {
    return {700.0f * p.x, 800.0f * p.y};
}
Vec2 magnified(Vec2 p) {
    return {0.21f * p.x + 20, 0.17f * p.y + 20};
}

// From 1.2 texels a pixel to 0.1.
Vec2 nearing(Vec2 p) {
    return {1.2f * p.x - 0.009f * p.x * p.x, 0.9f * p.y - 0.004f * p.y * p.y};
}
Vec2 stretched(Vec2 p) {
    return {0.3f * p.x + 0.1f * p.y, 0.5f * p.y + 0.12f * p.y * p.y};
}

void poison(ImageF3& frame) {
    const float nan = std::numeric_limits<float>::quiet_NaN(),
                inf = std::numeric_limits<float>::infinity();
    Rng rng(77);
    for (int k = 0; k < 40; ++k) {
        frame.at(static_cast<int>(rng.below(static_cast<std::uint64_t>(frame.width()))),
                 static_cast<int>(rng.below(static_cast<std::uint64_t>(frame.height()))),
                 static_cast<int>(rng.below(3))) = k % 3 == 0   ? nan
                                                   : k % 3 == 1 ? inf
                                                                : -0.3f;
    }
}

}  // namespace

std::vector<FrameCase> frame_cases() {
    std::vector<FrameCase> out;
    const Size size{83, 67};
    FrameCase c{
        "Plain", linear_noise(size, 1, 0.9f), {layer({50, 44}, WrapMode::kRepeat, turned)}, {}};
    c.layers[0].origin = {11, 9};
    out.push_back(c);

    c.name = "LitAndRolledOff";
    c.layers[0].multiply = {1.3f, 0.8f, 0.45f};
    c.layers[0].shading = light({42, 34}, 3, 1.4f);
    c.knee = 0.9f;
    out.push_back(c);

    c.name = "BrokenPixels";
    poison(c.frame);
    c.layers[0].strength = 0.6f;
    c.layers[0].downscale = 4;
    c.layers[0].shading = light({21, 17}, 4, 9.0f);
    c.layers[0].shading.at(9, 8) = std::numeric_limits<float>::quiet_NaN();
    c.layers[0].shading.at(10, 9) = -1;
    c.knee = 0.5f;
    out.push_back(c);

    c = {"LayersOverEachOther", linear_noise(size, 2, 0.9f), {}, 0.9f};
    c.layers = {layer({60, 60}, WrapMode::kMirror, squeezed),
                layer({52, 40}, WrapMode::kClamp, turned),
                layer({40, 52}, WrapMode::kRepeat, magnified)};
    c.layers[0].origin = {3, 4};
    c.layers[1].origin = {31, 20};
    c.layers[1].shading = light({42, 34}, 6, 1.2f);
    c.layers[1].quality = SampleQuality::kDraft;
    c.layers[2].origin = {20, 15};
    out.push_back(c);

    // Finer levels come in one after the other, and stay away where the other axis is too coarse.
    c = {"Magnified", linear_noise(size, 14, 0.9f), {}, {}};
    c.layers = {layer({60, 60}, WrapMode::kMirror, nearing, 2),
                layer({52, 40}, WrapMode::kClamp, stretched, 1),
                layer({40, 52}, WrapMode::kRepeat, magnified, 2)};
    c.layers[1].quality = SampleQuality::kDraft;
    out.push_back(c);

    c = {"WholeFrame", linear_noise(size, 8, 0.9f), {layer(size, WrapMode::kMirror, turned)}, 0.9f};
    c.layers[0].matte = Matte(size, 255);
    c.layers[0].shading = light({42, 34}, 9, 1.0f);
    c.layers[0].coords.at(40, 30, 0) = std::numeric_limits<float>::quiet_NaN();
    c.layers[0].coords.at(12, 50, 1) = 3e9f;
    out.push_back(c);

    // A pixel spans the plane many times: the last level, one texel.
    c = {"FarAway",
         linear_noise(size, 12, 0.9f),
         {layer({40, 30}, WrapMode::kRepeat, far_away)},
         {}};
    out.push_back(c);

    c = {"NoLayer", linear_noise(size, 10, 0.9f), {}, 0.9f};
    out.push_back(c);
    return out;
}

Recti box_of(const FrameLayer& l) {
    return {l.origin.x, l.origin.y, l.origin.x + l.matte.width(), l.origin.y + l.matte.height()};
}

ImageF3 old_surface(ViewF3 frame, const FrameLayer& l) {
    return unmix_surface(frame.crop(box_of(l)), l.matte);
}

LayerRequest request_of(const FrameLayer& l, ViewF3 old_surface) {
    LayerRequest r;
    r.texture = {&l.plane, l.coords, l.matte, l.quality};
    r.origin = l.origin;
    r.old_surface = old_surface;
    r.multiply = l.multiply;
    if (!l.shading.empty()) r.gain = GainRequest{l.shading, l.downscale, l.reference, l.strength};
    return r;
}

FrameResult composited_on_cpu(const FrameCase& c) {
    FrameResult out{c.frame, 0};
    Matte touched(c.frame.size());
    for (const FrameLayer& l : c.layers) {
        ImageF3 texture(l.matte.size());
        sample_plane_cpu({&l.plane, l.coords, l.matte, l.quality}, texture);
        apply_grade(texture, l.matte, {.multiply = l.multiply});
        if (!l.shading.empty()) {
            apply_light(texture, l.origin, l.matte, {l.shading, l.downscale, c.frame.size(), {}},
                        l.reference, {LightForm::kGain, l.strength});
        }
        const ImageF3 surface = old_surface(out.pixels, l);
        const ImageView<float, 3> area = out.pixels.view().crop(box_of(l));
        composite_over(area, area, surface, l.matte, texture);
        for (int y = 0; y < l.matte.height(); ++y) {
            for (int x = 0; x < l.matte.width(); ++x) {
                std::uint8_t& t = touched.at(l.origin.x + x, l.origin.y + y);
                t = std::max(t, l.matte.at(x, y));
            }
        }
    }
    if (c.knee) out.exceeded = roll_off(out.pixels, touched, *c.knee);
    return out;
}

}  // namespace weft::test
