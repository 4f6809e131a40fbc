// Grid warps to and from JSON, as described in docs/FORMATS.md.
#include <fmt/format.h>

#include "app/project/codec/json_codec.h"
#include "app/project/codec/project_json.h"
#include "engine/core/frame_range.h"

namespace weft {
namespace json_codec {
namespace {

using glm::dvec2;

constexpr std::array<std::pair<const char*, std::optional<dvec2> WarpPoint::*>, 4> kHandles{
    {{"left", &WarpPoint::left},
     {"right", &WarpPoint::right},
     {"up", &WarpPoint::up},
     {"down", &WarpPoint::down}}};

Expected<dvec2> read_place(const Json* json, const std::string& path) {
    if (json && json->is_array() && json->size() == 2 && (*json)[0].is_number() &&
        (*json)[1].is_number())
        return dvec2((*json)[0].get<double>(), (*json)[1].get<double>());
    return fail_at(path, "This must be two numbers, [x, y]");
}

Expected<std::vector<WarpPoint>> read_grid(const Json& json, const std::string& path,
                                           std::size_t most) {
    if (!json.is_array())
        return fail_at(path,
                       fmt::format("This is {}, but must be a list of points", type_of(json)));
    if (json.size() != most)
        return fail_at(path, fmt::format("This grid has {} points, not {}", most, json.size()));
    std::vector<WarpPoint> points;
    for (std::size_t i = 0; i < json.size(); ++i) {
        WEFT_TRY(object, ObjectReader::open(json[i], fmt::format("{}[{}]", path, i)));
        WarpPoint point;
        WEFT_TRY(at, read_place(object.take("at"), object.path_of("at")));
        point.at = at;
        for (const auto& [key, handle] : kHandles) {
            const Json* given = object.take(key);
            if (!given) continue;
            WEFT_TRY(offset, read_place(given, object.path_of(key)));
            point.*handle = offset;
        }
        WEFT_CHECK_OK(object.expect_no_rest());
        points.push_back(point);
    }
    return points;
}

Status read_warp_keys(const Json& json, const std::string& path, GridWarp& warp) {
    if (!json.is_array() || json.size() > GridWarp::kMostKeys)
        return fail_at(path,
                       fmt::format("This must be a list of at most {} keys", GridWarp::kMostKeys));
    for (std::size_t i = 0; i < json.size(); ++i) {
        WEFT_TRY(object, ObjectReader::open(json[i], fmt::format("{}[{}]", path, i)));
        WEFT_TRY(frame, object.integer("frame", -kMaxFrameNumber, kMaxFrameNumber));
        const Json* given = object.take("points");
        WEFT_CHECK_OK(object.expect_no_rest());
        if (!given) return fail_at(object.path_of("points"), "This key is missing", "add it");
        WEFT_TRY(points, read_grid(*given, object.path_of("points"), warp.count()));
        const std::size_t before = warp.keys.size();
        set_key(warp, static_cast<int>(frame), std::move(points));
        if (warp.keys.size() == before)
            return fail_at(path, fmt::format("Frame {} has two keys", frame), "remove one of them");
    }
    return {};
}

OrderedJson write_points(const std::vector<WarpPoint>& points) {
    const auto place = [](dvec2 p) { return OrderedJson{p.x, p.y}; };
    OrderedJson list = OrderedJson::array();
    for (const WarpPoint& point : points) {
        OrderedJson json{{"at", place(point.at)}};
        for (const auto& [key, handle] : kHandles)
            if (point.*handle) json[key] = place(*(point.*handle));
        list.push_back(std::move(json));
    }
    return list;
}

}  // namespace

Expected<ParameterValue> read_warp(const Json& value, const std::string& path) {
    WEFT_TRY(object, ObjectReader::open(value, path));
    GridWarp warp;
    WEFT_TRY(columns, object.integer("columns", 1, GridWarp::kMostPatches));
    WEFT_TRY(rows, object.integer("rows", 1, GridWarp::kMostPatches));
    warp.columns = static_cast<int>(columns);
    warp.rows = static_cast<int>(rows);
    const Json* corners = object.take("corners");
    if (!corners || !corners->is_array() || corners->size() != 4)
        return fail_at(object.path_of("corners"), "This must be four corners, [[x, y], …]");
    for (std::size_t k = 0; k < 4; ++k) {
        WEFT_TRY(at,
                 read_place(&(*corners)[k], fmt::format("{}[{}]", object.path_of("corners"), k)));
        warp.corners[k] = at;
    }
    if (const Json* falloff = object.take("falloff_px")) {
        if (!falloff->is_number())
            return fail_at(object.path_of("falloff_px"), "This must be a number of pixels");
        warp.falloff_px = falloff->get<double>();
    }
    const Json* points = object.take("points");
    if (const Json* keys = object.take("keys"))
        WEFT_CHECK_OK(read_warp_keys(*keys, object.path_of("keys"), warp));
    WEFT_CHECK_OK(object.expect_no_rest());
    if (points) {
        WEFT_TRY(read, read_grid(*points, object.path_of("points"), warp.count()));
        warp.points = std::move(read);
    } else if (!warp.keys.empty()) {
        warp.points = warp.keys.front().second;
    } else if (is_convex<double>(warp.corners)) {
        warp.points = grid_over(warp.corners, warp.columns, warp.rows).points;
    }
    return ParameterValue(std::move(warp));
}

OrderedJson write_warp(const GridWarp& warp) {
    OrderedJson corners = OrderedJson::array();
    for (const dvec2& corner : warp.corners)
        corners.push_back({corner.x, corner.y});
    OrderedJson out{{"columns", warp.columns},
                    {"rows", warp.rows},
                    {"corners", std::move(corners)},
                    {"falloff_px", warp.falloff_px},
                    {"points", write_points(warp.points)}};
    if (warp.keys.empty()) return out;
    OrderedJson keys = OrderedJson::array();
    for (const auto& [frame, points] : warp.keys)
        keys.push_back(OrderedJson{{"frame", frame}, {"points", write_points(points)}});
    out["keys"] = std::move(keys);
    return out;
}

}  // namespace json_codec

Expected<GridWarp> grid_warp_from_json(std::string_view text) {
    WEFT_TRY(json, json_codec::parse(text));
    WEFT_TRY(value, json_codec::read_warp(json, ""));
    return std::get<GridWarp>(std::move(value));
}

}  // namespace weft
