#include "texture_db/sources/picture_choice.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "texture_db/describe/near_duplicates.h"
#include "texture_db/describe/sample_codec.h"

namespace weft {
namespace {

constexpr int kSide = 96;
// Above it, half of 69 inspected samples showed two materials, an object or a stain.
constexpr float kMostColourUnevenness = 0.65f;

float luma(const std::uint8_t* p) {
    return 0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2];
}

struct BlockLook {
    float mean = 0, deviation = 0, detail = 0;
};

// Mean, contrast and fine detail (mean absolute Laplacian) of a square, 8-bit luma.
BlockLook look_at(ViewU8x3 image, const Recti& r) {
    double sum = 0, squares = 0, detail = 0;
    int inner = 0;
    for (int y = r.y0; y < r.y1; ++y) {
        for (int x = r.x0; x < r.x1; ++x) {
            const float v = luma(image.pixel(x, y));
            sum += v;
            squares += static_cast<double>(v) * v;
            if (x > r.x0 && x + 1 < r.x1 && y > r.y0 && y + 1 < r.y1) {
                detail +=
                    std::abs(4 * v - luma(image.pixel(x - 1, y)) - luma(image.pixel(x + 1, y)) -
                             luma(image.pixel(x, y - 1)) - luma(image.pixel(x, y + 1)));
                ++inner;
            }
        }
    }
    const double n = static_cast<double>(r.width()) * r.height(), mean = sum / n;
    return {static_cast<float>(mean),
            static_cast<float>(std::sqrt(std::max(0.0, squares / n - mean * mean))),
            static_cast<float>(detail / std::max(inner, 1))};
}

// Share of 8×8 blocks of one colour: logos, atlases, drawings.
float flat_share(ViewU8x3 image) {
    int flat = 0, all = 0;
    for (int y = 0; y + 8 <= image.height(); y += 8) {
        for (int x = 0; x + 8 <= image.width(); x += 8) {
            flat += look_at(image, {x, y, x + 8, y + 8}).deviation < 0.7f ? 1 : 0;
            ++all;
        }
    }
    return static_cast<float>(flat) / static_cast<float>(std::max(all, 1));
}

// True for a frame: the outermost ring differs from the ring further in much more than neighbouring
// rings do.
bool has_border(ViewU8x3 image) {
    const auto ring = [&](int inset) {
        std::array<double, 3> sum{};
        int n = 0;
        for (int x = inset; x < image.width() - inset; ++x) {
            for (const int y : {inset, image.height() - 1 - inset}) {
                for (int c = 0; c < 3; ++c)
                    sum[static_cast<std::size_t>(c)] += image.at(x, y, c);
                ++n;
            }
        }
        for (double& v : sum)
            v /= std::max(n, 1);
        return sum;
    };
    const auto apart = [](const auto& a, const auto& b) {
        return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
    };
    const auto edge = ring(1), in = ring(std::max(6, image.height() / 12)),
               further = ring(std::max(12, image.height() / 6));
    return apart(edge, in) > 90 && apart(in, further) < 30;
}

struct Square {
    Recti at;
    float badness = 0;
};

// How uneven a square is: the parts' means and contrasts relative to the whole's contrast.
float unevenness(ViewU8x3 image, const Recti& r, float contrast) {
    std::array<BlockLook, 9> parts;
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
            const int x = r.x0 + 32 * i, y = r.y0 + 32 * j;
            parts[static_cast<std::size_t>(3 * j + i)] = look_at(image, {x, y, x + 32, y + 32});
        }
    }
    float mean = 0, deviation = 0, means = 0, deviations = 0;
    for (const BlockLook& p : parts) {
        mean += p.mean / 9;
        deviation += p.deviation / 9;
    }
    for (const BlockLook& p : parts) {
        means += (p.mean - mean) * (p.mean - mean) / 9;
        deviations += (p.deviation - deviation) * (p.deviation - deviation) / 9;
    }
    return std::sqrt(means) / (contrast + 3) + 0.8f * std::sqrt(deviations) / (deviation + 3);
}

// How far the colours of a square's nine parts lie apart, relative to the spread of colour inside
// them: grass that becomes a path, another object at the edge.
float colour_unevenness(ViewU8x3 image, const Recti& r) {
    // Red against green, and both against blue.
    std::array<std::array<double, 2>, 9> sums{}, squares{};
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const std::uint8_t* p = image.pixel(r.x0 + x, r.y0 + y);
            const std::array<double, 2> c{static_cast<double>(p[0]) - p[1],
                                          0.5 * (p[0] + p[1]) - p[2]};
            const auto part = static_cast<std::size_t>(y / 32 * 3 + x / 32);
            for (std::size_t k = 0; k < 2; ++k) {
                sums[part][k] += c[k];
                squares[part][k] += c[k] * c[k];
            }
        }
    }
    constexpr double kPart = 32 * 32;
    double apart = 0, inside = 0;
    for (std::size_t k = 0; k < 2; ++k) {
        double mean = 0, deviation = 0;
        for (std::size_t part = 0; part < 9; ++part) {
            const double m = sums[part][k] / kPart;
            mean += m / 9;
            deviation += std::sqrt(std::max(0.0, squares[part][k] / kPart - m * m)) / 9;
        }
        for (const auto& sum : sums)
            apart += (sum[k] / kPart - mean) * (sum[k] / kPart - mean) / 9;
        inside += deviation * deviation;
    }
    return static_cast<float>(std::sqrt(apart) / (5 + std::sqrt(inside)));
}

// True for letters and drawings: places without any grain, some of them black and some white.
bool is_drawn(ViewU8x3 image, const Recti& r) {
    int black = 0, white = 0;
    for (int y = r.y0 + 1; y + 1 < r.y1; ++y) {
        for (int x = r.x0 + 1; x + 1 < r.x1; ++x) {
            const float v = luma(image.pixel(x, y));
            if (v > 12 && v < 243) continue;
            const bool even = std::abs(luma(image.pixel(x - 1, y)) - v) < 3 &&
                              std::abs(luma(image.pixel(x + 1, y)) - v) < 3 &&
                              std::abs(luma(image.pixel(x, y - 1)) - v) < 3 &&
                              std::abs(luma(image.pixel(x, y + 1)) - v) < 3;
            if (even) ++(v < 128 ? black : white);
        }
    }
    constexpr int kFew = kSide * kSide / 250;
    return black > kFew && white > kFew;
}

}  // namespace

std::string picture_fault(ViewU8x3 picture, const ChoiceRules& rules) {
    if (picture.width() < (rules.strict ? 128 : 48) || picture.height() < (rules.strict ? 128 : 48))
        return "too small";
    if (!rules.strict) return {};
    const float shape = static_cast<float>(picture.width()) / static_cast<float>(picture.height());
    if (shape > 4.1f || shape < 1 / 4.1f) return "a strip";
    if (flat_share(picture) > 0.12f) return "large flat parts";
    if (has_border(picture)) return "a border";
    return {};
}

ImageU8x3 at_sample_scale(ViewU8x3 picture) {
    Size size = picture.size();
    while (std::min(size.width, size.height) >= 1024)
        size = {size.width / 2, size.height / 2};
    if (std::min(size.width, size.height) < kSide) {
        const double up = static_cast<double>(kSide) / std::min(size.width, size.height);
        size = {std::max(kSide, static_cast<int>(std::lround(size.width * up))),
                std::max(kSide, static_cast<int>(std::lround(size.height * up)))};
    }
    return size == picture.size() ? cropped(picture, rect_of(size)) : resized(picture, size);
}

std::vector<Recti> choose_samples(ViewU8x3 picture, const ChoiceRules& rules) {
    const int columns = picture.width() / kSide, rows = picture.height() / kSide;
    // The squares are spread over the picture, so that none of its sides is lost.
    const auto start = [](int i, int n, int size) {
        return n == 1 ? (size - kSide) / 2 : i * (size - kSide) / (n - 1);
    };
    const BlockLook whole = look_at(picture, rect_of(picture.size()));
    std::vector<Square> squares;
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const int x = start(i, columns, picture.width()), y = start(j, rows, picture.height());
            Square s;
            s.at = {x, y, x + kSide, y + kSide};
            const BlockLook look = look_at(picture, s.at);
            const float uneven = unevenness(picture, s.at, look.deviation);
            s.badness = uneven + 0.4f * std::abs(look.mean - whole.mean) / (whole.deviation + 5);
            if (rules.strict) {
                const bool flat = look.deviation < 3.0f,
                           blurred =
                               look.detail < 2.4f || look.detail / (look.deviation + 2) < 0.24f;
                const bool blown = look.mean > 247 || look.mean < 20;
                const float own_flat = flat_share(picture.crop(s.at));
                if (flat || blurred || blown || own_flat > 0.15f || uneven > 0.85f) continue;
                if (colour_unevenness(picture, s.at) > kMostColourUnevenness ||
                    is_drawn(picture, s.at))
                    continue;
            }
            squares.push_back(s);
        }
    }
    std::stable_sort(squares.begin(), squares.end(),
                     [](const Square& a, const Square& b) { return a.badness < b.badness; });
    std::vector<Recti> chosen;
    NearDuplicates seen;
    for (const Square& s : squares) {
        if (static_cast<int>(chosen.size()) >= rules.most) break;
        if (rules.strict && seen.add_if_new(picture.crop(s.at)) == false) continue;
        chosen.push_back(s.at);
    }
    return chosen;
}

}  // namespace weft
