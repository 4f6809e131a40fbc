// Every option of a render has its documented effect.
#include <cmath>
#include <cstring>
#include <fstream>

#include "engine/core/fields.h"
#include "engine/media/image_files.h"
#include "tests/cli/cli_fixture.h"

namespace weft::test {
namespace {

using ::testing::IsEmpty;

// The largest difference between `a` and `b` moved by `shift`, over `box` of `a`.
float largest_difference(const ImageF3& a, const ImageF3& b, const Recti& box,
                         Vec2i shift = {0, 0}) {
    float largest = 0;
    for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; ++x)
            for (int c = 0; c < 3; ++c)
                largest =
                    std::max(largest, std::abs(a.at(x, y, c) - b.at(x + shift.x, y + shift.y, c)));
    return largest;
}

// The card's interior on the first frame.
Recti interior(int margin) {
    const Vec2i c = Card::corner(0);
    return {c.x + margin, c.y + margin, c.x + Card::kWidth - margin, c.y + Card::kHeight - margin};
}

class EveryValue : public CliTest, public ::testing::WithParamInterface<Words> {};

TEST_P(EveryValue, Renders) {
    make_shot(2);
    put_picture("light.png", pattern_picture({32, 32}, 9));
    const Outcome outcome = run_replace(GetParam());
    expect_success(outcome);
    EXPECT_THAT(outcome.err, IsEmpty());
    const ImageF3 plate = picture("frames/0002.png").rgb, result = picture("out/0002.png").rgb;
    EXPECT_GT(largest_difference(result, plate, interior(4)), 0.1f);
    // No pixel became black, white or a colour that the texture lacks.
    double mean = 0;
    const Recti box = interior(4);
    for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; ++x)
            mean += static_cast<double>(result.at(x, y, 1));
    mean /= box.width() * box.height();
    EXPECT_GT(mean, 0.2);
    EXPECT_LT(mean, 0.9);
}

// Synthesis and temporal options need a sample; the others do not.
Words sampled(const Words& more) {
    Words words{"--plane", "", "--texture", "sample.png"};  // an empty string: no plane
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

INSTANTIATE_TEST_SUITE_P(
    Options, EveryValue,
    ::testing::Values(
        sampled({"--seam", "graphcut", "--overlap", "24", "--feather", "2"}),
        sampled({"--seam", "dp"}), sampled({"--seam", "none"}),
        sampled({"--temporal", "paper", "--temporal-blend", "0.5", "--temporal-weight", "2"}),
        sampled({"--temporal", "none"}), Words{"--temporal", "locked", "--quality", "final"},
        Words{"--light", "plate", "--blend-mode", "gain", "--light-strength", "0.5"},
        Words{"--light", "plate", "--blend-mode", "detail"},
        Words{"--light", "plate", "--blend-mode", "literal"}, Words{"--light", "none"},
        Words{"--light", "light.png"},
        Words{"--scale", "1.5", "--rotate", "30", "--offset", "-4,7.5"},
        Words{"--plane-wrap", "mirror", "--working-space", "srgb"},
        Words{"--frames", "2", "--reference-frame", "1"}));

// Files of the card's true motion: forward (to the next frame) or backward.
class TrueMotion : public CliTest {
  protected:
    static FlowField motion(int step, int sign) {
        FlowField flow(Card::kPlate);
        for (int y = 0; y < Card::kPlate.height; ++y)
            for (int x = 0; x < Card::kPlate.width; ++x) {
                if (!Card::covers(step, x, y)) continue;
                flow.d.at(x, y, 0) = static_cast<float>(sign * Card::kStepX);
                flow.d.at(x, y, 1) = static_cast<float>(sign * Card::kStepY);
            }
        return flow;
    }
    void put_flo(const std::string& name, const FlowField& flow) const {
        std::ofstream file(folder_ / name, std::ios::binary);
        const std::int32_t size[2] = {flow.size().width, flow.size().height};
        file.write("PIEH", 4).write(reinterpret_cast<const char*>(size), sizeof size);
        file.write(reinterpret_cast<const char*>(flow.d.data()),
                   static_cast<std::streamsize>(flow.d.size_bytes()));
    }
    // The texture of frame 1 is on frame 4 where the surface has moved to.
    void expect_moves_with_the_surface() const {
        const Vec2i shift{3 * Card::kStepX, 3 * Card::kStepY};
        const ImageF3 first = picture("out/0001.png").rgb, last = picture("out/0004.png").rgb;
        EXPECT_LT(largest_difference(first, last, interior(6), shift), 0.03f);
        EXPECT_GT(largest_difference(first, last, interior(6)), 0.2f);
    }
};

TEST_F(TrueMotion, ForwardAsKittiPng) {
    make_shot(4);
    std::filesystem::create_directory(folder_ / "flow");
    for (int step = 0; step < 3; ++step) {
        const std::string name = in("flow/000" + std::to_string(step + 1) + ".png");
        ASSERT_TRUE(write_flow_kitti(name, motion(step, 1)));
    }
    expect_success(run_replace(
        {"--motion", "flow/####.png", "--motion-direction", "forward", "--light", "none"}));
    expect_moves_with_the_surface();
}

TEST_F(TrueMotion, BackwardAsFlo) {
    make_shot(4);
    std::filesystem::create_directory(folder_ / "flow");
    for (int step = 1; step < 4; ++step)
        put_flo("flow/000" + std::to_string(step + 1) + ".flo", motion(step, -1));
    const Words words{"--motion", "flow/####.flo", "--motion-direction",
                      "backward", "--light",       "none"};
    expect_success(run_replace(words));
    expect_moves_with_the_surface();
    std::filesystem::remove(folder_ / "flow/0003.flo");
    Words again = words;
    again.insert(again.end(), {"--overwrite"});
    expect_failure(run_replace(again), 4, {"motion", "flow/####.flo", "frame 3"});
}

TEST_F(CliTest, EstimatedMotionKeepsTheTextureOnTheSurface) {
    make_shot(4);
    expect_success(run_replace({"--quality", "final", "--light", "none"}));
    const ImageF3 first = picture("out/0001.png").rgb, last = picture("out/0004.png").rgb;
    const Vec2i shift{3 * Card::kStepX, 3 * Card::kStepY};
    double moved = 0, still = 0;
    const Recti box = interior(8);
    for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; ++x) {
            const float here = first.at(x, y, 1);
            moved += std::abs(here - last.at(x + shift.x, y + shift.y, 1));
            still += std::abs(here - last.at(x, y, 1));
        }
    EXPECT_LT(moved, 0.25 * still);
}

// Four colours, so that a rotated or mirrored placement is visible.
ImageF3 quadrants() {
    ImageF3 image(Size{64, 64});
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            image.at(x, y, 0) = x < 32 ? 0.8f : 0.2f;
            image.at(x, y, 1) = y < 32 ? 0.8f : 0.2f;
            image.at(x, y, 2) = 0.4f;
        }
    return image;
}

TEST_F(CliTest, CornersPlaceThePlaneOntoTheCard) {
    make_shot(2);
    put_picture("quadrants.png", quadrants());
    expect_success(run_replace({"--plane", "quadrants.png", "--light", "none", "--match-plate", "0",
                                "--corners", "30,25", "110,25", "110,85", "30,85"}));
    const ImageF3 result = picture("out/0001.png").rgb;
    EXPECT_NEAR(result.at(50, 40, 0), 0.8f, 0.01f);
    EXPECT_NEAR(result.at(50, 40, 1), 0.8f, 0.01f);
    EXPECT_NEAR(result.at(90, 40, 0), 0.2f, 0.01f);
    EXPECT_NEAR(result.at(90, 40, 1), 0.8f, 0.01f);
    EXPECT_NEAR(result.at(50, 70, 0), 0.8f, 0.01f);
    EXPECT_NEAR(result.at(50, 70, 1), 0.2f, 0.01f);
    EXPECT_NEAR(result.at(90, 70, 0), 0.2f, 0.01f);
    EXPECT_NEAR(result.at(90, 70, 1), 0.2f, 0.01f);
}

TEST_F(CliTest, OffsetMovesTheTextureInPlatePixels) {
    make_shot(1);
    expect_success(run_replace({"--light", "none"}));
    expect_success(run_replace({"--light", "none", "--offset", "5,3", "-o", "moved/####.png"}));
    const ImageF3 plain = picture("out/0001.png").rgb, moved = picture("moved/0001.png").rgb;
    EXPECT_LT(largest_difference(plain, moved, interior(8), {5, 3}), 0.01f);
}

TEST_F(CliTest, HoldoutsKeepWhatPassesInFront) {
    make_shot(3);
    std::filesystem::create_directory(folder_ / "front");
    Matte front(Card::kPlate);
    const Recti bar{64, 20, 78, 100};
    for (int y = bar.y0; y < bar.y1; ++y)
        for (int x = bar.x0; x < bar.x1; ++x)
            front.at(x, y) = 255;
    Matte other(Card::kPlate);
    for (int x = 40; x < 50; ++x)
        other.at(x, 60) = 255;
    for (const char* frame : {"0001", "0002", "0003"}) {
        put_matte(std::string("front/") + frame + ".png", front);
        put_matte(std::string("front/other.") + frame + ".png", other);
    }
    const Words light{"--light", "none"};
    expect_success(run_replace(light));
    expect_success(run_replace({"--light", "none", "-o", "held/####.png", "--holdout",
                                "front/####.png", "--holdout", "front/other.####.png"}));
    const ImageF3 plate = picture("frames/0003.png").rgb, held = picture("held/0003.png").rgb,
                  open = picture("out/0003.png").rgb;
    EXPECT_EQ(largest_difference(held, plate, bar), 0.0f);
    EXPECT_EQ(largest_difference(held, plate, {40, 60, 50, 61}), 0.0f);
    // Beside the bar the texture is at the same place.
    EXPECT_LT(largest_difference(held, open, {84, 40, 104, 78}), 0.1f);
}

TEST_F(CliTest, InsideALightZoneTheTextureTakesAnotherShareOfTheLight) {
    make_shot(2);
    ImageF3 light(160, 120, 0.2f);  // sRGB codes; bright on the right
    for (int y = 0; y < light.height(); ++y)
        std::fill(light.pixel(70, y), light.pixel(159, y) + 3, 0.8f);
    put_picture("light.png", light);
    Matte zone(Card::kPlate);
    const Recti box{40, 40, 64, 60};
    for (int y = box.y0; y < box.y1; ++y)
        std::fill(zone.row(y) + box.x0, zone.row(y) + box.x1, 255);
    put_matte("zone.png", zone);
    expect_success(run_replace({"--light", "none", "-o", "unlit/####.png"}));
    expect_success(run_replace({"--light", "light.png", "-o", "lit/####.png"}));
    expect_success(run_replace(
        {"--light", "light.png", "-o", "zoned/####.png", "--zone", "light=0@zone.png"}));
    const ImageF3 unlit = picture("unlit/0002.png").rgb, lit = picture("lit/0002.png").rgb,
                  zoned = picture("zoned/0002.png").rgb;
    EXPECT_GT(largest_difference(lit, unlit, box), 0.1f);
    EXPECT_LE(largest_difference(zoned, unlit, {44, 44, 60, 56}), 1.01f / 255);
    EXPECT_EQ(largest_difference(zoned, lit, {80, 40, 100, 60}), 0.0f);

    expect_failure(run_replace({"--zone", "zone.png"}), 2, {"--zone", "light=0.3@12=a.png"});
    expect_failure(run_replace({"--zone", "light=3@zone.png"}), 2, {"--zone", "0 to 2"});
    expect_failure(run_replace({"--zone", "fog=1@zone.png"}), 2, {"--zone", "light"});
    expect_failure(run_replace({"--zone", "light=1@gone.png"}), 4, {"gone.png"});
}

TEST_F(CliTest, MotionZonesChangeNoByteFurtherThan24PxOutside) {
    make_shot(4);
    Matte zone(Card::kPlate);
    const Recti box{60, 50, 84, 70};
    for (int y = box.y0; y < box.y1; ++y)
        std::fill(zone.row(y) + box.x0, zone.row(y) + box.x1, 255);
    put_matte("zone.png", zone);
    expect_success(run_replace({"-o", "tracked/####.png"}));
    const ImageF3 tracked = picture("tracked/0004.png").rgb;
    for (const std::string kind : {"ignore", "stiffer", "calmer", "surroundings"}) {
        expect_success(run_replace({"-o", kind + "/####.png", "--zone", kind + "=1@zone.png"}));
        const ImageF3 zoned = picture(kind + "/0004.png").rgb;
        EXPECT_LT(largest_difference(zoned, tracked, box), 0.5f) << kind << ": a rigid card";
        for (const Recti far : {Recti{0, 0, 160, 26}, Recti{0, 94, 160, 120}, Recti{0, 0, 36, 120},
                                Recti{108, 0, 160, 120}})
            EXPECT_EQ(largest_difference(zoned, tracked, far), 0.0f) << kind;
        expect_success(run_replace({"-o", kind + "0/####.png", "--zone", kind + "=0@zone.png"}));
        EXPECT_EQ(largest_difference(picture(kind + "0/0004.png").rgb, tracked, {0, 0, 160, 120}),
                  0.0f)
            << kind;
    }
}

TEST_F(CliTest, MotionZonesFromFilesReachBackToTheReferenceFrame) {
    make_shot(4);
    put_matte("zone0004.png", Matte(Card::kPlate));
    expect_failure(run_replace({"--frames", "4", "--zone", "stiffer=1@zone####.png"}), 4,
                   {"The zone", "zone####.png"});
    // Light is of the rendered frames alone.
    expect_success(run_replace({"--frames", "4", "--zone", "light=0@zone####.png"}));
}

TEST_F(CliTest, SeveralReferenceFramesAnchorTheTexture) {
    make_shot(5);
    expect_success(run_replace({"--light", "none"}));
    expect_success(run_replace({"--light", "none", "-o", "two/####.png", "--reference-frame", "1",
                                "--reference-frame", "5"}));
    // The first one holds the placement.
    EXPECT_EQ(picture("out/0001.png").rgb, picture("two/0001.png").rgb);
    const Vec2i shift{2 * Card::kStepX, 2 * Card::kStepY};
    EXPECT_LT(largest_difference(picture("two/0001.png").rgb, picture("two/0003.png").rgb,
                                 {60, 45, 90, 70}, shift),
              0.35f);
}

TEST_F(CliTest, PaintedKeyframesArePropagated) {
    make_shot(5);
    Words words = replace();
    words.erase(words.begin() + 3, words.begin() + 5);
    words.insert(words.end(), {"--matte", "1=masks/0001.png", "--matte", "5=masks/0005.png"});
    expect_success(run(words));
    for (int step = 0; step < 5; ++step) {
        const std::string name = "000" + std::to_string(step + 1) + ".png";
        const ImageF3 plate = picture("frames/" + name).rgb, result = picture("out/" + name).rgb;
        const Matte truth = card_matte(step);
        int wrong = 0, replaced = 0;
        for (int y = 0; y < truth.height(); ++y)
            for (int x = 0; x < truth.width(); ++x) {
                const bool changed =
                    std::memcmp(plate.pixel(x, y), result.pixel(x, y), 3 * sizeof(float)) != 0;
                wrong += changed && truth.at(x, y) == 0;
                replaced += changed && truth.at(x, y) > 0;
            }
        // On a keyframe nothing outside the paint changes; between them an edge may wander.
        EXPECT_LE(wrong, step == 0 || step == 4 ? 0 : 400) << name;
        EXPECT_GT(replaced, 4300) << name;
    }
}

TEST_F(CliTest, IdMattesChannelsAndInversion) {
    make_shot(1);
    const Matte card = card_matte(0);
    Matte ids(Card::kPlate, 7), inverse(Card::kPlate);
    ImageF3 colours(Card::kPlate);
    for (int y = 0; y < card.height(); ++y)
        for (int x = 0; x < card.width(); ++x) {
            if (card.at(x, y)) ids.at(x, y) = 3;
            inverse.at(x, y) = static_cast<std::uint8_t>(255 - card.at(x, y));
            colours.at(x, y, 1) = card.at(x, y) ? 1.0f : 0.0f;
            colours.at(x, y, 2) = 1;
        }
    for (const char* folder : {"ids", "inverse", "colours"})
        std::filesystem::create_directory(folder_ / folder);
    put_matte("ids/0001.png", ids);
    put_matte("inverse/0001.png", inverse);
    put_picture("colours/0001.png", colours);
    expect_success(run_replace());
    const auto with_matte = [&](const std::string& folder, const Words& more) {
        Words words = replace({"-o", folder + "-out/####.png"});
        words[4] = folder + "/####.png";
        words.insert(words.end(), more.begin(), more.end());
        expect_success(run(words));
        return picture(folder + "-out/0001.png").rgb;
    };
    const ImageF3 plain = picture("out/0001.png").rgb;
    EXPECT_EQ(with_matte("ids", {"--matte-value", "3"}), plain);
    EXPECT_EQ(with_matte("inverse", {"--matte-invert"}), plain);
    EXPECT_EQ(with_matte("colours", {"--matte-channel", "G"}), plain);
}

}  // namespace
}  // namespace weft::test
