#include "engine/lighting/plate_detail.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace weft {
namespace {

constexpr Size kPlate{240, 160};
constexpr Recti kBox{20, 20, 220, 140};

Matte box_matte() {
    Matte out(kPlate);
    for (int y = kBox.y0; y < kBox.y1; ++y)
        std::fill(out.row(y) + kBox.x0, out.row(y) + kBox.x1, 255);
    return out;
}

// Grey paint of 0.4 under even light, with a dark crease 3 px wide; other things around it.
ImageF3 creased() {
    ImageF3 out(kPlate, 0.9f);
    for (int y = kBox.y0; y < kBox.y1; ++y)
        for (int x = kBox.x0; x < kBox.x1; ++x)
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) = std::abs(x - 120) <= 1 ? 0.2f : 0.4f;
    return out;
}

Shading even_light(float value) {
    return {ImageF1(kPlate.width / 2, kPlate.height / 2, value), 2, kPlate, {}};
}

Shading changed(const Shading& shading, float amount) {
    return with_light_detail(shading, creased(), box_matte(), kBox, ImageF1(kPlate, amount));
}

TEST(LightDetail, AsEstimatedIsTheShadingAtFullSize) {
    const Shading same = changed(even_light(0.3f), kEstimatedDetail);
    EXPECT_EQ(same.value.size(), kPlate);
    EXPECT_EQ(same.downscale, 1);
    for (int x = 0; x < kPlate.width; ++x)
        EXPECT_EQ(same.value.at(x, 80), 0.3f) << x;
}

TEST(LightDetail, AllOfItTakesWhatThePlateShowsAndHalfOfItHalf) {
    const Shading all = changed(even_light(0.3f), 1), half = changed(even_light(0.3f), 0.75f);
    const float depth = std::log(all.value.at(60, 80) / all.value.at(120, 80));
    EXPECT_NEAR(depth, std::log(2.0f), 0.1f);
    EXPECT_NEAR(std::log(half.value.at(60, 80) / half.value.at(120, 80)), depth / 2, 1e-3f);
    EXPECT_NEAR(all.value.at(60, 80), 0.3f, 0.01f) << "at the shading's level";
    EXPECT_NEAR(all.value.at(kBox.x0, 80), all.value.at(60, 80), 1e-4f)
        << "what lies beside the matte is not its light";
    EXPECT_EQ(all.value.at(5, 5), 0.3f) << "outside of the matte";
}

TEST(LightDetail, NoneOfItIsBroadLightOnly) {
    Shading ridged = even_light(0.3f);
    for (int y = 0; y < ridged.value.height(); ++y)
        for (int x = 0; x < ridged.value.width(); ++x)
            ridged.value.at(x, y) = 0.3f * std::exp(0.2f * std::sin(static_cast<float>(x)) +
                                                    0.004f * static_cast<float>(x));
    const Shading broad = changed(ridged, 0);
    float fine = 0;
    for (int x = 60; x < 180; ++x)
        fine =
            std::max(fine, std::abs(std::log(broad.value.at(x, 80) / broad.value.at(x + 3, 80))));
    EXPECT_LT(fine, 0.05f) << "the ridges are gone";
    EXPECT_GT(broad.value.at(180, 80), 1.15f * broad.value.at(60, 80)) << "the slope is not";
}

TEST(KeepPlateDetail, MultipliesByTheCreaseAndByNothingElse) {
    const Size size = kBox.size();
    const Matte inside(size, 255);
    const Shading shading = even_light(0.3f);
    const auto kept = [&](const Shading* light, float amount) {
        ImageF3 texture(size, 0.5f);
        keep_plate_detail(texture, {kBox.x0, kBox.y0}, creased(), inside, light, amount);
        return texture;
    };
    const ImageF3 none = kept(&shading, 0), once = kept(&shading, 1), twice = kept(&shading, 2);
    EXPECT_EQ(none.at(100, 60, 0), 0.5f);
    EXPECT_LT(once.at(100, 60, 0), 0.5f / 1.4f);
    EXPECT_NEAR(twice.at(100, 60, 0) / 0.5f, std::pow(once.at(100, 60, 0) / 0.5f, 2.0f), 1e-3f);
    EXPECT_NEAR(once.at(40, 60, 0), 0.5f, 0.005f);
    EXPECT_NEAR(once.at(0, 60, 0), 0.5f, 0.005f) << "no rim from what lies beside";
    EXPECT_LT(kept(nullptr, 1).at(100, 60, 0), 0.5f / 1.4f) << "without light as well";
}

TEST(KeepPlateDetail, LeavesOutWhatTheLightHasAlready) {
    const Matte inside(kBox.size(), 255);
    const Shading all = changed(even_light(0.3f), 1);
    ImageF3 texture(kBox.size(), 0.5f);
    keep_plate_detail(texture, {kBox.x0, kBox.y0}, creased(), inside, &all, 1);
    EXPECT_NEAR(texture.at(100, 60, 0), 0.5f, 0.02f);
}

}  // namespace
}  // namespace weft
