// Roto shapes to and from JSON, as described in docs/FORMATS.md.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "app/project/codec/json_codec.h"

namespace weft::json_codec {
namespace {

constexpr std::size_t kMostPoints = 100'000;
constexpr std::size_t kNumbers = 7;

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

}  // namespace

Expected<RotoShape> read_shape(const Json& value, const std::string& path) {
    WEFT_TRY(object, ObjectReader::open(value, path));
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

OrderedJson write_shape(const RotoShape& shape) {
    OrderedJson points = OrderedJson::array();
    for (const RotoPoint& p : shape.points)
        points.push_back({p.at.x, p.at.y, p.in.x, p.in.y, p.out.x, p.out.y, p.feather_px});
    return {{"points", std::move(points)}};
}

}  // namespace weft::json_codec
