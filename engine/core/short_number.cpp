#include "engine/core/short_number.h"

#include <fmt/format.h>

namespace weft {

std::string short_number(double value, int decimals) {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    const std::size_t last = text.find_last_not_of('0');
    text.resize(text[last] == '.' ? last : last + 1);
    return text == "-0" ? "0" : text;
}

}  // namespace weft
