#pragma once
// Between JSON values and the document. Internal to this folder, and the only header of the project
// that names the JSON library.

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

using Json = nlohmann::json;                 // keys sorted: unknown keys come back in a fixed order
using OrderedJson = nlohmann::ordered_json;  // keys as written: files read from top to bottom

/// Errors: Unreadable with line and column, or the reason.
[[nodiscard]] Expected<Json> parse(std::string_view text);

/// Two spaces of indent, a line break at the end; the same value gives the same bytes everywhere.
/// Errors: Usage when a text is not UTF-8 (a path may be any bytes; JSON may not).
[[nodiscard]] Expected<std::string> to_text(const OrderedJson& value);

/// "regions[0].placement.scale: …"; an empty path means the whole document.
[[nodiscard]] tl::unexpected<Error> fail_at(const std::string& path, std::string message);
[[nodiscard]] std::string_view type_of(const Json& value);

/// One JSON object being read; remembers which keys were asked for. Refers to the object: must not
/// outlive it.
class ObjectReader {
  public:
    /// Errors: Unreadable when `value` is not an object.
    [[nodiscard]] static Expected<ObjectReader> open(const Json& value, std::string path);

    /// The value of a key, or null when there is none.
    [[nodiscard]] const Json* take(std::string_view key);
    [[nodiscard]] std::string path_of(std::string_view key) const;
    [[nodiscard]] const std::string& path() const { return path_; }
    /// The keys that were not read.
    [[nodiscard]] Extras rest() const;
    /// Errors: Unreadable when a key was not read: for formats in which a misspelt key is an error.
    [[nodiscard]] Status expect_no_rest() const;

    /// An integer in [low, high]. Errors: Unreadable, also when the key is missing.
    [[nodiscard]] Expected<std::int64_t> integer(std::string_view key, std::int64_t low,
                                                 std::int64_t high);
    /// A text. Errors: Unreadable, also when the key is missing.
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
// Keys over time, [{"frame": 1, "value": [x, y]}] (a single number without brackets), and lamps,
// [{"kind": "point", "keys": […]}], as app/project/codec/keyed_json.cpp has them. Errors:
// Unreadable with the path.
[[nodiscard]] Expected<ParameterValue> read_keys(const Json& value, const std::string& path);
[[nodiscard]] Expected<ParameterValue> read_lamps(const Json& value, const std::string& path);
[[nodiscard]] OrderedJson write_keys(const KeyedNumbers& keyed);
[[nodiscard]] OrderedJson write_lamps(const std::vector<Lamp>& lamps);
// Roto shapes: {"points": [[x, y, in x, in y, out x, out y, feather], …]}, plate pixels.
[[nodiscard]] Expected<RotoShape> read_shape(const Json& value, const std::string& path);
[[nodiscard]] OrderedJson write_shape(const RotoShape& shape);
/// An empty text or list, or an unset value.
[[nodiscard]] bool is_nothing(const ParameterValue& value);
[[nodiscard]] OrderedJson write_value(const ParameterInfo& info, const ParameterValue& value);

/// Reads the table's entries of one group out of the object; missing keys keep what `owner` has.
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
            return fail_at(path, status.error().message);
    }
    return {};
}

/// Writes them all, so that a later change of a default alters no shot; only nothing (an empty text
/// or list, an unset value) is left out where nothing is the default.
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
/// At least one pin. Errors: Unreadable with the path.
[[nodiscard]] Expected<std::vector<CorrectionPin>> read_pins(const Json& json,
                                                             const std::string& path);
[[nodiscard]] OrderedJson write_pins(const std::vector<CorrectionPin>& pins);
/// Of the current schema version. Errors: Unreadable with the path; two regions of one id.
[[nodiscard]] Expected<Project> read_project(const Json& json);
[[nodiscard]] OrderedJson write_project(const Project& project);
[[nodiscard]] Expected<Region> read_region(const Json& json, const std::string& path);
/// One group ("texture", "placement", …) into a region; ("plate", "output", …) into a project.
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

/// Brings a document of any older version to the current one (schema_upgrade.cpp). Errors:
/// Unreadable for a newer version, another kind of file, or a document that its own version does
/// not allow.
[[nodiscard]] Status upgrade_to_current(Json& document);

}  // namespace weft::json_codec
