// Node trees beside a render: evaluated node by node, they give the rendered picture.
#include <algorithm>
#include <cmath>

#include "tests/cli/cli_fixture.h"
#include "tests/cli/node_trees.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

// Light, gloss, grain and a grade, so that no node is idle.
const Words kFinished{"--highlights",  "1",   "--exposure",    "0.4",
                      "--keep-detail", "0.5", "--layer-blend", "soft-light"};

struct OffBy {
    float worst = 0;  ///< In steps of a half float at the larger value, at least at 1/16.
    int pixels = 0;   ///< Of the surface.
};

OffBy off_by(const Rgba& rebuilt, const std::string& render) {
    const Rgba there = read_rgba(render);
    const ImageF1 matte = exr_channel(render, "matte.A");
    OffBy out;
    for (int y = 0; y < matte.height(); ++y) {
        for (int x = 0; x < matte.width(); ++x) {
            out.pixels += matte.at(x, y) > 0;
            for (std::size_t c = 0; c < 3; ++c) {
                const float a = rebuilt[c].at(x, y), b = there[c].at(x, y);
                const float size = std::max({std::fabs(a), std::fabs(b), 1.0f / 16});
                const float step = std::ldexp(1.0f, std::ilogb(size) - 10);
                out.worst = std::max(out.worst, std::fabs(a - b) / step);
            }
        }
    }
    return out;
}

class Composites : public CliTest {
  protected:
    // The shot as EXR, and a holdout across the card.
    void make_linear_shot(int count) {
        make_shot(count, 1001, ".exr", PixelDepth::kHalf);
        fs::create_directories(in("hold"));
        for (int step = 0; step < count; ++step) {
            Matte hold(Card::kPlate);
            for (int y = 0; y < hold.height(); ++y)
                for (int x = 70; x < 84; ++x)
                    hold.at(x, y) = static_cast<std::uint8_t>(x < 74 ? 60 * (x - 69) : 255);
            put_matte("hold/" + std::to_string(1001 + step) + ".png", hold);
        }
    }
    Outcome render(const Words& more) const {
        Words words{"--plate", "frames/####.exr", "--holdout", "hold/####.png",
                    "-o",      "out/####.exr",    "--quality", "final"};
        words.insert(words.end(), kFinished.begin(), kFinished.end());
        words.insert(words.end(), more.begin(), more.end());
        return run_replace(words);
    }
    Rgba tree(const std::string& name, int frame, int texture = 0) const {
        const TreeRun run{fs::path(in(name)).parent_path().string(), frame, texture};
        return name.ends_with(".nk") ? evaluate_nuke(bytes(name), run)
                                     : evaluate_fusion(bytes(name), run);
    }
};

TEST_F(Composites, TheTreesGiveTheRender) {
    make_linear_shot(2);
    expect_success(render({"--export-composite", "out/shot.nk", "--export-composite",
                           "out/shot.comp", "--export-composite", "out/shot.py"}));
    EXPECT_EQ(names("out"),
              (Words{"1001.exr", "1002.exr", "shot.comp", "shot.nk", "shot.py", "shot_plane.exr"}));
    for (const char* name : {"out/shot.nk", "out/shot.comp"}) {
        const OffBy off = off_by(tree(name, 1002), in("out/1002.exr"));
        std::printf("%s: %.2f steps of a half float off\n", name, static_cast<double>(off.worst));
        EXPECT_GT(off.pixels, 3500);
        EXPECT_LE(off.worst, 1.5f) << name;
    }
    for (const char* name : {"out/shot.nk", "out/shot.comp", "out/shot.py"}) {
        EXPECT_THAT(bytes(name), Not(HasSubstr(folder_.string()))) << name;
        EXPECT_THAT(bytes(name), HasSubstr("../frames/")) << name;
    }
}

// The plane through the ST-map is the texture, within what filtering does.
TEST_F(Composites, TheSwitchShowsThePlaneThroughTheMap) {
    make_linear_shot(2);
    put_picture("tile.png", smooth_plane(), PixelDepth::kU16);
    expect_success(render({"--export-composite", "shot.nk", "--export-composite", "shot.comp",
                           "--plane", "tile.png", "--scale", "2"}));
    const Rgba nuke = tree("shot.nk", 1002, 1), fusion = tree("shot.comp", 1002, 1);
    const Rgba there = read_rgba(in("out/1002.exr"));
    const ImageF1 matte = exr_channel(in("out/1002.exr"), "matte.A");
    double off = 0, apart = 0, count = 0, differs = 0;
    for (int y = 0; y < matte.height(); ++y) {
        for (int x = 0; x < matte.width(); ++x) {
            if (matte.at(x, y) < 1) continue;
            for (std::size_t c = 0; c < 3; ++c) {
                off += std::fabs(nuke[c].at(x, y) - there[c].at(x, y));
                apart += std::fabs(nuke[c].at(x, y) - fusion[c].at(x, y));
                differs += nuke[c].at(x, y) != there[c].at(x, y);
                count += 1;
            }
        }
    }
    EXPECT_GT(count, 3 * 3000);
    EXPECT_GT(differs, 0) << "the switch does nothing";
    EXPECT_LT(off / count, 0.01);
    EXPECT_LT(apart / count, 1e-3);
}

TEST_F(Composites, SeveralRegionsShowTheirOwnPlanes) {
    make_linear_shot(2);
    fs::create_directories(in("half"));
    for (const int frame : {1001, 1002}) {
        Matte half = card_matte(frame - 1001);
        for (int y = 0; y < half.height(); ++y)
            for (int x = 0; x < 60; ++x)
                half.at(x, y) = 0;
        put_matte("half/" + std::to_string(frame) + ".png", half);
    }
    put_picture("tile.png", smooth_plane(), PixelDepth::kU16);
    put_picture("other.png", smooth_plane(32), PixelDepth::kU16);
    expect_success(run({"new", "shot.weft", "--plate", "frames/####.exr", "-o", "out/####.exr"}));
    for (const auto& [name, masks, plane] :
         {std::array{"card", "masks/####.png", "tile.png"}, {"half", "half/####.png", "other.png"}})
        expect_success(run({"region", "add", "shot.weft", "--name", name, "--matte", masks,
                            "--plane", plane, "--scale", "2"}));
    expect_success(run({"render", "shot.weft", "--export-composite", "shot.nk",
                        "--export-composite", "shot.comp"}));
    EXPECT_TRUE(fs::exists(in("shot_region1_plane.exr")));
    EXPECT_TRUE(fs::exists(in("shot_region2_plane.exr")));
    for (const char* name : {"shot.nk", "shot.comp"}) {
        EXPECT_LE(off_by(tree(name, 1002), in("out/1002.exr")).worst, 1.5f) << name;
        const Rgba switched = tree(name, 1002, 1), there = read_rgba(in("out/1002.exr"));
        // Well inside of either region.
        for (const int x : {45, 95}) {
            double off = 0;
            for (int y = 40; y < 70; ++y)
                off += std::fabs(switched[1].at(x, y) - there[1].at(x, y)) / 30;
            EXPECT_LT(off, 0.02) << name << " at " << x;
        }
    }
}

// The plate's codes become linear light in the tree.
TEST_F(Composites, ADisplayPlateIsConverted) {
    make_shot(2, 1001);
    expect_success(
        run_replace({"-o", "out/####.exr", "--depth", "float", "--quality", "final",
                     "--export-composite", "shot.nk", "--export-composite", "shot.comp"}));
    for (const char* name : {"shot.nk", "shot.comp"})
        EXPECT_LE(off_by(tree(name, 1001), in("out/1001.exr")).worst, 2.0f) << name;
}

TEST_F(Composites, NamesAreWrittenAsTheyAre) {
    make_linear_shot(1);
    const std::string odd = "it's [a] $odd \"name\"";
    fs::rename(in("frames"), in(odd));
    expect_success(render({"--plate", odd + "/####.exr", "--export-composite", "shot.nk",
                           "--export-composite", "shot.comp"}));
    for (const char* name : {"shot.nk", "shot.comp"})
        EXPECT_LE(off_by(tree(name, 1001), in("out/1001.exr")).worst, 1.5f) << name;
}

TEST_F(Composites, NothingOfOthersIsReplaced) {
    make_linear_shot(2);
    put("shot.nk", "mine");
    expect_failure(render({"--export-composite", "shot.nk"}), 2, {"shot.nk exists already"});
    expect_failure(render({"--export-composite", "shot.nk", "--resume"}), 2, {"shot.nk"});
    EXPECT_EQ(bytes("shot.nk"), "mine");
    EXPECT_FALSE(fs::exists(in("out")));
    expect_success(render({"--export-composite", "b.nk"}));
    const std::string before = bytes("b.nk");
    fs::remove(in("out/1002.exr"));
    expect_success(render({"--export-composite", "b.nk", "--resume", "--threads", "1"}));
    EXPECT_EQ(bytes("b.nk"), before);
}

TEST_F(Composites, WhatCannotBeRebuiltIsRefusedBeforeAnyWork) {
    make_linear_shot(2);
    const auto refused = [&](const Words& more, const Words& parts) {
        expect_failure(render(more), 2, parts);
        EXPECT_FALSE(fs::exists(in("out")));
    };
    refused({"--export-composite", "shot.aep"}, {"shot.aep", ".nk", ".comp", ".py"});
    refused({"--export-composite", "a.nk", "-o", "out/####.png"}, {"Layers need an EXR"});
    refused({"--export-composite", "a.py", "--plate-space", "cineon"}, {"Blender", "film log"});
    for (const int frame : {1001, 1002})
        fs::copy(in("frames/" + std::to_string(frame) + ".exr"),
                 in("frames/p." + std::to_string(frame) + ".v2.exr"));
    refused({"--export-composite", "a.comp", "--plate", "frames/p.####.v2.exr"},
            {"p.1001.v2.exr", "another number"});
}

}  // namespace
}  // namespace weft::test
