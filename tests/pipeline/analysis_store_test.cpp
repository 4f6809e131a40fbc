#include "engine/pipeline/analysis_store.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "engine/core/rng.h"

namespace weft {
namespace {

template <class T>
T random_image(Size size) {
    Rng rng(6);
    T image(size);
    for (std::size_t k = 0; k < image.size_bytes() / sizeof(*image.data()); ++k) {
        image.data()[k] =
            static_cast<std::remove_pointer_t<decltype(image.data())>>(rng.next() % 256);
    }
    return image;
}

LatticeField random_field(Size size, int spacing) {
    LatticeField field(size, spacing);
    field.nodes() = random_image<ImageF2>(field.nodes().size());
    return field;
}

Shading some_shading() {
    Shading shading;
    shading.full = {37, 21};
    shading.downscale = 2;
    shading.value = ImageF1(19, 11);
    for (int k = 0; k < 19 * 11; ++k)
        shading.value.data()[k] = std::exp2(static_cast<float>(k % 30) - 15.0f);
    return shading;
}

TEST(AnalysisCodecs, MattesComeBackExactly) {
    for (const Size size : {Size{31, 17}, Size{1, 1}, Size{0, 0}}) {
        const StoredMatte matte{random_image<Matte>(size), 0.625f};
        const auto back = decode_matte(encode(matte));
        ASSERT_TRUE(back);
        EXPECT_EQ(back->matte, matte.matte);
        EXPECT_EQ(back->confidence, 0.625f);
    }
}

TEST(AnalysisCodecs, WhatAWalkKnowsComesBackWithItsMatte) {
    const Size size{31, 17};
    const StoredMatte matte{random_image<Matte>(size), 0.25f, random_image<FramesSince>(size), 0.5f,
                            random_image<Matte>(size)};
    Bytes bytes = encode(matte);
    const auto back = decode_matte(bytes);
    ASSERT_TRUE(back);
    EXPECT_EQ(back->matte, matte.matte);
    EXPECT_EQ(back->since, matte.since);
    EXPECT_EQ(back->followed, matte.followed);
    EXPECT_EQ(back->since_confidence, 0.5f);
    bytes.pop_back();
    EXPECT_FALSE(decode_matte(bytes)) << "cut off";
}

TEST(AnalysisCodecs, FieldsComeBackExactly) {
    for (const int spacing : {1, 7, 8}) {
        const LatticeField field = random_field({50, 33}, spacing);
        const auto back = decode_lattice(encode(field));
        ASSERT_TRUE(back);
        EXPECT_EQ(back->full_size(), field.full_size());
        EXPECT_EQ(back->spacing(), spacing);
        EXPECT_EQ(back->nodes(), field.nodes());
    }
}

TEST(AnalysisCodecs, PicturesComeBackExactly) {
    const auto picture = random_image<ImageU8x3>({23, 9});
    const auto back = decode_picture(encode(picture));
    ASSERT_TRUE(back);
    EXPECT_EQ(*back, picture);
}

TEST(AnalysisCodecs, ShadingComesBackToAStep) {
    const Shading shading = some_shading();
    const auto back = decode_shading(encode(shading));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->full, shading.full);
    EXPECT_EQ(back->downscale, 2);
    ASSERT_EQ(back->value.size(), shading.value.size());
    for (int k = 0; k < 19 * 11; ++k) {
        EXPECT_NEAR(back->value.data()[k] / shading.value.data()[k], 1.0f, 0.0004f);
    }
    // A second round changes nothing more.
    EXPECT_EQ(encode(*back), encode(shading));
}

// Every kind's decoder on damaged bytes.
template <class Decode>
void expect_refuses_damage(const Bytes& good, const Decode& decode) {
    ASSERT_TRUE(decode(good));
    const auto refused = [&](const Bytes& bytes, const std::string& what) {
        const auto result = decode(bytes);
        ASSERT_FALSE(result) << what;
        EXPECT_EQ(result.error().code, ErrorCode::kRenderFailed) << what;
        EXPECT_NE(result.error().text().find("damaged"), std::string::npos) << what;
    };
    refused({}, "nothing");
    for (std::size_t size = 1; size < good.size(); size += 1 + size / 3) {
        refused(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)),
                std::to_string(size) + " bytes");
    }
    Bytes more = good;
    more.push_back(0);
    refused(more, "one byte more");
    // Sizes that are negative, or so large that room for them must not even be made.
    for (const std::int32_t side : {-1, 65536, 60000, 0x7FFFFFFF}) {
        Bytes wrong = good;
        std::memcpy(wrong.data(), &side, sizeof side);
        std::memcpy(wrong.data() + 4, &side, sizeof side);
        refused(wrong, "side " + std::to_string(side));
    }
}

TEST(AnalysisCodecs, RefuseDamagedBytes) {
    expect_refuses_damage(encode(StoredMatte{Matte(20, 10, 9), 1}), decode_matte);
    expect_refuses_damage(encode(random_field({50, 33}, 8)), decode_lattice);
    expect_refuses_damage(encode(FormMap{{-16, 4}, random_field({50, 33}, 8)}), decode_form);
    expect_refuses_damage(encode(ImageU8x3(9, 12, 3)), decode_picture);
    expect_refuses_damage(encode(some_shading()),
                          [](const Bytes& bytes) { return decode_shading(bytes); });
}

TEST(AnalysisCodecs, RefuseSettingsThatCannotBe) {
    Bytes field = encode(random_field({50, 33}, 8)), shading = encode(some_shading());
    for (const std::int32_t wrong : {0, -3, 0x7FFFFFFF}) {
        std::memcpy(field.data() + 8, &wrong, sizeof wrong);
        EXPECT_FALSE(decode_lattice(field)) << wrong;
    }
    for (const std::int32_t wrong : {0, -2}) {
        std::memcpy(shading.data() + 8, &wrong, sizeof wrong);
        EXPECT_FALSE(decode_shading(shading)) << wrong;
    }
    // The sizes of the shading itself.
    shading = encode(some_shading());
    const std::int32_t huge = 65536;
    std::memcpy(shading.data() + 12, &huge, sizeof huge);
    std::memcpy(shading.data() + 16, &huge, sizeof huge);
    EXPECT_FALSE(decode_shading(shading));
}

TEST(MemoryAnalysisStore, KeepsByRegionFrameAndKind) {
    MemoryAnalysisStore store;
    const AnalysisKey key{1, -4, AnalysisKind::kCoords};
    EXPECT_FALSE(store.has(key));
    const auto nothing = store.get(key);
    ASSERT_FALSE(nothing);
    EXPECT_EQ(nothing.error().code, ErrorCode::kRenderFailed);
    EXPECT_NE(nothing.error().text().find("-4"), std::string::npos);
    ASSERT_TRUE(store.put(key, {1, 2, 3}));
    ASSERT_TRUE(store.put(key, {4, 5}));
    EXPECT_EQ(*store.get(key), (Bytes{4, 5}));
    EXPECT_FALSE(store.has({0, -4, AnalysisKind::kCoords}));
    EXPECT_FALSE(store.has({1, 4, AnalysisKind::kCoords}));
    EXPECT_FALSE(store.has({1, -4, AnalysisKind::kMatte}));
}

}  // namespace
}  // namespace weft
