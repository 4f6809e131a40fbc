#include "engine/motion/photometric_register.h"

#include <gtest/gtest.h>

#include <functional>

#include "engine/core/rng.h"
#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kRegisteredFrame{320, 200};
using Map = std::function<Vec2(Vec2)>;  // anchor position of a frame position

Vec2 plane(Vec2 p) {
    const Vec2 q = (p - Vec2(160, 100)) / 160.0f;
    const float w = 1 + 0.08f * q.x - 0.05f * q.y;
    return Vec2(160, 100) +
           160.0f * Vec2(1.04f * q.x - 0.05f * q.y + 0.02f, 0.05f * q.x + 1.02f * q.y) / w;
}

Vec2 folded(Vec2 p) {
    return p + Vec2(1.2f * std::sin(p.x / 16.0f) + 3, 0.8f * std::sin(p.y / 20.0f + p.x / 40.0f));
}

struct Pair {
    Matte anchor, frame, visible;
};

// Both frames of a textured surface; a shadow with a hard edge lies on the second one only.
Pair pair(const Map& map, bool shadow) {
    const WaveTexture texture(3);
    Pair out;
    out.anchor = draw(kRegisteredFrame, [&](Vec2 p) { return 0.15f + 0.7f * texture(p); });
    out.frame = draw(kRegisteredFrame, [&](Vec2 p) {
        const float light = shadow && p.x + 0.5f * p.y > 190 ? 0.55f : 1.0f;
        return light * (0.15f + 0.7f * texture(map(p)));
    });
    out.visible = Matte(kRegisteredFrame, 255);
    return out;
}

// The truth plus `error` by place.
LatticeField field_with_error(const Map& map, const std::function<Vec2(Vec2)>& error) {
    LatticeField field(kRegisteredFrame, 8);
    for (int j = 0; j < field.nodes().height(); ++j) {
        for (int i = 0; i < field.nodes().width(); ++i) {
            const Vec2 p = field.node_position(i, j);
            field.set_node(i, j, map(p) - p + error(p));
        }
    }
    return field;
}
LatticeField exactly(const Map& map) {
    return field_with_error(map, [](Vec2) { return Vec2(0); });
}
// With an error of about a pixel, as a chain leaves it.
LatticeField roughly(const Map& map) {
    return field_with_error(map, [](Vec2 p) { return Vec2(0.7f, -0.6f + p.x / 400.0f); });
}

float mean_map_error(const LatticeField& field, const Map& map, const Recti& area) {
    double sum = 0;
    for (int y = area.y0; y < area.y1; ++y) {
        for (int x = area.x0; x < area.x1; ++x) {
            const Vec2 p = centre_of(x, y);
            sum += distance(p + field.at(p), map(p));
        }
    }
    return static_cast<float>(sum / (area.width() * area.height()));
}

constexpr Recti kInner{30, 30, 290, 170};

TEST(RegisterPlanar, FindsAPlaneThroughAShadow) {
    for (const bool shadow : {false, true}) {
        const Pair p = pair(plane, shadow);
        const LatticeField start = roughly(plane);
        const PlanarRegistration found =
            register_planar(registration_picture(p.anchor, p.visible),
                            registration_picture(p.frame, p.visible), start, {});
        ASSERT_TRUE(found.found);
        EXPECT_GT(mean_map_error(start, plane, kInner), 0.7f);
        EXPECT_LT(mean_map_error(found.anchor_from_cur, plane, kInner), 0.03f) << shadow;
        EXPECT_GT(found.fit.share, 0.8);
    }
}

// A faint pattern, of twenty levels, under noise of eight that is new in each frame.
Pair faint_pair(std::uint64_t seed) {
    const WaveTexture texture(3);
    Pair out;
    const auto seen = [&](const Map& map, std::uint64_t stream) {
        Rng rng(seed, stream, 0);
        return draw(kRegisteredFrame, [&](Vec2 p) {
            return 0.5f + 0.08f * texture(map(p)) + 0.03f * static_cast<float>(rng.uniform() - 0.5);
        });
    };
    out.anchor = seen([](Vec2 p) { return p; }, 1);
    out.frame = seen(plane, 2);
    out.visible = Matte(kRegisteredFrame, 255);
    return out;
}

TEST(RefinePlanar, ComparesMorePixelsOfAFaintSurface) {
    RegistrationOptions few;
    few.samples = 4000;
    float before = 0, after = 0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const Pair p = faint_pair(seed);
        const RegistrationPicture anchor = registration_picture(p.anchor, p.visible);
        const RegistrationPicture cur = registration_picture(p.frame, p.visible);
        const PlanarRegistration found = register_planar(anchor, cur, roughly(plane), few);
        ASSERT_TRUE(found.found);
        before += mean_map_error(found.anchor_from_cur, plane, kInner);
        after +=
            mean_map_error(refine_planar(anchor, cur, found.anchor_from_cur, few), plane, kInner);
    }
    EXPECT_LT(after, 0.5f * before);
}

TEST(RefinePlanar, LeavesWhatIsKnownWellEnough) {
    const Pair p = pair(plane, false);
    const RegistrationPicture anchor = registration_picture(p.anchor, p.visible);
    const RegistrationPicture cur = registration_picture(p.frame, p.visible);
    const LatticeField found = register_planar(anchor, cur, roughly(plane), {}).anchor_from_cur;
    EXPECT_EQ(refine_planar(anchor, cur, found, {}).nodes(), found.nodes());
}

TEST(RegisterPlanar, ExplainsAFoldedSurfaceWorseThanASmoothField) {
    const Pair p = pair(folded, false);
    const RegistrationPicture anchor = registration_picture(p.anchor, p.visible);
    const RegistrationPicture cur = registration_picture(p.frame, p.visible);
    const LatticeField start = roughly(folded);
    const LatticeField smooth = register_lattice(anchor, cur, start, {});
    const PlanarRegistration flat = register_planar(anchor, cur, start, {});
    const RegistrationFit fit = registration_fit(anchor, cur, smooth, {});
    EXPECT_GT(flat.fit.residual, 1.5 * fit.residual);
}

TEST(RegisterLattice, FollowsFolds) {
    for (const bool shadow : {false, true}) {
        const Pair p = pair(folded, shadow);
        const LatticeField field =
            register_lattice(registration_picture(p.anchor, p.visible),
                             registration_picture(p.frame, p.visible), roughly(folded), {});
        EXPECT_LT(mean_map_error(field, folded, kInner), 0.08f) << shadow;
    }
}

// Else the prior would outweigh them, and folds be smoothed.
TEST(RegisterLattice, ThinnedSamplesCountForThoseThatAreLeftOut) {
    const Pair p = pair(folded, false);
    const RegistrationPicture anchor = registration_picture(p.anchor, p.visible);
    const RegistrationPicture cur = registration_picture(p.frame, p.visible);
    RegistrationOptions stiff;
    stiff.stiffness_px = 0.004f;
    const auto error = [&](int samples, int thinned) {
        stiff.samples = samples;
        stiff.thinned = thinned;
        return mean_map_error(register_lattice(anchor, cur, roughly(folded), stiff), folded,
                              kInner);
    };
    constexpr int kEverySample = 100000, kOneInFour = 20000;
    const float all = error(kEverySample, 1);
    EXPECT_LT(error(kEverySample, 2), 1.15f * all);
    EXPECT_GT(error(kOneInFour, 1), 1.15f * all) << "as few that count for themselves";
}

TEST(RegisterLattice, ABlankPlaceFollowsItsSurroundings) {
    const Map shift = [](Vec2 p) { return p + Vec2(2, 1); };
    Pair p = pair(shift, false);
    const Recti blank{120, 70, 200, 130};
    for (int y = blank.y0; y < blank.y1; ++y) {
        for (int x = blank.x0; x < blank.x1; ++x) {
            p.anchor.at(x, y) = 120;
            p.frame.at(x, y) = 120;
        }
    }
    const LatticeField start = roughly(shift);
    const LatticeField field =
        register_lattice(registration_picture(p.anchor, p.visible),
                         registration_picture(p.frame, p.visible), start, {});
    const Recti middle{145, 90, 175, 110};
    EXPECT_GT(mean_map_error(start, shift, middle), 0.7f);
    EXPECT_LT(mean_map_error(field, shift, middle), 0.25f);
}

TEST(Registration, WithoutARegionLeavesTheField) {
    const Pair p = pair(plane, false);
    const RegistrationPicture nothing = registration_picture(p.anchor, Matte(kRegisteredFrame));
    const RegistrationPicture cur = registration_picture(p.frame, p.visible);
    const LatticeField start = roughly(plane);
    EXPECT_FALSE(register_planar(nothing, cur, start, {}).found);
    EXPECT_EQ(register_lattice(nothing, cur, start, {}).nodes(), start.nodes());
    EXPECT_EQ(register_lattice(cur, nothing, start, {}).nodes(), start.nodes());
    EXPECT_EQ(registration_fit(nothing, cur, start, {}).share, 0);
}

TEST(RegistrationAgreement, IsOneWhereTheSurfaceIsFoundAgain) {
    const Pair p = pair(plane, false);
    const RegistrationPicture anchor = registration_picture(p.anchor, p.visible);
    const RegistrationPicture frame = registration_picture(p.frame, p.visible);
    const LatticeField truth = exactly(plane), rough = roughly(plane);
    EXPECT_GT(registration_agreement(anchor, frame, truth), 0.97);
    EXPECT_LT(registration_agreement(anchor, frame, rough), 0.9);
    EXPECT_EQ(registration_agreement({}, {}, truth), 0);
}

TEST(RegistrationLead, IsPositiveForTheMapThatExplainsMore) {
    const Pair p = pair(plane, true);
    const RegistrationPicture anchor = registration_picture(p.anchor, p.visible);
    const RegistrationPicture frame = registration_picture(p.frame, p.visible);
    const LatticeField truth = exactly(plane), rough = roughly(plane);
    EXPECT_GT(registration_lead(anchor, frame, truth, rough).errors, 5);
    EXPECT_LT(registration_lead(anchor, frame, rough, truth).errors, -5);
    EXPECT_EQ(registration_lead(anchor, frame, truth, truth).errors, 0);
    EXPECT_EQ(registration_lead({}, {}, truth, rough).errors, 0);
}

}  // namespace
}  // namespace weft
