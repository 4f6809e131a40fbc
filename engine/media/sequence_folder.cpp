#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <map>
#include <system_error>

#include "engine/core/frame_range.h"
#include "engine/core/text.h"
#include "engine/media/plates.h"

namespace weft {
namespace fs = std::filesystem;
namespace {

bool is_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

template <std::size_t N>
bool has_extension(const std::string& path, const std::array<const char*, N>& known) {
    const std::string extension = lower_case(fs::path(path).extension().string());
    return std::find(known.begin(), known.end(), extension) != known.end();
}

// A file name split at a number of its stem, counted from the last one. A minus belongs to the
// number if it cannot be a dash between words: at the start, or behind a dot or an underscore.
struct NumberedName {
    std::string prefix, digits, suffix;
};

bool split_name(const std::string& name, NumberedName& out, int from_last = 0) {
    const std::size_t stem = std::min(name.size(), fs::path(name).stem().string().size());
    std::size_t end = stem, begin = stem;
    for (int k = 0; k <= from_last; ++k) {
        end = begin;
        while (end > 0 && !is_digit(name[end - 1]))
            --end;
        begin = end;
        while (begin > 0 && is_digit(name[begin - 1]))
            --begin;
        if (begin == end) return false;
    }
    out.digits = name.substr(begin, end - begin);
    const bool minus = begin > 0 && name[begin - 1] == '-' &&
                       (begin == 1 || name[begin - 2] == '.' || name[begin - 2] == '_');
    out.prefix = name.substr(0, minus ? begin - 1 : begin);
    out.suffix = name.substr(end);
    return true;
}

struct Group {
    std::size_t files = 0;
    std::size_t fewest_digits = 99;
};
using Groups = std::map<std::pair<std::string, std::string>, Group>;  // by prefix and suffix

Expected<Groups> group_files(const std::string& folder, int from_last) {
    Groups groups;
    std::error_code error;
    fs::directory_iterator entry(folder, error);
    for (const fs::directory_iterator end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        NumberedName parts;
        if (name.starts_with('.') || !has_picture_extension(name) ||
            !split_name(name, parts, from_last)) {
            continue;
        }
        Group& group = groups[{parts.prefix, parts.suffix}];
        ++group.files;
        group.fewest_digits = std::min(group.fewest_digits, parts.digits.size());
    }
    if (error) {
        return fail(ErrorCode::kUnreadable,
                    "The folder " + folder + " cannot be read: " + error.message() + ".",
                    "Check its permissions.");
    }
    return groups;
}

// A single picture with a number in its name beside a real sequence is not a second sequence.
bool keep_sequences(Groups& groups) {
    const bool real = std::any_of(groups.begin(), groups.end(),
                                  [](const auto& group) { return group.second.files > 1; });
    if (real) std::erase_if(groups, [](const auto& group) { return group.second.files == 1; });
    return real;
}

std::string pattern_text(const Groups::value_type& group) {
    return group.first.first + std::string(group.second.fewest_digits, '#') + group.first.second;
}

}  // namespace

std::optional<int> number_in_name(const std::string& path) {
    const std::string name = fs::path(path).filename().string();
    NumberedName parts;
    int number = 0;
    if (!split_name(name, parts)) return std::nullopt;
    const char* const end = parts.digits.data() + parts.digits.size();
    const auto [stop, error] = std::from_chars(parts.digits.data(), end, number);
    if (error != std::errc() || stop != end || !is_frame_number(number)) return std::nullopt;
    return name.size() > parts.prefix.size() && name[parts.prefix.size()] == '-' ? -number : number;
}

bool has_movie_extension(const std::string& path) {
    static constexpr std::array kMovies{".mp4", ".mov",  ".m4v", ".mkv", ".avi", ".webm", ".mxf",
                                        ".mpg", ".mpeg", ".wmv", ".ogv", ".mts", ".m2ts"};
    return has_extension(path, kMovies);
}

bool has_picture_extension(const std::string& path) {
    static constexpr std::array kPictures{".png", ".jpg", ".jpeg", ".tif", ".tiff", ".exr", ".dpx",
                                          ".cin", ".tga", ".bmp",  ".hdr", ".webp", ".jp2", ".sgi",
                                          ".rgb", ".iff", ".ppm",  ".pgm", ".pfm",  ".psd"};
    return has_extension(path, kPictures);
}

Expected<SequencePattern> find_sequence(const std::string& folder) {
    WEFT_TRY(groups, group_files(folder, 0));
    bool real = keep_sequences(groups);
    // The number that counts need not be the last: "plate_0001_4k.png".
    constexpr int kMostNumbers = 4;
    for (int k = 1; !real && groups.size() > 1 && k < kMostNumbers; ++k) {
        WEFT_TRY(others, group_files(folder, k));
        real = keep_sequences(others);
        if (real) groups = std::move(others);
    }
    if (groups.empty()) {
        return fail(ErrorCode::kMissingFrames,
                    "The folder " + folder + " has no numbered pictures.",
                    "Give a pattern such as " + folder + "/plate.####.exr, or another folder.");
    }
    if (groups.size() > 1) {
        std::string list;
        for (const auto& group : groups)
            list += (list.empty() ? "" : ", ") + pattern_text(group);
        return fail(ErrorCode::kUsage,
                    "The folder " + folder + " holds several sequences: " + list + ".",
                    "Name the one to use.");
    }
    const std::string slash = folder.ends_with('/') ? "" : "/";
    return SequencePattern::parse(folder + slash + pattern_text(*groups.begin()));
}

}  // namespace weft
