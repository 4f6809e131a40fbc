#include "engine/form/picture_lines.h"

#include <algorithm>
#include <array>
#include <map>
#include <opencv2/imgproc.hpp>

#include "engine/motion/view_mat.h"

namespace weft {
namespace {

constexpr int kMostSide = 1280;         // px; a long edge of a larger picture falls to pieces
constexpr double kLeastLength = 0.022;  // of the long side
constexpr double kLeastPiece = 0.007;   // of the long side
constexpr double kOneLine = 1.0 / 960;  // of the long side: pieces that far from a line are of it
constexpr double kGap = 0.04;           // of the long side, between two pieces of a line
constexpr double kRounded = 16;         // of a pixel
constexpr double kInside = 0.9;         // of a line's length
constexpr double kBeside = 0.005;       // of the long side: the outline's own edge lies about there
constexpr int kSamples = 21;            // of a line
constexpr int kSquares = 16;            // along the long side
constexpr int kAlike = 2;               // lines of one direction in one square that count

double to_grid(double v) {
    return std::round(v * kRounded) / kRounded;
}

// Which of twelve directions, without trigonometry: the slope of the line against tan 15° k.
int direction_of(const PictureLine& line) {
    constexpr std::array kTangents{0.2679491924311227, 0.5773502691896258, 1.0, 1.7320508075688772,
                                   3.7320508075688776};
    const glm::dvec2 d = line.to - line.from;
    const double run = std::abs(d.x), rise = std::abs(d.y);
    int out = 0;
    for (const double tangent : kTangents)
        out += rise > tangent * run;
    return d.x * d.y < 0 ? 11 - out : out;
}

void longest_first(std::vector<PictureLine>& lines) {
    std::stable_sort(lines.begin(), lines.end(), [](const PictureLine& a, const PictureLine& b) {
        return a.length() > b.length();
    });
}

double across(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.y - a.y * b.x;
}

// Where a piece begins and ends along a line from `from` in a unit direction.
struct Reach {
    double from, to;
    std::size_t piece;
};

// The pieces that lie on the line of one of them, from one end to the other without a gap, in the
// order along it.
std::vector<Reach> pieces_of(const std::vector<PictureLine>& pieces, std::size_t seed,
                             const std::vector<bool>& taken, double side) {
    const glm::dvec2 origin = pieces[seed].from,
                     along = (pieces[seed].to - origin) / pieces[seed].length();
    std::vector<Reach> on;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        if (taken[k]) continue;
        const glm::dvec2 a = pieces[k].from - origin, b = pieces[k].to - origin;
        if (std::abs(across(along, a)) > kOneLine * side ||
            std::abs(across(along, b)) > kOneLine * side)
            continue;
        const double from = along.x * a.x + along.y * a.y, to = along.x * b.x + along.y * b.y;
        on.push_back({std::min(from, to), std::max(from, to), k});
    }
    std::sort(on.begin(), on.end(), [](const Reach& a, const Reach& b) {
        return a.from != b.from ? a.from < b.from : a.piece < b.piece;
    });
    std::vector<Reach> out;
    bool with_seed = false;
    double end = 0;
    for (const Reach& reach : on) {
        if (!out.empty() && reach.from > end + kGap * side) {
            if (with_seed) break;
            out.clear();
        }
        end = out.empty() ? reach.to : std::max(end, reach.to);
        with_seed = with_seed || reach.piece == seed;
        out.push_back(reach);
    }
    return out;
}

// The line through all of them: their first principal axis, by length.
PictureLine through(const std::vector<PictureLine>& pieces, const std::vector<Reach>& of) {
    glm::dvec2 sum(0);
    double all = 0;
    for (const Reach& reach : of) {
        const PictureLine& piece = pieces[reach.piece];
        sum += 0.5 * piece.length() * (piece.from + piece.to);
        all += piece.length();
    }
    const glm::dvec2 middle = sum / all;
    double xx = 0, xy = 0, yy = 0;
    for (const Reach& reach : of) {
        const PictureLine& piece = pieces[reach.piece];
        for (const glm::dvec2 end : {piece.from, piece.to}) {
            const glm::dvec2 d = end - middle;
            xx += piece.length() * d.x * d.x;
            xy += piece.length() * d.x * d.y;
            yy += piece.length() * d.y * d.y;
        }
    }
    const double half = 0.5 * (xx - yy), root = std::sqrt(half * half + xy * xy);
    glm::dvec2 along = half >= 0 ? glm::dvec2(half + root, xy) : glm::dvec2(xy, root - half);
    const double length = std::sqrt(along.x * along.x + along.y * along.y);
    if (!(length > 0)) return pieces[of.front().piece];
    along /= length;
    double least = 0, most = 0;
    for (const Reach& reach : of)
        for (const glm::dvec2 end : {pieces[reach.piece].from, pieces[reach.piece].to}) {
            const double at = along.x * (end.x - middle.x) + along.y * (end.y - middle.y);
            least = std::min(least, at);
            most = std::max(most, at);
        }
    return {middle + least * along, middle + most * along};
}

// Lines that other lines cross are found in pieces.
std::vector<PictureLine> joined(std::vector<PictureLine> pieces, double side) {
    longest_first(pieces);
    std::vector<bool> taken(pieces.size(), false);
    std::vector<PictureLine> out;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        if (taken[k]) continue;
        const std::vector<Reach> of = pieces_of(pieces, k, taken, side);
        for (const Reach& reach : of)
            taken[reach.piece] = true;
        out.push_back(of.size() == 1 ? pieces[k] : through(pieces, of));
    }
    return out;
}

}  // namespace

std::vector<PictureLine> picture_lines(ViewU8x1 luma) {
    const cv::Mat given = as_mat(luma);
    const int side = std::max(given.cols, given.rows);
    if (side == 0) return {};
    cv::Mat read = given;
    if (side > kMostSide) {
        const double by = static_cast<double>(kMostSide) / side;
        cv::resize(given, read, {}, by, by, cv::INTER_AREA);
    }
    const double scale_x = static_cast<double>(given.cols) / read.cols,
                 scale_y = static_cast<double>(given.rows) / read.rows;
    std::vector<cv::Vec4f> found;
    cv::createLineSegmentDetector(cv::LSD_REFINE_STD)->detect(read, found);
    std::vector<PictureLine> pieces;
    for (const cv::Vec4f& v : found) {
        // The detector counts from the centres of pixels.
        const auto place = [&](float x, float y) {
            return glm::dvec2(to_grid((static_cast<double>(x) + 0.5) * scale_x),
                              to_grid((static_cast<double>(y) + 0.5) * scale_y));
        };
        const PictureLine piece{place(v[0], v[1]), place(v[2], v[3])};
        if (piece.length() >= kLeastPiece * side) pieces.push_back(piece);
    }
    std::vector<PictureLine> out = joined(std::move(pieces), side);
    out.erase(std::remove_if(
                  out.begin(), out.end(),
                  [&](const PictureLine& line) { return line.length() < kLeastLength * side; }),
              out.end());
    longest_first(out);
    return out;
}

std::vector<PictureLine> lines_on(const std::vector<PictureLine>& lines, ViewU8x1 matte) {
    const cv::Mat given = as_mat(matte);
    const int margin =
        static_cast<int>(std::lround(std::max(1.0, kBeside * std::max(given.cols, given.rows))));
    cv::Mat grown;
    cv::dilate(given, grown,
               cv::getStructuringElement(cv::MORPH_RECT, {2 * margin + 1, 2 * margin + 1}));
    const auto inside = [&](const PictureLine& line) {
        int count = 0;
        for (int k = 0; k < kSamples; ++k) {
            const glm::dvec2 p = line.from + (k + 0.5) / kSamples * (line.to - line.from);
            const int x = std::clamp(static_cast<int>(std::floor(p.x)), 0, grown.cols - 1),
                      y = std::clamp(static_cast<int>(std::floor(p.y)), 0, grown.rows - 1);
            count += grown.at<std::uint8_t>(y, x) >= 128;
        }
        return count >= kInside * kSamples;
    };
    std::vector<PictureLine> out;
    std::copy_if(lines.begin(), lines.end(), std::back_inserter(out), inside);
    return out;
}

std::vector<PictureLine> thinned(const std::vector<PictureLine>& lines, Size picture) {
    const double square = static_cast<double>(std::max(picture.width, picture.height)) / kSquares;
    std::map<std::array<int, 3>, int> taken;
    std::vector<PictureLine> out;
    for (const PictureLine& line : lines) {
        const glm::dvec2 middle = 0.5 * (line.from + line.to);
        const std::array<int, 3> where{static_cast<int>(std::floor(middle.x / square)),
                                       static_cast<int>(std::floor(middle.y / square)),
                                       direction_of(line)};
        if (++taken[where] <= kAlike) out.push_back(line);
    }
    return out;
}

}  // namespace weft
