#include "app/project/matte_parameters.h"

#include <limits>

#include "app/project/parameter_entry.h"

namespace weft {
namespace {

using namespace parameter_entry;

/// Path: member pointers to the MatteSource inside Owner; empty if Owner is one.
template <class Owner, auto... Path>
std::vector<Parameter<Owner>> matte_entries() {
    return {
        entry<Owner, Path..., &MatteSource::files>(
            {.group = "matte",
             .key = "files",
             .help = "Pattern of a matte for every frame, instead of keyframes",
             .is_path = true}),
        entry<Owner, Path..., &MatteSource::select, &MatteSelect::value>(
            {.group = "matte",
             .key = "value",
             .flag = "--matte-value",
             .help = "Id matte: the pixels with this value",
             .min = 0,
             .max = std::numeric_limits<std::int32_t>::max(),
             .optional = true}),
        entry<Owner, Path..., &MatteSource::select, &MatteSelect::channel>(
            {.group = "matte",
             .key = "channel",
             .flag = "--matte-channel",
             .help = "R, G, B, A, Y (luma) or a name; default A unless it is opaque, then Y"}),
        entry<Owner, Path..., &MatteSource::select, &MatteSelect::invert>(
            {.group = "matte",
             .key = "invert",
             .flag = "--matte-invert",
             .help = "The surface is black in the matte"}),
        entry<Owner, Path..., &MatteSource::select, &MatteSelect::crypto>(
            {.group = "matte",
             .key = "crypto",
             .help = "Objects of a Cryptomatte, separated by commas"}),
        entry<Owner, Path..., &MatteSource::steadiness>(
            {.group = "matte",
             .key = "steadiness",
             .flag = "--matte-stabilize",
             .old_flag = "--matte-steadiness",
             .help = "Reduction of edge boil in propagated mattes",
             .min = 0,
             .max = 1}),
        entry<Owner, Path..., &MatteSource::frozen>(
            {.group = "matte",
             .key = "frozen",
             .flag = "--matte-frozen",
             .help = "Frozen frames: read from the frozen files, not changed, used as keyframes",
             .min = -kMaxFrame,
             .max = kMaxFrame,
             .repeatable = true}),
        entry<Owner, Path..., &MatteSource::frozen_files>(
            {.group = "matte",
             .key = "frozen_files",
             .flag = "--matte-frozen-files",
             .help = "Pattern of the frozen frames' mattes, written without edge tools",
             .is_path = true}),
        entry<Owner, Path..., &MatteSource::propagate_direction>(
            {.group = "matte",
             .key = "carry",
             .flag = "--matte-propagate",
             .old_flag = "--matte-carry",
             .help = "Direction in which painted mattes are propagated"}),
        entry<Owner, Path..., &MatteSource::propagate_from>(
            {.group = "matte",
             .key = "carry_from",
             .flag = "--matte-from",
             .help = "First frame of propagation; there is no matte before it",
             .min = -kMaxFrame,
             .max = kMaxFrame,
             .optional = true}),
        entry<Owner, Path..., &MatteSource::propagate_to>(
            {.group = "matte",
             .key = "carry_to",
             .flag = "--matte-to",
             .help = "Last frame of propagation; there is no matte after it",
             .min = -kMaxFrame,
             .max = kMaxFrame,
             .optional = true}),
    };
}

// Its edge tools.
template <class Owner, auto... Path>
std::vector<Parameter<Owner>> edge_entries() {
    using E = MatteEdgeParams;
    constexpr double kMostPx = 200, kMostArea = 1e8;
    return {
        entry<Owner, Path..., &E::min_island_px>({.group = "matte",
                                                  .key = "min_island_px",
                                                  .flag = "--matte-min-island",
                                                  .unit = "px",
                                                  .help = "Islands of fewer pixels are removed",
                                                  .min = 0,
                                                  .max = kMostArea}),
        entry<Owner, Path..., &E::min_hole_px>({.group = "matte",
                                                .key = "min_hole_px",
                                                .flag = "--matte-min-hole",
                                                .unit = "px",
                                                .help = "Holes of fewer pixels are filled",
                                                .min = 0,
                                                .max = kMostArea}),
        entry<Owner, Path..., &E::smooth_px>(
            {.group = "matte",
             .key = "smooth_px",
             .flag = "--matte-smooth",
             .unit = "px",
             .help = "Smooths the outline; corners and notches below this size go",
             .min = 0,
             .max = 50}),
        entry<Owner, Path..., &E::choke_px>({.group = "matte",
                                             .key = "choke_px",
                                             .flag = "--matte-choke",
                                             .unit = "px",
                                             .help = "Grows the matte, below 0 shrinks it",
                                             .min = -kMostPx,
                                             .max = kMostPx}),
        entry<Owner, Path..., &E::choke_keys>(
            {.group = "matte",
             .key = "choke_keys",
             .flag = "--matte-choke-keys",
             .unit = "px",
             .help = "Animated choke: FRAME:PX, separated by spaces",
             .min = -kMostPx,
             .max = kMostPx}),
        entry<Owner, Path..., &E::feather_px>(
            {.group = "matte",
             .key = "feather_px",
             .flag = "--matte-feather",
             .unit = "px",
             .help = "Softens the edge over this length outwards, below 0 inwards",
             .min = -kMostPx,
             .max = kMostPx}),
        entry<Owner, Path..., &E::feather_keys>(
            {.group = "matte",
             .key = "feather_keys",
             .flag = "--matte-feather-keys",
             .unit = "px",
             .help = "Animated feather: FRAME:PX, separated by spaces",
             .min = -kMostPx,
             .max = kMostPx}),
        entry<Owner, Path..., &E::blur_px>({.group = "matte",
                                            .key = "blur_px",
                                            .flag = "--matte-blur",
                                            .unit = "px",
                                            .help = "Blurs the matte; deviation of the Gaussian",
                                            .min = 0,
                                            .max = kMostPx}),
        entry<Owner, Path..., &E::blur_keys>(
            {.group = "matte",
             .key = "blur_keys",
             .flag = "--matte-blur-keys",
             .unit = "px",
             .help = "Animated blur: FRAME:PX, separated by spaces",
             .min = 0,
             .max = kMostPx}),
    };
}

template <class Owner, auto... Path>
std::vector<Parameter<Owner>> all_entries() {
    auto table = matte_entries<Owner, Path...>();
    for (Parameter<Owner>& p : edge_entries<Owner, Path..., &MatteSource::edge>())
        table.push_back(std::move(p));
    return table;
}

}  // namespace

std::vector<Parameter<Region>> region_matte_parameters() {
    return all_entries<Region, &Region::matte>();
}

std::span<const Parameter<MatteSource>> matte_parameters() {
    static const std::vector<Parameter<MatteSource>> table = all_entries<MatteSource>();
    return table;
}

}  // namespace weft
