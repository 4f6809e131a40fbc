#pragma once
// Converts between JSON values and the document. Internal to this folder; no other header of
// app/project names the JSON library.

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "app/project/leaf.h"
#include "app/project/parameters.h"
#include "app/project/project.h"
#include "engine/core/error.h"

namespace weft::json_codec {

using Json = nlohmann::json;  // sorted keys: unknown keys are written in a fixed order
using OrderedJson = nlohmann::ordered_json;  // keys in writing order, for readable files

/// Parses JSON text. Errors: Unreadable with line and column, or the reason.
[[nodiscard]] Expected<Json> parse(std::string_view text);

/// Formats with an indent of two spaces and a final line break; equal values give equal bytes on
/// every machine. Errors: Usage when a string is not UTF-8 (paths may be any bytes, JSON may not).
[[nodiscard]] Expected<std::string> to_text(const OrderedJson& value);

/// An error that begins with its place: "regions[0].placement.scale: …"; an empty path means the
/// whole document. The second keeps an error's sentence and its remedy.
[[nodiscard]] tl::unexpected<Error> fail_at(const std::string& path, std::string message,
                                            std::string remedy = {});
[[nodiscard]] tl::unexpected<Error> fail_at(const std::string& path, const Error& error);
[[nodiscard]] std::string_view type_of(const Json& value);

/// Reads one JSON object and records which keys were read. Refers to the object and must not
/// outlive it.
class ObjectReader {
  public:
    /// Errors: Unreadable when `value` is not an object.
    [[nodiscard]] static Expected<ObjectReader> open(const Json& value, std::string path);

    /// Returns the value of a key; null if there is none.
    [[nodiscard]] const Json* take(std::string_view key);
    [[nodiscard]] std::string path_of(std::string_view key) const;
    [[nodiscard]] const std::string& path() const { return path_; }
    /// Returns the keys that were not read.
    [[nodiscard]] Extras rest() const;
    /// Errors: Unreadable when a key was not read; for formats in which unknown keys are errors.
    [[nodiscard]] Status expect_no_rest() const;

    /// An integer in [low, high]. Errors: Unreadable, also when the key is missing.
    [[nodiscard]] Expected<std::int64_t> integer(std::string_view key, std::int64_t low,
                                                 std::int64_t high);
    /// A string. Errors: Unreadable, also when the key is missing.
    [[nodiscard]] Expected<std::string> text(std::string_view key);

  private:
    ObjectReader(const Json& value, std::string path) : value_(&value), path_(std::move(path)) {}
    const Json* value_;
    std::string path_;
    std::set<std::string, std::less<>> taken_;
};

void write_extras(OrderedJson& object, const Extras& extra);

// ---- parameters ------------------------------------------------------------------------------

/// Errors: Unreadable with the path.
[[nodiscard]] Expected<ParameterValue> read_value(const Json& value, const std::string& path);
// Keys over time, [{"frame": 1, "value": [x, y]}] (a single number needs no brackets), and lamps,
// [{"kind": "point", "keys": […]}] (app/project/codec/keyed_json.cpp). Errors: Unreadable with the
// path.
[[nodiscard]] Expected<ParameterValue> read_keys(const Json& value, const std::string& path);
[[nodiscard]] Expected<ParameterValue> read_lamps(const Json& value, const std::string& path);
[[nodiscard]] OrderedJson write_keys(const KeyedNumbers& keyed);
[[nodiscard]] OrderedJson write_lamps(const std::vector<Lamp>& lamps);
// Shapes and strokes, [{"kind": "ball", "numbers": [x, y, r]}].
[[nodiscard]] Expected<ParameterValue> read_guides(const Json& value, const std::string& path);
[[nodiscard]] OrderedJson write_guides(const std::vector<FormGuide>& guides);
// A grid warp, {"columns": 2, "rows": 2, "corners": [[x, y], …], "points": [{"at": [x, y]}, …], …}
// (app/project/codec/warp_json.cpp). Points may be left out: at rest, or as on the first key.
[[nodiscard]] Expected<ParameterValue> read_warp(const Json& value, const std::string& path);
[[nodiscard]] OrderedJson write_warp(const GridWarp& warp);
// Roto shapes: {"points": [[x, y, in x, in y, out x, out y, feather], …]}, plate pixels.
[[nodiscard]] Expected<RotoShape> read_shape(const Json& value, const std::string& path);
[[nodiscard]] OrderedJson write_shape(const RotoShape& shape);
// Over time: {"follow": "planar", "track": path, "keys": [{"frame", "points"}, …]}.
// The painted frames of a matte, [{"frame", "path"}, …], and what is confirmed on other frames,
// [{"frame", "path", "area"}, …].
[[nodiscard]] Expected<std::map<int, MatteKeyframe>> read_keyframes(const Json& json,
                                                                    const std::string& path);
[[nodiscard]] OrderedJson write_keyframes(const std::map<int, MatteKeyframe>& keyframes);
[[nodiscard]] Expected<std::map<int, ConfirmedEdge>> read_confirmed(const Json& json,
                                                                    const std::string& path);
[[nodiscard]] OrderedJson write_confirmed(const std::map<int, ConfirmedEdge>& confirmed);
[[nodiscard]] Expected<KeyedShape> read_keyed_shape(const Json& value, const std::string& path);
[[nodiscard]] OrderedJson write_keyed_shape(const KeyedShape& shape);
/// Returns true for an empty string or list, or an unset value.
[[nodiscard]] bool is_nothing(const ParameterValue& value);
[[nodiscard]] OrderedJson write_value(const ParameterInfo& info, const ParameterValue& value);

/// Reads the table's entries of one group; missing keys leave the values of `owner` unchanged.
template <class Owner>
[[nodiscard]] Status read_parameters(ObjectReader& object, std::span<const Parameter<Owner>> table,
                                     std::string_view group, Owner& owner) {
    for (const Parameter<Owner>& parameter : table) {
        if (parameter.group != group) continue;
        const Json* json = object.take(parameter.key);
        if (!json) continue;
        const std::string path = object.path_of(parameter.key);
        WEFT_TRY(value, read_value(*json, path));
        if (auto status = set_parameter(owner, parameter, std::move(value)); !status)
            return fail_at(path, status.error());
    }
    return {};
}

/// Writes all entries, so that changing a default later alters no project. Only empty strings,
/// empty lists and unset values are omitted where they are the default.
template <class Owner>
void write_parameters(OrderedJson& object, std::span<const Parameter<Owner>> table,
                      std::string_view group, const Owner& owner) {
    for (const Parameter<Owner>& parameter : table) {
        if (parameter.group != group) continue;
        const ParameterValue value = parameter.read(owner);
        if (value == parameter.default_value && is_nothing(value)) continue;
        object[std::string(parameter.key)] = write_value(parameter, value);
    }
}

// ---- parts of the document (also used by edits) ----------------------------------------------

[[nodiscard]] Expected<MatteSource> read_matte_source(const Json& json, const std::string& path);
[[nodiscard]] Expected<std::vector<MatteSource>> read_holdouts(const Json& json,
                                                               const std::string& path);
[[nodiscard]] Expected<std::vector<Zone>> read_zones(const Json& json, const std::string& path);
/// Reads at least one pin. Errors: Unreadable with the path.
[[nodiscard]] Expected<std::vector<CorrectionPin>> read_pins(const Json& json,
                                                             const std::string& path);
[[nodiscard]] OrderedJson write_pins(const std::vector<CorrectionPin>& pins);
/// Reads a document of the current schema version. Errors: Unreadable with the path, or when two
/// regions have one id.
[[nodiscard]] Expected<Project> read_project(const Json& json);
[[nodiscard]] OrderedJson write_project(const Project& project);
[[nodiscard]] Expected<Region> read_region(const Json& json, const std::string& path);
/// Reads one group into a region ("texture", "placement", …) or a project ("plate", "output", …).
[[nodiscard]] Status read_group(const Json& json, const std::string& path, std::string_view group,
                                Region& region);
[[nodiscard]] Status read_group(const Json& json, const std::string& path, std::string_view group,
                                Project& project);

[[nodiscard]] OrderedJson write_matte_source(const MatteSource& matte);
[[nodiscard]] Expected<std::vector<PlaneAmendment>> read_amendments(const Json& json,
                                                                    const std::string& path);
[[nodiscard]] OrderedJson write_amendments(const std::vector<PlaneAmendment>& amendments);
[[nodiscard]] OrderedJson write_holdouts(const std::vector<MatteSource>& holdouts);
[[nodiscard]] OrderedJson write_zones(const std::vector<Zone>& zones);
[[nodiscard]] OrderedJson write_region(const Region& region);
[[nodiscard]] OrderedJson write_group(std::string_view group, const Region& region);
[[nodiscard]] OrderedJson write_group(std::string_view group, const Project& project);

// ---- schema versions -------------------------------------------------------------------------

/// Upgrades a document of any older version to the current one (schema_upgrade.cpp). Errors:
/// Unreadable for a newer version, another kind of file, or a document that is invalid in its own
/// version.
[[nodiscard]] Status upgrade_to_current(Json& document);

}  // namespace weft::json_codec
