// A first job from the welcome screen to rendered frames, by mouse and keyboard alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>
#include <string>

#include "app/project/codec/project_file.h"
#include "engine/media/image_files.h"
#include "tests/editor/desktop.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;

struct Middle {
    int x = 0, y = 0;
};
using Items = std::map<std::string, Middle>;

// Where everything stands on a screen of this size: the same program, drawn without a window.
Items items_after(const Sandbox& sandbox, const std::string& steps) {
    const std::string file = sandbox.in("items.txt");
    std::ofstream(sandbox.in("items.json"))
        << "[" << steps << R"(, {"items": ")" << file << R"("}])";
    (void)run(sandbox, {"edit", "--script", sandbox.in("items.json"), "--size", "1600x900"});
    Items out;
    std::ifstream lines(file);
    for (std::string line; std::getline(lines, line);) {
        // The name may hold blanks; four numbers follow it.
        std::size_t at = line.size();
        for (int k = 0; k < 4 && at != std::string::npos; ++k)
            at = line.rfind(' ', at - 1);
        if (at == std::string::npos) continue;
        float x0 = 0, y0 = 0, x1 = 0, y1 = 0;
        std::sscanf(line.c_str() + at, "%f %f %f %f", &x0, &y0, &x1, &y1);
        out[line.substr(0, at)] = {static_cast<int>((x0 + x1) / 2),
                                   static_cast<int>((y0 + y1) / 2)};
    }
    return out;
}

class WholeJob : public Desktop {
  protected:
    // The work as the recovery snapshot has it.
    [[nodiscard]] std::optional<Project> snapshot() const {
        std::error_code error;
        for (const auto& entry : fs::directory_iterator(
                 fs::path(sandbox_.in("home")) / ".local/state/weft/recovery", error)) {
            if (entry.path().extension() != ".weft") continue;
            if (auto project = load_project(entry.path().string())) return *project;
        }
        return std::nullopt;
    }
    void stroke(int x0, int y0, int x1, int y1) const {
        tool("mousemove " + std::to_string(x0) + " " + std::to_string(y0));
        rest(0.4);
        tool("mousedown 1");
        rest(0.3);
        for (int k = 1; k <= 10; ++k) {
            tool("mousemove " + std::to_string(x0 + (x1 - x0) * k / 10) + " " +
                 std::to_string(y0 + (y1 - y0) * k / 10));
            rest(0.05);
        }
        tool("mouseup 1");
        rest(0.4);
    }
    void click_item(const Items& items, const std::string& name, int times = 1) const {
        const auto found = std::find_if(items.begin(), items.end(), [&](const auto& item) {
            return item.first == name || item.first.ends_with("/" + name);
        });
        ASSERT_NE(found, items.end()) << "There is no '" << name << "' on the screen.";
        click(found->second.x, found->second.y, times);
    }
};

TEST_F(WholeJob, FromTheWelcomeScreenToFrames) {
    const Items welcome = items_after(sandbox_, R"({"wait": 0.2})");
    if (welcome.empty()) GTEST_SKIP() << "Nothing can be drawn here without a display.";
    const Items textures = items_after(
        sandbox_, R"({"demo": true}, {"wait_for": "plate"}, {"key": "Ctrl+Shift+N"},)"
                  R"({"workspace": "Texture"}, {"wait": 3}, {"click": "Search textures"},)"
                  R"({"type": "brick"}, {"wait": 3})");
    const Items jobs = items_after(
        sandbox_, R"({"demo": true}, {"wait_for": "plate"}, {"workspace": "Jobs"}, {"wait": 1})");
    const pid_t pid = start(sandbox_, {"edit"}, display_);
    if (!wait_for_window()) {
        ::kill(pid, SIGKILL);
        const Finished done = finish(sandbox_, pid);
        GTEST_SKIP() << "No window came: " << done.errors;
    }
    rest(4);
    focus();
    picture("01_welcome");
    click_item(welcome, "Open demo shot");
    rest(8);
    picture("02_demo");
    press("ctrl+shift+n");
    press("b");
    stroke(520, 620, 900, 650);
    stroke(520, 660, 900, 690);
    EXPECT_TRUE(wait_until(
        [&] {
            const auto work = snapshot();
            return work && work->regions.size() == 4 &&
                   !work->regions.back()->matte->keyframes.empty();
        },
        30))
        << "nothing was painted";
    picture("03_painted");
    press("F6");
    rest(6);
    picture("04_textures");
    // What is searched for is the first of the grid, whatever is suggested above it else.
    click_item(textures, "Search textures");
    tool("type --delay 120 brick");
    rest(4);
    picture("05_searched");
    click_item(textures, "Textures/Brick", 2);
    EXPECT_TRUE(wait_until(
        [&] {
            const auto work = snapshot();
            return work && !work->regions.back()->texture.sample.empty();
        },
        30))
        << "no texture was picked";
    picture("06_picked");
    rest(30);
    picture("07_preview");
    press("F8");
    rest(10);
    picture("08_light");
    // Three frames are enough to see them land.
    press("Home");
    press("i");
    press("Right");
    press("Right");
    press("o");
    press("F10");
    rest(1);
    click_item(jobs, "Marked range");
    picture("09_jobs");
    // The range's hint has gone, so that the button stands where it stood.
    click_item(jobs, "Render frames");
    rest(4);
    picture("10_submitted");
    const fs::path folder = fs::path(sandbox_.in("home")) / "weft/Courtyard/render_v001";
    const auto frames = [&] {
        int count = 0;
        std::error_code error;
        for (const auto& entry : fs::directory_iterator(folder, error))
            count += entry.path().extension() == ".png" &&
                     !entry.path().filename().string().starts_with('.');
        return count;
    };
    EXPECT_TRUE(wait_until([&] { return frames() == 3 || has_ended(pid); }, 1500));
    rest(4);
    picture("11_rendered");
    ASSERT_FALSE(has_ended(pid)) << finish(sandbox_, pid).errors;
    EXPECT_EQ(frames(), 3);
    for (const int number : {1001, 1002, 1003}) {
        const std::string name = "Courtyard_v001." + std::to_string(number) + ".png";
        const auto frame = read_image((folder / name).string());
        ASSERT_TRUE(frame) << frame.error().text();
        EXPECT_EQ(frame->rgb.size(), (Size{960, 540}));
    }
    press("F9");
    rest(2);
    picture("12_review");
    ::kill(pid, SIGTERM);
    (void)finish(sandbox_, pid);
}

}  // namespace
}  // namespace weft::test
