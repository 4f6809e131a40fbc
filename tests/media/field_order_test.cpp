#include "engine/media/field_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace weft {
namespace {

constexpr Size kDiscSize{120, 96};

std::uint8_t ground_at(int x, int y) {
    return static_cast<std::uint8_t>(90 + 30 * std::sin(0.21 * x) * std::cos(0.33 * y));
}

// A textured disc before a texture, at half frame `t`, that moves by `step` px from frame to frame.
Matte disc_picture(int t, double step_x, double step_y) {
    Matte out(kDiscSize);
    const double x0 = 40 + 0.5 * t * step_x, y0 = 48 + 0.5 * t * step_y;
    for (int y = 0; y < kDiscSize.height; ++y) {
        for (int x = 0; x < kDiscSize.width; ++x) {
            const double u = x - x0, v = y - y0;
            const double front = 150 + 60 * std::sin(0.4 * u + 0.2 * v) * std::cos(0.5 * v);
            out.at(x, y) = u * u + v * v < 900 ? static_cast<std::uint8_t>(front) : ground_at(x, y);
        }
    }
    return out;
}

Matte woven(const Matte& upper, const Matte& lower) {
    Matte out = upper;
    for (int y = 1; y < kDiscSize.height; y += 2)
        std::copy_n(lower.row(y), kDiscSize.width, out.row(y));
    return out;
}

// `fields`: the half frames at which frame k's upper and lower lines were taken.
using FieldTimes = std::function<std::pair<int, int>(int)>;
using Painter = std::function<Matte(int)>;

Fields seen(const FieldTimes& fields, const Painter& picture, bool flagged = true) {
    FieldMeter meter;
    for (int k = 0; k < 10; ++k) {
        const auto [upper, lower] = fields(k);
        meter.add(woven(picture(upper), picture(lower)));
    }
    return meter.fields(flagged);
}

Painter disc(double step_x, double step_y) {
    return [=](int t) { return disc_picture(t, step_x, step_y); };
}

// A hard-edged bar on a still, textured ground. Its upper and lower edges lie on even lines on
// whole frames.
Painter bar(int step_x, int step_y) {
    return [=](int t) {
        Matte out(kDiscSize);
        for (int y = 0; y < kDiscSize.height; ++y)
            for (int x = 0; x < kDiscSize.width; ++x)
                out.at(x, y) = ground_at(x, y);
        for (int y = 20 + t * step_y / 2; y < 44 + t * step_y / 2; ++y)
            std::fill_n(out.row(y) + 20 + t * step_x / 2, 50, std::uint8_t{235});
        return out;
    };
}

std::pair<int, int> one_moment(int k) {
    return {2 * k, 2 * k};
}
std::pair<int, int> upper_first(int k) {
    return {2 * k, 2 * k + 1};
}
std::pair<int, int> lower_first(int k) {
    return {2 * k + 1, 2 * k};
}

TEST(FieldMeter, TellsOneMomentFromTwo) {
    for (const auto& [x, y] : {std::pair(2.0, 0.0), {1.0, 1.0}, {0.0, 2.0}, {7.0, 3.0}}) {
        EXPECT_EQ(seen(one_moment, disc(x, y)), Fields::kProgressive) << x << ", " << y;
        EXPECT_EQ(seen(upper_first, disc(x, y), false), Fields::kInterlaced) << x << ", " << y;
        EXPECT_EQ(seen(lower_first, disc(x, y), false), Fields::kInterlaced) << x << ", " << y;
    }
}

TEST(FieldMeter, HardEdgesThatMoveByTwoLinesAreNotTakenForFields) {
    for (const auto& [x, y] : {std::pair(0, 2), {0, -2}}) {
        EXPECT_NE(seen(one_moment, bar(x, y), false), Fields::kInterlaced) << x << ", " << y;
        // The flag decides what the pictures leave open.
        EXPECT_EQ(seen(one_moment, bar(x, y), true), Fields::kInterlaced) << x << ", " << y;
    }
    for (const auto& [x, y] : {std::pair(4, 0), {8, 4}, {2, 2}}) {
        EXPECT_EQ(seen(upper_first, bar(x, y), false), Fields::kInterlaced) << x << ", " << y;
        EXPECT_EQ(seen(lower_first, bar(x, y), false), Fields::kInterlaced) << x << ", " << y;
    }
}

TEST(FieldMeter, FindsTheMixedFramesOfTelecine) {
    // Film frames A A B C D: 2:3 pulldown mixes two frames of five.
    const auto telecine = [](int k) {
        const int film = k / 5 * 4;
        constexpr int kUpper[] = {0, 1, 1, 2, 3}, kLower[] = {0, 1, 2, 3, 3};
        return std::pair(2 * (film + kUpper[k % 5]), 2 * (film + kLower[k % 5]));
    };
    EXPECT_EQ(seen(telecine, disc(3, 1)), Fields::kInterlaced);
}

TEST(FieldMeter, KnowsNothingOfWhatStandsStill) {
    EXPECT_EQ(seen(upper_first, disc(0, 0)), Fields::kUnknown);
    FieldMeter meter;
    for (int k = 0; k < 4; ++k) {
        meter.skip();
        meter.add(disc_picture(8 * k, 2, 0));
    }
    EXPECT_EQ(meter.fields(true), Fields::kUnknown);
}

}  // namespace
}  // namespace weft
