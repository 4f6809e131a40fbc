#pragma once

namespace weft {

/// i modulo n, from 0 to n − 1 for negative i too. n > 0.
[[nodiscard]] constexpr int wrapped(int i, int n) {
    i %= n;
    return i < 0 ? i + n : i;
}

}  // namespace weft
