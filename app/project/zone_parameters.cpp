#include "app/project/parameter_entry.h"

namespace weft {

using parameter_entry::entry;

std::span<const Parameter<Zone>> zone_parameters() {
    static const std::vector<Parameter<Zone>> table{
        entry<Zone, &Zone::kind>({.key = "kind", .help = "What the zone changes"}),
        entry<Zone, &Zone::value>(
            {.key = "value",
             .help =
                 "Inside the zone; of light: how much of it the texture takes; of detail: 0 paint "
                 "to 1 light; of motion: how far, 0 to 1",
             .min = 0,
             .max = 2}),
        entry<Zone, &Zone::value_keys>({.key = "value_keys",
                                        .help = "Animated value: FRAME:VALUE, separated by spaces",
                                        .min = 0,
                                        .max = 2}),
    };
    return table;
}

}  // namespace weft
