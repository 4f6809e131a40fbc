#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "engine/media/image_files.h"
#include "tests/media/media_fixture.h"
#include "tests/support/places.h"

namespace weft {
namespace {

using ::testing::HasSubstr;

class FlowFile : public MediaTest {
  protected:
    void put_flo(const std::string& name, int width, int height, const std::vector<float>& d) {
        std::vector<char> bytes(12 + d.size() * 4);
        const float magic = 202021.25f;
        std::memcpy(bytes.data(), &magic, 4);
        std::memcpy(bytes.data() + 4, &width, 4);
        std::memcpy(bytes.data() + 8, &height, 4);
        std::memcpy(bytes.data() + 12, d.data(), d.size() * 4);
        put_bytes(in(name), bytes, bytes.size());
    }
};

TEST_F(FlowFile, FloIsReadAndUnknownIsInvalid) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    put_flo("a.flo", 3, 2, {1.5f, -2, 2e9f, 0, 0, nan, 3, 4, -2e9f, 1, 900, 0.25f});
    const FlowField flow = read_flow(in("a.flo"), {3, 2}).value();
    EXPECT_EQ(flow.d.at(0, 0, 0), 1.5f);
    EXPECT_EQ(flow.d.at(0, 0, 1), -2.0f);
    EXPECT_EQ(flow.d.at(2, 1, 0), 900.0f);
    const std::vector<int> valid(flow.valid.data(), flow.valid.data() + 6);
    EXPECT_THAT(valid, ::testing::ElementsAre(255, 0, 0, 255, 0, 255));
    EXPECT_EQ(flow.d.at(1, 0, 0), 0.0f);
    EXPECT_EQ(flow.d.at(2, 0, 1), 0.0f);
}

TEST_F(FlowFile, KittiComesBackToASixtyFourth) {
    FlowField flow(Size{40, 30});
    Rng rng(5);
    for (int i = 0; i < 40 * 30; ++i) {
        for (int c = 0; c < 2; ++c) {
            flow.d.data()[2 * i + c] =
                static_cast<float>(static_cast<int>(rng.below(65536)) - 32768) / 64.0f;
        }
        flow.valid.data()[i] = rng.below(4) == 0 ? 0 : 255;
        if (flow.valid.data()[i] == 0) flow.d.data()[2 * i] = flow.d.data()[2 * i + 1] = 0;
    }
    ASSERT_TRUE(write_flow_kitti(in("a.png"), flow));
    const FlowField back = read_flow(in("a.png"), {40, 30}).value();
    EXPECT_TRUE(back.d == flow.d);
    EXPECT_TRUE(back.valid == flow.valid);
}

TEST_F(FlowFile, MotionBeyondTheFormatIsUnknown) {
    FlowField flow(Size{3, 1});
    flow.d.at(0, 0, 0) = 600.0f;
    flow.d.at(1, 0, 1) = std::numeric_limits<float>::quiet_NaN();
    flow.d.at(2, 0, 0) = -512.0f;
    ASSERT_TRUE(write_flow_kitti(in("a.png"), flow));
    const FlowField back = read_flow(in("a.png"), {3, 1}).value();
    EXPECT_EQ(back.valid.at(0, 0), 0);
    EXPECT_EQ(back.valid.at(1, 0), 0);
    EXPECT_EQ(back.valid.at(2, 0), 255);
    EXPECT_EQ(back.d.at(2, 0, 0), -512.0f);
}

TEST_F(FlowFile, BadFilesAreNamed) {
    put_flo("short.flo", 3, 2, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
    put_flo("other.flo", 2, 3, std::vector<float>(12, 0.0f));
    put_bytes(in("text.flo"), {'h', 'i'}, 2);
    put_frame(in("eight.png"), picture({3, 2}, 0));
    for (const char* name : {"short.flo", "other.flo", "text.flo", "eight.png"}) {
        const auto flow = read_flow(in(name), {3, 2});
        ASSERT_FALSE(flow) << name;
        EXPECT_EQ(flow.error().code, ErrorCode::kUnreadable);
        EXPECT_THAT(flow.error().sentence(), HasSubstr(name));
    }
    EXPECT_THAT(read_flow(in("other.flo"), {3, 2}).error().sentence(), HasSubstr("2x3"));
    EXPECT_EQ(read_flow(in("none.flo"), {3, 2}).error().code, ErrorCode::kMissingFrames);
}

TEST(FlowData, RendererAndSintel) {
    const std::string data = test::shared_data_folder() + "/sequences/";
    if (!std::filesystem::exists(data)) GTEST_SKIP() << "no evaluation data";
    const FlowField fox =
        read_flow(data + "blender_fox_gt/flow_fwd_kitti16/00000.png", {854, 480}).value();
    std::int64_t valid = 0;
    float largest = 0;
    for (int i = 0; i < 854 * 480; ++i) {
        valid += fox.valid.data()[i] == 255;
        largest = std::max(largest, std::hypot(fox.d.data()[2 * i], fox.d.data()[2 * i + 1]));
    }
    EXPECT_GT(valid, 854 * 480 * 9 / 10);
    EXPECT_GT(largest, 1.0f);
    EXPECT_LT(largest, 200.0f);
    const auto sintel = read_flow(data + "sintel_gt_clean_easy/gt/frame_0002.flo", {1024, 436});
    EXPECT_TRUE(sintel) << sintel.error().text();
}

}  // namespace
}  // namespace weft
