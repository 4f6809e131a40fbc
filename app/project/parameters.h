#pragma once
// One table per parameter. JSON keys, command-line flags, validation, sliders and the documentation
// all come from these tables, so a parameter is described in exactly one place; its default is the
// initialiser of the struct member it stands for.

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
    kPath,     ///< std::string, relative paths against the project's folder
    kPoint,    ///< 2 numbers: x, y. On the command line "X,Y".
    kPaths,    ///< std::vector<std::string>, as kPath. On the command line one a line.
    kCorners,  ///< 8 numbers: TL, TR, BR, BL, or unset. On the command line "x,y x,y x,y x,y".
    kFrames,   ///< Frame numbers. On the command line a frame list.
    kNames,    ///< std::vector<std::string>, each one of `choices`. On the command line with commas
               ///< between them, or "all".
    kKeys,     ///< KeyedNumbers of `components` each. On the command line "FRAME:X FRAME:X,Y".
    kLamps     ///< std::vector<Lamp>. On the command line as parse_lamps() reads them.
};

/// std::monostate: not set (only where `optional`); std::vector<double>: points and frames.
using ParameterValue =
    std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<double>,
                 std::vector<std::string>, KeyedNumbers, std::vector<Lamp>>;

struct ParameterInfo {
    std::string_view group{};  ///< JSON object that holds it; empty: the region or project itself.
    std::string_view key{};    ///< JSON key.
    std::string_view flag{};   ///< "--scale"; empty: has none.
    std::string_view old_flag{};  ///< The flag's name before: still read, but not shown.
    std::string_view unit{};      ///< "px", "deg", …; empty: a bare number or text.
    std::string_view help{};      ///< One line of sentence case without a full stop at its end.
    double min = 0, max = 0;      ///< Inclusive; numbers, integers, every coordinate, every frame.
    std::size_t components = 1;   ///< Of kKeys: how many numbers a key has.
    bool optional = false;        ///< May be unset.
    bool repeatable = false;      ///< The flag may be given several times.
    /// On the command line, a text that is none of `choices` is a path: it becomes this key of the
    /// same group, and the choice becomes the last of `choices`. Empty: no such thing.
    std::string_view path_key{};
    bool is_path = false;  ///< A text that names files.

    ParameterKind kind = ParameterKind::kText;  // these three follow from the member
    std::vector<std::string_view> choices{};
    ParameterValue default_value{};

    /// "placement.scale": the name in edits and messages.
    [[nodiscard]] std::string full_key() const;
};

/// A parameter of a Region, a Project, a MatteSource or a Zone.
template <class Owner>
struct Parameter : ParameterInfo {
    ParameterValue (*read)(const Owner&) = nullptr;
    /// Only for values that normalise() returned.
    void (*write)(Owner&, const ParameterValue&) = nullptr;
};

// The tables, in the order of the file. Immutable.
[[nodiscard]] std::span<const Parameter<Region>> region_parameters();
[[nodiscard]] std::span<const Parameter<Project>> project_parameters();
/// The same entries as the region's group "matte", for holdouts.
[[nodiscard]] std::span<const Parameter<MatteSource>> matte_parameters();
/// Kind and value of a zone; its matte has matte_parameters().
[[nodiscard]] std::span<const Parameter<Zone>> zone_parameters();

/// The value in the type that the parameter wants (an integer for a number, whole numbers for an
/// integer, what a text says for names, keys and lamps). Errors: Usage when the type, the range or
/// the choice is wrong; the message names the parameter, the value and what is allowed.
[[nodiscard]] Expected<ParameterValue> normalise(const ParameterInfo& info, ParameterValue value);

/// From the command line's text. Errors as normalise().
[[nodiscard]] Expected<ParameterValue> parse_parameter(const ParameterInfo& info,
                                                       std::string_view text);
/// The text that parse_parameter() reads back; empty for an unset one.
[[nodiscard]] std::string format_parameter(const ParameterInfo& info, const ParameterValue& value);
/// "0.001 to 1000 px", "graphcut, dp or none": for help and messages; empty when anything goes.
[[nodiscard]] std::string allowed_values(const ParameterInfo& info);

/// The entry by its full key ("placement.scale") or flag ("--scale"). Errors: Usage with the
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

/// Sets one parameter from the command line's text: what every flag of the tables does. Errors as
/// parse_parameter().
[[nodiscard]] Status set_parameter_text(Region& region, const Parameter<Region>& parameter,
                                        std::string_view text);
[[nodiscard]] Status set_parameter_text(Project& project, const Parameter<Project>& parameter,
                                        std::string_view text);

// The names of the choices, as in files and on the command line.
[[nodiscard]] std::string_view choice_name(Quality value);
[[nodiscard]] std::string_view choice_name(OutputDepth value);
[[nodiscard]] std::string_view choice_name(WrapMode value);
[[nodiscard]] std::string_view choice_name(MotionDirection value);
[[nodiscard]] std::string_view choice_name(SeamMethod value);
[[nodiscard]] std::string_view choice_name(TemporalMode value);
[[nodiscard]] std::string_view choice_name(LightSource value);
[[nodiscard]] std::string_view choice_name(LightForm value);

}  // namespace weft
