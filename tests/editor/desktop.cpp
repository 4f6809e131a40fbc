#include "tests/editor/desktop.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <thread>

namespace weft::test {

void rest(double seconds) {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

bool wait_until(const std::function<bool()>& holds, double patience_s) {
    for (double waited = 0; waited < patience_s; waited += 0.5) {
        if (holds()) return true;
        rest(0.5);
    }
    return holds();
}

void Desktop::SetUp() {
    for (const char* name : {"Xvfb", "xdotool"})
        if (!has_tool(name)) GTEST_SKIP() << name << " is not installed";
    display_ = ":" + std::to_string(700 + getpid() % 200);
    const std::string size = screen() + "x24";
    server_ = fork();
    if (server_ == 0) {
        execlp("Xvfb", "Xvfb", display_.c_str(), "-screen", "0", size.c_str(), "-nolisten", "tcp",
               nullptr);
        _exit(1);
    }
    rest(1.5);
}

void Desktop::TearDown() {
    if (server_ <= 0) return;
    ::kill(server_, SIGTERM);
    waitpid(server_, nullptr, 0);
}

int Desktop::tool(const std::string& arguments) const {
    return std::system(
        ("DISPLAY=" + display_ + " xdotool " + arguments + " >/dev/null 2>&1").c_str());
}

std::string Desktop::answer(const std::string& arguments) const {
    const std::string file = sandbox_.in("answer.txt");
    // No other thread runs. NOLINTNEXTLINE(concurrency-mt-unsafe)
    (void)std::system(
        ("DISPLAY=" + display_ + " xdotool " + arguments + " >'" + file + "' 2>/dev/null").c_str());
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

bool Desktop::wait_for_window() const {
    return wait_until([&] { return tool("search --name '^Weft$'") == 0; }, 60);
}

void Desktop::focus() const {
    tool("search --onlyvisible --name Weft windowfocus");
}

void Desktop::press(const std::string& chord) const {
    tool("key " + chord);
    rest(0.6);
}

void Desktop::click(int x, int y, int times) const {
    tool("mousemove " + std::to_string(x) + " " + std::to_string(y));
    rest(0.4);
    tool("click --repeat " + std::to_string(times) + " --delay 60 1");
    rest(0.6);
}

void Desktop::picture(const std::string& name) const {
    const char* folder = std::getenv("WEFT_DESKTOP_SHOTS");
    if (!folder) return;
    (void)std::system(("DISPLAY=" + display_ + " import -window root '" + folder + "/" + name +
                       ".png' >/dev/null 2>&1")
                          .c_str());
}

}  // namespace weft::test
