#include "bench/retrieval/evaluate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/texture_db/scratch.h"
#include "texture_db/describe/sample_codec.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// Grey stones and green grasses out of a package, in pictures "stone_wall_0" … "grass_7".
NewTexture from_package(int i, bool stone) {
    const std::string name = (stone ? "stone_wall_" : "grass_") + std::to_string(i / 2 % 8);
    NewTexture t =
        stone ? new_texture(static_cast<std::uint64_t>(i), "stone", name, 110, 110, 112)
              : new_texture(static_cast<std::uint64_t>(100 + i), "grass", name, 60, 150, 50);
    t.origin = TextureOrigin::kPackage;
    t.package = "some-textures";
    t.source = "textures/" + name + ".png";
    return t;
}

class Evaluation : public ::testing::Test {
  protected:
    void SetUp() override {
        std::vector<NewTexture> textures;
        for (int i = 0; i < 48; ++i)
            textures.push_back(from_package(i, i % 2 == 0));
        // Of other names, so that something remains where stone walls and grasses are left out.
        const char* stones[]{"cliff", "ledge", "crag", "boulder", "rubble", "slab"};
        const char* lawns[]{"lawn", "meadow", "turf", "pasture", "sward", "field"};
        for (int i = 0; i < 30; ++i) {
            for (const bool stone : {true, false}) {
                NewTexture t = from_package(500 + 2 * i + (stone ? 0 : 1), stone);
                t.source = std::string("textures/") + (stone ? stones : lawns)[i / 5] + "_" +
                           std::to_string(i) + ".png";
                textures.push_back(t);
            }
        }
        const auto library = open_or_die(path_);
        ASSERT_TRUE(library->add(textures));
        for (const char* material : {"stone", "grass"}) {
            fs::create_directories(scratch_.at(std::string("photos/") + material));
        }
        std::ofstream manifest(scratch_.at("photos/manifest.csv"));
        manifest << "file,category,package,path\n";
        for (int i = 0; i < 3; ++i) {
            put_photo("stone", i, manifest, "textures/stone_wall_" + std::to_string(i) + ".png");
            put_photo("grass", i, manifest, "textures/grass_" + std::to_string(i) + ".png");
        }
    }
    void put_photo(const std::string& material, int i, std::ofstream& manifest,
                   const std::string& source) {
        const bool stone = material == "stone";
        const auto seed = static_cast<std::uint64_t>(1000 + 10 * i + (stone ? 0 : 1));
        const ImageU8x3 picture =
            stone ? noise_picture(128, seed, 110, 110, 112) : noise_picture(128, seed, 60, 150, 50);
        const std::string name = material + "/photo" + std::to_string(i) + ".png";
        const auto png = encode_png(picture);
        std::ofstream file(scratch_.at("photos/" + name), std::ios::binary);
        file.write(reinterpret_cast<const char*>(png.data()),
                   static_cast<std::streamsize>(png.size()));
        manifest << name << "," << material << ",Debian some-textures 1.0-2," << source << ",x\n";
    }
    EvaluationReport ask(LeaveOut leave_out) {
        EvaluationOptions options;
        options.folder = scratch_.at("photos");
        options.leave_out = leave_out;
        const auto report = evaluate_library(path_, options);
        EXPECT_TRUE(report) << report.error().text();
        return report ? *report : EvaluationReport();
    }
    const Scratch scratch_;
    const std::string path_ = scratch_.at("a.db");
};

TEST_F(Evaluation, LeavesOutWhatItIsAskedFor) {
    // Three of eight pictures of each, of 24 samples: 9 each. Then the walls, whose name has two
    // words. Then the grasses, too.
    const EvaluationReport photographs = ask(LeaveOut::kPhotographs);
    EXPECT_EQ(photographs.asked, 6);
    const int themselves = photographs.left_out;
    EXPECT_EQ(themselves, 18);
    EXPECT_EQ(photographs.samples + themselves, 108);
    const int with_walls = ask(LeaveOut::kSeries).left_out,
              with_grasses = ask(LeaveOut::kStem).left_out;
    EXPECT_EQ(with_walls, themselves / 2 + 24);
    EXPECT_EQ(with_grasses, 48);
}

TEST_F(Evaluation, FindsWhatIsPlain) {
    const EvaluationReport report = ask(LeaveOut::kStem);
    ASSERT_EQ(report.materials.size(), 2u);
    for (const RetrievalScore& s : report.materials) {
        EXPECT_EQ(s.first, 1) << s.material;
        EXPECT_EQ(s.merged_among_five, 1) << s.material;
    }
    const auto itself = evaluate_library(path_, {});
    ASSERT_TRUE(itself) << itself.error().text();
    EXPECT_EQ(itself->average.first, 1);
    EXPECT_GT(itself->asked, 20);
}

TEST_F(Evaluation, SaysWhatCannotBeAsked) {
    EvaluationOptions options;
    options.folder = scratch_.at("nothing");
    EXPECT_EQ(evaluate_library(path_, options).error().code, ErrorCode::kUnreadable);
    fs::create_directories(scratch_.at("nothing/xyzzy"));
    EXPECT_EQ(evaluate_library(path_, options).error().code, ErrorCode::kUsage);
    EXPECT_EQ(evaluate_library(scratch_.at("none.db"), {}).error().code, ErrorCode::kUnreadable);
}

}  // namespace
}  // namespace weft
