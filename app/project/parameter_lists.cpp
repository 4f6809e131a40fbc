#include "app/project/parameter_lists.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/project/parameter_entry.h"
#include "engine/core/text.h"

namespace weft::parameter_lists {
namespace {

constexpr std::size_t kMostKeys = 100'000;
constexpr std::size_t kMostLamps = 1000;

bool is_empty_list(const ParameterValue& value) {
    const auto* numbers = std::get_if<std::vector<double>>(&value);
    const auto* texts = std::get_if<std::vector<std::string>>(&value);
    const auto* keyed = std::get_if<KeyedNumbers>(&value);
    const auto* lamps = std::get_if<std::vector<Lamp>>(&value);
    const auto* guides = std::get_if<std::vector<FormGuide>>(&value);
    return (numbers && numbers->empty()) || (guides && guides->empty()) ||
           (texts && texts->empty()) || (keyed && keyed->empty()) || (lamps && lamps->empty());
}

Status check_keys(const KeyedNumbers& keyed, std::size_t count) {
    if (keyed.keys.size() > kMostKeys)
        return fail(ErrorCode::kUsage, fmt::format("it has more than {} keys", kMostKeys));
    for (const auto& [frame, numbers, after] : keyed.keys) {
        if (std::abs(static_cast<double>(frame)) > parameter_entry::kMaxFrame)
            return fail(ErrorCode::kUsage, fmt::format("frame {} is out of range", frame));
        if (numbers.size() != count)
            return fail(ErrorCode::kUsage,
                        fmt::format("the key on frame {} has {} numbers instead of {}", frame,
                                    numbers.size(), count));
        for (const double number : numbers)
            if (!std::isfinite(static_cast<float>(number)))
                return fail(ErrorCode::kUsage,
                            fmt::format("the key on frame {} is not a number", frame));
    }
    return {};
}

}  // namespace

Expected<ParameterValue> names(const ParameterInfo& info, ParameterValue value) {
    if (is_empty_list(value)) return ParameterValue(std::vector<std::string>());
    std::vector<std::string> given;
    if (const auto* list = std::get_if<std::vector<std::string>>(&value)) {
        given = *list;
    } else if (const auto* text = std::get_if<std::string>(&value)) {
        if (*text == "all") {
            given.assign(info.choices.begin(), info.choices.end());
        } else {
            for (const std::string_view part : split(*text, ','))
                if (!part.empty()) given.emplace_back(part);
        }
    } else {
        return fail(ErrorCode::kUsage, "it must be a list of names");
    }
    std::vector<std::string> out;
    for (const std::string& name : given) {
        if (std::find(info.choices.begin(), info.choices.end(), name) == info.choices.end())
            return fail(ErrorCode::kUsage,
                        fmt::format("unknown name {}", quoted(name.substr(0, 60))),
                        fmt::format("the names are {}, or all", fmt::join(info.choices, ", ")));
        if (std::find(out.begin(), out.end(), name) == out.end()) out.push_back(name);
    }
    return ParameterValue(std::move(out));
}

Expected<ParameterValue> keys(const ParameterInfo& info, ParameterValue value) {
    if (is_empty_list(value)) return ParameterValue(KeyedNumbers());
    KeyedNumbers keyed;
    if (const auto* text = std::get_if<std::string>(&value)) {
        WEFT_TRY(parsed, parse_keyed_numbers(*text, info.components));
        keyed = std::move(parsed);
    } else if (auto* typed = std::get_if<KeyedNumbers>(&value)) {
        WEFT_TRY(sorted, sorted_keys(std::move(typed->keys)));
        keyed = std::move(sorted);
    } else {
        return fail(ErrorCode::kUsage, "it must be a list of keys");
    }
    WEFT_CHECK_OK(check_keys(keyed, info.components));
    for (const auto& [frame, numbers, after] : keyed.keys)
        for (const double number : numbers)
            if (number < info.min || number > info.max)
                return fail(ErrorCode::kUsage, fmt::format("{} on frame {} is not from {} to {}",
                                                           number, frame, info.min, info.max));
    return ParameterValue(std::move(keyed));
}

Expected<ParameterValue> lamps(const ParameterInfo&, ParameterValue value) {
    if (is_empty_list(value)) return ParameterValue(std::vector<Lamp>());
    std::vector<Lamp> out;
    if (const auto* text = std::get_if<std::string>(&value)) {
        WEFT_TRY(parsed, parse_lamps(*text));
        out = std::move(parsed);
    } else if (auto* typed = std::get_if<std::vector<Lamp>>(&value)) {
        out = std::move(*typed);
    } else {
        return fail(ErrorCode::kUsage, "it must be a list of lamps");
    }
    if (out.size() > kMostLamps)
        return fail(ErrorCode::kUsage, fmt::format("it has more than {} lamps", kMostLamps));
    for (Lamp& lamp : out) {
        if (lamp.numbers.empty()) return fail(ErrorCode::kUsage, "a lamp has no numbers");
        WEFT_TRY(sorted, sorted_keys(std::move(lamp.numbers.keys)));
        lamp.numbers = std::move(sorted);
        WEFT_CHECK_OK(check_keys(lamp.numbers, info_of(lamp.kind).numbers));
    }
    return ParameterValue(std::move(out));
}

Expected<ParameterValue> guides(const ParameterInfo& info, ParameterValue value) {
    if (is_empty_list(value)) return ParameterValue(std::vector<FormGuide>());
    std::vector<FormGuide> out;
    if (const auto* text = std::get_if<std::string>(&value)) {
        WEFT_TRY(parsed, parse_form_guides(*text));
        out = std::move(parsed);
    } else if (auto* typed = std::get_if<std::vector<FormGuide>>(&value)) {
        out = std::move(*typed);
    } else {
        return fail(ErrorCode::kUsage, "it must be a list of shapes or strokes");
    }
    if (static_cast<double>(out.size()) > info.max)
        return fail(ErrorCode::kUsage, fmt::format("it has more than {} of them", info.max));
    for (const FormGuide& guide : out) {
        const std::string_view name = info_of(guide.kind).name;
        if (std::find(info.choices.begin(), info.choices.end(), name) == info.choices.end())
            return fail(ErrorCode::kUsage, fmt::format("{} is none of {}", quoted(name),
                                                       fmt::join(info.choices, ", ")));
        WEFT_CHECK_OK(check_form_guide(guide));
    }
    return ParameterValue(std::move(out));
}

Expected<ParameterValue> warp(const ParameterInfo&, ParameterValue value) {
    if (const auto* text = std::get_if<std::string>(&value)) {
        WEFT_TRY(parsed, parse_grid_warp(*text));
        value = std::move(parsed);
    }
    auto* typed = std::get_if<GridWarp>(&value);
    if (!typed) return fail(ErrorCode::kUsage, "it must be a grid warp");
    WEFT_CHECK_OK(check_grid_warp(*typed));
    return value;
}

std::string text_of(const ParameterValue& value) {
    if (const auto* names = std::get_if<std::vector<std::string>>(&value))
        return fmt::format("{}", fmt::join(*names, ","));
    if (const auto* keyed = std::get_if<KeyedNumbers>(&value)) return keyed_text(*keyed);
    if (const auto* lamps = std::get_if<std::vector<Lamp>>(&value)) return lamps_text(*lamps);
    if (const auto* guides = std::get_if<std::vector<FormGuide>>(&value))
        return form_guides_text(*guides);
    if (const auto* warp = std::get_if<GridWarp>(&value)) return grid_warp_text(*warp);
    return {};
}

}  // namespace weft::parameter_lists
