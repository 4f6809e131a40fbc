#pragma once
// Cryptomatte (Friedman & Jones 2015): pairs of a name's hash and its coverage in an EXR's layers.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"

namespace weft {

struct CryptoObject {
    std::string layer;       ///< "ViewLayer.CryptoObject"
    std::string name;        ///< By the manifest; of one that is not in it, its id in digits.
    std::uint32_t id = 0;    ///< The name's hash.
    double coverage_px = 0;  ///< Sum of its coverage over the frame.
};

/// What the frame shows, by layer and, within one, the largest first. Errors: Unreadable (no EXR,
/// no Cryptomatte in it).
[[nodiscard]] Expected<std::vector<CryptoObject>> list_cryptomatte(const std::string& path);

/// Coverage of the named objects together, at the frame's display window. `names` is a list by
/// commas; one may be "LAYER/NAME", where LAYER is the end of a layer's name, and may have * for
/// anything. Errors: Unreadable, listing what there is, when a name is nowhere; a size other than
/// `expected` (empty: any).
[[nodiscard]] Expected<Matte> read_cryptomatte(const std::string& path, std::string_view names,
                                               Size expected);

/// What covers most of pixel (x, y) of the display window, in the first layer; an empty name where
/// nothing does. Errors: as list_cryptomatte(); Usage outside of the picture.
[[nodiscard]] Expected<CryptoObject> pick_cryptomatte(const std::string& path, int x, int y);

/// The manifests that lie beside the file at `path` and that it names; none when there is no such
/// file or it is not an EXR.
[[nodiscard]] std::vector<std::string> cryptomatte_manifest_files(const std::string& path);

/// A manifest: one flat JSON object of name → id in 8 hexadecimal digits. Hostile text is an error,
/// never a crash. Errors: Unreadable.
[[nodiscard]] Expected<std::map<std::string, std::uint32_t>> parse_cryptomatte_manifest(
    std::string_view text);

/// The specification's MurmurHash3 (32 bit) of a name, its exponent kept from 0 and 255 so that the
/// bits are an ordinary float.
[[nodiscard]] std::uint32_t cryptomatte_id(std::string_view name);

}  // namespace weft
