#include "app/shot/matte_movies.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>

#include "app/exchange/region_matte_sources.h"
#include "engine/media/matte_movie.h"

namespace weft {
namespace {

// Of the plate itself: frames that repeat its first one may come before it.
int first_frame(const FrameReader& plate) {
    return plate.frames().empty() ? 0 : plate.shown_frame(plate.frames().front());
}
int last_frame(const FrameReader& plate) {
    return plate.frames().empty() ? 0 : plate.shown_frame(plate.frames().back());
}

std::string count_warning(const std::string& name, const std::string& path, int count,
                          const FrameReader& plate) {
    const int first = first_frame(plate), plate_count = last_frame(plate) - first + 1;
    if (count == plate_count) return {};
    return "Region '" + name + "': the matte " + path + " has " + std::to_string(count) +
           " frames, but the plate has " + std::to_string(plate_count) +
           ". Its first one is used for frame " + std::to_string(first) +
           ": check that they begin together.";
}

}  // namespace

Expected<MatteFiles> matte_files(const std::string& text, const FrameReader& plate) {
    return MatteFiles::parse(text, first_frame(plate));
}

int matte_frame(const MatteFiles& files, int frame, const FrameReader& plate) {
    const int shown = plate.shown_frame(frame);
    if (shown == frame) return frame;
    if (files.is_movie()) {
        const auto frames = files.list_frames();
        return frames && std::binary_search(frames->begin(), frames->end(), frame) ? frame : shown;
    }
    std::error_code ignored;
    return std::filesystem::exists(files.path_for(frame), ignored) ? frame : shown;
}

Expected<std::vector<int>> frames_with_files(const std::string& text, const FrameReader& plate,
                                             std::vector<int> frames) {
    if (text.empty()) return frames;
    WEFT_TRY(files, matte_files(text, plate));
    if (files.is_single()) return frames;
    WEFT_TRY(present, files.list_frames());
    std::vector<int> both;
    std::set_intersection(frames.begin(), frames.end(), present.begin(), present.end(),
                          std::back_inserter(both));
    std::erase_if(both, [&](int frame) {
        std::error_code ignored;  // a link may lead nowhere
        return !std::filesystem::exists(files.path_for(frame), ignored);
    });
    return both;
}

Expected<std::vector<std::string>> check_matte_movies(const Region& region,
                                                      const FrameReader& plate) {
    std::vector<std::string> warnings;
    std::set<std::string> seen;
    const auto check = [&](const std::string& text, const MatteSelect& select) -> Status {
        if (text.empty()) return {};
        // A pattern that is wrong is reported where its files are looked for.
        const auto files = matte_files(text, plate);
        if (!files || !files->is_movie()) return {};
        WEFT_CHECK_OK(files->check_select(select));
        if (!seen.insert(text).second) return {};
        WEFT_TRY(movie, MatteMovie::open(text));
        auto own = movie->warnings();
        std::move(own.begin(), own.end(), std::back_inserter(warnings));
        auto counted = count_warning(region.name, text, movie->frame_count(), plate);
        if (!counted.empty()) warnings.push_back(std::move(counted));
        if (!select.channel.empty()) return {};
        WEFT_TRY(judged, movie->judge());
        if (!judged.empty()) warnings.push_back("Region '" + region.name + "': " + judged);
        return {};
    };
    for (const MatteSource* matte : matte_sources(region))
        WEFT_CHECK_OK(check(matte->files, matte->select));
    WEFT_CHECK_OK(check(region.lines.files, {}));
    return warnings;
}

}  // namespace weft
