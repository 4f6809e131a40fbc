#include "engine/mask/matte_box.h"

#include <algorithm>

namespace weft {

Recti matte_box(ViewU8x1 matte, std::uint8_t least) {
    Recti out{};
    for (int y = 0; y < matte.height(); ++y) {
        const auto* row = matte.row(y);
        const auto* const end = row + matte.width();
        const auto inside = [least](std::uint8_t v) { return v >= least; };
        const auto* const first = std::find_if(row, end, inside);
        if (first == end) continue;
        const auto* last = end;
        while (!inside(last[-1]))
            --last;
        out = out.united({static_cast<int>(first - row), y, static_cast<int>(last - row), y + 1});
    }
    return out;
}

}  // namespace weft
