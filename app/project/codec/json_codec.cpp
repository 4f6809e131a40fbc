#include "app/project/codec/json_codec.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/project/codec/json_limits.h"

namespace weft::json_codec {
namespace {

constexpr const char* kOpenAnother = "open a file that Weft saved";

/// Thrown from the parser's callback and caught in parse(), as the parser cannot be stopped
/// otherwise.
struct Refused {
    std::string message, remedy;
};

/// Checks nesting depth and duplicate keys while parsing; of duplicate keys the parser would
/// silently keep one.
class ParseGuard {
  public:
    bool operator()(int depth, nlohmann::json::parse_event_t event, Json& parsed) {
        using Event = nlohmann::json::parse_event_t;
        if (depth > kMaxJsonDepth)
            throw Refused{
                fmt::format("It is nested more than {} levels deep, which no Weft file is",
                            kMaxJsonDepth),
                kOpenAnother};
        if (event == Event::object_start) keys_.emplace_back();
        if (event == Event::object_end) keys_.pop_back();
        if (event != Event::key) return true;
        if (keys_.back().size() >= kMaxJsonKeys)
            throw Refused{fmt::format("An object has more than {} keys, which no Weft file has",
                                      kMaxJsonKeys),
                          kOpenAnother};
        if (!keys_.back().insert(parsed.get<std::string>()).second)
            throw Refused{
                fmt::format("The key '{}' occurs twice in one object", parsed.get<std::string>()),
                "remove one of them"};
        return true;
    }

  private:
    std::vector<std::set<std::string>> keys_;
};

/// Line and column of the parser's position. The text there is not quoted, as the file may belong
/// to another user.
std::string place_of(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, byte > 0 ? byte - 1 : 0);
    const std::size_t start = before.rfind('\n');
    return fmt::format("line {}, column {}", 1 + std::count(before.begin(), before.end(), '\n'),
                       before.size() - (start == std::string_view::npos ? 0 : start + 1) + 1);
}

}  // namespace

Expected<Json> parse(std::string_view text) {
    if (text.size() > kMaxJsonBytes)
        return fail(ErrorCode::kUnreadable,
                    fmt::format("It has {} bytes, and no Weft file is larger than {} MB",
                                text.size(), kMaxJsonBytes >> 20));
    try {
        return Json::parse(text, ParseGuard());
    } catch (const Refused& refused) {
        return fail(ErrorCode::kUnreadable, refused.message, refused.remedy);
    } catch (const Json::parse_error& error) {
        return fail(ErrorCode::kUnreadable,
                    fmt::format("It is not valid JSON at {}", place_of(text, error.byte)),
                    "correct it or restore a backup");
    } catch (const Json::exception&) {
        return fail(ErrorCode::kUnreadable, "It is not valid JSON: a number is out of range",
                    "correct it or restore a backup");
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::kNoSpace, "Not enough memory to read it");
    }
}

Expected<std::string> to_text(const OrderedJson& value) {
    try {
        return value.dump(2) + "\n";
    } catch (const OrderedJson::exception&) {
        return fail(ErrorCode::kUsage, "A name or path is not UTF-8 text", "rename it");
    }
}

tl::unexpected<Error> fail_at(const std::string& path, std::string message, std::string remedy) {
    return fail(ErrorCode::kUnreadable, path.empty() ? std::move(message) : path + ": " + message,
                std::move(remedy));
}

tl::unexpected<Error> fail_at(const std::string& path, const Error& error) {
    return fail_at(path, error.message, error.remedy);
}

std::string_view type_of(const Json& value) {
    switch (value.type()) {
        case Json::value_t::null:
            return "null";
        case Json::value_t::object:
            return "an object";
        case Json::value_t::array:
            return "a list";
        case Json::value_t::string:
            return "a string";
        case Json::value_t::boolean:
            return "true or false";
        default:
            return "a number";
    }
}

Expected<ObjectReader> ObjectReader::open(const Json& value, std::string path) {
    if (!value.is_object())
        return fail_at(path, fmt::format("This is {}, but must be an object", type_of(value)));
    return ObjectReader(value, std::move(path));
}

const Json* ObjectReader::take(std::string_view key) {
    const auto found = value_->find(key);
    if (found == value_->end()) return nullptr;
    taken_.emplace(key);
    return &*found;
}

std::string ObjectReader::path_of(std::string_view key) const {
    return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

Extras ObjectReader::rest() const {
    Extras out;
    for (const auto& [key, value] : value_->items())
        if (!taken_.contains(key)) out.emplace(key, value.dump());
    return out;
}

Status ObjectReader::expect_no_rest() const {
    for (const auto& [key, value] : value_->items())
        if (!taken_.contains(key))
            return fail_at(path_of(key), "This key is not known here", "correct or remove it");
    return {};
}

Expected<std::int64_t> ObjectReader::integer(std::string_view key, std::int64_t low,
                                             std::int64_t high) {
    const Json* json = take(key);
    if (!json) return fail_at(path_of(key), "This key is missing", "add it");
    // Compared as double first, so that a number beyond 64 bits does not wrap into the range.
    const bool fits = json->is_number_integer() &&
                      json->get<double>() >= static_cast<double>(low) &&
                      json->get<double>() <= static_cast<double>(high);
    if (!fits)
        return fail_at(path_of(key),
                       fmt::format("This must be a whole number from {} to {}", low, high));
    return json->get<std::int64_t>();
}

Expected<std::string> ObjectReader::text(std::string_view key) {
    const Json* json = take(key);
    if (!json) return fail_at(path_of(key), "This key is missing", "add it");
    if (!json->is_string())
        return fail_at(path_of(key),
                       fmt::format("This is {}, but must be a string", type_of(*json)));
    return json->get<std::string>();
}

void write_extras(OrderedJson& object, const Extras& extra) {
    for (const auto& [key, value] : extra) {
        OrderedJson json = OrderedJson::parse(value, nullptr, false);
        if (!json.is_discarded() && !object.contains(key)) object[key] = std::move(json);
    }
}

Expected<ParameterValue> read_value(const Json& value, const std::string& path) {
    switch (value.type()) {
        case Json::value_t::null:
            return ParameterValue();
        case Json::value_t::boolean:
            return ParameterValue(value.get<bool>());
        case Json::value_t::string:
            return ParameterValue(value.get<std::string>());
        case Json::value_t::number_integer:
            return ParameterValue(value.get<std::int64_t>());
        case Json::value_t::number_unsigned: {
            // Numbers beyond 63 bits exceed every range; as a double they fail the range check
            // without wrapping.
            const auto number = value.get<std::uint64_t>();
            if (number > static_cast<std::uint64_t>(INT64_MAX))
                return ParameterValue(static_cast<double>(number));
            return ParameterValue(static_cast<std::int64_t>(number));
        }
        case Json::value_t::number_float:
            return ParameterValue(value.get<double>());
        case Json::value_t::array:
            break;
        default:
            if (value.is_object() && value.contains("columns")) return read_warp(value, path);
            return fail_at(path, fmt::format("This is {}, but must be a value", type_of(value)));
    }
    const auto all = [&](auto&& holds) {
        return !value.empty() && std::all_of(value.begin(), value.end(), holds);
    };
    if (all([](const Json& element) { return element.is_string(); }))
        return ParameterValue(value.get<std::vector<std::string>>());
    if (all([](const Json& element) { return element.is_object(); })) {
        if (value[0].contains("numbers")) return read_guides(value, path);
        return value[0].contains("kind") ? read_lamps(value, path) : read_keys(value, path);
    }
    std::vector<double> numbers;
    for (const Json& element : value) {
        if (!element.is_number())
            return fail_at(path,
                           fmt::format("This list contains {}, but must contain numbers or strings",
                                       type_of(element)));
        numbers.push_back(element.get<double>());
    }
    return ParameterValue(std::move(numbers));
}

bool is_nothing(const ParameterValue& value) {
    const auto* text = std::get_if<std::string>(&value);
    const auto* numbers = std::get_if<std::vector<double>>(&value);
    const auto* texts = std::get_if<std::vector<std::string>>(&value);
    const auto* keyed = std::get_if<KeyedNumbers>(&value);
    const auto* lamps = std::get_if<std::vector<Lamp>>(&value);
    const auto* guides = std::get_if<std::vector<FormGuide>>(&value);
    return std::holds_alternative<std::monostate>(value) || (guides && guides->empty()) ||
           (text && text->empty()) || (texts && texts->empty()) || (numbers && numbers->empty()) ||
           (keyed && keyed->empty()) || (lamps && lamps->empty());
}

OrderedJson write_value(const ParameterInfo& info, const ParameterValue& value) {
    if (const auto* flag = std::get_if<bool>(&value)) return *flag;
    if (const auto* integer = std::get_if<std::int64_t>(&value)) return *integer;
    if (const auto* number = std::get_if<double>(&value)) return *number;
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    if (const auto* texts = std::get_if<std::vector<std::string>>(&value)) return *texts;
    if (const auto* keyed = std::get_if<KeyedNumbers>(&value)) return write_keys(*keyed);
    if (const auto* lamps = std::get_if<std::vector<Lamp>>(&value)) return write_lamps(*lamps);
    if (const auto* guides = std::get_if<std::vector<FormGuide>>(&value))
        return write_guides(*guides);
    if (const auto* warp = std::get_if<GridWarp>(&value)) return write_warp(*warp);
    const auto* numbers = std::get_if<std::vector<double>>(&value);
    if (!numbers) return {};
    if (info.kind != ParameterKind::kFrames) return *numbers;
    return std::vector<std::int64_t>(numbers->begin(), numbers->end());
}

}  // namespace weft::json_codec
