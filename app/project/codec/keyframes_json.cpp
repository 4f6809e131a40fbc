// The painted frames of a matte: its keyframes, and what is confirmed on other frames.
#include <fmt/format.h>

#include <utility>

#include "app/project/codec/json_codec.h"
#include "engine/core/frame_range.h"

namespace weft::json_codec {

Expected<std::map<int, MatteKeyframe>> read_keyframes(const Json& json, const std::string& path) {
    if (!json.is_array())
        return fail_at(path,
                       fmt::format("This is {}, but must be a list of keyframes", type_of(json)));
    std::map<int, MatteKeyframe> out;
    for (std::size_t i = 0; i < json.size(); ++i) {
        WEFT_TRY(object, ObjectReader::open(json[i], fmt::format("{}[{}]", path, i)));
        WEFT_TRY(frame, object.integer("frame", -kMaxFrameNumber, kMaxFrameNumber));
        WEFT_TRY(file, object.text("path"));
        if (file.find('\0') != std::string::npos)
            return fail_at(object.path_of("path"), "This path contains a zero character",
                           "remove it");
        MatteKeyframe key{std::move(file)};
        if (const Json* shape = object.take("shape")) {
            WEFT_TRY(read, read_shape(*shape, object.path_of("shape")));
            key.shape = std::move(read);
        }
        if (const Json* between = object.take("shape_between"))
            key.shape_between = between->is_boolean() && between->get<bool>();
        key.extra = object.rest();
        if (!out.emplace(static_cast<int>(frame), std::move(key)).second)
            return fail_at(object.path(), fmt::format("Frame {} has two keyframes", frame),
                           "remove one of them");
    }
    return out;
}

Expected<std::map<int, ConfirmedEdge>> read_confirmed(const Json& json, const std::string& path) {
    if (!json.is_array())
        return fail_at(
            path, fmt::format("This is {}, but must be a list of confirmed parts", type_of(json)));
    std::map<int, ConfirmedEdge> out;
    for (std::size_t i = 0; i < json.size(); ++i) {
        WEFT_TRY(object, ObjectReader::open(json[i], fmt::format("{}[{}]", path, i)));
        WEFT_TRY(frame, object.integer("frame", -kMaxFrameNumber, kMaxFrameNumber));
        ConfirmedEdge edge;
        for (const auto& [key, file] : {std::pair{"path", &edge.path}, {"area", &edge.area}}) {
            WEFT_TRY(text, object.text(key));
            if (text.empty() || text.find('\0') != std::string::npos)
                return fail_at(object.path_of(key), "This must be the path of an image");
            *file = std::move(text);
        }
        edge.extra = object.rest();
        if (!out.emplace(static_cast<int>(frame), std::move(edge)).second)
            return fail_at(object.path(), fmt::format("Frame {} is listed twice", frame),
                           "remove one of them");
    }
    return out;
}

OrderedJson write_keyframes(const std::map<int, MatteKeyframe>& keyframes) {
    OrderedJson list = OrderedJson::array();
    for (const auto& [frame, key] : keyframes) {
        OrderedJson entry{{"frame", frame}, {"path", key.path}};
        if (key.shape) entry["shape"] = write_shape(*key.shape);
        if (key.shape_between) entry["shape_between"] = true;
        write_extras(entry, key.extra);
        list.push_back(std::move(entry));
    }
    return list;
}

OrderedJson write_confirmed(const std::map<int, ConfirmedEdge>& confirmed) {
    OrderedJson list = OrderedJson::array();
    for (const auto& [frame, edge] : confirmed) {
        OrderedJson entry{{"frame", frame}, {"path", edge.path}, {"area", edge.area}};
        write_extras(entry, edge.extra);
        list.push_back(std::move(entry));
    }
    return list;
}

}  // namespace weft::json_codec
