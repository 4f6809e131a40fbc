// What goes to other programs and projects: looks, schemas, Cryptomatte files, collected projects.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "app/exchange/collect.h"
#include "app/exchange/crypto_files.h"
#include "app/exchange/input_files.h"
#include "app/exchange/kept_textures.h"
#include "app/exchange/look.h"
#include "app/exchange/schemas.h"
#include "tests/support/places.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

class Exchange : public ::testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "weft_exchange_XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        folder_ = name;
    }
    void TearDown() override { fs::remove_all(folder_); }
    [[nodiscard]] std::string in(const std::string& name) const {
        return (folder_ / name).string();
    }
    [[nodiscard]] Project shot(const std::string& region_name) const {
        Project project;
        project.plate.path = in("plate.png");
        Region region;
        region.id = project.next_region_id++;
        region.name = region_name;
        MatteSource matte;
        matte.files = in("matte.png");
        region.matte = matte;
        region.texture.plane = in("tile.png");
        project.regions.emplace_back(region);
        return project;
    }
    fs::path folder_;
};

TEST_F(Exchange, ALookHasTheTextureAndNotTheMatte) {
    Project from = shot("wall");
    from.regions[0] = from.regions[0].with([](Region& r) { r.placement.scale = 2.5; });
    ASSERT_TRUE(save_look(in("a.weftlook"), from, "wall", WriteRule::own()));
    Project to = shot("floor");
    to.regions[0] = to.regions[0].with([&](Region& r) {
        r.texture.plane = in("other.png");
        MatteSource matte;
        matte.files = in("floor.png");
        r.matte = matte;
    });
    const auto applied = apply_look(in("a.weftlook"), to, folder_.string(), "floor");
    ASSERT_TRUE(applied) << applied.error().text();
    const Region& region = *applied->regions[0];
    EXPECT_EQ(region.placement.scale, 2.5);
    EXPECT_THAT(region.texture.plane, testing::EndsWith("tile.png"));
    EXPECT_EQ(region.matte->files, in("floor.png"));
    EXPECT_EQ(region.name, "floor");
    EXPECT_EQ(save_look(in("b.weftlook"), from, "nobody", WriteRule::own()).error().code,
              ErrorCode::kUsage);
    EXPECT_EQ(apply_look(in("none"), to, folder_.string(), "").error().code,
              ErrorCode::kUnreadable);
}

TEST_F(Exchange, CryptomatteObjectsComeFromThePlateByDefault) {
    Region region;
    MatteSource matte;
    matte.select.crypto = {"hero"};
    region.matte = matte;
    ASSERT_TRUE(name_crypto_files(region, in("plate.####.exr")));
    EXPECT_EQ(region.matte->files, in("plate.####.exr"));
    ASSERT_TRUE(name_crypto_files(region, in("other.####.exr")));
    EXPECT_EQ(region.matte->files, in("plate.####.exr")) << "what is named stays";
    Region folder;
    folder.matte = matte;
    EXPECT_EQ(name_crypto_files(folder, folder_.string()).error().code, ErrorCode::kUsage);
}

TEST(Schemas, AreThoseOfTheDocumentation) {
    for (const char* name : {"project", "actions", "report", "motion"}) {
        std::ifstream file(test::source_folder() + "/docs/schemas/" + name + ".schema.json");
        const std::string documented(std::istreambuf_iterator<char>(file), {});
        ASSERT_FALSE(documented.empty()) << name;
        const auto schema = json_schema(name);
        ASSERT_TRUE(schema);
        EXPECT_EQ(nlohmann::json::parse(*schema), nlohmann::json::parse(documented)) << name;
    }
    EXPECT_EQ(json_schema("nothing").error().code, ErrorCode::kUsage);
}

TEST(KeptTextures, LieBesideTheProject) {
    EXPECT_EQ(kept_textures_name("/a/shot.weft"), "shot_textures");
    EXPECT_EQ(*keep_library_textures(Project{}, "/nowhere", "t", ""), Project{})
        << "without a library's texture nothing is opened or written";
}

TEST_F(Exchange, ACollectedProjectNeedsNothingFromOutside) {
    for (const char* name : {"plate.png", "matte.png", "tile.png"})
        std::ofstream(in(name)) << name;
    const auto collected = collect_project(shot("wall"), "shot", in("collected"), "", {}, {}, {});
    ASSERT_TRUE(collected) << collected.error().text();
    EXPECT_EQ(collected->files, 3);
    EXPECT_TRUE(fs::is_regular_file(collected->project));
    std::ifstream file(collected->project);
    const std::string text(std::istreambuf_iterator<char>(file), {});
    EXPECT_THAT(text, testing::Not(testing::HasSubstr(in("plate"))));
    EXPECT_EQ(collect_project(shot("wall"), "shot", in("collected"), "", {}, {}, {}).error().code,
              ErrorCode::kUsage);
    Project gone = shot("wall");
    fs::remove(in("tile.png"));
    EXPECT_FALSE(collect_project(gone, "shot", in("again"), "", {}, {}, {}));
    EXPECT_FALSE(fs::exists(in("again"))) << "what was copied before the error is removed";
}

TEST_F(Exchange, ACancelledCollectLeavesNothingAndDoesNotStandInTheWay) {
    for (const char* name : {"plate.png", "matte.png", "tile.png"})
        std::ofstream(in(name)) << name;
    fs::create_directory(in("archive"));
    std::ofstream(in("archive/mine.txt")) << "mine";
    const CancelToken cancel;
    std::vector<std::int64_t> totals;
    const auto stopped = collect_project(shot("wall"), "shot", in("archive"), "", {}, cancel,
                                         [&](const ProgressEvent& event) {
                                             totals.push_back(event.total);
                                             if (event.done == 2) cancel.cancel();
                                         });
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().code, ErrorCode::kTerminated);
    EXPECT_THAT(totals, testing::ElementsAre(3, 3));
    EXPECT_TRUE(fs::exists(in("archive/mine.txt")));
    EXPECT_FALSE(fs::exists(in("archive/files")));
    EXPECT_TRUE(collect_project(shot("wall"), "shot", in("archive"), "", {}, {}, {}));
}

TEST_F(Exchange, InputsAreProtectedUnderAnyName) {
    for (const char* name : {"plate.png", "matte.png", "tile.png"})
        std::ofstream(in(name)) << name;
    fs::create_symlink(folder_ / "plate.png", folder_ / "alias.png");
    const auto fence = make_fence(shot("wall"), {folder_.string(), {}});
    ASSERT_TRUE(fence) << fence.error().text();
    const auto refused = [&](const std::string& path) {
        const Status status = (*fence)->check(path, real_path(path));
        return !status && status.error().code == ErrorCode::kUsage;
    };
    EXPECT_TRUE(refused(in("matte.png")));
    EXPECT_TRUE(refused(in("none/../tile.png")));
    EXPECT_TRUE(refused("/elsewhere/a.png"));
    EXPECT_FALSE(refused(in("out.png")));
    EXPECT_FALSE(check_apart({{"The movie", in("a.mp4")}, {"The report", in("a.mp4")}}));
    EXPECT_TRUE(check_apart({{"The movie", in("a.mp4")}, {"The report", in("a.json")}}));
}

}  // namespace
}  // namespace weft
