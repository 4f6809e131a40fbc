#include "engine/core/error.h"

namespace weft {

std::string Error::text() const {
    std::string out;
    for (auto it = context.rbegin(); it != context.rend(); ++it)
        out += *it + ": ";
    return out + message;
}

}  // namespace weft
