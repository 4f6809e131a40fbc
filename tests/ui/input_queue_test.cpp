// No event between two frames is lost, and each keeps its position.
#include "ui/input/input_queue.h"

#include <gtest/gtest.h>

namespace weft::test {
namespace {

class Queue : public ::testing::Test {
  protected:
    void SetUp() override {
        ImGui::CreateContext();
        io = &ImGui::GetIO();
        io->IniFilename = nullptr;
        io->DisplaySize = {400, 300};
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io->Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
    }
    void TearDown() override { ImGui::DestroyContext(); }
    // Frames are far apart: 4 a second.
    void frame() {
        if (begun) ImGui::EndFrame();
        io->DeltaTime = 0.25f;
        queue.feed(*io);
        ImGui::NewFrame();
        begun = true;
    }

    InputQueue queue;
    ImGuiIO* io = nullptr;
    bool begun = false;
    static constexpr int kF6 = 295, kControl = 341, kEnter = 257;
};

TEST_F(Queue, AKeyPressedAndReleasedBetweenFramesIsSeen) {
    queue.key(kF6, true);
    queue.key(kF6, false);
    frame();
    EXPECT_TRUE(ImGui::IsKeyPressed(kF6, false));
    EXPECT_TRUE(queue.pending());
    frame();
    EXPECT_FALSE(ImGui::IsKeyDown(kF6));
    EXPECT_FALSE(queue.pending());
}

TEST_F(Queue, ThreePressesAreThree) {
    int pressed = 0;
    for (int k = 0; k < 3; ++k) {
        queue.key(kF6, true);
        queue.key(kF6, false);
    }
    for (int k = 0; k < 8; ++k) {
        frame();
        pressed += ImGui::IsKeyPressed(kF6, false) ? 1 : 0;
    }
    EXPECT_EQ(pressed, 3);
}

TEST_F(Queue, AChordKeepsItsModifier) {
    queue.key(kControl, true);
    queue.key('S', true);
    queue.key('S', false);
    queue.key(kControl, false);
    frame();
    EXPECT_TRUE(ImGui::IsKeyPressed('S', false));
    EXPECT_TRUE(io->KeyCtrl);
    frame();
    frame();
    EXPECT_FALSE(io->KeyCtrl);
    EXPECT_FALSE(ImGui::IsKeyDown('S'));
}

TEST_F(Queue, AClickKeepsItsPosition) {
    queue.move({10, 20});
    queue.button(0, true, 1.0);
    queue.button(0, false, 1.05);
    queue.move({200, 100});
    frame();
    EXPECT_TRUE(ImGui::IsMouseClicked(0));
    EXPECT_EQ(io->MousePos.x, 10);
    frame();
    EXPECT_TRUE(ImGui::IsMouseReleased(0));
    EXPECT_EQ(io->MousePos.x, 10);
    frame();
    EXPECT_EQ(io->MousePos.x, 200);
}

TEST_F(Queue, ADoubleClickIsTimedByItsEvents) {
    queue.move({10, 20});
    for (const double at : {1.0, 1.15}) {
        queue.button(0, true, at);
        queue.button(0, false, at + 0.05);
    }
    int twice = 0;
    for (int k = 0; k < 5; ++k) {
        frame();
        twice += ImGui::IsMouseDoubleClicked(0) ? 1 : 0;
    }
    EXPECT_EQ(twice, 1);
    // Slow clicks are not a double click, however few frames there were.
    for (const double at : {5.0, 6.0}) {
        queue.button(0, true, at);
        queue.button(0, false, at + 0.05);
    }
    for (int k = 0; k < 5; ++k) {
        frame();
        EXPECT_FALSE(ImGui::IsMouseDoubleClicked(0));
    }
}

TEST_F(Queue, AStrokeKeepsItsPath) {
    queue.move({10, 10});
    queue.button(0, true, 1.0);
    for (int k = 1; k <= 5; ++k)
        queue.move({10.0f + static_cast<float>(k), 10});
    queue.button(0, false, 1.2);
    frame();
    EXPECT_TRUE(ImGui::IsMouseClicked(0));
    EXPECT_TRUE(queue.path().empty());
    frame();
    EXPECT_EQ(queue.path().size(), 5u);
    EXPECT_TRUE(ImGui::IsMouseReleased(0));
}

TEST_F(Queue, TextComesBeforeTheKeyThatEndsIt) {
    queue.key('A', true);
    queue.character('a');
    queue.key('A', false);
    queue.key(kEnter, true);
    frame();
    EXPECT_EQ(io->InputQueueCharacters.Size, 1);
    EXPECT_FALSE(ImGui::IsKeyDown(kEnter));
    io->InputQueueCharacters.resize(0);
    frame();
    frame();
    EXPECT_TRUE(ImGui::IsKeyDown(kEnter));
}

TEST_F(Queue, LosingFocusReleasesAllKeys) {
    queue.key('S', true);
    queue.button(0, true, 1);
    frame();
    frame();
    queue.release_all();
    for (int k = 0; k < 3; ++k)
        frame();
    EXPECT_FALSE(ImGui::IsKeyDown('S'));
    EXPECT_FALSE(ImGui::IsMouseDown(0));
}

}  // namespace
}  // namespace weft::test
