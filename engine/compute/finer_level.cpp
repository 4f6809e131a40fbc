#include "engine/compute/finer_level.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "engine/compute/plane_pyramid.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

using Quad = float __attribute__((vector_size(16)));
using Texels = Image<float, 4>;

constexpr int kRounds = 4;
// A round reaches 3 texels further, and what is done before at most 5: with this border a texel is
// the same in whatever tile it lies.
constexpr int kTile = 112, kBorder = 5 + 3 * kRounds;

Quad load(const float* from) {
    Quad v;
    std::memcpy(&v, from, sizeof v);
    return v;
}
void store(float* to, Quad v) {
    std::memcpy(to, &v, sizeof v);
}
Quad lesser(Quad a, Quad b) {
    return a < b ? a : b;
}
Quad greater(Quad a, Quad b) {
    return a > b ? a : b;
}

// Part of a plane, which goes on beyond its sides.
void cut_out(const Texels& plane, WrapMode wrap, int x0, int y0, Texels& out) {
    for (int y = 0; y < out.height(); ++y) {
        const float* from = plane.row(wrapped_index(y0 + y, plane.height(), wrap));
        for (int x = 0; x < out.width(); ++x) {
            std::memcpy(out.pixel(x, y), from + 4 * wrapped_index(x0 + x, plane.width(), wrap),
                        4 * sizeof(float));
        }
    }
}

// Catmull–Rom at a quarter of a texel before the centre; after it the weights are reversed.
constexpr std::array<float, 4> kQuarter{-0.0703125f, 0.8671875f, 0.2265625f, -0.0234375f};

// What follows leaves a rim of a tile undone, for which the border is there. Tiles are all of one
// size and their images are used again: to get them fresh took five times as long as the work.
constexpr int kRim = 2;

// A Catmull–Rom magnification by two; the centres of the new texels lie a quarter off the old ones.
struct Doubling {
    Texels wide, out;
    explicit Doubling(Size size)
        : wide(2 * size.width, size.height), out(2 * size.width, 2 * size.height) {}

    void run(const Texels& in) {
        for (int y = 0; y < in.height(); ++y) {
            const float* from = in.row(y) + 4 * kRim;
            float* to = wide.row(y) + 8 * kRim;
            for (int x = kRim; x < in.width() - kRim; ++x, from += 4, to += 8) {
                const Quad a = load(from - 8), b = load(from - 4), c = load(from),
                           d = load(from + 4), e = load(from + 8);
                store(to, kQuarter[3] * a + kQuarter[2] * b + kQuarter[1] * c + kQuarter[0] * d);
                store(to + 4,
                      kQuarter[0] * b + kQuarter[1] * c + kQuarter[2] * d + kQuarter[3] * e);
            }
        }
        for (int y = kRim; y < in.height() - kRim; ++y) {
            const float* from = wide.row(y);
            const std::ptrdiff_t row = wide.row(1) - wide.row(0);
            float *above = out.row(2 * y), *below = out.row(2 * y + 1);
            for (int x = 0; x < 4 * wide.width(); x += 4) {
                const Quad a = load(from + x - 2 * row), b = load(from + x - row),
                           c = load(from + x), d = load(from + x + row),
                           e = load(from + x + 2 * row);
                store(above + x,
                      kQuarter[3] * a + kQuarter[2] * b + kQuarter[1] * c + kQuarter[0] * d);
                store(below + x,
                      kQuarter[0] * b + kQuarter[1] * c + kQuarter[2] * d + kQuarter[3] * e);
            }
        }
    }
};

// The least and the most of the 3×3 around every texel.
struct Range {
    Texels least, most;
    explicit Range(Size size) : least(size), most(size) {}
};

void find_range(const Texels& in, Range& rows, Range& out) {
    for (int y = 0; y < in.height(); ++y) {
        for (int x = 1; x < in.width() - 1; ++x) {
            const float* p = in.pixel(x, y);
            const Quad a = load(p - 4), b = load(p), c = load(p + 4);
            store(rows.least.pixel(x, y), lesser(a, lesser(b, c)));
            store(rows.most.pixel(x, y), greater(a, greater(b, c)));
        }
    }
    for (int y = 1; y < in.height() - 1; ++y) {
        for (int x = 1; x < in.width() - 1; ++x) {
            const auto of = [&](const Texels& t, int k) { return load(t.pixel(x, y + k)); };
            store(out.least.pixel(x, y),
                  lesser(of(rows.least, -1), lesser(of(rows.least, 0), of(rows.least, 1))));
            store(out.most.pixel(x, y),
                  greater(of(rows.most, -1), greater(of(rows.most, 0), of(rows.most, 1))));
        }
    }
}

// Structure tensors of the luma: xx, yy, xy, averaged with a Gaussian of one texel.
struct Tensors {
    Texels raw, wide, out;
    explicit Tensors(Size size) : raw(size), wide(size), out(size) {}
};

void find_tensors(const ImageF1& luma, Tensors& tensors) {
    const int w = luma.width(), h = luma.height();
    auto& [raw, wide, out] = tensors;
    constexpr std::array<float, 3> kGauss{0.4026f, 0.2442f, 0.0545f};
    for (int y = 1; y < h - 1; ++y) {
        for (int x = 1; x < w - 1; ++x) {
            const float dx = 0.5f * (luma.at(x + 1, y) - luma.at(x - 1, y));
            const float dy = 0.5f * (luma.at(x, y + 1) - luma.at(x, y - 1));
            store(raw.pixel(x, y), Quad{dx * dx, dy * dy, dx * dy, 0});
        }
    }
    const auto blur = [w, h, kGauss](const Texels& from, Texels& to, std::ptrdiff_t step) {
        for (int y = kRim; y < h - kRim; ++y) {
            for (int x = kRim; x < w - kRim; ++x) {
                const float* p = from.pixel(x, y);
                store(to.pixel(x, y), kGauss[0] * load(p) +
                                          kGauss[1] * (load(p - step) + load(p + step)) +
                                          kGauss[2] * (load(p - 2 * step) + load(p + 2 * step)));
            }
        }
    };
    blur(raw, wide, 4);
    blur(wide, out, wide.row(1) - wide.row(0));
}

// The direction across an edge, as cosine and sine of twice its angle, times how clearly there is
// one: from 0 in flat or crossing detail to 1 on a line.
void find_edges(const Texels& in, ImageF1& luma, Tensors& tensors, ImageF2& out) {
    for (int y = 0; y < in.height(); ++y) {
        for (int x = 0; x < in.width(); ++x) {
            const float* p = in.pixel(x, y);
            luma.at(x, y) = 0.25f * p[0] + 0.5f * p[1] + 0.25f * p[2];
        }
    }
    find_tensors(luma, tensors);
    constexpr float kLeastCoherence = 0.3f, kFaint = 0.02f;
    for (int y = 0; y < in.height(); ++y) {
        for (int x = 0; x < in.width(); ++x) {
            const float* t = tensors.out.pixel(x, y);
            out.pixel(x, y)[0] = out.pixel(x, y)[1] = 0;
            const float mean = 0.5f * (t[0] + t[1]), across = t[0] - t[1], twice = 2 * t[2];
            const float length = std::sqrt(across * across + twice * twice);
            const float strong = std::sqrt(std::max(0.0f, mean + 0.5f * length));
            const float weak = std::sqrt(std::max(0.0f, mean - 0.5f * length));
            if (!(length > 0) || !(strong > 0)) continue;
            const float coherence = (strong - weak) / (strong + weak);
            const float clear = std::max(0.0f, coherence - kLeastCoherence) /
                                (1 - kLeastCoherence) * strong / (strong + kFaint * luma.at(x, y));
            out.pixel(x, y)[0] = clear * across / length;
            out.pixel(x, y)[1] = clear * twice / length;
        }
    }
}

// For every new texel how much of the second difference along x, along y and along one diagonal is
// added: together a step of diffusion along its edge.
struct Flow {
    float x = 0, y = 0, diagonal = 0;
    int falling = 0;  ///< The diagonal that falls to the right, else the other.
};

Flow flow_of(float cosine2, float sine2) {
    const float clear = std::sqrt(cosine2 * cosine2 + sine2 * sine2);
    if (clear < 0.05f) return {};
    // Half the angle; the edge runs at a right angle to it. Bilinear lookups half a square root of
    // two texels away on either side, which weigh a quarter each.
    const float cosine = cosine2 / clear;
    constexpr float kReach = 0.70710678f;
    const float along_x = kReach * std::sqrt(std::max(0.0f, 0.5f * (1 - cosine)));
    const float along_y = kReach * std::sqrt(std::max(0.0f, 0.5f * (1 + cosine)));
    const float share = 0.25f * clear;
    return {share * along_x * (1 - along_y), share * along_y * (1 - along_x),
            share * along_x * along_y, sine2 < 0 ? 1 : 0};
}

void find_flows(const ImageF2& edges, Image<Flow, 1>& out) {
    const int w = edges.width(), h = edges.height();
    for (int y = kRim; y < 2 * h - kRim; ++y) {
        const int near_y = y / 2, far_y = near_y + (y % 2 ? 1 : -1);
        for (int x = kRim; x < 2 * w - kRim; ++x) {
            const int near_x = x / 2, far_x = near_x + (x % 2 ? 1 : -1);
            const float *a = edges.pixel(near_x, near_y), *b = edges.pixel(far_x, near_y),
                        *c = edges.pixel(near_x, far_y), *d = edges.pixel(far_x, far_y);
            const auto of = [&](int k) {
                return 0.5625f * a[k] + 0.1875f * (b[k] + c[k]) + 0.0625f * d[k];
            };
            out.at(x, y) = flow_of(of(0), of(1));
        }
    }
}

void smooth_along(const Texels& in, const Image<Flow, 1>& flows, Texels& out) {
    const std::ptrdiff_t row = in.row(1) - in.row(0);
    for (int y = 1; y < in.height() - 1; ++y) {
        for (int x = 1; x < in.width() - 1; ++x) {
            const float* p = in.pixel(x, y);
            Quad v = load(p);
            const Flow& flow = flows.at(x, y);
            if (flow.x + flow.y > 0) {
                const Quad twice = v + v;
                const std::ptrdiff_t over = flow.falling ? row + 4 : row - 4;
                v += flow.x * (load(p - 4) + load(p + 4) - twice) +
                     flow.y * (load(p - row) + load(p + row) - twice) +
                     flow.diagonal * (load(p - over) + load(p + over) - twice);
            }
            store(out.pixel(x, y), v);
        }
    }
}

// Gives every four new texels the mean of the old one again, within the range around that.
void project_back(const Texels& old, const Range& range, Doubling& change, Texels& missing,
                  Texels& fine) {
    for (int y = 0; y < old.height(); ++y) {
        const float *a = fine.row(2 * y), *b = fine.row(2 * y + 1);
        for (int x = 0; x < old.width(); ++x, a += 8, b += 8) {
            const Quad mean = 0.25f * (load(a) + load(a + 4) + load(b) + load(b + 4));
            store(missing.pixel(x, y), load(old.pixel(x, y)) - mean);
        }
    }
    change.run(missing);
    for (int y = 0; y < fine.height(); ++y) {
        for (int x = 0; x < fine.width(); ++x) {
            const Quad v = load(fine.pixel(x, y)) + load(change.out.pixel(x, y));
            store(fine.pixel(x, y), lesser(greater(v, load(range.least.pixel(x / 2, y / 2))),
                                           load(range.most.pixel(x / 2, y / 2))));
        }
    }
}

// The images of one tile.
struct Work {
    Texels old, missing, fine, smooth;
    Range rows, range;
    ImageF1 luma;
    Tensors tensors;
    ImageF2 edges;
    Image<Flow, 1> flows;
    Doubling doubling;

    explicit Work(Size size)
        : old(size),
          missing(size),
          fine(2 * size.width, 2 * size.height),
          smooth(fine.size()),
          rows(size),
          range(size),
          luma(size),
          tensors(size),
          edges(size),
          flows(fine.size()),
          doubling(size) {}

    // From `old` to `fine`.
    void run() {
        find_range(old, rows, range);
        find_edges(old, luma, tensors, edges);
        find_flows(edges, flows);
        doubling.run(old);
        std::swap(fine, doubling.out);
        for (int k = 0; k < kRounds; ++k) {
            smooth_along(fine, flows, smooth);
            project_back(old, range, doubling, missing, smooth);
            std::swap(fine, smooth);
        }
    }
};

}  // namespace

Image<float, 4> finer_level(const Image<float, 4>& plane, WrapMode wrap) {
    Texels out(2 * plane.width(), 2 * plane.height());
    const int columns = (plane.width() + kTile - 1) / kTile;
    const int tiles = columns * ((plane.height() + kTile - 1) / kTile);
    const int workers = std::min(tiles, std::max(1, thread_count()));
    parallel_for(static_cast<std::size_t>(workers), [&](std::size_t worker) {
        Work work({kTile + 2 * kBorder, kTile + 2 * kBorder});
        for (int i = static_cast<int>(worker); i < tiles; i += workers) {
            const int x0 = i % columns * kTile, y0 = i / columns * kTile;
            const int w = std::min(kTile, plane.width() - x0);
            const int h = std::min(kTile, plane.height() - y0);
            cut_out(plane, wrap, x0 - kBorder, y0 - kBorder, work.old);
            work.run();
            for (int y = 0; y < 2 * h; ++y) {
                std::memcpy(out.pixel(2 * x0, 2 * y0 + y),
                            work.fine.pixel(2 * kBorder, 2 * kBorder + y),
                            sizeof(float) * 8 * static_cast<std::size_t>(w));
            }
        }
    });
    return out;
}

}  // namespace weft
