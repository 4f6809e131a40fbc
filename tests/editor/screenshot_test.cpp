// Pictures of every workspace without a display.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

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

bool no_gl(const Finished& run) {
    return run.errors.find("No OpenGL") != std::string::npos ||
           run.errors.find("cannot draw without a display") != std::string::npos;
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
    if (no_gl(done)) GTEST_SKIP() << done.errors;
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
        if (no_gl(done)) GTEST_SKIP() << done.errors;
        ASSERT_EQ(done.code, 0) << done.errors;
        const auto picture = read_image(out);
        ASSERT_TRUE(picture);
        if (k == 1) {
            EXPECT_LT(difference(first, picture->rgb), 0.002);
        }
        first = picture->rgb;
    }
}

TEST(Screenshots, AScriptThatFailsSaysWhichStep) {
    const Sandbox sandbox;
    std::ofstream(sandbox.in("script.json"))
        << "[{\"wait\": 0.1}, {\"click\": \"No such button\"}]";
    const Finished done = run(sandbox, {"edit", "--script", sandbox.in("script.json")});
    if (no_gl(done)) GTEST_SKIP() << done.errors;
    EXPECT_EQ(done.code, 1);
    EXPECT_THAT(done.errors, testing::HasSubstr("step 2"));
    EXPECT_THAT(done.errors, testing::HasSubstr("No such button"));
}

}  // namespace
}  // namespace weft::test
