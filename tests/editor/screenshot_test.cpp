// Pictures of every workspace without a display.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "engine/media/frame_writer.h"
#include "engine/media/image_files.h"
#include "tests/editor/program.h"

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
    const Finished done = run(
        sandbox, {"edit", "--demo", "--script", sandbox.in("script.json"), "--size", "1280x720"});
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

TEST(Screenshots, TheSameScriptGivesTheSamePicture) {
    const Sandbox sandbox;
    ImageF3 first;
    for (int k = 0; k < 2; ++k) {
        const std::string out = sandbox.in(std::to_string(k) + ".png");
        const Finished done = run(sandbox, {"edit", "--screenshot", out, "--size", "1280x720"});
        if (cannot_draw(done)) GTEST_SKIP() << done.errors;
        ASSERT_EQ(done.code, 0) << done.errors;
        const auto picture = read_image(out);
        ASSERT_TRUE(picture);
        if (k == 1) {
            EXPECT_LT(difference(first, picture->rgb), 0.002);
        }
        first = picture->rgb;
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

// The share of tiles of 16×16 that differ by more than drivers and fonts do.
double tiles_that_differ(const ImageF3& a, const ImageF3& b) {
    constexpr int kTile = 16;
    int tiles = 0, different = 0;
    for (int top = 0; top + kTile <= a.height(); top += kTile) {
        for (int left = 0; left + kTile <= a.width(); left += kTile) {
            double sum = 0;
            for (int y = top; y < top + kTile; ++y)
                for (int k = 3 * left; k < 3 * (left + kTile); ++k)
                    sum += std::abs(static_cast<double>(a.row(y)[k] - b.row(y)[k]));
            ++tiles;
            if (sum / (3 * kTile * kTile) > 0.03) ++different;
        }
    }
    return static_cast<double>(different) / tiles;
}

struct Page {
    const char* file;
    const char* workspace;
};
constexpr Page kPages[] = {{"mask", "Mask"},           {"texture", "Texture"}, {"motion", "Motion"},
                           {"light", "Seams & Light"}, {"review", "Review"},   {"jobs", "Jobs"}};

// Compares with pictures that somebody has looked at. With WEFT_UPDATE_GOLDEN in the environment
// they are written anew.
void expect_golden(const std::string& picture_path, const std::string& name) {
    const auto picture = read_image(picture_path);
    ASSERT_TRUE(picture) << picture.error().text();
    const ImageF3 now = quartered(picture->rgb);
    const std::string golden =
        std::string(WEFT_SOURCE_DIR) + "/tests/editor/golden/" + name + ".jpg";
    if (std::getenv("WEFT_UPDATE_GOLDEN")) {
        WriteOptions options;
        options.jpeg_quality = 85;
        ASSERT_TRUE(write_image(golden, now, {}, options));
        return;
    }
    const auto before = read_image(golden);
    ASSERT_TRUE(before) << before.error().text();
    ASSERT_EQ(before->rgb.size(), now.size());
    EXPECT_LT(tiles_that_differ(before->rgb, now), 0.06)
        << name << " looks different. Look at it; if that is meant, write the golden pictures "
        << "anew with WEFT_UPDATE_GOLDEN=1.";
}

// Goes through the workspaces after `begin` and compares each with golden/<prefix><page>.jpg.
void expect_golden_pages(const Sandbox& sandbox, const std::vector<std::string>& arguments,
                         const std::string& begin, const std::string& prefix) {
    {
        std::ofstream script(sandbox.in("script.json"));
        script << "[" << begin;
        for (const Page& page : kPages)
            script << R"(, {"workspace": ")" << page.workspace
                   << R"("}, {"hover": "Top/File"}, {"wait": 0.7}, {"screenshot": ")"
                   << sandbox.in(std::string(page.file) + ".png") << R"("})";
        script << "]";
    }
    std::vector<std::string> all = arguments;
    all.insert(all.end(), {"--script", sandbox.in("script.json"), "--size", "1280x720"});
    const Finished done = run(sandbox, all);
    if (cannot_draw(done)) GTEST_SKIP() << done.errors;
    ASSERT_EQ(done.code, 0) << done.errors;
    for (const Page& page : kPages)
        expect_golden(sandbox.in(std::string(page.file) + ".png"), prefix + page.file);
}

// The analysis is paused, so that what is seen does not depend on the machine.
TEST(Screenshots, EveryWorkspaceLooksAsItDid) {
    const Sandbox sandbox;
    expect_golden_pages(sandbox, {"edit", "--demo"},
                        R"({"click": "Top/Region"}, {"click": "Menu/Pause the analysis"},)"
                        R"({"wait_for": "plate"}, {"wait_for": "mattes"}, {"wait": 1.5})",
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

TEST(Screenshots, AnEmptyShotSaysWhatToDoInEveryWorkspace) {
    const Sandbox sandbox;
    write_plates(sandbox);
    expect_golden_pages(sandbox, {"edit", sandbox.in("shot")}, R"({"wait_for": "plate"})",
                        "empty_");
}

TEST(Screenshots, AFailingShotSaysWhyInEveryWorkspace) {
    const Sandbox sandbox;
    write_plates(sandbox);
    std::ofstream(sandbox.in("shot.weft")) << R"({"schema": "weft.project/1", "name": "Failing",
               "plate": {"path": "shot/####.png", "fps": 24.0},
               "regions": [{"id": 1, "name": "floor", "matte": {"files": "gone/####.png"},
                            "texture": {"sample": "gone.png"}}]})";
    expect_golden_pages(sandbox, {"edit", sandbox.in("shot.weft")},
                        R"({"wait_for": "plate"}, {"wait_for": "failure"}, {"wait": 1})",
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
        << WEFT_SOURCE_DIR << R"(/assets/demo/textures/brick.png"}}]})";
}

// Rendered and measured: graphs, heat strips and the worst frames with their pictures.
TEST(Screenshots, AMeasuredRenderLooksAsItDid) {
    const Sandbox sandbox;
    write_moving_shot(sandbox);
    std::ofstream(sandbox.in("script.json"))
        << R"([{"wait_for": "analysis", "timeout": 240}, {"workspace": "Jobs"},
               {"click": "Render frames"}, {"wait": 0.5}, {"wait_for": "jobs", "timeout": 240},
               {"workspace": "Review"}, {"click": "Measure it"},
               {"wait_for": "report", "timeout": 240}, {"settle": true, "timeout": 60},
               {"hover": "Top/File"}, {"wait": 6.5}, {"screenshot": ")"
        << sandbox.in("measured.png") << R"("}, {"click": "Worst/Seams"}, {"wait": 0.3},
               {"click": "Worst/Drift"}, {"wait": 0.3}])";
    const Finished done = run(sandbox, {"edit", sandbox.in("shot.weft"), "--script",
                                        sandbox.in("script.json"), "--size", "1280x720"});
    if (cannot_draw(done)) GTEST_SKIP() << done.errors;
    ASSERT_EQ(done.code, 0) << done.errors;
    expect_golden(sandbox.in("measured.png"), "review_measured");
}

TEST(Screenshots, TheWelcomeScreenLooksAsItDid) {
    const Sandbox sandbox;
    const std::string out = sandbox.in("welcome.png");
    const Finished done = run(sandbox, {"edit", "--screenshot", out, "--size", "1280x720"});
    if (cannot_draw(done)) GTEST_SKIP() << done.errors;
    ASSERT_EQ(done.code, 0) << done.errors;
    expect_golden(out, "welcome");
}

TEST(Screenshots, AScriptThatFailsSaysWhichStep) {
    const Sandbox sandbox;
    std::ofstream(sandbox.in("script.json"))
        << "[{\"wait\": 0.1}, {\"click\": \"No such button\"}]";
    const Finished done = run(sandbox, {"edit", "--script", sandbox.in("script.json")});
    if (cannot_draw(done)) GTEST_SKIP() << done.errors;
    EXPECT_EQ(done.code, 1);
    EXPECT_THAT(done.errors, testing::HasSubstr("step 2"));
    EXPECT_THAT(done.errors, testing::HasSubstr("No such button"));
}

}  // namespace
}  // namespace weft::test
