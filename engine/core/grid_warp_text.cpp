// Grid warps as text, for the command line and scripts.
#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "engine/core/grid_warp.h"
#include "engine/core/text.h"

namespace weft {
namespace {

using glm::dvec2;

std::string point_text(const WarpPoint& point) {
    std::string out = fmt::format("{},{}", point.at.x, point.at.y);
    const auto add = [&](char side, const std::optional<dvec2>& handle) {
        if (handle) out += fmt::format(":{}{},{}", side, handle->x, handle->y);
    };
    add('l', point.left);
    add('r', point.right);
    add('u', point.up);
    add('d', point.down);
    return out;
}

std::optional<double> number_of(std::string_view text) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

std::optional<dvec2> pair_of(std::string_view text) {
    const std::size_t comma = text.find(',');
    if (comma == std::string_view::npos) return std::nullopt;
    const auto x = number_of(text.substr(0, comma)), y = number_of(text.substr(comma + 1));
    if (!x || !y) return std::nullopt;
    return dvec2(*x, *y);
}

tl::unexpected<Error> unclear(std::string_view word, std::string_view wanted) {
    return fail(ErrorCode::kUsage, fmt::format("{} is not {}", quoted(word.substr(0, 60)), wanted));
}

Expected<WarpPoint> read_point(std::string_view word) {
    const auto wrong = [&] {
        return unclear(word, "a point such as 320,180 or 320,180:l-40,0:r40,0:u0,-30:d0,30");
    };
    WarpPoint out;
    bool first = true;
    for (std::string_view part : split(word, ':')) {
        std::optional<dvec2>* handle = nullptr;
        if (!first) {
            if (part.empty()) return wrong();
            switch (part.front()) {
                case 'l':
                    handle = &out.left;
                    break;
                case 'r':
                    handle = &out.right;
                    break;
                case 'u':
                    handle = &out.up;
                    break;
                case 'd':
                    handle = &out.down;
                    break;
                default:
                    return wrong();
            }
            part.remove_prefix(1);
        }
        const auto xy = pair_of(part);
        if (!xy) return wrong();
        if (first)
            out.at = *xy;
        else
            *handle = *xy;
        first = false;
    }
    return out;
}

// The words of a text one after the other.
class Words {
  public:
    explicit Words(std::string_view text) : text_(text) {}
    [[nodiscard]] std::string_view peek() const {
        constexpr std::string_view kBetween = " \t\n";
        const std::size_t from = text_.find_first_not_of(kBetween);
        if (from == std::string_view::npos) return {};
        return text_.substr(from, text_.find_first_of(kBetween, from) - from);
    }
    std::string_view next() {
        const std::string_view word = peek();
        if (word.empty())
            text_ = {};
        else
            text_.remove_prefix(static_cast<std::size_t>(word.data() - text_.data()) + word.size());
        return word;
    }

  private:
    std::string_view text_;
};

Expected<std::vector<WarpPoint>> read_points(Words& words, std::size_t most) {
    std::vector<WarpPoint> out;
    while (!words.peek().empty() && words.peek() != "key") {
        if (out.size() == most)
            return fail(ErrorCode::kUsage, fmt::format("it has more than {} points", most));
        WEFT_TRY(point, read_point(words.next()));
        out.push_back(point);
    }
    return out;
}

Status read_size(std::string_view word, GridWarp& warp) {
    const std::size_t times = word.find('x');
    const auto columns = number_of(word.substr(0, times));
    const auto rows =
        times == std::string_view::npos ? std::nullopt : number_of(word.substr(times + 1));
    const auto fits = [](std::optional<double> n) {
        return n && *n >= 1 && *n <= GridWarp::kMostPatches && std::trunc(*n) == *n;
    };
    if (!fits(columns) || !fits(rows))
        return unclear(word, fmt::format("COLUMNSxROWS, 1x1 to {0}x{0}", GridWarp::kMostPatches));
    warp.columns = static_cast<int>(*columns);
    warp.rows = static_cast<int>(*rows);
    return {};
}

Status read_keys(Words& words, GridWarp& warp) {
    while (!words.peek().empty()) {
        words.next();  // "key", where read_points() stopped
        const std::string_view word = words.next();
        const auto frame = number_of(word);
        constexpr double kMostFrame = 1e9;
        if (!frame || std::trunc(*frame) != *frame || std::abs(*frame) > kMostFrame)
            return unclear(word, "the frame of a key");
        if (warp.keys.size() == GridWarp::kMostKeys)
            return fail(ErrorCode::kUsage,
                        fmt::format("it has more than {} keys", GridWarp::kMostKeys));
        WEFT_TRY(points, read_points(words, warp.count()));
        set_key(warp, static_cast<int>(*frame), std::move(points));
    }
    return {};
}

}  // namespace

Expected<GridWarp> parse_grid_warp(std::string_view text) {
    GridWarp warp;
    Words words(text);
    WEFT_CHECK_OK(read_size(words.next(), warp));
    if (words.next() != "corners")
        return fail(ErrorCode::kUsage, "after the size it needs the word corners and four places");
    for (dvec2& corner : warp.corners) {
        const std::string_view word = words.next();
        const auto xy = pair_of(word);
        if (!xy) return unclear(word, "a corner such as 640,360");
        corner = *xy;
    }
    if (words.peek() == "falloff") {
        words.next();
        const std::string_view word = words.next();
        const auto px = number_of(word);
        if (!px) return unclear(word, "a fall-off in pixels");
        warp.falloff_px = *px;
    }
    if (words.peek().empty()) {
        const bool usable = is_convex<double>(warp.corners);
        if (usable) warp.points = grid_over(warp.corners, warp.columns, warp.rows).points;
        return warp;
    }
    if (const std::string_view word = words.next(); word != "points")
        return unclear(word, "the word falloff or points");
    WEFT_TRY(points, read_points(words, warp.count()));
    warp.points = std::move(points);
    WEFT_CHECK_OK(read_keys(words, warp));
    return warp;
}

std::string grid_warp_text(const GridWarp& warp) {
    std::string out = fmt::format("{}x{} corners", warp.columns, warp.rows);
    for (const dvec2& corner : warp.corners)
        out += fmt::format(" {},{}", corner.x, corner.y);
    if (warp.falloff_px != 0) out += fmt::format(" falloff {}", warp.falloff_px);
    out += " points";
    for (const WarpPoint& point : warp.points)
        out += " " + point_text(point);
    for (const auto& [frame, points] : warp.keys) {
        out += fmt::format(" key {}", frame);
        for (const WarpPoint& point : points)
            out += " " + point_text(point);
    }
    return out;
}

}  // namespace weft
