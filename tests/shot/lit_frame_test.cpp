#include "app/shot/lit_frame.h"

#include <gmock/gmock.h>

#include "app/shot/region_reference.h"
#include "engine/color/color_space.h"
#include "engine/media/frame_writer.h"
#include "tests/render/shot_fixture.h"

namespace weft::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Optional;

class LitFrame : public ShotTest {
  protected:
    // Frame k + 1 in linear light times gains[k]; a negative gain is a white frame.
    void light(const std::vector<float>& gains) {
        for (std::size_t k = 0; k < gains.size(); ++k) {
            ImageF3 plate = card_plate(static_cast<int>(k));
            for (std::size_t i = 0; i < plate.size_bytes() / sizeof(float); ++i) {
                float& v = plate.data()[i];
                v = gains[k] < 0 ? 1.0f : linear_to_srgb(gains[k] * srgb_to_linear(v));
            }
            WriteOptions options;
            options.rule.existing = Existing::kReplace;
            const auto written =
                write_image(in("frames/000" + std::to_string(k + 1) + ".png"), plate, {}, options);
            ASSERT_TRUE(written) << written.error().text();
        }
    }
    [[nodiscard]] Project project() const { return spec("out").project; }
    [[nodiscard]] int reference() const {
        const auto shot = open_shot(project());
        EXPECT_TRUE(shot) << (shot ? "" : shot.error().text());
        return shot ? (*shot)->plan.regions[0].reference_frames.front() : 0;
    }
};

TEST_F(LitFrame, AFadeInHasItsReferenceInTheLight) {
    light({0, 0.02f, 0.3f, 0.6f, 1, 1});
    const auto shot = open_shot(project());
    ASSERT_TRUE(shot) << shot.error().text();
    EXPECT_EQ((*shot)->plan.regions[0].reference_frames.front(), 5);
    EXPECT_FALSE((*shot)->plan.regions[0].light_frame);
    ASSERT_FALSE((*shot)->notes.empty());
    EXPECT_THAT((*shot)->notes[0], HasSubstr("is dark or burnt out on frame 1"));
}

TEST_F(LitFrame, ABurntOutFirstFrameIsNoReference) {
    light({-1, 1, 1, 1, 1, 1});
    EXPECT_EQ(reference(), 2);
}

TEST_F(LitFrame, AnOrdinaryShotAndANightKeepTheirFirstFrame) {
    EXPECT_EQ(reference(), 1);
    light({0.02f, 0.02f, 0.03f, 0.02f, 0.02f, 0.02f});
    EXPECT_EQ(reference(), 1);
    light({0, 0, 0, 0, 0, 0});
    EXPECT_EQ(reference(), 1);
}

TEST_F(LitFrame, AGivenReferenceStaysAndItsLightIsTakenElsewhere) {
    light({0, 1, 1, 1, 1, 1});
    Project given = project();
    given.regions[0] = given.regions[0].with([](Region& region) { region.reference_frames = {1}; });
    const auto shot = open_shot(given);
    ASSERT_TRUE(shot) << shot.error().text();
    EXPECT_EQ((*shot)->plan.regions[0].reference_frames.front(), 1);
    EXPECT_THAT((*shot)->plan.regions[0].light_frame, Optional(2));
    EXPECT_EQ((*shot)->plan.regions[0].light_reference(), 2);
}

TEST_F(LitFrame, RemembersWhatItHasSeen) {
    light({0, 1, 1, 1, 1, 1});
    const auto shot = open_shot(project());
    ASSERT_TRUE(shot) << shot.error().text();
    const CachedReader& plate = *(*shot)->plate;
    VisibilityCache memory;
    EXPECT_THAT(lit_frame(plate, 1, plate.frames(), &memory), Optional(2));
    EXPECT_EQ(memory.size(), 6u);
    EXPECT_FALSE(lit_frame(plate, 2, plate.frames(), &memory));
    EXPECT_EQ(*light_of_frame(plate, 1, &memory), 0.0);
}

}  // namespace
}  // namespace weft::test
