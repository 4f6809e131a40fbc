#pragma once
// Builds a table entry from a struct member, given by a path of member pointers. Kind, choices and
// default follow from the member. Internal; only the tables include it.

#include <concepts>
#include <type_traits>

#include "app/project/choices.h"
#include "app/project/parameters.h"
#include "engine/core/frame_range.h"

namespace weft::parameter_entry {

// ---- between members and ParameterValue ------------------------------------------------------

template <class T>
constexpr ParameterKind kind_of(const ParameterInfo& info) {
    if constexpr (std::same_as<T, bool>)
        return ParameterKind::kFlag;
    else if constexpr (std::is_enum_v<T>)
        return ParameterKind::kChoice;
    else if constexpr (std::integral<T> || std::same_as<T, std::optional<int>>)
        return ParameterKind::kInteger;
    else if constexpr (std::floating_point<T> || std::same_as<T, std::optional<double>>)
        return ParameterKind::kNumber;
    else if constexpr (std::same_as<T, PlatePoint>)
        return ParameterKind::kPoint;
    else if constexpr (std::same_as<T, RgbNumbers>)
        return ParameterKind::kRgb;
    else if constexpr (std::same_as<T, std::vector<int>>)
        return ParameterKind::kFrames;
    else if constexpr (std::same_as<T, std::vector<std::string>>)
        return ParameterKind::kPaths;
    else if constexpr (std::same_as<T, std::vector<LayerKind>>)
        return ParameterKind::kNames;
    else if constexpr (std::same_as<T, KeyedNumbers>)
        return ParameterKind::kKeys;
    else if constexpr (std::same_as<T, std::vector<Lamp>>)
        return ParameterKind::kLamps;
    else if constexpr (std::same_as<T, std::vector<FormGuide>>)
        return ParameterKind::kGuides;
    else if constexpr (std::same_as<T, std::optional<GridWarp>>)
        return ParameterKind::kWarp;
    else if constexpr (std::same_as<T, std::string>)
        return info.is_path ? ParameterKind::kPath : ParameterKind::kText;
    else
        return ParameterKind::kCorners;
}

template <class T>
requires std::integral<T> || std::floating_point<T> ParameterValue to_value(const T& member) {
    if constexpr (std::same_as<T, bool>)
        return member;
    else if constexpr (std::integral<T>)
        return static_cast<std::int64_t>(member);
    else
        return member;
}
template <class E>
requires std::is_enum_v<E> ParameterValue to_value(const E& member) {
    return std::string(name_of(member));
}
inline ParameterValue to_value(const std::string& member) {
    return member;
}
inline ParameterValue to_value(const std::vector<std::string>& member) {
    return member;
}
inline ParameterValue to_value(const std::vector<LayerKind>& member) {
    std::vector<std::string> names;
    for (const LayerKind kind : member)
        names.emplace_back(info_of(kind).name);
    return names;
}
inline ParameterValue to_value(const KeyedNumbers& member) {
    return member;
}
inline ParameterValue to_value(const std::vector<Lamp>& member) {
    return member;
}
inline ParameterValue to_value(const std::vector<FormGuide>& member) {
    return member;
}
inline ParameterValue to_value(const std::optional<GridWarp>& member) {
    return member ? ParameterValue(*member) : ParameterValue();
}
inline ParameterValue to_value(const std::optional<int>& member) {
    return member ? ParameterValue(std::int64_t{*member}) : ParameterValue();
}
inline ParameterValue to_value(const std::optional<double>& member) {
    return member ? ParameterValue(*member) : ParameterValue();
}
inline ParameterValue to_value(const PlatePoint& member) {
    return std::vector<double>{member.x, member.y};
}
inline ParameterValue to_value(const RgbNumbers& member) {
    return std::vector<double>{member.r, member.g, member.b};
}
inline ParameterValue to_value(const std::vector<int>& member) {
    return std::vector<double>(member.begin(), member.end());
}
inline ParameterValue to_value(const std::optional<std::array<PlatePoint, 4>>& member) {
    if (!member) return {};
    std::vector<double> out;
    for (const PlatePoint& p : *member)
        out.insert(out.end(), {p.x, p.y});
    return out;
}

template <class T>
requires std::integral<T> || std::floating_point<T>
void from_value(const ParameterValue& value, T& member) {
    if constexpr (std::same_as<T, bool>)
        member = std::get<bool>(value);
    else if constexpr (std::integral<T>)
        member = static_cast<T>(std::get<std::int64_t>(value));
    else
        member = std::get<double>(value);
}
template <class E>
requires std::is_enum_v<E>
void from_value(const ParameterValue& value, E& member) {
    member = choice_from<E>(std::get<std::string>(value));
}
inline void from_value(const ParameterValue& value, std::string& member) {
    member = std::get<std::string>(value);
}
inline void from_value(const ParameterValue& value, std::vector<std::string>& member) {
    member = std::get<std::vector<std::string>>(value);
}
inline void from_value(const ParameterValue& value, std::vector<LayerKind>& member) {
    member.clear();
    for (const std::string& name : std::get<std::vector<std::string>>(value))
        member.push_back(choice_from<LayerKind>(name));
}
inline void from_value(const ParameterValue& value, KeyedNumbers& member) {
    member = std::get<KeyedNumbers>(value);
}
inline void from_value(const ParameterValue& value, std::vector<Lamp>& member) {
    member = std::get<std::vector<Lamp>>(value);
}
inline void from_value(const ParameterValue& value, std::vector<FormGuide>& member) {
    member = std::get<std::vector<FormGuide>>(value);
}
inline void from_value(const ParameterValue& value, std::optional<GridWarp>& member) {
    const auto* warp = std::get_if<GridWarp>(&value);
    member = warp ? std::optional<GridWarp>(*warp) : std::nullopt;
}
inline void from_value(const ParameterValue& value, std::optional<int>& member) {
    const auto* number = std::get_if<std::int64_t>(&value);
    member = number ? std::optional<int>(static_cast<int>(*number)) : std::nullopt;
}
inline void from_value(const ParameterValue& value, std::optional<double>& member) {
    const auto* number = std::get_if<double>(&value);
    member = number ? std::optional<double>(*number) : std::nullopt;
}
inline void from_value(const ParameterValue& value, PlatePoint& member) {
    const auto& xy = std::get<std::vector<double>>(value);
    member = {xy[0], xy[1]};
}
inline void from_value(const ParameterValue& value, RgbNumbers& member) {
    const auto& rgb = std::get<std::vector<double>>(value);
    member = {rgb[0], rgb[1], rgb[2]};
}
inline void from_value(const ParameterValue& value, std::vector<int>& member) {
    const auto& frames = std::get<std::vector<double>>(value);
    member.assign(frames.begin(), frames.end());
}
inline void from_value(const ParameterValue& value,
                       std::optional<std::array<PlatePoint, 4>>& member) {
    member.reset();
    const auto* xy = std::get_if<std::vector<double>>(&value);
    if (!xy) return;
    member.emplace();
    for (std::size_t i = 0; i < 4; ++i)
        (*member)[i] = {(*xy)[2 * i], (*xy)[2 * i + 1]};
}

// ---- a member by the path of member pointers to it -------------------------------------------

template <auto First, auto... Rest>
struct Access {
    template <class Owner>
    static const auto& get(const Owner& owner) {
        return next(owner.*First);
    }
    template <class Owner, class Change>
    static void change(Owner& owner, Change&& apply) {
        if constexpr (sizeof...(Rest) == 0)
            apply(owner.*First);
        else
            change_inside(owner.*First, apply);
    }

  private:
    template <class T>
    static const auto& next(const T& member) {
        if constexpr (sizeof...(Rest) == 0)
            return member;
        else
            return Access<Rest...>::get(member);
    }
    template <class T>
    static const auto& next(const Leaf<T>& member) {
        return next(*member);
    }
    template <class T, class Change>
    static void change_inside(T& member, Change& apply) {
        Access<Rest...>::change(member, apply);
    }
    template <class T, class Change>
    static void change_inside(Leaf<T>& member, Change& apply) {
        member = member.with([&](T& value) { Access<Rest...>::change(value, apply); });
    }
};

template <class Owner, auto... Path>
Parameter<Owner> entry(ParameterInfo info) {
    using Member =
        std::remove_cvref_t<decltype(Access<Path...>::get(std::declval<const Owner&>()))>;
    Parameter<Owner> out{std::move(info)};
    out.kind = kind_of<Member>(out);
    if constexpr (std::is_enum_v<Member>)
        for (const auto& choice : Choices<Member>::kNames)
            out.choices.push_back(choice.second);
    if constexpr (std::same_as<Member, std::vector<LayerKind>>)
        for (const LayerInfo& layer : kLayers)
            out.choices.push_back(layer.name);
    out.read = [](const Owner& owner) { return to_value(Access<Path...>::get(owner)); };
    out.write = [](Owner& owner, const ParameterValue& value) {
        Access<Path...>::change(owner, [&](auto& member) { from_value(value, member); });
    };
    out.default_value = out.read(Owner{});
    return out;
}

inline constexpr double kMaxFrame = kMaxFrameNumber;  // either sign
inline constexpr double kMaxPlatePx = 1'000'000;
inline constexpr double kMaxExactInteger = 9007199254740991;  // 2^53 − 1: exact in any JSON reader

}  // namespace weft::parameter_entry
