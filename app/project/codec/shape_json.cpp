// Roto shapes to and from JSON, as described in docs/FORMATS.md.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/project/codec/json_codec.h"
#include "engine/core/frame_range.h"

namespace weft::json_codec {
namespace {

constexpr std::size_t kMostPoints = 100'000;
constexpr std::size_t kNumbers = 7;
constexpr std::size_t kMostKeys = 100'000;
constexpr std::array<std::pair<ShapeFollow, std::string_view>, 4> kFollows{
    {{ShapeFollow::kNone, "none"},
     {ShapeFollow::kPosition, "position"},
     {ShapeFollow::kSimilarity, "position_rotation_scale"},
     {ShapeFollow::kPlanar, "planar"}}};

Expected<RotoPoint> read_point(const Json& json, const std::string& path) {
    if (!json.is_array() || json.size() != kNumbers)
        return fail_at(path, fmt::format("This must be a list of {} numbers", kNumbers));
    std::array<float, kNumbers> n{};
    for (std::size_t k = 0; k < kNumbers; ++k) {
        if (json[k].is_number()) n[k] = json[k].get<float>();
        if (!json[k].is_number() || !std::isfinite(n[k]))
            return fail_at(path, fmt::format("This must be a list of {} numbers", kNumbers));
    }
    return RotoPoint{{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}, n[6]};
}

Expected<RotoShape> read_points(ObjectReader& object, const std::string& path) {
    const Json* points = object.take("points");
    if (!points || !points->is_array() || points->size() > kMostPoints)
        return fail_at(object.path_of("points"),
                       fmt::format("This must be a list of at most {} points", kMostPoints));
    RotoShape shape;
    for (std::size_t i = 0; i < points->size(); ++i) {
        WEFT_TRY(point, read_point((*points)[i], fmt::format("{}.points[{}]", path, i)));
        shape.points.push_back(point);
    }
    return shape;
}

Expected<std::map<int, RotoShape>> read_shape_keys(const Json& json, const std::string& path) {
    if (!json.is_array() || json.empty() || json.size() > kMostKeys)
        return fail_at(path, fmt::format("This must be a list of 1 to {} keys", kMostKeys));
    std::map<int, RotoShape> out;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const std::string where = fmt::format("{}[{}]", path, i);
        WEFT_TRY(object, ObjectReader::open(json[i], where));
        WEFT_TRY(frame, object.integer("frame", -kMaxFrameNumber, kMaxFrameNumber));
        WEFT_TRY(shape, read_points(object, where));
        WEFT_CHECK_OK(object.expect_no_rest());
        if (!out.emplace(static_cast<int>(frame), std::move(shape)).second)
            return fail_at(path, fmt::format("Frame {} has two keys", frame), "remove one of them");
    }
    return out;
}

}  // namespace

Expected<RotoShape> read_shape(const Json& value, const std::string& path) {
    WEFT_TRY(object, ObjectReader::open(value, path));
    return read_points(object, path);
}

Expected<KeyedShape> read_keyed_shape(const Json& value, const std::string& path) {
    WEFT_TRY(object, ObjectReader::open(value, path));
    KeyedShape out;
    if (const Json* follow = object.take("follow")) {
        const auto* const known =
            std::find_if(kFollows.begin(), kFollows.end(),
                         [&](const auto& entry) { return *follow == entry.second; });
        if (known == kFollows.end())
            return fail_at(object.path_of("follow"),
                           "This must be none, position, position_rotation_scale or planar");
        out.follow = known->first;
    }
    if (const Json* track = object.take("track")) {
        if (!track->is_string() || track->get<std::string>().find('\0') != std::string::npos)
            return fail_at(object.path_of("track"), "This must be the path of a track");
        out.track = track->get<std::string>();
    }
    const Json* keys = object.take("keys");
    WEFT_CHECK_OK(object.expect_no_rest());
    if (!keys) return fail_at(object.path_of("keys"), "This key is missing", "add it");
    WEFT_TRY(shapes, read_shape_keys(*keys, object.path_of("keys")));
    out.keys = std::move(shapes);
    return out;
}

OrderedJson write_keyed_shape(const KeyedShape& shape) {
    OrderedJson out = OrderedJson::object();
    for (const auto& [follow, name] : kFollows)
        if (follow == shape.follow) out["follow"] = name;
    if (!shape.track.empty()) out["track"] = shape.track;
    OrderedJson& keys = out["keys"] = OrderedJson::array();
    for (const auto& [frame, drawn] : shape.keys) {
        OrderedJson key{{"frame", frame}};
        key.update(write_shape(drawn));
        keys.push_back(std::move(key));
    }
    return out;
}

OrderedJson write_shape(const RotoShape& shape) {
    OrderedJson points = OrderedJson::array();
    for (const RotoPoint& p : shape.points)
        points.push_back({p.at.x, p.at.y, p.in.x, p.in.y, p.out.x, p.out.y, p.feather_px});
    return {{"points", std::move(points)}};
}

}  // namespace weft::json_codec
