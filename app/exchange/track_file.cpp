#include "app/exchange/track_file.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/core/frame_range.h"
#include "engine/core/input_file.h"
#include "engine/media/atomic_file.h"

namespace weft {
namespace {

using Json = nlohmann::json;

constexpr const char* kTrackSchema = "weft.track/1";

Expected<CornerTrack> parse_json(const std::string& text) {
    const Json file = Json::parse(text, nullptr, false);
    if (!file.is_object() || file.value("schema", Json()) != kTrackSchema ||
        !file.contains("frames") || !file["frames"].is_array()) {
        return fail(ErrorCode::kUnreadable, std::string("It is not JSON of \"schema\": \"") +
                                                kTrackSchema + "\" with a list \"frames\"");
    }
    CornerTrack track;
    for (const Json& entry : file["frames"]) {
        const auto number = entry.is_object() ? entry.find("frame") : entry.end();
        const auto corners = entry.is_object() ? entry.find("corners_px") : entry.end();
        bool good = entry.is_object() && number != entry.end() && number->is_number_integer() &&
                    corners != entry.end() && corners->is_array() && corners->size() == 8;
        good = good && is_frame_number(number->get<std::int64_t>());
        for (std::size_t k = 0; good && k < 8; ++k)
            good = (*corners)[k].is_number() && std::isfinite((*corners)[k].get<double>());
        if (!good) {
            return fail(ErrorCode::kUnreadable,
                        "An entry of \"frames\" has no whole number \"frame\" or no eight numbers "
                        "\"corners_px\"");
        }
        const int frame = static_cast<int>(number->get<std::int64_t>());
        Quad<double> quad;
        for (std::size_t k = 0; k < 4; ++k)
            quad[k] = {(*corners)[2 * k].get<double>(), (*corners)[2 * k + 1].get<double>()};
        if (!track.emplace(frame, quad).second) {
            return fail(ErrorCode::kUnreadable,
                        "Frame " + std::to_string(frame) + " is there twice");
        }
    }
    return completed(std::move(track));
}

}  // namespace

Expected<CornerTrack> read_corner_track(const std::string& path,
                                        const CornerTrackContext& context) {
    WEFT_TRY(text, read_file(path, "The track"));
    // Windows' Notepad begins a file with a byte order mark.
    if (constexpr std::string_view kMark = "\xef\xbb\xbf"; text.starts_with(kMark))
        text.erase(0, kMark.size());
    const std::size_t start = text.find_first_not_of(" \t\r\n");
    const bool is_json = start != std::string::npos && text[start] == '{';
    auto track = is_json ? parse_json(text) : parse_corner_track(text, context);
    if (!track) return fail_in(std::move(track).error(), "The track " + path);
    return track;
}

Status write_corner_track(const std::string& path, const CornerTrack& track,
                          const WriteRule& rule) {
    nlohmann::ordered_json file{{"schema", kTrackSchema},
                                {"frames", nlohmann::ordered_json::array()}};
    for (const auto& [frame, quad] : track) {
        nlohmann::ordered_json corners = nlohmann::ordered_json::array();
        for (const glm::dvec2 corner : quad) {
            corners.push_back(corner.x);
            corners.push_back(corner.y);
        }
        file["frames"].push_back({{"frame", frame}, {"corners_px", std::move(corners)}});
    }
    return write_file_atomically(path, file.dump(1), rule);
}

}  // namespace weft
