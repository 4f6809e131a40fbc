#pragma once
// Everything of a region that has keys over time, row by row as a dope sheet shows it, and what an
// artist does to these keys. All functions are pure; region_edits() makes edits of the difference.

#include <compare>
#include <cstddef>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "app/project/project.h"

namespace weft {

enum class KeyRowKind : std::uint8_t {
    kMatte,       ///< Painted mattes of `layer`.
    kShape,       ///< The roto shape over time of `layer`.
    kReference,   ///< Reference frames.
    kCorrection,  ///< Pins.
    kNumbers,     ///< The parameter `key`.
    kLamp,        ///< The lamp of number `layer`.
    kZoneValue,   ///< The value of the zone of number `layer`.
    kMatteEdge,   ///< The edge setting `key` of the matte of `layer`.
    kWarp         ///< Points of the grid warp.
};

/// A row. `layer` of mattes, their edges and shapes: 0 the region's own, k its holdout k − 1, −1 −
/// k its zone k.
struct KeyRowId {
    KeyRowKind kind = KeyRowKind::kNumbers;
    int layer = 0;
    std::string key = {};  ///< Of region_parameters(): "placement.scale_keys", "matte.choke_keys".
    auto operator<=>(const KeyRowId&) const = default;  // NOLINT(modernize-use-nullptr)
};

struct KeyMark {
    int frame = 0;
    KeyInterpolation after = KeyInterpolation::kLinear;  ///< Of numbers.
    bool between = false;  ///< A shape that was interpolated between others.
};

struct KeyRow {
    KeyRowId id;
    std::vector<KeyMark> keys;  ///< By frame, ascending; at least one.
};

/// The rows of a region that have keys, in the order in which they are shown.
[[nodiscard]] std::vector<KeyRow> key_rows(const Region& region);

/// One key.
struct KeyRef {
    KeyRowId row;
    int frame = 0;
    auto operator<=>(const KeyRef&) const = default;  // NOLINT(modernize-use-nullptr)
};
using KeySet = std::set<KeyRef>;

/// The numbers of a row; null for rows of other kinds and rows that the region does not have.
[[nodiscard]] const KeyedNumbers* numbers_of(const Region& region, const KeyRowId& row);
/// The same numbers in a parameter's table entry: their range; unlimited for lamps.
struct NumberRange {
    double min = 0, max = 0;
};
[[nodiscard]] NumberRange range_of(const KeyRowId& row);

/// Keys moved by whole frames, all together. One that arrives on another key replaces it.
[[nodiscard]] Region with_keys_moved(const Region& region, const KeySet& keys, int by);
/// Without these keys; a holdout or zone that has no matte left is removed too.
[[nodiscard]] Region without_keys(const Region& region, const KeySet& keys);
/// The way from these keys to the next ones. Rows without numbers are left as they are.
[[nodiscard]] Region with_interpolation(const Region& region, const KeySet& keys,
                                        KeyInterpolation after);
/// One of the numbers of a key, limited to its range. Nothing happens without such a key.
[[nodiscard]] Region with_key_value(const Region& region, const KeyRef& key, std::size_t which,
                                    double value);

/// What a key holds. An order is the place of a reference frame among them.
using KeyContent = std::variant<std::size_t, NumberKey, MatteKeyframe, RotoShape,
                                std::vector<CorrectionPin>, std::vector<WarpPoint>>;
struct CopiedKey {
    KeyRef key;
    KeyContent content;
};
[[nodiscard]] std::vector<CopiedKey> copied_keys(const Region& region, const KeySet& keys);
struct PastedKeys {
    Region region;
    KeySet keys;  ///< As they are now.
};
/// The keys in the same rows, the earliest of them on `frame`. Keys of holdouts, zones and lamps
/// that the region does not have, and shapes and warps with another number of points, are left out.
[[nodiscard]] PastedKeys with_keys_pasted(const Region& region, const std::vector<CopiedKey>& keys,
                                          int frame);

}  // namespace weft
