// The real window on a real (virtual) screen, by mouse and keyboard alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "app/project/project_file.h"
#include "tests/editor/program.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;

void rest(double seconds) {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

class Desktop : public ::testing::Test {
  protected:
    void SetUp() override {
        for (const char* tool : {"Xvfb", "xdotool"})
            if (!has_tool(tool)) GTEST_SKIP() << tool << " is not installed";
        display_ = ":" + std::to_string(700 + getpid() % 200);
        server_ = fork();
        if (server_ == 0) {
            execlp("Xvfb", "Xvfb", display_.c_str(), "-screen", "0", "1600x900x24", "-nolisten",
                   "tcp", nullptr);
            _exit(1);
        }
        rest(1.5);
    }
    void TearDown() override {
        if (server_ > 0) {
            ::kill(server_, SIGTERM);
            waitpid(server_, nullptr, 0);
        }
    }
    int tool(const std::string& arguments) const {
        return std::system(
            ("DISPLAY=" + display_ + " xdotool " + arguments + " >/dev/null 2>&1").c_str());
    }
    bool wait_for_window() const {
        for (int k = 0; k < 120; ++k) {
            if (tool("search --name '^Weft$'") == 0) return true;
            rest(0.25);
        }
        return false;
    }

    // Pressed and released at once: the software renderer draws few frames a second, and none of
    // it may be lost.
    void press(const std::string& chord) const {
        tool("key " + chord);
        rest(0.4);
    }

    Sandbox sandbox_;
    std::string display_;
    pid_t server_ = -1;
};

TEST_F(Desktop, AStrokeByMouseAndKeyboardIsSaved) {
    const pid_t pid = start(sandbox_, {"edit", "--demo"}, display_);
    if (!wait_for_window()) {
        ::kill(pid, SIGKILL);
        const Finished done = finish(sandbox_, pid);
        GTEST_SKIP() << "No window came: " << done.errors;
    }
    rest(6);
    // Without a window manager nobody else gives the window the keyboard.
    tool("search --onlyvisible --name Weft windowfocus");
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
    rest(3);
    ASSERT_FALSE(has_ended(pid)) << finish(sandbox_, pid).errors;
    const fs::path folder = fs::path(sandbox_.in("home")) / ".local/state/weft/recovery";
    bool painted = false;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const auto project = load_project(entry.path().string());
        if (project && project->regions.size() == 4)
            painted = !project->regions.back()->matte->keyframes.empty();
    }
    EXPECT_TRUE(painted);
    ::kill(pid, SIGTERM);
    (void)finish(sandbox_, pid);
}

}  // namespace
}  // namespace weft::test
