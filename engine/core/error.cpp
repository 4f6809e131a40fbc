#include "engine/core/error.h"

namespace weft {

std::string Error::sentence() const {
    if (remedy.empty()) return message;
    return message + (message.ends_with('.') ? " " : "; ") + remedy;
}

std::string Error::text() const {
    std::string out;
    for (auto it = context.rbegin(); it != context.rend(); ++it)
        out += *it + ": ";
    return out + sentence();
}

}  // namespace weft
