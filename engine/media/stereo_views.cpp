#include "engine/media/stereo_views.h"

#include <algorithm>

#include "engine/core/text.h"

namespace weft {
namespace {

bool is_view(std::string_view name, const std::vector<std::string>& views) {
    if (views.empty()) return same_ignoring_case(name, "left") || same_ignoring_case(name, "right");
    return std::any_of(views.begin(), views.end(),
                       [&](const std::string& view) { return same_ignoring_case(name, view); });
}

}  // namespace

ViewName split_view(std::string_view name, const std::vector<std::string>& views) {
    ViewName out;
    for (const std::string_view piece : split(name, '.')) {
        if (out.view.empty() && is_view(piece, views)) {
            out.view = piece;
            continue;
        }
        if (!out.pass.empty()) out.pass += '.';
        out.pass += piece;
    }
    return out;
}

std::string_view render_of(std::string_view pass) {
    return pass.substr(0, pass.rfind('.') + 1);
}

}  // namespace weft
