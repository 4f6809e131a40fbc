// The editor is killed at random moments while painting, saving and rendering: finished work
// survives, and no file is damaged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <fstream>
#include <random>
#include <thread>

#include "app/project/codec/project_file.h"
#include "engine/media/frame_writer.h"
#include "engine/media/image_files.h"
#include "tests/editor/program.h"
#include "tests/support/places.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 6;
constexpr Size kPlate{320, 180};
constexpr int kMostStrokes = 26;

std::mt19937& dice() {
    static std::mt19937 random(std::random_device{}());
    return random;
}

void sleep_ms(int ms) {
    std::this_thread::sleep_for(std::chrono::milliseconds(ms));
}

// A small shot with one region that renders, saved as shot.weft.
void make_shot(const Sandbox& sandbox) {
    fs::create_directories(sandbox.in("plates"));
    ImageF3 frame(kPlate);
    for (int y = 0; y < kPlate.height; ++y)
        for (int x = 0; x < kPlate.width; ++x)
            for (int c = 0; c < 3; ++c)
                frame.pixel(x, y)[c] =
                    0.2f + 0.6f * static_cast<float>((x * (7 + c) + y * 13) % 64) / 64.0f;
    for (int k = 1; k <= kFrames; ++k)
        ASSERT_TRUE(
            write_image(sandbox.in("plates/000" + std::to_string(k) + ".png"), frame, {}, {}));
    Matte matte(kPlate);
    for (int y = 20; y < 80; ++y)
        std::fill(matte.row(y) + 20, matte.row(y) + 140, std::uint8_t{255});
    ASSERT_TRUE(write_matte(sandbox.in("matte.png"), matte.view()));
    std::ofstream(sandbox.in("shot.weft"))
        << R"({"schema": "weft.project/1", "name": "Small",
               "plate": {"path": "plates/####.png", "fps": 24.0},
               "regions": [{"id": 1, "name": "floor",
                            "matte": {"keyframes": [{"frame": 1, "path": "matte.png"}]},
                            "texture": {"sample": ")"
        << source_folder() << R"(/assets/demo/textures/brick.png"}}]})";
}

// Begins a region of its own and paints; `between` follows every stroke.
std::string painting(const Sandbox& sandbox, const std::string& between) {
    std::string steps = R"([{"open": ")" + sandbox.in("shot.weft") +
                        R"("}, {"wait_for": "plate"}, {"key": "Ctrl+Shift+N"}, {"key": "B"})";
    for (int k = 0; k < kMostStrokes; ++k) {
        const std::string x = std::to_string(10 + 11 * k), to = std::to_string(20 + 11 * k);
        steps += R"(, {"stroke": [[)" + x + ", 120], [" + to + R"(, 150]]}, {"times": ")" +
                 sandbox.in("strokes") + R"("}, {"wait": 0.1})" + between;
    }
    return steps + "]";
}

int lines_of(const std::string& path) {
    std::ifstream file(path);
    int lines = 0;
    for (std::string line; std::getline(file, line);)
        ++lines;
    return lines;
}

// Waits until so many strokes are finished. False: the editor ended before.
bool painted(const Sandbox& sandbox, pid_t pid, int strokes) {
    for (int k = 0; k < 2400 && lines_of(sandbox.in("strokes")) < strokes; ++k) {
        sleep_ms(50);
        if (has_ended(pid)) break;
    }
    return lines_of(sandbox.in("strokes")) >= strokes;
}

// The middle of every stroke that was finished a second before the end, in the last region.
void expect_strokes(const Project& project, const std::string& file, int finished) {
    ASSERT_EQ(project.regions.size(), 2u) << file;
    const auto& keys = project.regions.back()->matte->keyframes;
    ASSERT_EQ(keys.size(), 1u) << file;
    const std::string path = fs::path(file).parent_path() / keys.begin()->second.path;
    const auto matte = read_matte(path, {}, kPlate);
    ASSERT_TRUE(matte) << matte.error().text();
    for (int k = 0; k < finished; ++k)
        EXPECT_GT(matte->at(15 + 11 * k, 135), 128) << "stroke " << k << " in " << file;
}

// The one snapshot that the recovery would offer.
void expect_snapshot(const Sandbox& sandbox, int finished) {
    int snapshots = 0;
    for (const auto& entry :
         fs::directory_iterator(fs::path(sandbox.in("home")) / ".local/state/weft/recovery")) {
        const std::string name = entry.path().filename().string();
        if (entry.path().extension() != ".weft" || name.starts_with('.')) continue;
        ++snapshots;
        const auto project = load_project(entry.path().string());
        ASSERT_TRUE(project) << project.error().text();
        expect_strokes(*project, entry.path().string(), finished);
    }
    EXPECT_EQ(snapshots, 1);
}

// Every picture and project in a folder is whole; what has a leading dot is a file that was being
// written, which nobody takes for one.
void expect_whole_files(const fs::path& folder) {
    if (!fs::exists(folder)) return;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const fs::path& path = entry.path();
        if (!entry.is_regular_file() || path.filename().string().starts_with('.')) continue;
        if (path.extension() == ".png") {
            const auto picture = read_image(path.string());
            ASSERT_TRUE(picture) << picture.error().text();
            EXPECT_EQ(picture->rgb.size(), kPlate) << path;
        } else if (path.extension() == ".weft") {
            EXPECT_TRUE(load_project(path.string())) << path;
        }
    }
}

struct Started {
    pid_t pid = -1;
    bool ready = false;
};
Started start_painting(const Sandbox& sandbox, const std::string& script, int strokes) {
    std::ofstream(sandbox.in("script.json")) << script;
    Started out;
    out.pid = start(sandbox, without_library({"edit", "--script", sandbox.in("script.json"),
                                              "--size", "960x600"}));
    out.ready = painted(sandbox, out.pid, strokes);
    return out;
}

// Where nothing can be drawn there is nothing to kill; any other end is a failure.
void gave_up(const Sandbox& sandbox, pid_t pid) {
    ::kill(pid, SIGKILL);
    const Finished ended = finish(sandbox, pid);
    if (cannot_draw(ended)) GTEST_SKIP() << ended.errors;
    FAIL() << "The editor did not start painting: " << ended.errors;
}

// What is lost at most is a second's work.
int killed_later(const Sandbox& sandbox, pid_t pid) {
    const int finished = lines_of(sandbox.in("strokes"));
    sleep_ms(1000 + static_cast<int>(dice()() % 1200));
    ::kill(pid, SIGKILL);
    (void)finish(sandbox, pid);
    return finished;
}

TEST(Kill, FinishedStrokesSurviveWhilePainting) {
    for (int round = 0; round < WEFT_KILL_ROUNDS; ++round) {
        const Sandbox sandbox;
        make_shot(sandbox);
        const Started editor = start_painting(sandbox, painting(sandbox, ""), 3);
        if (!editor.ready) return gave_up(sandbox, editor.pid);
        const int finished = killed_later(sandbox, editor.pid);
        expect_snapshot(sandbox, finished);
    }
}

TEST(Kill, TheProjectIsOldOrNewWhileSaving) {
    for (int round = 0; round < WEFT_KILL_ROUNDS; ++round) {
        const Sandbox sandbox;
        make_shot(sandbox);
        const Started editor =
            start_painting(sandbox, painting(sandbox, R"(, {"key": "Ctrl+S"})"), 3);
        if (!editor.ready) return gave_up(sandbox, editor.pid);
        const int finished = killed_later(sandbox, editor.pid);
        expect_whole_files(sandbox.in(""));
        // A save comes after every stroke: the file holds them, whatever the snapshot says.
        const auto saved = load_project(sandbox.in("shot.weft"));
        ASSERT_TRUE(saved) << saved.error().text();
        expect_strokes(*saved, sandbox.in("shot.weft"), finished);
    }
}

// The render is a process of its own: it goes on, or dies at the same moment as the editor.
TEST(Kill, FramesAreWholeWhileRendering) {
    for (int round = 0; round < WEFT_KILL_ROUNDS; ++round) {
        const Sandbox sandbox;
        make_shot(sandbox);
        std::string script = painting(sandbox, "");
        const std::string submit =
            R"({"workspace": "Jobs"}, {"wait": 0.3}, {"click": "Render frames"}, )"
            R"({"workspace": "Mask"}, )";
        // Three strokes, the render, then strokes while it runs.
        std::size_t at = 0;
        for (int k = 0; k < 4; ++k)
            at = script.find(R"({"stroke")", at + 1);
        script.insert(at, submit);
        const Started editor = start_painting(sandbox, script, 4);
        if (!editor.ready) return gave_up(sandbox, editor.pid);
        const std::vector<pid_t> jobs = children_of(editor.pid);
        const int finished = killed_later(sandbox, editor.pid);
        const bool both = round % 2 == 0;
        for (const pid_t job : jobs)
            if (both) ::kill(job, SIGKILL);
        expect_snapshot(sandbox, finished);
        for (int k = 0; k < 1200 && !both; ++k) {
            if (std::none_of(jobs.begin(), jobs.end(), [](pid_t job) { return runs(job); })) break;
            sleep_ms(50);
        }
        expect_whole_files(sandbox.in(""));
        int frames = 0;
        const std::string folder = sandbox.in("shot_render_v001");
        if (fs::exists(folder))
            for (const auto& entry : fs::directory_iterator(folder))
                frames += entry.path().extension() == ".png" &&
                          !entry.path().filename().string().starts_with('.');
        if (!both && !jobs.empty()) {
            EXPECT_EQ(frames, kFrames) << "the render did not go on";
        }
    }
}

}  // namespace
}  // namespace weft::test
