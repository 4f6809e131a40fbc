// Requests that the drawer repeats in every frame are answered once.
#include "app/textures/texture_shelf.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>

#include "engine/media/frame_writer.h"
#include "texture_db/library/library.h"
#include "texture_db/starter/starter.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

ImageU8x3 sample(int number) {
    ImageU8x3 out(96, 96);
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 96; ++x)
            for (int c = 0; c < 3; ++c)
                out.pixel(x, y)[c] = static_cast<std::uint8_t>(
                    90 + 60 * ((number >> c) & 1) + 30 * std::sin(0.1 * (number + 2) * x) +
                    (x * 5 + y * 3 + number) % 11);
    return out;
}

// One library for all tests: filling it takes seconds.
class TextureShelfTest : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = fs::temp_directory_path() / ("weft_shelf_" + std::to_string(getpid()));
        fs::create_directories(folder_);
        const std::string path = (folder_ / "library.wtl").string();
        {
            auto library = TextureLibrary::open(path);
            ASSERT_TRUE(library) << library.error().text();
            std::vector<NewTexture> all;
            for (int number = 0; number < 24; ++number) {
                NewTexture one;
                one.pixels = sample(number);
                one.name = (number % 2 ? "stone " : "wood ") + std::to_string(number);
                one.material = number % 2 ? "stone" : "wood";
                one.author = "Ada";
                one.licence = "CC0-1.0";
                one.source = one.name;
                all.push_back(std::move(one));
            }
            ASSERT_EQ((*library)->add(all), 24);
            // As if the starter textures were all there: making them takes minutes, and each is an
            // arrival.
            ASSERT_TRUE((*library)->set_note("starter.done",
                                             "2:" + std::to_string(starter_catalogue().size())));
        }
        shelf_ = std::make_unique<TextureShelf>();
        shelf_->open_library(path);
        // Opening the library is three changes: its list before and after the starter textures, and
        // that this is over. On a busy machine the last two come late.
        ASSERT_TRUE(wait([&] { return shelf_->changes() >= 3 && !shelf_->cards()->empty(); }));
        ASSERT_TRUE(settle());
    }
    static void TearDownTestSuite() {
        shelf_.reset();
        fs::remove_all(folder_);
    }

    // Without a pause, so that the request is repeated while it is pending.
    static bool wait(const std::function<bool()>& done) {
        const auto end = Clock::now() + std::chrono::minutes(2);
        while (!done())
            if (Clock::now() > end) return false;
        return true;
    }
    // Nothing changes any more.
    static bool settle() {
        auto seen = shelf_->changes();
        auto since = Clock::now();
        return wait([&] {
            if (shelf_->changes() != seen || !shelf_->activity().empty()) {
                seen = shelf_->changes();
                since = Clock::now();
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            return Clock::now() - since > std::chrono::milliseconds(300);
        });
    }
    // Number of changes while `asked` is requested repeatedly until it is answered.
    static std::uint64_t arrivals_of(const std::function<bool()>& asked) {
        const std::uint64_t before = shelf_->changes();
        EXPECT_TRUE(wait(asked));
        EXPECT_TRUE(settle());
        return shelf_->changes() - before;
    }
    static SurfaceQuery surface() {
        ImageU8x3 plate(192, 144, 110);
        for (int y = 40; y < 120; ++y)
            for (int x = 40; x < 120; ++x)
                plate.pixel(x, y)[0] = static_cast<std::uint8_t>(60 + (x * 7 + y * 3) % 90);
        Matte matte(192, 144);
        for (int y = 40; y < 120; ++y)
            std::fill_n(matte.row(y) + 40, 80, std::uint8_t{255});
        return {"wall", make_picture(std::move(plate)),
                std::make_shared<const Matte>(std::move(matte)), ""};
    }

    static inline fs::path folder_;
    static inline std::unique_ptr<TextureShelf> shelf_;
};

TEST_F(TextureShelfTest, RepeatedRequestsRankARegionOnce) {
    const SurfaceQuery wall = surface();
    EXPECT_EQ(arrivals_of([&] {
                  shelf_->suggest_for("wall", wall);
                  return shelf_->suggested("wall");
              }),
              1u);
    EXPECT_FALSE(shelf_->suggestions("wall").empty());
    EXPECT_TRUE(shelf_->suggestions("another").empty());
}

TEST_F(TextureShelfTest, RepeatedRequestsRankASetOnce) {
    const SurfaceQuery wall = surface();
    Matte right(192, 144);
    for (int y = 40; y < 120; ++y)
        std::fill_n(right.row(y) + 130, 50, std::uint8_t{255});
    const std::vector<TogetherRegion> regions{
        {1, "wall", wall.matte, {}},
        {2, "floor", std::make_shared<const Matte>(std::move(right)), {}}};
    EXPECT_EQ(arrivals_of([&] {
                  shelf_->suggest_together("both", wall.plate, regions, "");
                  return shelf_->together("both") != nullptr;
              }),
              1u);
    EXPECT_FALSE(shelf_->together("both")->empty());
}

TEST_F(TextureShelfTest, RepeatedRequestsSearchOnce) {
    TextureQuery stone;
    stone.words = "stone";
    EXPECT_EQ(arrivals_of([&] { return shelf_->search(stone) != nullptr; }), 1u);
    EXPECT_GE(shelf_->search(stone)->paths.size(), 12u);
}

TEST_F(TextureShelfTest, RepeatedRequestsFindSimilarTexturesOnce) {
    const PicturePtr plate = surface().plate;
    EXPECT_EQ(arrivals_of([&] {
                  shelf_->find_similar("here", plate, {40, 40, 120, 120});
                  return shelf_->similar("here") != nullptr;
              }),
              1u);
}

TEST_F(TextureShelfTest, RepeatedRequestsMakeAThumbnailOnce) {
    const std::string path = (folder_ / "large.png").string();
    ASSERT_TRUE(write_image(path, ImageF3(1600, 1200, 0.5f), {}, {.depth = PixelDepth::kU8}));
    EXPECT_EQ(arrivals_of([&] { return shelf_->thumbnail(path, 128) != nullptr; }), 1u);
}

TEST_F(TextureShelfTest, AFileThatIsWrittenAnewHasANewThumbnail) {
    const std::string path = (folder_ / "painted.png").string();
    const auto red = [&](float grey) {
        fs::remove(path);
        EXPECT_TRUE(write_image(path, ImageF3(64, 64, grey), {}, {.depth = PixelDepth::kU8}));
        shelf_->forget_thumbnails(path);
        PicturePtr picture;
        arrivals_of([&] { return (picture = shelf_->thumbnail(path, 32)) != nullptr; });
        return picture->at(16, 16).x;
    };
    EXPECT_NEAR(red(0.8f), 0.8f, 0.01f);
    EXPECT_NEAR(red(0.2f), 0.2f, 0.01f);
}

TEST_F(TextureShelfTest, RepeatedRequestsLookUpDetailsOnce) {
    const TextureCard card = shelf_->cards()->front();
    EXPECT_EQ(arrivals_of([&] { return !shelf_->details(card).author.empty(); }), 1u);
}

// Another machine may have none of the project's textures in its library.
TEST_F(TextureShelfTest, AKeptTextureHasTheNameOfItsCredit) {
    const std::string path = (folder_ / ("db_" + std::string(32, 'a') + ".png")).string();
    std::ofstream(path) << "x";
    EXPECT_TRUE(shelf_->name_of_texture(path).starts_with("db_"));
    ASSERT_TRUE(settle());
    EXPECT_TRUE(shelf_->name_of_texture(path).starts_with("db_")) << "it has no credit";
    const std::string named = (folder_ / ("db_" + std::string(32, 'b') + ".png")).string();
    std::ofstream(named) << "x";
    std::ofstream(named + ".credit.json") << R"({"name": "basket_brick-24", "material": "brick"})";
    EXPECT_TRUE(wait([&] { return shelf_->name_of_texture(named) == "Basket brick 24"; }));
    TextureShelf without_library;
    EXPECT_TRUE(wait([&] { return without_library.name_of_texture(named) == "Basket brick 24"; }));
}

}  // namespace
}  // namespace weft::test
