// The command line's own parsers: the first byte chooses one.
#include <cstdlib>
#include <string>

#include "app/base/path_map.h"
#include "app/project/parameters.h"
#include "app/render/memory_plan.h"
#include "app/render/version_up.h"
#include "engine/core/frame_range.h"
#include "engine/form/form_guide.h"
#include "engine/lighting/lamp.h"
#include "engine/media/sequence_pattern.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, unsigned long size) {
    if (size < 2) return 0;
    const std::string text(reinterpret_cast<const char*>(data + 2),
                           static_cast<std::size_t>(size - 2));
    switch (data[0] % 8) {
        case 0:
            if (const auto frames = weft::parse_frame_list(text)) {
                const auto again = weft::parse_frame_list(weft::format_frame_list(*frames));
                if (!frames->empty() && (!again || *again != *frames)) std::abort();
            }
            break;
        case 1:
            if (const auto pattern = weft::SequencePattern::parse(text)) {
                const std::string path = pattern->path_for(static_cast<int>(data[1]) - 100);
                if (!pattern->is_single() &&
                    pattern->frame_of(path) != static_cast<int>(data[1]) - 100)
                    std::abort();
            }
            break;
        case 2:
            static_cast<void>(weft::parse_bytes(text));
            break;
        case 3:
            static_cast<void>(weft::parse_root_map(text));
            break;
        case 4: {
            weft::MatteSource matte;
            static_cast<void>(weft::add_matte_text(matte, text));
            break;
        }
        case 5:
            static_cast<void>(weft::parse_lamps(text));
            if (const auto guides = weft::parse_form_guides(text))
                for (const weft::FormGuide& guide : *guides)
                    static_cast<void>(weft::check_form_guide(guide));
            static_cast<void>(weft::parse_keyed_numbers(text, 2));
            break;
        case 6: {
            const auto table = weft::region_parameters();
            weft::Region region;
            static_cast<void>(
                weft::set_parameter_text(region, table[data[1] % table.size()], text));
            break;
        }
        default:
            static_cast<void>(weft::version_in(text));
            break;
    }
    return 0;
}
