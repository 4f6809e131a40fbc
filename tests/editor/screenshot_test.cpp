// Pictures of every workspace without a display.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "engine/media/frame_writer.h"
#include "engine/media/image_files.h"
#include "tests/editor/program.h"
#include "tests/support/places.h"

namespace weft::test {
namespace {

// How much a picture differs from point to point: a flat one shows nothing.
double liveliness(const ImageF3& picture) {
    double sum = 0;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 1; x < picture.width(); ++x)
            sum +=
                std::abs(static_cast<double>(picture.pixel(x, y)[1] - picture.pixel(x - 1, y)[1]));
    return sum / (static_cast<double>(picture.width()) * picture.height());
}

double difference(const ImageF3& a, const ImageF3& b) {
    double sum = 0;
    const std::size_t count = a.size_bytes() / sizeof(float);
    for (std::size_t k = 0; k < count; ++k)
        sum += std::abs(static_cast<double>(a.data()[k] - b.data()[k]));
    return sum / static_cast<double>(count);
}

TEST(Screenshots, EveryWorkspaceShowsSomethingOfItsOwn) {
    const Sandbox sandbox;
    const char* const names[] = {"Mask", "Texture", "Motion", "Seams & Light", "Review", "Jobs"};
    {
        std::ofstream script(sandbox.in("script.json"));
        script << "[{\"wait_for\": \"plate\"}, {\"settle\": true, \"timeout\": 4}";
        for (int k = 0; k < 6; ++k)
            script << ", {\"workspace\": \"" << names[k]
                   << "\"}, {\"wait\": 0.3}, {\"screenshot\": \""
                   << sandbox.in(std::to_string(k) + ".png") << "\"}";
        script << "]";
    }
    const Finished done =
        run(sandbox, without_library({"edit", "--demo", "--script", sandbox.in("script.json"),
                                      "--size", "1280x720"}));
    if (cannot_draw(done)) GTEST_SKIP() << done.errors;
    ASSERT_EQ(done.code, 0) << done.errors;
    ImageF3 before;
    for (int k = 0; k < 6; ++k) {
        const auto picture = read_image(sandbox.in(std::to_string(k) + ".png"));
        ASSERT_TRUE(picture) << picture.error().text();
        EXPECT_EQ(picture->rgb.size(), (Size{1280, 720}));
        EXPECT_GT(liveliness(picture->rgb), 0.002) << names[k];
        if (k > 0) {
            EXPECT_GT(difference(before, picture->rgb), 0.002) << names[k];
        }
        before = picture->rgb;
    }
}

// Means over blocks of 4×4: what a golden picture holds.
ImageF3 quartered(const ImageF3& picture) {
    ImageF3 out(picture.width() / 4, picture.height() / 4);
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x)
            for (int c = 0; c < 3; ++c) {
                float sum = 0;
                for (int k = 0; k < 16; ++k)
                    sum += picture.pixel(4 * x + k % 4, 4 * y + k / 4)[c];
                out.pixel(x, y)[c] = sum / 16;
            }
    return out;
}

// Tiles of 8×8 (32×32 on the screen) that differ by more than drivers do: a word that goes missing
// is 0.03 and more. What lies in `ignored` does not count.
std::vector<Vec2i> tiles_that_differ(const ImageF3& a, const ImageF3& b, const Recti& ignored) {
    constexpr int kTile = 8;
    std::vector<Vec2i> out;
    for (int top = 0; top < a.height(); top += kTile) {
        for (int left = 0; left < a.width(); left += kTile) {
            const Recti tile{left, top, std::min(left + kTile, a.width()),
                             std::min(top + kTile, a.height())};
            if (!tile.intersected(ignored).empty()) continue;
            double sum = 0;
            for (int y = tile.y0; y < tile.y1; ++y)
                for (int k = 3 * tile.x0; k < 3 * tile.x1; ++k)
                    sum += std::abs(static_cast<double>(a.row(y)[k] - b.row(y)[k]));
            if (sum / (3.0 * tile.width() * tile.height()) > 0.02) out.push_back({left, top});
        }
    }
    return out;
}

TEST(ScreenshotTiles, AMissingWordIsDetected) {
    ImageF3 before(320, 180, 0.12f);
    ImageF3 now = before;
    // Six letters of 2×3 in the middle of a dark panel.
    for (int letter = 0; letter < 6; ++letter)
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 2; ++x)
                for (int c = 0; c < 3; ++c)
                    before.pixel(100 + 3 * letter + x, 90 + y)[c] = 0.5f;
    EXPECT_THAT(tiles_that_differ(before, before, {}), testing::IsEmpty());
    EXPECT_THAT(tiles_that_differ(before, now, {}), testing::SizeIs(testing::Ge(2u)));
    EXPECT_THAT(tiles_that_differ(before, now, {96, 88, 128, 96}), testing::IsEmpty());
    // The last row and column of a picture that is no multiple of a tile.
    now = before;
    for (int c = 0; c < 3; ++c)
        for (int k = 0; k < 4; ++k)
            now.pixel(319 - k, 179)[c] = 1.0f;
    EXPECT_THAT(tiles_that_differ(before, now, {}), testing::ElementsAre(Vec2i{312, 176}));
}

struct Page {
    const char* file;
    const char* workspace;
    Recti ignored;   ///< Of the golden picture: what depends on the machine.
    int wait_s = 0;  ///< For small pictures that are still being made on a busy machine.
};
// In Mask the path of the matte files begins with the folder of the sources. In Texture the heading
// says how far the search for suggestions is. In Motion the path of the
// demo's motion passes begins with the folder of the sources; in Jobs the output lies in the
// sandbox, whose name is drawn.
const Page kPages[] = {{"mask", "Mask", {272, 112, 320, 120}},
                       {"texture", "Texture", {168, 92, 320, 104}},
                       {"motion", "Motion", {272, 152, 320, 168}},
                       {"light", "Seams & Light", {}, 8},
                       {"review", "Review", {}},
                       {"jobs", "Jobs", {24, 56, 112, 72}}};

// Compares with reviewed golden pictures. With WEFT_UPDATE_GOLDEN in the environment they are
// written instead.
void expect_golden(const std::string& picture_path, const std::string& name,
                   const Recti& ignored = {}) {
    const auto picture = read_image(picture_path);
    ASSERT_TRUE(picture) << picture.error().text();
    const ImageF3 now = quartered(picture->rgb);
    const std::string golden = source_folder() + "/tests/editor/golden/" + name + ".png";
    if (std::getenv("WEFT_UPDATE_GOLDEN")) {
        WriteOptions options;
        options.rule = WriteRule::own();
        ASSERT_TRUE(write_image(golden, now, {}, options));
        return;
    }
    const auto before = read_image(golden);
    ASSERT_TRUE(before) << before.error().text();
    ASSERT_EQ(before->rgb.size(), now.size());
    for (const Vec2i at : tiles_that_differ(before->rgb, now, ignored))
        ADD_FAILURE() << name << " looks different around (" << 4 * at.x << ", " << 4 * at.y
                      << "). Look at it; if that is meant, write the golden pictures anew with "
                      << "WEFT_UPDATE_GOLDEN=1.";
}

// Goes through the workspaces after `begin` and compares each with golden/<prefix><page>.png.
void expect_golden_pages(const Sandbox& sandbox, const std::vector<std::string>& arguments,
                         const std::string& begin, const std::string& prefix) {
    {
        std::ofstream script(sandbox.in("script.json"));
        script << "[" << begin;
        for (const Page& page : kPages) {
            script << R"(, {"workspace": ")" << page.workspace << R"("})";
            if (prefix.empty() && page.wait_s > 0) script << R"(, {"wait": )" << page.wait_s << "}";
            script << R"(, {"hover": "Top/File"}, {"settle": true, "timeout": 20}, {"wait": 0.7}, )"
                   << R"({"screenshot": ")" << sandbox.in(std::string(page.file) + ".png")
                   << R"("})";
        }
        script << "]";
    }
    std::vector<std::string> all = arguments;
    all.insert(all.end(), {"--script", sandbox.in("script.json"), "--size", "1280x720"});
    // The starter textures would be listed as fast as the machine makes them.
    const Finished done = run(sandbox, without_library(all));
    if (cannot_draw(done)) GTEST_SKIP() << done.errors;
    ASSERT_EQ(done.code, 0) << done.errors;
    for (const Page& page : kPages)
        expect_golden(sandbox.in(std::string(page.file) + ".png"), prefix + page.file,
                      page.ignored);
}

// The analysis is paused from the first frame on, so that what is seen does not depend on the
// machine.
TEST(Screenshots, EveryWorkspaceMatchesItsGoldenPicture) {
    const Sandbox sandbox;
    expect_golden_pages(sandbox, {"edit", "--demo", "--paused"},
                        R"({"wait_for": "cached", "timeout": 240}, {"wait_for": "mattes"},
            {"wait_for": "provisional", "timeout": 60}, {"wait": 1.5})",
                        "");
}

void write_plates(const Sandbox& sandbox) {
    std::filesystem::create_directories(sandbox.in("shot"));
    ImageF3 frame(320, 180);
    for (int y = 0; y < frame.height(); ++y)
        for (int x = 0; x < frame.width(); ++x)
            for (int c = 0; c < 3; ++c)
                frame.pixel(x, y)[c] = static_cast<float>((c + 1) * x + y) / 1200.0f;
    for (const char* name : {"0001.png", "0002.png", "0003.png", "0004.png"})
        ASSERT_TRUE(write_image(sandbox.in(std::string("shot/") + name), frame, {}, {}));
}

TEST(Screenshots, AnEmptyShotMatchesItsGoldenPictures) {
    const Sandbox sandbox;
    write_plates(sandbox);
    expect_golden_pages(sandbox, {"edit", sandbox.in("shot")}, R"({"wait_for": "cached"})",
                        "empty_");
}

TEST(Screenshots, AFailingShotMatchesItsGoldenPictures) {
    const Sandbox sandbox;
    write_plates(sandbox);
    // Absolute, so that the messages are the same in every sandbox.
    std::ofstream(sandbox.in("shot.weft")) << R"({"schema": "weft.project/1", "name": "Failing",
               "plate": {"path": "shot/####.png", "fps": 24.0},
               "regions": [{"id": 1, "name": "floor", "matte": {"files": "/gone/####.png"},
                            "texture": {"sample": "/gone.png"}}]})";
    expect_golden_pages(sandbox, {"edit", sandbox.in("shot.weft")},
                        R"({"wait_for": "cached"}, {"wait_for": "failure"}, {"wait": 1})",
                        "failing_");
}

// A surface that moves, its mattes, and a project that puts bricks on it.
void write_moving_shot(const Sandbox& sandbox) {
    for (const char* name : {"shot", "mattes"})
        std::filesystem::create_directories(sandbox.in(name));
    for (int k = 1; k <= 12; ++k) {
        ImageF3 frame(320, 180);
        Matte matte(320, 180);
        const int left = 70 + 4 * k;
        for (int y = 0; y < frame.height(); ++y)
            for (int x = 0; x < frame.width(); ++x) {
                const bool inside = x >= left && x < left + 150 && y >= 30 && y < 150;
                const int u = inside ? x - left : x / 3, v = inside ? y : y / 3;
                const float grain = static_cast<float>((u * 37 + v * 59 + u * v) % 29) / 120.0f;
                for (int c = 0; c < 3; ++c)
                    frame.pixel(x, y)[c] =
                        (inside ? 0.45f : 0.2f + 0.05f * static_cast<float>(c)) + grain;
                matte.at(x, y) = inside ? 255 : 0;
            }
        const std::string file = "/" + std::string(k < 10 ? "000" : "00") + std::to_string(k);
        ASSERT_TRUE(write_image(sandbox.in("shot") + file + ".png", frame, {}, {}));
        ASSERT_TRUE(write_matte(sandbox.in("mattes") + file + ".png", matte));
    }
    std::ofstream(sandbox.in("shot.weft"))
        << R"({"schema": "weft.project/1", "name": "Moving",
               "plate": {"path": "shot/####.png", "fps": 24.0},
               "settings": {"quality": "draft"},
               "output": {"path": "render/####.png"},
               "regions": [{"id": 1, "name": "card", "matte": {"files": "mattes/####.png"},
                            "placement": {"scale": 0.5}, "texture": {"sample": ")"
        << source_folder() << R"(/assets/demo/textures/brick.png"}}]})";
}

// Rendered and measured: graphs, heat strips and the worst frames with their pictures.
TEST(Screenshots, AMeasuredRenderMatchesItsGoldenPicture) {
    const Sandbox sandbox;
    write_moving_shot(sandbox);
    std::ofstream(sandbox.in("script.json"))
        << R"([{"wait_for": "analysis", "timeout": 240}, {"workspace": "Jobs"},
               {"click": "Render frames"}, {"wait": 0.5}, {"wait_for": "jobs", "timeout": 240},
               {"workspace": "Review"}, {"click": "Measure"},
               {"wait_for": "report", "timeout": 240}, {"settle": true, "timeout": 60},
               {"hover": "Top/File"}, {"wait": 6.5}, {"screenshot": ")"
        << sandbox.in("measured.png") << R"("}, {"click": "Worst/Seams"}, {"wait": 0.3},
               {"click": "Worst/Drift"}, {"wait": 0.3}])";
    const Finished done =
        run(sandbox, without_library({"edit", sandbox.in("shot.weft"), "--script",
                                      sandbox.in("script.json"), "--size", "1280x720"}));
    if (cannot_draw(done)) GTEST_SKIP() << done.errors;
    ASSERT_EQ(done.code, 0) << done.errors;
    expect_golden(sandbox.in("measured.png"), "review_measured");
}

// Twice the same picture, and the right one.
TEST(Screenshots, TheWelcomeScreenMatchesItsGoldenPicture) {
    const Sandbox sandbox;
    ImageF3 first;
    for (int k = 0; k < 2; ++k) {
        const std::string out = sandbox.in(std::to_string(k) + ".png");
        const Finished done = run(sandbox, {"edit", "--screenshot", out, "--size", "1280x720"});
        if (cannot_draw(done)) GTEST_SKIP() << done.errors;
        ASSERT_EQ(done.code, 0) << done.errors;
        expect_golden(out, "welcome");
        const auto picture = read_image(out);
        ASSERT_TRUE(picture);
        if (k == 1) {
            EXPECT_LT(difference(first, picture->rgb), 0.002);
        }
        first = picture->rgb;
    }
}

TEST(Screenshots, AFailingScriptNamesItsStep) {
    const Sandbox sandbox;
    std::ofstream(sandbox.in("script.json"))
        << "[{\"wait\": 0.1}, {\"click\": \"No such button\"}]";
    const Finished done =
        run(sandbox, without_library({"edit", "--script", sandbox.in("script.json")}));
    if (cannot_draw(done)) GTEST_SKIP() << done.errors;
    EXPECT_EQ(done.code, 1);
    EXPECT_THAT(done.errors, testing::HasSubstr("step 2"));
    EXPECT_THAT(done.errors, testing::HasSubstr("No such button"));
}

}  // namespace
}  // namespace weft::test
