#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

#include <bit>

#include "engine/media/cryptomatte.h"
#include "engine/media/cryptomatte_selection.h"
#include "engine/media/image_files.h"
#include "tests/media/media_fixture.h"

namespace weft {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class CryptomatteTest : public MediaTest {
  protected:
    // 4×1: wholly the wall; three quarters wall, one the ball; wholly the ball; nothing.
    void put(const std::string& name, const std::string& manifest,
             std::uint32_t wall_id = cryptomatte_id("Wall"),
             std::uint32_t ball_id = cryptomatte_id("Ball"), const std::string& layer = "obj",
             const std::vector<std::string>& channels = {"obj00.r", "obj00.g", "obj00.b",
                                                         "obj00.a"}) {
        OIIO::ImageSpec spec(4, 1, 7, OIIO::TypeFloat);
        spec.channelnames = {"R", "G", "B"};
        spec.channelnames.insert(spec.channelnames.end(), channels.begin(), channels.end());
        spec.attribute("cryptomatte/1234567/name", layer);
        spec.attribute("cryptomatte/1234567/hash", "MurmurHash3_32");
        spec.attribute("cryptomatte/1234567/conversion", "uint32_to_float32");
        if (!manifest.empty()) spec.attribute("cryptomatte/1234567/manifest", manifest);
        const float wall = std::bit_cast<float>(wall_id);
        const float ball = std::bit_cast<float>(ball_id);
        const std::vector<float> data{0, 0, 0, wall, 1,     0,    0,      //
                                      0, 0, 0, wall, 0.75f, ball, 0.25f,  //
                                      0, 0, 0, ball, 1,     0,    0,      //
                                      0, 0, 0, 0,    0,     0,    0};
        auto output = OIIO::ImageOutput::create(in(name));
        ASSERT_TRUE(output->open(in(name), spec));
        ASSERT_TRUE(output->write_image(OIIO::TypeFloat, data.data()));
        ASSERT_TRUE(output->close());
    }
    static constexpr const char* kManifest = R"({"Wall":"2c388f97","Ball":"74d3ebe9"})";
};

TEST_F(CryptomatteTest, NamesHaveTheHashesThatARendererGaveThem) {
    EXPECT_EQ(cryptomatte_id("Wall"), 0x2c388f97u);
    EXPECT_EQ(cryptomatte_id("Ball"), 0x74d3ebe9u);
    EXPECT_EQ(cryptomatte_id("Ground"), 0x24950135u);
}

TEST_F(CryptomatteTest, ObjectsAreListedPickedAndRead) {
    put("a.exr", kManifest);
    const auto objects = list_cryptomatte(in("a.exr")).value();
    ASSERT_EQ(objects.size(), 2u);
    EXPECT_EQ(objects[0].name, "Wall");
    EXPECT_DOUBLE_EQ(objects[0].coverage_px, 1.75);
    EXPECT_EQ(objects[1].name, "Ball");
    EXPECT_EQ(pick_cryptomatte(in("a.exr"), 1, 0).value().name, "Wall");
    EXPECT_EQ(pick_cryptomatte(in("a.exr"), 2, 0).value().name, "Ball");
    EXPECT_EQ(pick_cryptomatte(in("a.exr"), 3, 0).value().name, "");
    EXPECT_EQ(pick_cryptomatte(in("a.exr"), 4, 0).error().code, ErrorCode::kUsage);

    const Matte wall = read_cryptomatte(in("a.exr"), "Wall", {4, 1}).value();
    EXPECT_EQ(std::vector<int>(wall.data(), wall.data() + 4), (std::vector<int>{255, 191, 0, 0}));
    const Matte both = read_cryptomatte(in("a.exr"), "Wall,obj/B*", {}).value();
    EXPECT_EQ(std::vector<int>(both.data(), both.data() + 4), (std::vector<int>{255, 255, 255, 0}));
    MatteSelect select;
    select.crypto = "Ball";
    select.invert = true;
    EXPECT_EQ(read_matte(in("a.exr"), select, {4, 1}).value().at(2, 0), 0);
}

TEST_F(CryptomatteTest, NamesAreFoundWithoutAManifest) {
    put("a.exr", "");
    EXPECT_EQ(read_cryptomatte(in("a.exr"), "Ball", {}).value().at(2, 0), 255);
}

TEST_F(CryptomatteTest, WhatIsNotThereIsSaid) {
    put("a.exr", kManifest);
    const auto none = check_cryptomatte_names({in("a.exr"), in("a.exr")}, "Wall,Door");
    ASSERT_FALSE(none);
    EXPECT_THAT(none.error().sentence(), HasSubstr("'Door'"));
    EXPECT_THAT(none.error().sentence(), HasSubstr("Ball, Wall"));
    EXPECT_THAT(read_cryptomatte(in("a.exr"), "Wall", {5, 1}).error().sentence(), HasSubstr("4x1"));
    EXPECT_EQ(list_cryptomatte(in("b.exr")).error().code, ErrorCode::kMissingFrames);
}

// Renderers list the objects that a frame shows only.
TEST_F(CryptomatteTest, ObjectsMayBeMissingFromFrames) {
    put("a.exr", R"({"Ball":"74d3ebe9"})", cryptomatte_id("Ball"));
    put("b.exr", kManifest);
    EXPECT_EQ(read_cryptomatte(in("a.exr"), "Wall", {}).value().at(0, 0), 0);
    EXPECT_EQ(read_cryptomatte(in("a.exr"), "Wa*", {}).value().at(0, 0), 0);
    EXPECT_TRUE(check_cryptomatte_names({in("a.exr"), in("b.exr")}, "Wall,B*"));
    EXPECT_FALSE(check_cryptomatte_names({in("a.exr")}, "Wall"));
    EXPECT_FALSE(check_cryptomatte_names({in("a.exr"), in("b.exr")}, "D*"));
    // Without a manifest the pixels tell.
    put("c.exr", "");
    EXPECT_TRUE(check_cryptomatte_names({in("c.exr")}, "Wall"));
    EXPECT_FALSE(check_cryptomatte_names({in("c.exr")}, "Door"));
}

TEST_F(CryptomatteTest, NamesMayHoldCommasAndStars) {
    put("a.exr", R"({"wall, left":"2c388f97","Ball":"74d3ebe9","B*":"1"})");
    for (const char* text : {"wall\\, left", "\"wall, left\"", "Ball, \"wall, left\"", "wall*"})
        EXPECT_EQ(read_cryptomatte(in("a.exr"), text, {}).value().at(0, 0), 255) << text;
    EXPECT_EQ(read_cryptomatte(in("a.exr"), "B\\*", {}).value().at(2, 0), 0);
    EXPECT_EQ(read_cryptomatte(in("a.exr"), "B*", {}).value().at(2, 0), 255);
}

TEST(CryptomatteSelection, NamesComeBackAsTheyWere) {
    for (const std::string name : {"Wall", "wall, left", "a\\", "\\,", "\"q\"", " lead", "*", ""})
        EXPECT_THAT(split_crypto_names(escaped_crypto_name(name)), ElementsAre(name));
    EXPECT_THAT(split_crypto_names("a , b\\c,\"d\"e"), ElementsAre("a", "b\\c", "\"d\"e"));
    EXPECT_THAT(split_crypto_names("\"a, b\" ,c"), ElementsAre("a, b", "c"));
    EXPECT_THAT(split_crypto_names("a*"), ElementsAre(std::string("a") + kAnyText));
    EXPECT_EQ(escaped_crypto_name(std::string("a") + kAnyText), "a*");
}

// PXR24 keeps 24 bits of each float, rounded.
TEST_F(CryptomatteTest, RoundedIdsAreMatchedByWhatIsLeft) {
    put("a.exr", kManifest, 0x2c389000u, 0x74d3ec00u);
    const Matte wall = read_cryptomatte(in("a.exr"), "Wall", {}).value();
    EXPECT_EQ(std::vector<int>(wall.data(), wall.data() + 4), (std::vector<int>{255, 191, 0, 0}));
    EXPECT_EQ(pick_cryptomatte(in("a.exr"), 2, 0).value().name, "Ball");
    put("b.exr", "", 0x2c389000u, 0x74d3ec00u);
    EXPECT_EQ(read_cryptomatte(in("b.exr"), "Wall", {}).value().at(0, 0), 255);
}

TEST_F(CryptomatteTest, IdsThatHalfHasRoundedAreNamed) {
    put("a.exr", kManifest, 0x2c388000u, 0x74d3e000u);
    const auto lost = read_cryptomatte(in("a.exr"), "Wall", {});
    ASSERT_FALSE(lost);
    EXPECT_EQ(lost.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(lost.error().sentence(), HasSubstr("rounded"));
}

// A File Output node names the Cryptomatte by its slot, and its channels in capital letters.
TEST_F(CryptomatteTest, ASlotsNameNeedNotEndInANumber) {
    put("a.exr", R"({"Wall":"2c388f97"})", 0x2c388f97u, 0x74d3ebe9u, "matte",
        {"matte.R", "matte.G", "matte.B", "matte.A"});
    EXPECT_EQ(read_cryptomatte(in("a.exr"), "Wall", {}).value().at(0, 0), 255);
}

TEST_F(CryptomatteTest, CutNamesAreTheCauseOfLostChannels) {
    const std::string layer = std::string(48, 'L') + ".CryptoObject";
    put("a.exr", R"({"Wall":"2c388f97"})", 0x2c388f97u, 0x74d3ebe9u, layer,
        {layer + "00.", layer + "01.", layer + "02.", "V"});
    const auto lost = read_cryptomatte(in("a.exr"), "Wall", {});
    ASSERT_FALSE(lost);
    EXPECT_THAT(lost.error().sentence(), HasSubstr("64 characters"));
}

// Two renders of one scene list the same objects.
TEST_F(CryptomatteTest, TheLayerOfThePlatesRenderIsMeant) {
    OIIO::ImageSpec spec(1, 1, 8, OIIO::TypeFloat);
    spec.channelnames.clear();
    for (const std::string view : {"bg", "fg"}) {
        for (const char* channel : {"r", "g", "b", "a"})
            spec.channelnames.push_back(view + ".Crypto00." + channel);
        spec.attribute("cryptomatte/" + view + "/name", view + ".Crypto");
        spec.attribute("cryptomatte/" + view + "/manifest", kManifest);
    }
    const float wall = std::bit_cast<float>(cryptomatte_id("Wall"));
    const std::vector<float> data{0, 0, 0, 0, wall, 1, 0, 0};
    auto output = OIIO::ImageOutput::create(in("two.exr"));
    ASSERT_TRUE(output->open(in("two.exr"), spec));
    ASSERT_TRUE(output->write_image(OIIO::TypeFloat, data.data()));
    ASSERT_TRUE(output->close());
    const auto beside = [&](const char* names, const char* layer) {
        return cryptomatte_names_beside(in("two.exr"), names, layer);
    };
    EXPECT_EQ(beside("Wall, B*", "fg.Combined"), "fg.Crypto/Wall, fg.Crypto/B*");
    EXPECT_EQ(beside("Wall", "bg.Combined"), "Wall") << "the first in any case";
    EXPECT_EQ(beside("Wall", "other.Combined"), "Wall");
    EXPECT_EQ(beside("bg.Crypto/Wall", "fg.Combined"), "bg.Crypto/Wall");
    EXPECT_EQ(cryptomatte_layer(in("two.exr"), beside("Wall", "fg.Combined")), "fg.Crypto");
    EXPECT_EQ(read_cryptomatte(in("two.exr"), beside("Wall", "fg.Combined"), {}).value().at(0, 0),
              255);
}

TEST_F(CryptomatteTest, OneUnlistedObjectIsNoSignOfRounding) {
    put("a.exr", R"({"Door":"1"})", 0x2c389000u, 0x2c389000u);
    EXPECT_EQ(read_cryptomatte(in("a.exr"), "Door", {}).value().at(0, 0), 0);
}

TEST(CryptomatteManifest, IsReadStrictly) {
    const auto good =
        parse_cryptomatte_manifest(R"( { "a b\"c" : "0000000A" , "é\u00e9": "ff" } )");
    ASSERT_TRUE(good);
    EXPECT_EQ(good->at("a b\"c"), 10u);
    EXPECT_EQ(good->at("éé"), 255u);
    EXPECT_TRUE(parse_cryptomatte_manifest("{}"));
    for (const char* bad : {"", "{", "[]", R"({"a"})", R"({"a":"xyz"})", R"({"a":"123456789"})",
                            R"({"a":"1")", R"({"a":"1",})", R"({"\u12":"1"})", R"({"a)"})
        EXPECT_FALSE(parse_cryptomatte_manifest(bad)) << bad;
}

class MotionPass : public MediaTest {
  protected:
    // One pixel's vector everywhere in 8×4.
    void put(const std::string& name, const std::vector<std::string>& channels,
             const std::vector<float>& pixel) {
        OIIO::ImageSpec spec(8, 4, static_cast<int>(channels.size()), OIIO::TypeFloat);
        spec.channelnames = channels;
        std::vector<float> data;
        for (int i = 0; i < 32; ++i)
            data.insert(data.end(), pixel.begin(), pixel.end());
        auto output = OIIO::ImageOutput::create(in(name));
        ASSERT_TRUE(output->open(in(name), spec));
        ASSERT_TRUE(output->write_image(OIIO::TypeFloat, data.data()));
        ASSERT_TRUE(output->close());
    }
    std::vector<float> motion(const std::string& name, MotionConvention convention,
                              MotionDirection direction, const std::string& layer = "") {
        const auto flow = read_motion(in(name), {convention, direction, layer}, {8, 4});
        EXPECT_TRUE(flow) << flow.error().text();
        if (!flow) return {};
        EXPECT_EQ(flow->valid.at(3, 2), 255);
        return {flow->d.at(3, 2, 0), flow->d.at(3, 2, 1)};
    }
};

// In all of them the surface goes 3 px to the right and 1 px up in a frame.
TEST_F(MotionPass, EveryConventionGivesTheSameMotion) {
    const std::vector<float> to_next{3, -1}, to_previous{-3, 1};
    put("blender.exr", {"v.Vector.X", "v.Vector.Y", "v.Vector.Z", "v.Vector.W"}, {-3, -1, -3, -1});
    EXPECT_EQ(motion("blender.exr", MotionConvention::kBlender, kBackward), to_previous);
    EXPECT_EQ(motion("blender.exr", MotionConvention::kBlender, kForward), to_next);
    put("nuke.exr", {"forward.u", "forward.v", "backward.u", "backward.v"}, {3, 1, -3, -1});
    EXPECT_EQ(motion("nuke.exr", MotionConvention::kNuke, kForward), to_next);
    EXPECT_EQ(motion("nuke.exr", MotionConvention::kNuke, kBackward), to_previous);
    // Half covered: both the vector and the alpha are halved.
    put("moonray.exr", {"motionvec.R", "motionvec.G", "A"}, {0.375f, 0.125f, 0.5f});
    EXPECT_EQ(motion("moonray.exr", MotionConvention::kMoonray, kForward), to_next);
    put("flame.exr", {"R", "G", "B"}, {0.375f, 0.25f, 0});
    EXPECT_EQ(motion("flame.exr", MotionConvention::kFlame, kForward), to_next);
    EXPECT_EQ(motion("flame.exr", MotionConvention::kFlame, kBackward), to_previous);
    put("arnold.exr", {"R", "G", "B", "motionvector.R", "motionvector.G"}, {9, 9, 9, 3, 1});
    EXPECT_EQ(motion("arnold.exr", MotionConvention::kArnold, kForward), to_next);
    EXPECT_EQ(motion("arnold.exr", MotionConvention::kArnold, kForward, "motionvector"), to_next);
}

TEST_F(MotionPass, WhatIsNotThereIsListed) {
    put("a.exr", {"R", "G", "B"}, {0, 0, 0});
    const auto none = read_motion(in("a.exr"), {MotionConvention::kBlender, kForward, ""}, {8, 4});
    ASSERT_FALSE(none);
    EXPECT_THAT(none.error().sentence(), HasSubstr("R, G, B"));
    EXPECT_FALSE(read_motion(in("a.exr"), {MotionConvention::kFlame, kForward, ""}, {9, 4}));
}

TEST_F(MotionPass, UvPassesHaveUAndVOrRAndG) {
    put("uv.exr", {"shot.UV.U", "shot.UV.V", "shot.UV.A"}, {0.25f, 0.75f, 1});
    EXPECT_EQ(read_uv(in("uv.exr"), "", {8, 4}).value().at(1, 1, 1), 0.75f);
    put("st.exr", {"R", "G", "B"}, {0.5f, 0.125f, 0});
    EXPECT_EQ(read_uv(in("st.exr"), "", {8, 4}).value().at(1, 1, 0), 0.5f);
    EXPECT_EQ(read_uv(in("uv.exr"), "shot.UV", {8, 4}).value().at(1, 1, 0), 0.25f);
    EXPECT_FALSE(read_uv(in("uv.exr"), "", {8, 5}));
}

// Houdini's and USD's names are paths.
TEST_F(CryptomatteTest, ANameMayBeginWithASlash) {
    put("a.exr", R"({"/obj/Wall":"2c388f97","Ball":"74d3ebe9"})");
    EXPECT_EQ(read_cryptomatte(in("a.exr"), "/obj/Wall", {}).value().at(0, 0), 255);
    EXPECT_EQ(read_cryptomatte(in("a.exr"), "obj//obj/Wall", {}).value().at(0, 0), 255);
    EXPECT_TRUE(check_cryptomatte_names({in("a.exr")}, "/obj/Wall"));
}

TEST_F(CryptomatteTest, AFilteredOneIsRefused) {
    OIIO::ImageSpec spec(4, 4, 5, OIIO::TypeFloat);
    spec.channelnames = {"R", "obj00.r", "obj00.g", "obj00.b", "obj00.a"};
    spec.attribute("cryptomatte/1234567/name", "obj");
    spec.attribute("cryptomatte/1234567/manifest", kManifest);
    const auto put_ids = [&](const char* name, std::uint32_t beside) {
        std::vector<float> data;
        for (int i = 0; i < 16; ++i)
            data.insert(
                data.end(),
                {0, std::bit_cast<float>(cryptomatte_id("Wall") + (i > 5 ? beside : 0)), 1, 0, 0});
        auto output = OIIO::ImageOutput::create(in(name));
        ASSERT_TRUE(output->open(in(name), spec));
        ASSERT_TRUE(output->write_image(OIIO::TypeFloat, data.data()));
        ASSERT_TRUE(output->close());
    };
    put_ids("whole.exr", 0);
    EXPECT_TRUE(read_cryptomatte(in("whole.exr"), "Wall", {}));
    put_ids("scaled.exr", 3);
    EXPECT_THAT(read_cryptomatte(in("scaled.exr"), "Wall", {}).error().sentence(),
                HasSubstr("scaled, turned or blurred"));
    put_ids("others.exr", 4000);
    EXPECT_TRUE(read_cryptomatte(in("others.exr"), "Wall", {})) << "an object without a name";
}

TEST_F(CryptomatteTest, WithoutAManifestNoNamesAreListed) {
    put("a.exr", "");
    EXPECT_THAT(check_cryptomatte_names({in("a.exr")}, "Bal").error().sentence(),
                HasSubstr("lists no names"));
}

}  // namespace
}  // namespace weft
