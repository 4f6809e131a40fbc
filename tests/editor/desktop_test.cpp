// The real window on a virtual screen, driven by mouse and keyboard only.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include "app/project/codec/project_file.h"
#include "tests/editor/desktop.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;

TEST_F(Desktop, AStrokeByMouseAndKeyboardIsSaved) {
    const pid_t pid = start(sandbox_, {"edit", "--demo"}, display_);
    if (!wait_for_window()) {
        ::kill(pid, SIGKILL);
        const Finished done = finish(sandbox_, pid);
        GTEST_SKIP() << "No window came: " << done.errors;
    }
    rest(6);
    focus();
    tool("mousemove 600 400 click 2");
    press("ctrl+shift+n");
    press("b");
    tool("mousemove 500 350");
    rest(0.3);
    tool("mousedown 1");
    rest(0.3);
    for (int k = 0; k < 8; ++k) {
        tool("mousemove " + std::to_string(500 + 15 * k) + " 360");
        rest(0.05);
    }
    tool("mouseup 1");
    const auto painted = [&] {
        const fs::path folder = fs::path(sandbox_.in("home")) / ".local/state/weft/recovery";
        std::error_code error;
        for (const auto& entry : fs::directory_iterator(folder, error)) {
            const auto project = load_project(entry.path().string());
            if (project && project->regions.size() == 4 &&
                !project->regions.back()->matte->keyframes.empty())
                return true;
        }
        return false;
    };
    EXPECT_TRUE(wait_until(painted, 20));
    ASSERT_FALSE(has_ended(pid)) << finish(sandbox_, pid).errors;
    ::kill(pid, SIGTERM);
    (void)finish(sandbox_, pid);
}

}  // namespace
}  // namespace weft::test
