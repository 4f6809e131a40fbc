// Where XInput 2 is not there, a pen is a mouse.
#include "app/editor/pen.h"

namespace weft {

std::unique_ptr<PenSource> open_pen() {
    return nullptr;
}

}  // namespace weft
