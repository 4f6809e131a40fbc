#pragma once
// Cryptomatte (Friedman & Jones 2015): pairs of a name's hash and its coverage in the layers of an
// EXR.

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
    std::string name;        ///< From the manifest; for an id without a name, its digits.
    std::uint32_t id = 0;    ///< The name's hash.
    double coverage_px = 0;  ///< Sum of its coverage over the frame.
};

/// The objects of the frame, by layer and then by size, the largest first. Errors: Unreadable (not
/// an EXR, no Cryptomatte in it).
[[nodiscard]] Expected<std::vector<CryptoObject>> list_cryptomatte(const std::string& path);

/// Combined coverage of the named objects, at the frame's display window. `names` is separated by
/// commas (engine/media/cryptomatte_selection.h); a name may be "LAYER/NAME", where LAYER is the
/// end of a layer's name, and may contain * for any text. An object that is not in the frame covers
/// nothing; check_cryptomatte_names() tells whether it is in any. Ids that PXR24 has rounded are
/// matched by what is left of them. Errors: Unreadable for a size other than `expected` (empty:
/// any), and for ids that have lost more than that.
[[nodiscard]] Expected<Matte> read_cryptomatte(const std::string& path, std::string_view names,
                                               Size expected);

/// Whether each of `names`, as above, is in one of the files at least: in a manifest, or by its
/// hash in a pixel. Reads no further than it must. Errors: Unreadable for a name that is in none,
/// listing what the first file has; for a file that cannot be read, MissingFrames or Unreadable.
[[nodiscard]] Status check_cryptomatte_names(const std::vector<std::string>& paths,
                                             std::string_view names);

/// The layer whose manifest in this file lists the first of `names` (as above); empty: none.
[[nodiscard]] std::string cryptomatte_layer(const std::string& path, std::string_view names);

/// `names` (as above), each that is listed in several layers of this file with the layer that
/// stands beside `beside`, as the plate's "shot.Combined" and "shot.CryptoObject" do. Unchanged if
/// there is none, and if the file cannot be read.
[[nodiscard]] std::string cryptomatte_names_beside(const std::string& path, std::string_view names,
                                                   std::string_view beside);

/// The object with the most coverage at pixel (x, y) of the display window, in the first layer; an
/// empty name if there is none. Errors: as list_cryptomatte(); Usage outside the picture.
[[nodiscard]] Expected<CryptoObject> pick_cryptomatte(const std::string& path, int x, int y);

/// The manifest files that the file at `path` names, beside it; empty if there is no such file or
/// it is not an EXR.
[[nodiscard]] std::vector<std::string> cryptomatte_manifest_files(const std::string& path);

/// Reads a manifest: one flat JSON object of name → id in 8 hexadecimal digits. Safe for hostile
/// text. Errors: Unreadable.
[[nodiscard]] Expected<std::map<std::string, std::uint32_t>> parse_cryptomatte_manifest(
    std::string_view text);

/// The specification's MurmurHash3 (32 bit) of a name, with its exponent kept from 0 and 255 so
/// that the bits are an ordinary float.
[[nodiscard]] std::uint32_t cryptomatte_id(std::string_view name);

}  // namespace weft
