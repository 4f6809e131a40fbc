#include "app/render/version_up.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>

#include "engine/core/setting.h"
#include "engine/media/sequence_pattern.h"

namespace weft {
namespace {

struct Token {
    std::size_t at = 0, digits = 0;  // digits after the v
    int number = 0;
};

bool is_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0;
}

// Finds the next version from `from` on: a v with at least two digits that is not part of a longer
// word.
std::optional<Token> next_token(const std::string& path, std::size_t from) {
    for (std::size_t i = from; i + 1 < path.size(); ++i) {
        if ((path[i] != 'v' && path[i] != 'V') || (i > 0 && is_word(path[i - 1]))) continue;
        std::size_t end = i + 1;
        while (end < path.size() && std::isdigit(static_cast<unsigned char>(path[end])))
            ++end;
        Token token{i + 1, end - i - 1, 0};
        constexpr std::size_t kFewest = 2, kMost = 6;
        if (token.digits < kFewest || token.digits > kMost ||
            (end < path.size() && is_word(path[end])))
            continue;
        std::from_chars(path.data() + token.at, path.data() + end, token.number);
        return token;
    }
    return std::nullopt;
}

std::string with_version(std::string path, int version) {
    std::size_t from = 0;
    while (const auto token = next_token(path, from)) {
        std::string digits = std::to_string(version);
        digits.insert(0, token->digits - std::min(token->digits, digits.size()), '0');
        path.replace(token->at, token->digits, digits);
        from = token->at + digits.size();
    }
    return path;
}

bool is_there(const std::string& path) {
    const auto pattern = SequencePattern::parse(path);
    std::error_code ignored;
    if (!pattern || pattern->is_single()) return std::filesystem::exists(path, ignored);
    const auto frames = pattern->list_frames();
    return frames && !frames->empty();
}

}  // namespace

std::optional<int> version_in(const std::string& path) {
    std::optional<int> found;
    std::size_t from = 0;
    while (const auto token = next_token(path, from)) {
        found = token->number;
        from = token->at + token->digits;
    }
    return found;
}

Expected<Project> version_up(const Project& project) {
    const auto own = version_in(project.output.path);
    if (!own) {
        return fail(ErrorCode::kUsage, "The output " + project.output.path + " has no version.",
                    "Name it like 'out/shot_v001.####.exr' to version up" +
                        by({{setting::kVersionUp}}) + ".");
    }
    constexpr int kLookedAhead = 1000;
    int version = *own;
    for (int k = *own; k < *own + kLookedAhead; ++k) {
        if (is_there(with_version(project.output.path, k))) version = k + 1;
    }
    Project out = project;
    for (std::string* path : {&out.output.path, &out.output.movie, &out.output.layers_path})
        *path = with_version(*path, version);
    return out;
}

}  // namespace weft
