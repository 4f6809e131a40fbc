// Places of a grown plane that are kept, or made again.
#include <gtest/gtest.h>

#include "engine/core/parallel.h"
#include "engine/synthesis/texture_plane.h"
#include "tests/synthesis/samples.h"

namespace weft {
namespace {

using test::blob_sample;
using test::grow;

PlaneOptions tileable_options() {
    PlaneOptions o;
    o.size = {220, 180};
    o.tileable = true;
    return o;
}

// What a plane shows in a rectangle, texel by texel.
PlaneAmendment keep(const TexturePlane& plane, const Recti& rect) {
    PlaneAmendment out;
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x) {
            const std::int32_t* from =
                plane.source.pixel(x % plane.source.width(), y % plane.source.height());
            out.runs.push_back({x, y, 1, from[0], from[1], 0, 0});
        }
    return out;
}

bool same_in(const TexturePlane& a, const TexturePlane& b, const Recti& rect) {
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x)
            if (!std::equal(a.pixels.pixel(x, y), a.pixels.pixel(x, y) + 3, b.pixels.pixel(x, y)))
                return false;
    return true;
}

constexpr Recti kPlace{60, 50, 110, 95};

TEST(Amendments, LockingEverythingChangesNothing) {
    const ImageU8x3 sample = blob_sample(96, 96, 5);
    PlaneOptions o = tileable_options();
    const TexturePlane before = grow(sample, o);
    o.amendments = {keep(before, kPlace)};
    EXPECT_EQ(grow(sample, o).pixels, before.pixels);
}

TEST(Amendments, ALockedPatchStaysWhenTheRestIsRegenerated) {
    const ImageU8x3 sample = blob_sample(96, 96, 5);
    PlaneOptions o = tileable_options();
    const TexturePlane before = grow(sample, o);
    PlaneOptions other = o;
    other.seed = 9;
    const TexturePlane without = grow(sample, other);
    ASSERT_FALSE(same_in(without, before, kPlace)) << "the seed changes it otherwise";
    other.amendments = {keep(before, kPlace)};
    const TexturePlane with = grow(sample, other);
    EXPECT_TRUE(same_in(with, before, kPlace));
    // Far from it the plane is what it would be without.
    EXPECT_TRUE(same_in(with, without, {0, 0, 220, 10}));
    // Its joins are cut, not pasted: the seams cost about what they cost elsewhere.
    EXPECT_LT(with.stats.seam_energy_per_area, 1.6 * without.stats.seam_energy_per_area);
    for (int y = 0; y < 180; ++y)
        for (int x = 0; x < 220; ++x) {
            const std::int32_t* from = with.source.pixel(x, y);
            ASSERT_TRUE(std::equal(with.pixels.pixel(x, y), with.pixels.pixel(x, y) + 3,
                                   sample.pixel(from[0], from[1])));
        }
}

TEST(Amendments, RegeneratingChangesThatPlaceOnly) {
    const ImageU8x3 sample = blob_sample(96, 96, 5);
    PlaneOptions o = tileable_options();
    const TexturePlane before = grow(sample, o);
    PlaneAmendment again = keep(before, kPlace);
    again.kind = PlaneAmendment::Kind::kAgain;
    o.amendments = {again};
    const TexturePlane first = grow(sample, o);
    EXPECT_FALSE(same_in(first, before, kPlace));
    EXPECT_TRUE(same_in(first, before, {0, 0, 220, 40}));
    EXPECT_TRUE(same_in(first, before, {0, 105, 220, 180}));
    o.amendments[0].seed = 1;
    EXPECT_FALSE(same_in(grow(sample, o), first, kPlace)) << "another seed, another result";
}

TEST(Amendments, LockedTexelsAreNotRegenerated) {
    const ImageU8x3 sample = blob_sample(96, 96, 5);
    PlaneOptions o = tileable_options();
    const TexturePlane before = grow(sample, o);
    const Recti inner{75, 60, 95, 80};
    PlaneAmendment again = keep(before, kPlace);
    again.kind = PlaneAmendment::Kind::kAgain;
    o.amendments = {keep(before, inner), again};
    const TexturePlane after = grow(sample, o);
    EXPECT_TRUE(same_in(after, before, inner));
    EXPECT_FALSE(same_in(after, before, kPlace));
}

TEST(Amendments, SameBytesForAnyThreadCount) {
    const ImageU8x3 sample = blob_sample(96, 96, 5);
    PlaneOptions o = tileable_options();
    const TexturePlane before = grow(sample, o);
    o.seed = 3;
    o.amendments = {keep(before, {200, 170, 240, 190})};  // over the border
    set_thread_count(1);
    const TexturePlane one = grow(sample, o);
    set_thread_count(3);
    const TexturePlane three = grow(sample, o);
    set_thread_count(0);
    EXPECT_EQ(one.pixels, three.pixels);
}

TEST(Amendments, WhatIsNotInTheSampleIsLeftOut) {
    const ImageU8x3 sample = blob_sample(96, 96, 5);
    PlaneOptions o = tileable_options();
    const TexturePlane before = grow(sample, o);
    o.amendments = {{PlaneAmendment::Kind::kKeep,
                     0,
                     {{10, 10, 40, 90, 90, 0, 0}, {5, 5, 3, -2, 7, 0, 0}, {5, 5, 3, 1, 1, 4, 0}}}};
    EXPECT_TRUE(grow_plane(sample, o));
}

}  // namespace
}  // namespace weft
