#pragma once
// Parameter tables: the only description of each parameter. JSON keys, command-line flags,
// validation, sliders and documentation are generated from them. A parameter's default is the
// initialiser of its struct member.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/project/project.h"
#include "engine/core/error.h"

namespace weft {

enum class ParameterKind {
    kFlag,     ///< bool
    kInteger,  ///< std::int64_t
    kNumber,   ///< double
    kChoice,   ///< std::string, one of `choices`
    kText,     ///< std::string
    kPath,     ///< std::string; relative paths refer to the project's folder
    kPoint,    ///< 2 numbers: x, y. On the command line "X,Y".
    kPaths,    ///< std::vector<std::string>, as kPath. On the command line, one per line.
    kRgb,      ///< 3 numbers: R, G, B. On the command line "R,G,B", or one number for all three.
    kCorners,  ///< 8 numbers: TL, TR, BR, BL, or unset. On the command line "x,y x,y x,y x,y".
    kFrames,   ///< Frame numbers. On the command line a frame list.
    kNames,    ///< std::vector<std::string>, each one of `choices`. On the command line with commas
               ///< between them, or "all".
    kKeys,     ///< KeyedNumbers of `components` each. On the command line "FRAME:X FRAME:X,Y".
    kLamps,    ///< std::vector<Lamp>. On the command line as parse_lamps() reads them.
    kWarp,     ///< A GridWarp, or unset. On the command line as parse_grid_warp() reads it.
    kGuides    ///< std::vector<FormGuide>, each of one of `choices`, at most `max`. On the command
               ///< line as parse_form_guides() reads them.
};

/// std::monostate: not set (only if `optional`); std::vector<double>: points and frames.
using ParameterValue = std::variant<std::monostate, bool, std::int64_t, double, std::string,
                                    std::vector<double>, std::vector<std::string>, KeyedNumbers,
                                    std::vector<Lamp>, std::vector<FormGuide>, GridWarp>;

struct ParameterInfo {
    /// JSON object that holds it; empty: directly in the region or project.
    std::string_view group{};
    std::string_view key{};       ///< JSON key.
    std::string_view flag{};      ///< "--scale"; empty: no flag.
    std::string_view old_flag{};  ///< Former name of the flag: accepted but hidden.
    std::string_view unit{};      ///< "px", "deg", …; empty: a bare number or text.
    std::string_view help{};      ///< One line in sentence case, without a final full stop.
    double min = 0, max = 0;      ///< Inclusive range of numbers, integers, coordinates and frames.
    std::size_t components = 1;   ///< For kKeys: numbers per key.
    bool optional = false;        ///< May be unset.
    bool repeatable = false;      ///< The flag may be given several times.
    /// On the command line, text that is not a choice is taken as a path: it is stored under this
    /// key of the same group, and the choice becomes the last of `choices`. Empty: not supported.
    std::string_view path_key{};
    bool is_path = false;  ///< A string that names files.

    ParameterKind kind = ParameterKind::kText;  // these three are derived from the member
    std::vector<std::string_view> choices{};
    ParameterValue default_value{};

    /// Name in edits and messages: "placement.scale".
    [[nodiscard]] std::string full_key() const;
};

/// A parameter of a Region, a Project, a MatteSource or a Zone.
template <class Owner>
struct Parameter : ParameterInfo {
    ParameterValue (*read)(const Owner&) = nullptr;
    /// Accepts only values returned by normalise().
    void (*write)(Owner&, const ParameterValue&) = nullptr;
};

// The tables, in the order of the file. Immutable.
[[nodiscard]] std::span<const Parameter<Region>> region_parameters();
[[nodiscard]] std::span<const Parameter<Project>> project_parameters();
/// The entries of the region's group "matte", for holdouts.
[[nodiscard]] std::span<const Parameter<MatteSource>> matte_parameters();
/// Kind and value of a zone; its matte has matte_parameters().
[[nodiscard]] std::span<const Parameter<Zone>> zone_parameters();

/// Converts a value to the parameter's type (integer to number, whole number to integer, text to
/// names, keys or lamps). Errors: Usage for a wrong type, range or choice; the message names the
/// parameter, the value and what is allowed.
[[nodiscard]] Expected<ParameterValue> normalise(const ParameterInfo& info, ParameterValue value);

/// Parses command-line text. Errors as normalise().
[[nodiscard]] Expected<ParameterValue> parse_parameter(const ParameterInfo& info,
                                                       std::string_view text);
/// Formats a value for parse_parameter(); empty if unset.
[[nodiscard]] std::string format_parameter(const ParameterInfo& info, const ParameterValue& value);
/// "0.001 to 1000 px", "graphcut, dp or none": for help and messages; empty if any value is
/// allowed.
[[nodiscard]] std::string allowed_values(const ParameterInfo& info);

/// Finds an entry by its full key ("placement.scale") or flag ("--scale"). Errors: Usage with the
/// nearest name.
template <class Owner>
[[nodiscard]] Expected<const Parameter<Owner>*> find_parameter(
    std::span<const Parameter<Owner>> table, std::string_view key_or_flag);

/// Sets one parameter. Errors as normalise().
template <class Owner>
[[nodiscard]] Status set_parameter(Owner& owner, const Parameter<Owner>& parameter,
                                   ParameterValue value) {
    WEFT_TRY(normal, normalise(parameter, std::move(value)));
    parameter.write(owner, normal);
    return {};
}

/// Sets one parameter from command-line text, as all flags of the tables do. Errors as
/// parse_parameter().
[[nodiscard]] Status set_parameter_text(Region& region, const Parameter<Region>& parameter,
                                        std::string_view text);
[[nodiscard]] Status set_parameter_text(Project& project, const Parameter<Project>& parameter,
                                        std::string_view text);

// Names of the choices in files and on the command line.
[[nodiscard]] std::string_view choice_name(TemporalMode value);
[[nodiscard]] std::string_view choice_name(LightSource value);

}  // namespace weft
