// The real window on a virtual screen, driven by mouse and keyboard only.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "app/project/codec/project_file.h"
#include "engine/media/image_files.h"
#include "tests/editor/desktop.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;

// The matte that was painted for a fourth region, as the autosave has it; none while there is none.
std::optional<Matte> painted_matte(const Sandbox& sandbox) {
    const fs::path folder = fs::path(sandbox.in("home")) / ".local/state/weft/recovery";
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const auto project = load_project(entry.path().string());
        if (!project || project->regions.size() != 4) continue;
        for (const auto& [frame, key] : project->regions.back()->matte->keyframes) {
            auto matte = read_matte(resolve_path(folder.string(), key.path), {}, {});
            if (matte) return std::move(*matte);
        }
    }
    return std::nullopt;
}

Recti bounds_of(const Matte& matte) {
    Recti out{matte.width(), matte.height(), 0, 0};
    for (int y = 0; y < matte.height(); ++y)
        for (int x = 0; x < matte.width(); ++x)
            if (matte.at(x, y) > 127)
                out = {std::min(out.x0, x), std::min(out.y0, y), std::max(out.x1, x + 1),
                       std::max(out.y1, y + 1)};
    return out;
}

class Painting : public Desktop {
  protected:
    // The demo shot with a new region, and the brush in the hand.
    void SetUp() override {
        Desktop::SetUp();
        if (IsSkipped()) return;
        pid_ = start(sandbox_, without_library({"edit", "--demo"}), display_);
        if (!wait_for_window()) {
            ::kill(pid_, SIGKILL);
            const Finished done = finish(sandbox_, std::exchange(pid_, -1));
            GTEST_SKIP() << "No window came: " << done.errors;
        }
        rest(6);
        focus();
        tool("mousemove 600 400 click 2");
        press("ctrl+shift+n");
        press("b");
    }
    void TearDown() override {
        if (pid_ > 0) {
            EXPECT_FALSE(has_ended(pid_));
            ::kill(pid_, SIGTERM);
            (void)finish(sandbox_, pid_);
        }
        Desktop::TearDown();
    }

    pid_t pid_ = -1;
};

TEST_F(Painting, ByMouseAndKeyboardIsSaved) {
    tool("mousemove 500 350");
    rest(0.3);
    tool("mousedown 1");
    rest(0.3);
    for (int k = 0; k < 8; ++k) {
        tool("mousemove " + std::to_string(500 + 15 * k) + " 360");
        rest(0.05);
    }
    tool("mouseup 1");
    EXPECT_TRUE(wait_until([&] { return painted_matte(sandbox_).has_value(); }, 20));
}

TEST_F(Painting, BeginsWhereTheButtonWasPressedHoweverFastTheMouseMovesOn) {
    // Between two frames: to the right, then down.
    tool("mousemove 500 300");
    rest(0.5);
    tool("mousedown 1 mousemove 640 300 mousemove 640 400 mouseup 1");
    std::optional<Matte> painted;
    ASSERT_TRUE(wait_until([&] { return (painted = painted_matte(sandbox_)).has_value(); }, 20));
    const Recti box = bounds_of(*painted);
    EXPECT_GT(box.width(), box.height());
}

class SmallScreen : public Desktop {
  protected:
    [[nodiscard]] std::string screen() const override { return "1280x720"; }
};

TEST_F(SmallScreen, TheWindowIsNotLargerThanItIs) {
    const pid_t pid = start(sandbox_, {"edit"}, display_);
    const bool came = wait_for_window();
    // The window comes before its size has been set.
    std::string size;
    (void)wait_until(
        [&] {
            size = answer("search --name '^Weft$' getwindowgeometry");
            return size.find("Geometry: 1280x720") != std::string::npos;
        },
        10);
    ::kill(pid, SIGKILL);
    const Finished done = finish(sandbox_, pid);
    if (!came) GTEST_SKIP() << "No window came: " << done.errors;
    EXPECT_THAT(size, ::testing::HasSubstr("Geometry: 1280x720"));
}

}  // namespace
}  // namespace weft::test
