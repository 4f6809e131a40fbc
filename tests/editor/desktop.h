#pragma once
// A virtual screen, with the mouse and the keyboard before it.

#include <gtest/gtest.h>
#include <sys/types.h>

#include <chrono>
#include <functional>
#include <map>
#include <string>

#include "tests/editor/program.h"

namespace weft::test {

void rest(double seconds);
/// Until it holds, looking every half second. False: it never did.
bool wait_until(const std::function<bool()>& holds, double patience_s);

/// Xvfb and xdotool; a test without them is skipped.
class Desktop : public ::testing::Test {
  protected:
    void SetUp() override;
    [[nodiscard]] virtual std::string screen() const { return "1600x900"; }
    void TearDown() override;
    int tool(const std::string& arguments) const;
    /// What the tool prints.
    [[nodiscard]] std::string answer(const std::string& arguments) const;
    [[nodiscard]] bool wait_for_window() const;
    /// Without a window manager nobody else gives the window the keyboard.
    void focus() const;
    /// Pressed and released at once: the software renderer draws few frames a second, and none of
    /// it may be lost.
    void press(const std::string& chord) const;
    void click(int x, int y, int times = 1) const;
    /// With WEFT_DESKTOP_SHOTS in the environment: a picture of the screen into that folder.
    void picture(const std::string& name) const;

    Sandbox sandbox_;
    std::string display_;
    pid_t server_ = -1;
};

}  // namespace weft::test
