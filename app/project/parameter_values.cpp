#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>

#include "app/project/parameter_lists.h"
#include "app/project/parameters.h"
#include "engine/core/frame_range.h"
#include "engine/core/setting.h"

namespace weft {
namespace {

constexpr std::size_t kMostFrames = 1'000'000;

std::string display_name(const ParameterInfo& info) {
    const std::string name = setting_name({info.full_key()});
    return name.empty() ? info.full_key() : name;
}

std::string_view type_name(ParameterKind kind) {
    switch (kind) {
        case ParameterKind::kFlag:
            return "true or false";
        case ParameterKind::kInteger:
            return "a whole number";
        case ParameterKind::kNumber:
            return "a number";
        case ParameterKind::kChoice:
        case ParameterKind::kText:
            return "a string";
        case ParameterKind::kPath:
            return "a path";
        case ParameterKind::kPaths:
            return "a list of paths";
        case ParameterKind::kPoint:
            return "two numbers, x and y";
        case ParameterKind::kRgb:
            return "three numbers, for red, green and blue";
        case ParameterKind::kCorners:
            return "four points (top left, top right, bottom right, bottom left)";
        case ParameterKind::kFrames:
            return "a list of frame numbers";
        case ParameterKind::kNames:
            return "a list of names";
        case ParameterKind::kKeys:
            return "a list of keys";
        case ParameterKind::kLamps:
            return "a list of lamps";
        case ParameterKind::kGuides:
            return "a list of shapes or strokes";
        case ParameterKind::kWarp:
            return "a grid warp";
    }
    return "";
}

std::string shown_value(const ParameterValue& value) {
    struct Show {
        std::string operator()(std::monostate) const { return "nothing"; }
        std::string operator()(bool v) const { return v ? "true" : "false"; }
        std::string operator()(std::int64_t v) const { return fmt::format("{}", v); }
        std::string operator()(double v) const { return fmt::format("{}", v); }
        std::string operator()(const std::string& v) const {
            constexpr std::size_t kLongest = 60;
            return v.size() <= kLongest ? "'" + v + "'" : "'" + v.substr(0, kLongest) + "…'";
        }
        std::string operator()(const std::vector<double>& v) const {
            return fmt::format("{} numbers", v.size());
        }
        std::string operator()(const std::vector<std::string>& v) const {
            return fmt::format("{} strings", v.size());
        }
        std::string operator()(const KeyedNumbers& v) const {
            return fmt::format("{} keys", v.keys.size());
        }
        std::string operator()(const std::vector<Lamp>& v) const {
            return fmt::format("{} lamps", v.size());
        }
        std::string operator()(const std::vector<FormGuide>& v) const {
            return fmt::format("{} shapes or strokes", v.size());
        }
        std::string operator()(const GridWarp& v) const {
            return fmt::format("a grid of {} × {}", v.columns, v.rows);
        }
    };
    return std::visit(Show{}, value);
}

tl::unexpected<Error> wrong(const ParameterInfo& info, const ParameterValue& value,
                            const std::string& wanted) {
    return fail(ErrorCode::kUsage, fmt::format("{} must be {}, not {}", display_name(info), wanted,
                                               shown_value(value)));
}

std::string range_text(const ParameterInfo& info) {
    std::string out = fmt::format("{} to {}", info.min, info.max);
    if (!info.unit.empty()) out += fmt::format(" {}", info.unit);
    return out;
}

/// "graphcut, dp or none"
std::string choices_text(const ParameterInfo& info) {
    std::string out;
    for (std::size_t i = 0; i < info.choices.size(); ++i) {
        if (i > 0) out += i + 1 == info.choices.size() ? " or " : ", ";
        out += info.choices[i];
    }
    return out;
}

/// Returns false for NaN.
bool in_range(const ParameterInfo& info, double v) {
    return v >= info.min && v <= info.max;
}

std::optional<std::int64_t> whole(const ParameterValue& value) {
    if (const auto* i = std::get_if<std::int64_t>(&value)) return *i;
    const auto* d = std::get_if<double>(&value);
    constexpr double kExact = 9007199254740992.0;  // 2^53
    if (d && std::trunc(*d) == *d && std::abs(*d) <= kExact) return static_cast<std::int64_t>(*d);
    return std::nullopt;
}

Expected<ParameterValue> normalise_integer(const ParameterInfo& info, const ParameterValue& value) {
    const std::optional<std::int64_t> number = whole(value);
    if (!number) return wrong(info, value, "a whole number from " + range_text(info));
    if (!in_range(info, static_cast<double>(*number))) return wrong(info, value, range_text(info));
    return ParameterValue(*number);
}

Expected<ParameterValue> normalise_number(const ParameterInfo& info, const ParameterValue& value) {
    double number = 0;
    if (const auto* i = std::get_if<std::int64_t>(&value))
        number = static_cast<double>(*i);
    else if (const auto* d = std::get_if<double>(&value))
        number = *d;
    else
        return wrong(info, value, "a number from " + range_text(info));
    if (!in_range(info, number)) return wrong(info, value, range_text(info));
    // no negative zero, so equal values give equal bytes
    return ParameterValue(number == 0 ? 0.0 : number);
}

Expected<ParameterValue> normalise_text(const ParameterInfo& info, ParameterValue value) {
    const auto* text = std::get_if<std::string>(&value);
    if (!text) return wrong(info, value, std::string(type_name(info.kind)));
    if (text->find('\0') != std::string::npos)
        return fail(ErrorCode::kUsage, display_name(info) + " contains a zero character",
                    "remove it");
    return value;
}

Expected<ParameterValue> normalise_choice(const ParameterInfo& info, ParameterValue value) {
    const auto* text = std::get_if<std::string>(&value);
    if (!text || std::find(info.choices.begin(), info.choices.end(), *text) == info.choices.end())
        return wrong(info, value, choices_text(info));
    return value;
}

Expected<ParameterValue> normalise_numbers(const ParameterInfo& info, ParameterValue value) {
    auto* numbers = std::get_if<std::vector<double>>(&value);
    if (std::holds_alternative<std::vector<std::string>>(value))
        return fail(ErrorCode::kUsage,
                    display_name(info) + " contains strings, but must be numbers");
    if (!numbers) return wrong(info, value, std::string(type_name(info.kind)));
    const std::size_t wanted = info.kind == ParameterKind::kPoint     ? 2
                               : info.kind == ParameterKind::kRgb     ? 3
                               : info.kind == ParameterKind::kCorners ? 8
                                                                      : numbers->size();
    if (numbers->size() != wanted) return wrong(info, value, std::string(type_name(info.kind)));
    for (double& number : *numbers) {
        const bool fits = in_range(info, number) &&
                          (info.kind != ParameterKind::kFrames || std::trunc(number) == number);
        if (!fits)
            return fail(ErrorCode::kUsage,
                        fmt::format("{} holds {}, but must hold numbers from {}",
                                    display_name(info), number, range_text(info)));
        if (number == 0) number = 0;
    }
    if (info.kind == ParameterKind::kFrames) {
        // Keeps the given order, which may matter, and removes duplicates.
        std::set<double> known;
        std::erase_if(*numbers, [&](double number) { return !known.insert(number).second; });
    }
    return value;
}

Expected<ParameterValue> normalise_paths(const ParameterInfo& info, ParameterValue value) {
    // An empty list has no type yet.
    const auto* numbers = std::get_if<std::vector<double>>(&value);
    if (numbers && numbers->empty()) return ParameterValue(std::vector<std::string>());
    const auto* paths = std::get_if<std::vector<std::string>>(&value);
    if (!paths) return wrong(info, value, std::string(type_name(info.kind)));
    if (paths->size() > static_cast<std::size_t>(info.max))
        return wrong(info, value, fmt::format("at most {}", info.max));
    for (const std::string& path : *paths) {
        if (path.empty() || path.find_first_of(std::string_view("\0\n", 2)) != std::string::npos)
            return fail(ErrorCode::kUsage,
                        display_name(info) + " holds a path that is empty or has a line break",
                        "remove it");
    }
    return value;
}

using ListReader = Expected<ParameterValue> (*)(const ParameterInfo&, ParameterValue);

Expected<ParameterValue> normalise_list(const ParameterInfo& info, ParameterValue value,
                                        ListReader read) {
    auto read_value = read(info, std::move(value));
    if (!read_value) return fail_in(std::move(read_value).error(), display_name(info));
    return read_value;
}

std::optional<double> number_from(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

/// Numbers separated by commas and spaces; nothing if one of them is not a number.
std::optional<std::vector<double>> numbers_from(std::string_view text) {
    std::vector<double> out;
    constexpr std::string_view kBetween = ", \t";
    for (std::size_t at = 0;
         (at = text.find_first_not_of(kBetween, at)) != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(kBetween, at), text.size());
        const std::optional<double> number = number_from(text.substr(at, end - at));
        if (!number) return std::nullopt;
        out.push_back(*number);
        at = end;
    }
    return out;
}

std::optional<bool> flag_from(std::string_view text) {
    for (const std::string_view yes : {"true", "on", "yes", "1"})
        if (text == yes) return true;
    for (const std::string_view no : {"false", "off", "no", "0"})
        if (text == no) return false;
    return std::nullopt;
}

/// Converts the text to the type of the parameter. If that fails, returns the text, and normalise()
/// reports what is expected.
Expected<ParameterValue> typed(const ParameterInfo& info, std::string_view text) {
    const ParameterValue as_text{std::string(text)};
    switch (info.kind) {
        case ParameterKind::kFlag: {
            const auto flag = flag_from(text);
            return flag ? ParameterValue(*flag) : as_text;
        }
        case ParameterKind::kInteger:
        case ParameterKind::kNumber: {
            const auto number = number_from(text);
            return number ? ParameterValue(*number) : as_text;
        }
        case ParameterKind::kPoint:
        case ParameterKind::kCorners: {
            auto numbers = numbers_from(text);
            return numbers ? ParameterValue(std::move(*numbers)) : as_text;
        }
        case ParameterKind::kRgb: {
            auto numbers = numbers_from(text);
            if (numbers && numbers->size() == 1) numbers->resize(3, numbers->front());
            return numbers ? ParameterValue(std::move(*numbers)) : as_text;
        }
        case ParameterKind::kPaths: {
            std::vector<std::string> paths;
            for (std::size_t from = 0; from < text.size();) {
                const std::size_t to = std::min(text.find('\n', from), text.size());
                paths.emplace_back(text.substr(from, to - from));
                from = to + 1;
            }
            return ParameterValue(std::move(paths));
        }
        case ParameterKind::kFrames: {
            std::vector<double> numbers;
            for (std::size_t from = 0; from < text.size();) {
                const std::size_t to = std::min(text.find(',', from), text.size());
                WEFT_TRY(frames, parse_frame_list(text.substr(from, to - from)));
                if (numbers.size() + frames.size() > kMostFrames)
                    return fail(ErrorCode::kUsage, "The frames are more than a million.");
                numbers.insert(numbers.end(), frames.begin(), frames.end());
                from = to + 1;
            }
            return ParameterValue(std::move(numbers));
        }
        default:
            return as_text;
    }
}

template <class Owner>
Status set_text(Owner& owner, const Parameter<Owner>& parameter,
                std::span<const Parameter<Owner>> table, std::string_view text) {
    const auto& choices = parameter.choices;
    if (!parameter.path_key.empty() &&
        std::find(choices.begin(), choices.end(), text) == choices.end()) {
        const std::string path_name = fmt::format("{}.{}", parameter.group, parameter.path_key);
        WEFT_TRY(path, find_parameter(table, path_name));
        WEFT_CHECK_OK(set_parameter(owner, *path, std::string(text)));
        return set_parameter(owner, parameter, std::string(choices.back()));
    }
    WEFT_TRY(value, parse_parameter(parameter, text));
    parameter.write(owner, value);
    return {};
}

}  // namespace

std::string ParameterInfo::full_key() const {
    return group.empty() ? std::string(key) : fmt::format("{}.{}", group, key);
}

Expected<ParameterValue> normalise(const ParameterInfo& info, ParameterValue value) {
    if (info.optional && std::holds_alternative<std::monostate>(value)) return value;
    switch (info.kind) {
        case ParameterKind::kFlag:
            if (!std::holds_alternative<bool>(value)) return wrong(info, value, "true or false");
            return value;
        case ParameterKind::kInteger:
            return normalise_integer(info, value);
        case ParameterKind::kNumber:
            return normalise_number(info, value);
        case ParameterKind::kChoice:
            return normalise_choice(info, std::move(value));
        case ParameterKind::kText:
        case ParameterKind::kPath:
            return normalise_text(info, std::move(value));
        case ParameterKind::kPaths:
            return normalise_paths(info, std::move(value));
        case ParameterKind::kNames:
            return normalise_list(info, std::move(value), parameter_lists::names);
        case ParameterKind::kKeys:
            return normalise_list(info, std::move(value), parameter_lists::keys);
        case ParameterKind::kLamps:
            return normalise_list(info, std::move(value), parameter_lists::lamps);
        case ParameterKind::kGuides:
            return normalise_list(info, std::move(value), parameter_lists::guides);
        case ParameterKind::kWarp:
            return normalise_list(info, std::move(value), parameter_lists::warp);
        case ParameterKind::kPoint:
        case ParameterKind::kRgb:
        case ParameterKind::kCorners:
        case ParameterKind::kFrames:
            return normalise_numbers(info, std::move(value));
    }
    return value;
}

Expected<ParameterValue> parse_parameter(const ParameterInfo& info, std::string_view text) {
    if (info.optional && (text.empty() || text == "none" || text == "auto"))
        return ParameterValue();
    auto value = typed(info, text);
    if (!value) return fail_in(std::move(value).error(), display_name(info));
    return normalise(info, std::move(*value));
}

std::string format_parameter(const ParameterInfo& info, const ParameterValue& value) {
    if (std::holds_alternative<std::monostate>(value)) return {};
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    if (info.kind == ParameterKind::kNames || info.kind == ParameterKind::kKeys ||
        info.kind == ParameterKind::kLamps || info.kind == ParameterKind::kGuides ||
        info.kind == ParameterKind::kWarp)
        return parameter_lists::text_of(value);
    std::string out;
    if (const auto* paths = std::get_if<std::vector<std::string>>(&value)) {
        for (const std::string& path : *paths)
            out += (out.empty() ? "" : "\n") + path;
        return out;
    }
    const auto* numbers = std::get_if<std::vector<double>>(&value);
    if (!numbers) return shown_value(value);
    if (info.kind == ParameterKind::kFrames) {
        if (std::is_sorted(numbers->begin(), numbers->end()))
            return format_frame_list(std::vector<int>(numbers->begin(), numbers->end()));
        for (const double number : *numbers)
            out += (out.empty() ? "" : ",") + fmt::format("{}", number);
        return out;
    }
    for (std::size_t i = 0; i < numbers->size(); ++i) {
        const bool inside = i % 2 == 1 || info.kind == ParameterKind::kRgb;
        if (i > 0) out += inside ? "," : " ";
        out += fmt::format("{}", (*numbers)[i]);
    }
    return out;
}

std::string allowed_values(const ParameterInfo& info) {
    switch (info.kind) {
        case ParameterKind::kFlag:
            return "true or false";
        case ParameterKind::kChoice: {
            if (info.path_key.empty()) return choices_text(info);
            ParameterInfo named = info;
            named.choices.back() = "a path";
            return choices_text(named);
        }
        case ParameterKind::kText:
        case ParameterKind::kPath:
        case ParameterKind::kPaths:
        case ParameterKind::kLamps:
        case ParameterKind::kGuides:
        case ParameterKind::kWarp:
            return {};
        case ParameterKind::kNames:
            return "all, or of " + choices_text(info);
        default:
            return range_text(info);
    }
}

Status set_parameter_text(Region& region, const Parameter<Region>& parameter,
                          std::string_view text) {
    return set_text(region, parameter, region_parameters(), text);
}
Status set_parameter_text(Project& project, const Parameter<Project>& parameter,
                          std::string_view text) {
    return set_text(project, parameter, project_parameters(), text);
}

}  // namespace weft
