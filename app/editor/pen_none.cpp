// Without XInput 2, a pen acts as a mouse.
#include "app/editor/pen.h"

namespace weft {

std::unique_ptr<PenSource> open_pen() {
    return nullptr;
}

}  // namespace weft
