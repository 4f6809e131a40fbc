#pragma once
// A random walk through the editor, and its replay at leisure: what is left must be the same.

#include <string>
#include <vector>

#include "tests/ui/ui_harness.h"

namespace weft::test {

struct WalkStep {
    enum class Kind {
        kStroke,
        kUndo,
        kRedo,
        kFrame,
        kRegion,
        kJob,
        kWindow,
        kSetting,
        kRefine,
        kReopen
    };
    Kind kind = Kind::kStroke;
    std::vector<Vec2> line;  ///< Of a stroke, as shares of the picture.
    bool subtract = false;
    int number = 0;  ///< A frame's index, a region's, a size's; a setting's value in hundredths.
};

/// Undoing never goes behind what the walk began with.
[[nodiscard]] std::vector<WalkStep> random_walk(unsigned seed, int steps, int frames);

/// A shot of a moving patch with two regions, a keyframe on every frame of each.
class WalkTest : public SessionTest {
  protected:
    /// Opens a shot of its own in `name` and paints what the walk begins with.
    void begin(const std::string& name, Size size, int frames);
    /// `leisurely`: waits after each step for all that it has begun.
    void walk(const std::vector<WalkStep>& steps, bool leisurely);
    /// The document in words: its project without the names of matte files, and their pixels.
    [[nodiscard]] std::string document();

  private:
    void take(const WalkStep& step);
    void reopen();
    void settle();
    [[nodiscard]] Vec2 place(Vec2 share) const;

    std::string project_;
    Size size_;
};

}  // namespace weft::test
