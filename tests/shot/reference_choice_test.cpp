// The default reference frame on synthetic mattes, the demo and clips.
#include "app/shot/reference_choice.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "engine/media/frame_writer.h"
#include "tests/support/places.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr Size kSize{64, 48};

// A plate of which only frame numbers and size matter.
class Numbers final : public FrameReader {
  public:
    explicit Numbers(int count, Size size = kSize, int first = 1) : size_(size) {
        for (int k = 0; k < count; ++k)
            frames_.push_back(first + k);
    }
    [[nodiscard]] const std::vector<int>& frames() const override { return frames_; }
    [[nodiscard]] Size size() const override { return size_; }
    [[nodiscard]] double fps() const override { return 0; }
    [[nodiscard]] PixelDepth depth() const override { return PixelDepth::kU8; }
    [[nodiscard]] bool display_encoded() const override { return true; }
    [[nodiscard]] std::string path_of(int) const override { return {}; }
    [[nodiscard]] Expected<PlateFrame> read(int) const override {
        return fail(ErrorCode::kUnreadable, "not to be read");
    }
    [[nodiscard]] Expected<Hash128> stamp(int) const override { return Hash128{}; }

  private:
    std::vector<int> frames_;
    Size size_;
};

Matte box(int x, int width, int height = 20) {
    Matte matte(kSize);
    for (int y = 10; y < 10 + height; ++y)
        std::fill_n(matte.row(y) + x, width, std::uint8_t{255});
    return matte;
}

class ReferenceChoiceTest : public ::testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "weft_reference_XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        folder_ = name;
        fs::create_directory(folder_ / "holdouts");
    }
    void TearDown() override { fs::remove_all(folder_); }

    [[nodiscard]] std::string file(int frame, const std::string& folder = {}) const {
        char name[32];
        std::snprintf(name, sizeof name, "%04d.png", frame);
        return (folder_ / folder / name).string();
    }
    void put(int frame, const Matte& matte, const std::string& folder = {}) const {
        ASSERT_TRUE(write_matte(file(frame, folder), matte, WriteRule::own()));
    }
    [[nodiscard]] Region region() const {
        Region out;
        MatteSource matte;
        matte.files = (folder_ / "####.png").string();
        out.matte = matte;
        return out;
    }
    [[nodiscard]] static int chosen(const Region& region, const FrameReader& plate) {
        const auto choice = choose_reference(region, plate, nullptr);
        EXPECT_TRUE(choice) << choice.error().text();
        return choice ? choice->frame : -1;
    }

    fs::path folder_;
};

TEST_F(ReferenceChoiceTest, TheBoxOfASurfaceIsItsMattesOrTheWholePicture) {
    put(1, box(7, 30));
    put(2, Matte(kSize));
    const Numbers plate(3);
    EXPECT_EQ(surface_box(region(), plate, 1, {}), (Recti{7, 10, 37, 30}));
    EXPECT_EQ(surface_box(region(), plate, 2, {}), rect_of(kSize)) << "an empty matte";
    EXPECT_EQ(surface_box(region(), plate, 3, {}), rect_of(kSize)) << "no file";
}

TEST_F(ReferenceChoiceTest, EmptyFramesAreLeftOut) {
    for (int frame = 1; frame <= 6; ++frame)
        put(frame, frame <= 3 ? Matte(kSize) : box(20, 20));
    EXPECT_EQ(chosen(region(), Numbers(6)), 4);
}

TEST_F(ReferenceChoiceTest, ASurfaceThatEntersIsTakenWhenItIsInside) {
    for (int frame = 1; frame <= 8; ++frame)
        put(frame, box(0, std::min(3 * frame, 20)));
    EXPECT_EQ(chosen(region(), Numbers(8)), 7);
}

TEST_F(ReferenceChoiceTest, TheFirstFrameStaysWhereItIsGood) {
    for (int frame = 1; frame <= 8; ++frame)
        put(frame, box(20, 12 + frame));
    EXPECT_EQ(chosen(region(), Numbers(8)), 1);
}

TEST_F(ReferenceChoiceTest, HoldoutsHideTheSurface) {
    Region held = region();
    MatteSource holdout;
    holdout.files = (folder_ / "holdouts/####.png").string();
    held.holdouts = std::vector<MatteSource>{holdout};
    for (int frame = 1; frame <= 4; ++frame) {
        put(frame, box(20, 20));
        put(frame, frame < 3 ? box(18, 19) : Matte(kSize), "holdouts");
    }
    EXPECT_EQ(chosen(held, Numbers(4)), 3);
    EXPECT_EQ(chosen(region(), Numbers(4)), 1);
}

TEST_F(ReferenceChoiceTest, OnePaintedFrameIsTheReferenceAndOfSeveralTheFirstGoodOne) {
    put(5, Matte(kSize));
    put(9, box(20, 20));
    Region painted;
    MatteSource matte;
    matte.keyframes[9] = {file(9), {}};
    painted.matte = matte;
    EXPECT_EQ(chosen(painted, Numbers(12)), 9);
    matte.keyframes[5] = {file(5), {}};
    painted.matte = matte;
    EXPECT_EQ(chosen(painted, Numbers(12)), 9);
    put(5, box(20, 14));
    EXPECT_EQ(chosen(painted, Numbers(12)), 5);
}

TEST_F(ReferenceChoiceTest, EmptyEverywhereKeepsTheFirstFrameAndIsReported) {
    for (int frame = 1; frame <= 300; ++frame)
        put(frame, Matte(kSize));
    const auto choice = choose_reference(region(), Numbers(300), nullptr);
    ASSERT_TRUE(choice);
    EXPECT_EQ(choice->frame, 1);
    EXPECT_FALSE(choice->shown);
    EXPECT_TRUE(shows_nothing(region(), Numbers(300), 7, nullptr));
    put(151, box(20, 20));  // between the first looks
    EXPECT_EQ(chosen(region(), Numbers(300)), 151);
}

TEST_F(ReferenceChoiceTest, AFileThatCannotBeReadIsNoReference) {
    for (int frame = 1; frame <= 3; ++frame)
        put(frame, box(20, 20));
    std::ofstream(file(1), std::ios::trunc) << "no picture";
    EXPECT_EQ(chosen(region(), Numbers(3)), 2);
    EXPECT_FALSE(shows_nothing(region(), Numbers(3), 1, nullptr));
}

TEST_F(ReferenceChoiceTest, ExaminedMattesAreNotReadAgain) {
    for (int frame = 1; frame <= 8; ++frame)
        put(frame, frame < 4 ? Matte(kSize) : box(20, 20));
    // Painted on each frame, so that no folder is listed.
    MatteSource keys;
    for (int frame = 1; frame <= 8; ++frame)
        keys.keyframes[frame] = {file(frame)};
    Region painted;
    painted.matte = keys;
    VisibilityCache memory;
    ASSERT_EQ(choose_reference(painted, Numbers(8), &memory)->frame, 4);
    // While no file can be opened, a matte that was read again would show nothing.
    rlimit usual{};
    ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &usual), 0);
    const rlimit none{0, usual.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &none), 0);
    const auto remembered = choose_reference(painted, Numbers(8), &memory);
    const auto read = choose_reference(painted, Numbers(8), nullptr);
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &usual), 0);
    EXPECT_EQ(remembered->frame, 4);
    EXPECT_FALSE(read->shown);
    // Other bytes of the same size and time are another file.
    const auto time = fs::last_write_time(file(4));
    const auto bytes = fs::file_size(file(4));
    std::ofstream(file(4), std::ios::trunc) << std::string(bytes, 'x');
    fs::last_write_time(file(4), time);
    EXPECT_EQ(choose_reference(painted, Numbers(8), &memory)->frame, 5);
}

TEST_F(ReferenceChoiceTest, ALongShotIsJudgedByAFewFrames) {
    put(1, box(20, 20));
    for (int frame = 2; frame <= 1000; ++frame)
        fs::create_hard_link(file(1), file(frame));
    VisibilityCache memory;
    EXPECT_EQ(choose_reference(region(), Numbers(1000), &memory)->frame, 1);
    EXPECT_EQ(memory.size(), 9u);
}

TEST_F(ReferenceChoiceTest, ALongShotOfEmptyMattesIsSampledInSteps) {
    put(1, Matte(kSize));
    for (int frame = 2; frame <= 1000; ++frame)
        fs::create_hard_link(file(1), file(frame));
    VisibilityCache memory;
    EXPECT_FALSE(choose_reference(region(), Numbers(1000), &memory)->shown);
    EXPECT_GT(memory.size(), 250u);
    EXPECT_LT(memory.size(), 430u);  // 9 + 33 + 129 + 257, less those looked at twice
}

// The first frames of the demo's regions and of clips that artists have masked are good.
TEST(ReferenceChoiceOnShots, TheDemoKeepsItsFirstFrame) {
    for (const char* name : {"ball", "cape", "cloth", "door", "ground", "wall"}) {
        Region region;
        MatteSource matte;
        matte.files = (test::source_folder() + "/assets/demo/mattes/") + name + "/####.png";
        region.matte = matte;
        const Numbers plate(48, {}, 1001);
        const auto choice = choose_reference(region, plate, nullptr);
        ASSERT_TRUE(choice) << choice.error().text();
        EXPECT_TRUE(choice->shown) << name;
        EXPECT_EQ(choice->frame, 1001) << name;
    }
}

TEST(ReferenceChoiceOnShots, ClipsKeepTheirFirstFrame) {
    const fs::path clips = fs::path(test::shared_data_folder()) / "sequences";
    if (!fs::exists(clips)) GTEST_SKIP() << "no clips";
    struct Clip {
        const char* mattes;
        int frames;
        std::optional<int> id;
    };
    std::vector<Clip> all{{"davis_blackswan/masks", 50, {}}, {"davis_dance-twirl/masks", 60, {}}};
    for (int id = 1; id <= 5; ++id)
        all.push_back({"blender_fox_gt/masks_ids", 27, id});
    for (const Clip& clip : all) {
        Region region;
        MatteSource matte;
        matte.files = (clips / clip.mattes / "#####.png").string();
        matte.select.value = clip.id;
        region.matte = matte;
        const auto choice = choose_reference(region, Numbers(clip.frames, {}, 0), nullptr);
        ASSERT_TRUE(choice) << choice.error().text();
        EXPECT_TRUE(choice->shown) << clip.mattes;
        EXPECT_EQ(choice->frame, 0) << clip.mattes << " " << clip.id.value_or(-1);
    }
}

TEST(ReferenceChoiceOnShots, MachineMadeKeyframesKeepTheFirst) {
    const fs::path masks =
        fs::path(test::shared_data_folder()) / "sequences/bbb_bird/masks_machine";
    if (!fs::exists(masks)) GTEST_SKIP() << "no clips";
    Region region;
    MatteSource matte;
    for (const auto& entry : fs::directory_iterator(masks))
        matte.keyframes[std::stoi(entry.path().stem().string())] = {entry.path().string(), {}};
    region.matte = matte;
    const auto choice = choose_reference(region, Numbers(48, {}, 0), nullptr);
    ASSERT_TRUE(choice) << choice.error().text();
    EXPECT_EQ(choice->frame, matte.keyframes.begin()->first);
}

}  // namespace
}  // namespace weft
