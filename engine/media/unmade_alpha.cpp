#include "engine/media/unmade_alpha.h"

#include <cstddef>
#include <variant>

namespace weft {

void drop_unmade_alpha(Raster& raster) {
    if (!raster.has_alpha) return;
    const auto wide = static_cast<std::size_t>(raster.channels), colors = wide - 1;
    std::visit(
        [&](auto& samples) {
            for (std::size_t i = colors; i < samples.size(); i += wide)
                if (samples[i] != 0) return;
            std::size_t to = 0;
            for (std::size_t i = 0; i < samples.size(); ++i)
                if (i % wide != colors) samples[to++] = samples[i];
            samples.resize(to);
            raster.has_alpha = false;
            raster.channels = static_cast<int>(colors);
        },
        raster.samples);
}

}  // namespace weft
