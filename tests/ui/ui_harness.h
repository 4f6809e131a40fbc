#pragma once
// The real panels without a window: ImGui with no renderer, a session on a small shot, a robot
// hand.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/session/session.h"
#include "ui/shell/robot.h"

namespace weft::test {

/// Takes what the panels would draw and shows nothing.
class NoPictures final : public PictureHost {
  public:
    [[nodiscard]] ImTextureID texture(const PicturePtr&) override { return nullptr; }
    void draw(ImDrawList&, const PictureDraw& draw) override { pictures.push_back(draw); }
    void draw(ImDrawList&, const MatteDraw& draw) override {
        ++mattes;
        if (on_matte) on_matte(draw);
    }
    void set_clipboard(const std::string& text) override { clipboard = text; }
    void reveal(const std::string& path) override { revealed = path; }
    void toggle_fullscreen() override {}
    std::vector<PictureDraw> pictures;
    int mattes = 0;
    std::function<void(const MatteDraw&)> on_matte;  ///< Its pixels hold during the call.
    std::string clipboard, revealed;
};

/// Panels on a view that the test makes; actions are only collected.
class PanelTest : public ::testing::Test {
  protected:
    void SetUp() override;
    void TearDown() override;
    void frame();
    /// The actions of one kind that were emitted since the last call of clear().
    template <class T>
    [[nodiscard]] std::vector<T> emitted() const {
        std::vector<T> out;
        for (const Action& action : actions)
            if (const T* one = std::get_if<T>(&action)) out.push_back(*one);
        return out;
    }
    void clear() { actions.clear(); }

    SessionView view;
    EditorSettings settings;
    NoPictures pictures;
    std::unique_ptr<Shell> shell;
    std::unique_ptr<Robot> robot;
    std::vector<Action> actions;
    ImVec2 size{1600, 900};
};

/// A view of a shot with two regions, as panels get it when all is well.
[[nodiscard]] SessionView normal_view();
/// Everything that can fail has failed.
[[nodiscard]] SessionView failing_view();
/// A thousand frames, sixty regions, long names, forty jobs.
[[nodiscard]] SessionView huge_view();

/// The real session on a shot of a few small frames on disk, driven through the panels.
class SessionTest : public ::testing::Test {
  protected:
    void SetUp() override;
    void TearDown() override;
    void frame();
    /// Draws frames until `done`, or three minutes of patience are over.
    template <class Done>
    [[nodiscard]] bool wait(Done&& done) {
        // Workers give way to everything else on the machine, so this may take long on a busy one.
        const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(3);
        // Not asked again once it was so: it may have passed.
        while (!done()) {
            if (std::chrono::steady_clock::now() > end) return false;
            frame();
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return true;
    }
    void restart_session(const std::string& texture_library = {});
    /// Middle of a plate pixel on the screen.
    [[nodiscard]] ImVec2 at(float x, float y) const;

    std::filesystem::path folder;
    EditorSettings settings;
    NoPictures pictures;
    std::unique_ptr<Session> session;
    std::unique_ptr<Shell> shell;
    std::unique_ptr<Robot> robot;
    double now_s = 0;
};

}  // namespace weft::test
