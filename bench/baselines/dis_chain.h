#pragma once
// The least that any tool does which sticks a picture to a moving surface: the floor of its cost.

#include <memory>

#include "engine/core/image.h"

namespace weft {

/// Motion from frame to frame (OpenCV's DIS, preset medium), chained, and one bilinear lookup of a
/// picture that repeats, over the frame by its matte. It drifts, knows no light and has no soft
/// edges. Not thread-safe; OpenCV's own threads and instruction sets.
class DisChain {
  public:
    /// `first`: the frame on which the picture's top left corner lies at (0, 0), display codes.
    DisChain(ViewU8x3 first, ViewU8x3 picture);
    ~DisChain();
    DisChain(DisChain&&) noexcept;
    DisChain& operator=(DisChain&&) noexcept;

    /// The next frame, of the first one's size, with the picture over it. `matte`: H×W.
    [[nodiscard]] ImageU8x3 next(ViewU8x3 frame, ViewU8x1 matte);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace weft
