#pragma once
// A session on a small shot on disk, driven by actions only.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "app/base/background.h"
#include "app/render/render_job.h"
#include "app/session/session.h"
#include "engine/media/frame_writer.h"
#include "engine/media/image_files.h"

namespace weft::test {

namespace fs = std::filesystem;

class SessionByActions : public ::testing::Test {
  protected:
    void SetUp() override {
        keep_thread_priority();
        make_libraries_deterministic();
        folder_ = fs::temp_directory_path() / ("weft_session_" + std::to_string(getpid()));
        write_shot("frames");
        ImageF3 tile(96, 96, 0.4f);
        for (int y = 0; y < 96; ++y)
            for (int x = 0; x < 96; ++x)
                tile.pixel(x, y)[0] = static_cast<float>((x * 7 + y * 13) % 32) / 32.0f;
        ASSERT_TRUE(write_image(in("tile.png"), tile, {}, {}));
    }
    void TearDown() override {
        session_.reset();
        fs::remove_all(folder_);
    }
    // Four frames of a moving patch.
    void write_shot(const std::string& folder) {
        fs::create_directories(in(folder));
        for (int k = 0; k < 4; ++k) {
            ImageF3 plate(96, 64, 0.2f);
            for (int y = 16; y < 48; ++y)
                for (int x = 24 + k; x < 64 + k; ++x)
                    plate.pixel(x, y)[0] = 0.5f + static_cast<float>((x - k + y) % 7) / 35.0f;
            ASSERT_TRUE(
                write_image(in(folder + "/000" + std::to_string(k + 1) + ".png"), plate, {}, {}));
        }
    }
    void open() {
        SessionOptions options;
        options.program = "/bin/false";
        options.state_folder = in("state");
        options.cache.folder = in("cache");
        options.trust_file = in("trusted.json");
        session_ = std::make_unique<Session>(options);
        act(OpenAny{in("frames")});
        ASSERT_TRUE(wait([&] { return view().plate_picture != nullptr; }));
        Region wall;
        wall.name = "wall";
        act(DoEdit{AddRegion{wall, {}}});
        update();
    }
    static Brush pen() {
        Brush out;
        out.radius_px = 8;
        out.hardness = 1;
        return out;
    }
    void paint() {
        act(BeginStroke{pen(), {30, 30}, 1});
        act(ContinueStroke{{50, 34}, 1});
        act(EndStroke{});
        update();
    }
    [[nodiscard]] std::string in(const std::string& name) const {
        return (folder_ / name).string();
    }
    void act(const Action& action) { session_->act(action); }
    void update() { session_->update(now_s_ += 1.0 / 60); }
    [[nodiscard]] const SessionView& view() const { return session_->view(); }
    [[nodiscard]] const Region& region() const { return *view().project.regions.back(); }
    template <class Done>
    bool wait(Done&& done) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
        while (!done()) {
            if (std::chrono::steady_clock::now() > end) return false;
            update();
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        return true;
    }

    fs::path folder_;
    std::unique_ptr<Session> session_;
    double now_s_ = 0;
};

}  // namespace weft::test
