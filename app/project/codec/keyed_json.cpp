// Keyed numbers, lamps and guides of form to and from JSON, as described in docs/FORMATS.md.
#include <fmt/format.h>

#include <algorithm>

#include "app/project/codec/json_codec.h"
#include "engine/core/frame_range.h"

namespace weft::json_codec {
namespace {

constexpr std::size_t kMostNumbers = 16;

Expected<NumberKey> read_key(const Json& json, const std::string& path) {
    WEFT_TRY(object, ObjectReader::open(json, path));
    WEFT_TRY(frame, object.integer("frame", -kMaxFrameNumber, kMaxFrameNumber));
    NumberKey key{static_cast<int>(frame), {}};
    const Json* value = object.take("value");
    if (const Json* name = object.take("interpolation")) {
        const auto after = parse_interpolation(name->is_string() ? name->get<std::string>() : "");
        if (!after)
            return fail_at(object.path_of("interpolation"),
                           "This must be \"linear\", \"smooth\" or \"hold\"");
        key.after = *after;
    }
    WEFT_CHECK_OK(object.expect_no_rest());
    if (value && value->is_number()) {
        key.numbers = {value->get<double>()};
        return key;
    }
    const bool fits = value && value->is_array() && value->size() <= kMostNumbers &&
                      std::all_of(value->begin(), value->end(),
                                  [](const Json& number) { return number.is_number(); });
    if (!fits)
        return fail_at(object.path_of("value"), "This must be a number or a list of numbers");
    key.numbers = value->get<std::vector<double>>();
    return key;
}

Expected<KeyedNumbers> read_key_list(const Json& json, const std::string& path) {
    if (!json.is_array())
        return fail_at(path, fmt::format("This is {}, but must be a list of keys", type_of(json)));
    std::vector<NumberKey> keys;
    for (std::size_t i = 0; i < json.size(); ++i) {
        WEFT_TRY(key, read_key(json[i], fmt::format("{}[{}]", path, i)));
        keys.push_back(std::move(key));
    }
    auto sorted = sorted_keys(std::move(keys));
    if (!sorted) return fail_at(path, sorted.error().message, "remove one of them");
    return sorted;
}

}  // namespace

Expected<ParameterValue> read_keys(const Json& value, const std::string& path) {
    WEFT_TRY(keyed, read_key_list(value, path));
    return ParameterValue(std::move(keyed));
}

Expected<ParameterValue> read_lamps(const Json& value, const std::string& path) {
    std::vector<Lamp> lamps;
    for (std::size_t i = 0; i < value.size(); ++i) {
        WEFT_TRY(object, ObjectReader::open(value[i], fmt::format("{}[{}]", path, i)));
        WEFT_TRY(name, object.text("kind"));
        const auto* const info =
            std::find_if(kLampKinds.begin(), kLampKinds.end(),
                         [&](const LampKindInfo& known) { return known.name == name; });
        if (info == kLampKinds.end())
            return fail_at(object.path_of("kind"), "This must be point, directional or gradient");
        const Json* keys = object.take("keys");
        WEFT_CHECK_OK(object.expect_no_rest());
        if (!keys) return fail_at(object.path_of("keys"), "This key is missing", "add it");
        WEFT_TRY(numbers, read_key_list(*keys, object.path_of("keys")));
        lamps.push_back({info->kind, std::move(numbers)});
    }
    return ParameterValue(std::move(lamps));
}

Expected<ParameterValue> read_guides(const Json& value, const std::string& path) {
    std::vector<FormGuide> guides;
    for (std::size_t i = 0; i < value.size(); ++i) {
        WEFT_TRY(object, ObjectReader::open(value[i], fmt::format("{}[{}]", path, i)));
        WEFT_TRY(name, object.text("kind"));
        const auto* const info =
            std::find_if(kFormGuides.begin(), kFormGuides.end(),
                         [&](const FormGuideInfo& known) { return known.name == name; });
        if (info == kFormGuides.end())
            return fail_at(object.path_of("kind"),
                           "This must be plane, cylinder, cone, ball, parallel or level");
        const Json* numbers = object.take("numbers");
        WEFT_CHECK_OK(object.expect_no_rest());
        const bool fits = numbers && numbers->is_array() &&
                          numbers->size() <= kMostParallelNumbers &&
                          std::all_of(numbers->begin(), numbers->end(),
                                      [](const Json& number) { return number.is_number(); });
        if (!fits) return fail_at(object.path_of("numbers"), "This must be a list of numbers");
        guides.push_back({info->kind, numbers->get<std::vector<double>>()});
    }
    return ParameterValue(std::move(guides));
}

OrderedJson write_keys(const KeyedNumbers& keyed) {
    OrderedJson list = OrderedJson::array();
    for (const auto& [frame, numbers, after] : keyed.keys) {
        OrderedJson key{{"frame", frame}};
        if (numbers.size() == 1)
            key["value"] = numbers[0];
        else
            key["value"] = numbers;
        if (after != KeyInterpolation::kLinear) key["interpolation"] = name_of(after);
        list.push_back(std::move(key));
    }
    return list;
}

OrderedJson write_lamps(const std::vector<Lamp>& lamps) {
    OrderedJson list = OrderedJson::array();
    for (const Lamp& lamp : lamps)
        list.push_back(
            OrderedJson{{"kind", info_of(lamp.kind).name}, {"keys", write_keys(lamp.numbers)}});
    return list;
}

OrderedJson write_guides(const std::vector<FormGuide>& guides) {
    OrderedJson list = OrderedJson::array();
    for (const FormGuide& guide : guides)
        list.push_back(OrderedJson{{"kind", info_of(guide.kind).name}, {"numbers", guide.numbers}});
    return list;
}

}  // namespace weft::json_codec
