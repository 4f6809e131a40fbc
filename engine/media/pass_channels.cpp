#include "engine/media/pass_channels.h"

#include <utility>
#include <variant>

#include "engine/media/raster.h"
#include "engine/media/raster_errors.h"

namespace weft {

Expected<std::vector<float>> read_pass_channel(const std::string& path, const std::string& channel,
                                               std::string_view pass, Size& size) {
    WEFT_TRY(raster, read_raster(path, {{}, channel, false}));
    size = raster.info.size;
    auto* samples = std::get_if<std::vector<float>>(&raster.samples);
    if (!samples) {
        const std::string name(pass);
        return tl::unexpected(unreadable(path, "its " + name + " is not in half or float",
                                         "Render the " + name + " pass as EXR."));
    }
    return std::move(*samples);
}

std::string list_of(const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names)
        list += (list.empty() ? "" : ", ") + name;
    return list;
}

}  // namespace weft
