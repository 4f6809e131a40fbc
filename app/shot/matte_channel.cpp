#include "app/shot/matte_channel.h"

#include "app/exchange/region_matte_sources.h"
#include "engine/media/image_files.h"
#include "engine/media/sequence_files.h"

namespace weft {

void choose_matte_channels(Region& region, const std::vector<int>& frames) {
    change_matte_sources(region, [&](MatteSource& matte) {
        const MatteSelect& select = matte.select;
        if (matte.files.empty() || !select.channel.empty() || !select.crypto.empty() ||
            select.value)
            return;
        const auto pattern = SequencePattern::parse(matte.files);
        if (!pattern || pattern->is_single()) return;
        matte.select.channel = channel_of_mattes(existing_files(*pattern, frames));
    });
}

}  // namespace weft
