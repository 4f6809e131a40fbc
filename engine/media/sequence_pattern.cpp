#include "engine/media/sequence_pattern.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <limits>
#include <map>
#include <system_error>

#include "engine/core/frame_range.h"

namespace weft {
namespace {

struct Placeholder {
    std::size_t begin = 0;
    std::size_t length = 0;
    int padding = 1;
    bool printf = false;
};

constexpr int kMaxPadding = 12;
constexpr std::int64_t kBeyond = std::numeric_limits<std::int64_t>::max();

/// A run of # or of @, or %d, %04d, that starts at `i`; length 0 if there is none.
Placeholder placeholder_at(std::string_view s, std::size_t i) {
    if (s[i] == '#' || s[i] == '@') {
        std::size_t end = i;
        while (end < s.size() && s[end] == s[i])
            ++end;
        return {i, end - i, static_cast<int>(std::min<std::size_t>(end - i, kMaxPadding + 1))};
    }
    if (s[i] != '%') return {};
    std::size_t end = i + 1;
    const bool zero = end < s.size() && s[end] == '0';
    int width = 0;
    while (end < s.size() && std::isdigit(static_cast<unsigned char>(s[end])) && width < 1000) {
        width = width * 10 + (s[end++] - '0');
    }
    // %4d would pad with blanks, which no renderer writes, so it is not a placeholder.
    if (end >= s.size() || s[end] != 'd' || (width > 0 && !zero)) return {};
    return {i, end + 1 - i, std::max(1, std::min(width, kMaxPadding + 1)), true};
}

std::vector<Placeholder> placeholders_in(std::string_view s) {
    std::vector<Placeholder> found;
    for (std::size_t i = 0; i < s.size();) {
        const Placeholder p = placeholder_at(s, i);
        if (p.length > 0) found.push_back(p);
        i += std::max<std::size_t>(1, p.length);
    }
    return found;
}

bool is_one_character(const Placeholder& p) {
    return p.length == 1 && !p.printf;
}

// A single # or @ stands for a number unless there is a file of that very name: logo@2x.png.
bool is_part_of_name(const std::vector<Placeholder>& found, const std::string& path) {
    std::error_code ignored;
    return found.size() == 1 && is_one_character(found[0]) &&
           std::filesystem::is_regular_file(path, ignored);
}

// Beside a longer placeholder it is part of the name, too: take#2.####.exr.
void leave_out_single(std::vector<Placeholder>& found) {
    const auto longer = std::count_if(found.begin(), found.end(),
                                      [](const Placeholder& p) { return !is_one_character(p); });
    if (longer == 1) std::erase_if(found, is_one_character);
}

// With `sign_counts` the minus is one of the places, as printf counts them.
std::string padded(std::int64_t frame, int padding, bool sign_counts) {
    std::string digits = std::to_string(frame < 0 ? -frame : frame);
    if (frame < 0 && sign_counts) --padding;
    if (static_cast<int>(digits.size()) < padding) {
        digits.insert(0, static_cast<std::size_t>(padding) - digits.size(), '0');
    }
    return frame < 0 ? "-" + digits : digits;
}

// The number between the prefix and the suffix, in any spelling.
std::optional<std::int64_t> any_number_in(std::string_view path, const std::string& prefix,
                                          const std::string& suffix) {
    if (path.size() <= prefix.size() + suffix.size()) return std::nullopt;
    if (!path.starts_with(prefix) || !path.ends_with(suffix)) return std::nullopt;
    const std::string_view number =
        path.substr(prefix.size(), path.size() - prefix.size() - suffix.size());
    std::int64_t frame = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), frame);
    if (end != number.data() + number.size()) return std::nullopt;
    if (error == std::errc::result_out_of_range || frame < -kBeyond) return kBeyond;
    if (error != std::errc()) return std::nullopt;
    return frame;
}

// A file that belongs to the sequence by its number, but is padded otherwise: of a frame that is
// missing between the others or directly beside them. What lies further off is another sequence.
Status check_padding(const SequencePattern& pattern, const std::vector<int>& frames,
                     const std::map<std::int64_t, std::string>& others) {
    if (frames.empty()) return {};
    for (const auto& [frame, path] : others) {
        if (frame < frames.front() - 1 || frame > frames.back() + 1 ||
            std::binary_search(frames.begin(), frames.end(), frame))
            continue;
        return fail(
            ErrorCode::kUsage,
            path + " is frame " + std::to_string(frame) + ", but for " + pattern.text() +
                " that frame is " + pattern.path_for(static_cast<int>(frame)) + ".",
            "Give all files the same padding, or name the pattern of those that are meant.");
    }
    return {};
}

}  // namespace

Expected<SequencePattern> SequencePattern::parse(std::string_view text) {
    const std::size_t slash = text.rfind('/');
    const std::size_t name_at = slash == std::string_view::npos ? 0 : slash + 1;
    const std::string whole(text);
    if (name_at == text.size()) {
        return fail(ErrorCode::kUsage, "'" + whole + "' has no file name.",
                    "Write a name such as plate.####.exr.");
    }
    for (const Placeholder& p : placeholders_in(text.substr(0, name_at))) {
        if (p.length == 1) continue;
        return fail(ErrorCode::kUsage, "'" + whole + "' has a frame number in its folder part.",
                    "Only the file name can have one, such as plate.####.exr.");
    }
    std::vector<Placeholder> found = placeholders_in(text.substr(name_at));
    if (is_part_of_name(found, whole)) found.clear();
    leave_out_single(found);
    if (found.size() > 1) {
        return fail(ErrorCode::kUsage, "'" + whole + "' has more than one frame number.",
                    "Leave one of them, such as plate.####.exr.");
    }
    SequencePattern pattern;
    pattern.text_ = whole;
    if (found.empty()) return pattern;
    if (found[0].padding > kMaxPadding) {
        return fail(ErrorCode::kUsage, "'" + whole + "' asks for more than 12 digits.",
                    "Use fewer.");
    }
    const std::size_t begin = name_at + found[0].begin;
    pattern.numbered_ = true;
    pattern.padding_ = found[0].padding;
    pattern.printf_ = found[0].printf;
    pattern.prefix_ = whole.substr(0, begin);
    pattern.suffix_ = whole.substr(begin + found[0].length);
    return pattern;
}

SequencePattern SequencePattern::single(std::string_view path) {
    SequencePattern pattern;
    pattern.text_ = std::string(path);
    return pattern;
}

std::string SequencePattern::path_for(int frame) const {
    return numbered_ ? prefix_ + padded(frame, padding_, printf_) + suffix_ : text_;
}

std::optional<std::int64_t> SequencePattern::number_in(std::string_view path,
                                                       bool sign_counts) const {
    if (!numbered_) return std::nullopt;
    const auto frame = any_number_in(path, prefix_, suffix_);
    if (!frame || *frame == kBeyond) return frame;
    // #### would not write 00012, nor -0: each number has one file name, and each file name one
    // number.
    const std::string_view number =
        path.substr(prefix_.size(), path.size() - prefix_.size() - suffix_.size());
    if (padded(*frame, padding_, sign_counts) != number) return std::nullopt;
    return frame;
}

std::optional<int> SequencePattern::frame_of(std::string_view path) const {
    const auto number = number_in(path, printf_);
    if (!number || !is_frame_number(*number)) return std::nullopt;
    return static_cast<int>(*number);
}

Error SequencePattern::other_spelling(const std::string& path, std::int64_t frame) const {
    const std::string places = std::to_string(padding_);
    const std::string fitting =
        printf_ ? std::string(static_cast<std::size_t>(padding_), '#') : "%0" + places + "d";
    const std::string own = prefix_ + padded(frame, padding_, printf_) + suffix_;
    Error error;
    error.code = ErrorCode::kUsage;
    error.message = path + " is frame " + std::to_string(frame) + " with its minus " +
                    (printf_ ? "beside" : "as one of") + " the " + places + " places, but for " +
                    text_ + " that frame is " + own + ".";
    error.remedy = "Write " + fitting + " for the frame number, or rename the files.";
    return error;
}

Expected<std::vector<int>> SequencePattern::list_frames() const {
    std::vector<int> frames;
    std::map<std::int64_t, std::string> otherwise_padded;
    if (!numbered_) return frames;
    const std::size_t slash = prefix_.rfind('/');
    const std::string folder = slash == std::string::npos ? "" : prefix_.substr(0, slash + 1);
    std::error_code error;
    std::filesystem::directory_iterator entry(folder.empty() ? "." : folder, error);
    for (const std::filesystem::directory_iterator end; !error && entry != end;
         entry.increment(error)) {
        const std::string path = folder + entry->path().filename().string();
        const auto number = number_in(path, printf_);
        if (const auto other = number_in(path, !printf_); !number && other)
            return tl::unexpected(other_spelling(path, *other));
        if (const auto other = any_number_in(path, prefix_, suffix_); !number && other)
            otherwise_padded.emplace(*other, path);
        if (!number) continue;
        if (!is_frame_number(*number)) {
            return fail(
                ErrorCode::kUnreadable,
                path + " has a frame number beyond " + std::to_string(kMaxFrameNumber) + ".",
                "Renumber it, or take it out of the folder.");
        }
        frames.push_back(static_cast<int>(*number));
    }
    if (error) {
        return fail(ErrorCode::kUnreadable,
                    "The folder " + (folder.empty() ? "." : folder) +
                        " cannot be read: " + error.message() + ".",
                    "Check the path and its permissions.");
    }
    std::sort(frames.begin(), frames.end());
    WEFT_CHECK_OK(check_padding(*this, frames, otherwise_padded));
    return frames;
}

}  // namespace weft
