#include "engine/temporal/track_seam.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <utility>

#include <opencv2/imgproc/detail/gcgraph.hpp>

#include "engine/core/rng.h"
#include "engine/core/smooth_step.h"

namespace weft {
namespace {

using Labels = Image<std::uint8_t, 1>;
using Weight = std::int64_t;
constexpr float kUnits = 16.0f;  // of the costs, a level and pixel
constexpr Weight kNever = Weight{1} << 40;

bool near_surface(const LatticeField& field, ViewU8x1 extent, int i, int j) {
    const Vec2 p = field.node_position(i, j);
    const int reach = field.spacing();
    for (int k = 0; k < 9; ++k) {
        const int x = static_cast<int>(p.x) + (k % 3 - 1) * reach;
        const int y = static_cast<int>(p.y) + (k / 3 - 1) * reach;
        if (rect_of(extent.size()).contains(x, y) && extent.at(x, y) > 0) return true;
    }
    return false;
}

// A smooth random number in [0, 1] for every cell: values on a coarse lattice, interpolated.
ImageF1 smooth_noise(Size size, std::uint64_t seed) {
    constexpr int kStep = 14;  // cells
    const auto value = [&](int i, int j) {
        const auto key = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)) << 32) |
                         static_cast<std::uint32_t>(j);
        return static_cast<float>(mix64(mix64(seed) ^ key) >> 40) / static_cast<float>(1 << 24);
    };
    ImageF1 out(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const int i = x / kStep, j = y / kStep;
            const float fx = static_cast<float>(x % kStep) / kStep;
            const float fy = static_cast<float>(y % kStep) / kStep;
            const float top = value(i, j) + fx * (value(i + 1, j) - value(i, j));
            const float low = value(i, j + 1) + fx * (value(i + 1, j + 1) - value(i, j + 1));
            out.at(x, y) = top + fy * (low - top);
        }
    }
    return out;
}

// The graph: a node for every cell and frame; the track from the reference before is the source.
class TrackCutGraph {
  public:
    TrackCutGraph(const std::vector<TrackEvidence>& frames, const TrackCutOptions& options)
        : frames_(frames), options_(options), size_(frames.front().pixels.size()) {
        const auto nodes = static_cast<unsigned>(frames.size()) *
                           static_cast<unsigned>(size_.width * size_.height);
        graph_.create(nodes, 6 * nodes);
        for (unsigned k = 0; k < nodes; ++k)
            graph_.addVtx();
    }

    std::vector<Labels> solve() {
        for (std::size_t t = 0; t < frames_.size(); ++t) {
            add_seams(t);
            add_changes(t);
        }
        hold_to_their_times();
        graph_.maxFlow();
        std::vector<Labels> out;
        for (std::size_t t = 0; t < frames_.size(); ++t) {
            Labels labels(size_);
            for (int y = 0; y < size_.height; ++y) {
                for (int x = 0; x < size_.width; ++x)
                    labels.at(x, y) = graph_.inSourceSegment(node(t, x, y)) ? 0 : 1;
            }
            out.push_back(std::move(labels));
        }
        return out;
    }

  private:
    [[nodiscard]] int node(std::size_t t, int x, int y) const {
        return (static_cast<int>(t) * size_.height + y) * size_.width + x;
    }
    static Weight units(float cost) {
        return static_cast<Weight>(std::lround(std::min(cost, 1e7f) * kUnits));
    }

    // Kwatra et al. 2003, eq. 1, times the length of the cells' common side on the frame.
    void add_seams(std::size_t t) {
        const ImageF1 &mismatch = frames_[t].mismatch, &pixels = frames_[t].pixels;
        const auto seam = [&](int x0, int y0, int x1, int y1) {
            const float side = 0.5f * (std::sqrt(pixels.at(x0, y0)) + std::sqrt(pixels.at(x1, y1)));
            const Weight w = units((mismatch.at(x0, y0) + mismatch.at(x1, y1)) * side);
            if (w > 0) graph_.addEdges(node(t, x0, y0), node(t, x1, y1), w, w);
        };
        for (int y = 0; y < size_.height; ++y) {
            for (int x = 0; x < size_.width; ++x) {
                if (x + 1 < size_.width) seam(x, y, x + 1, y);
                if (y + 1 < size_.height) seam(x, y, x, y + 1);
            }
        }
    }

    // λ_t ‖T_after − T_before‖² over the cell's pixels, in levels.
    [[nodiscard]] float change(std::size_t t, int x, int y) const {
        const float m = frames_[t].mismatch.at(x, y);
        return options_.lambda * m * m / 255.0f * frames_[t].pixels.at(x, y);
    }

    void add_changes(std::size_t t) {
        const bool is_last = t + 1 == frames_.size();
        for (int y = 0; y < size_.height; ++y) {
            for (int x = 0; x < size_.width; ++x) {
                // Links to the references, which show one track each.
                const Weight from_first = t == 0 ? units(change(t, x, y)) : 0;
                const Weight to_last = is_last ? units(change(t, x, y)) : 0;
                if (from_first + to_last > 0)
                    graph_.addTermWeights(node(t, x, y), from_first, to_last);
                if (is_last) continue;
                const float both = 0.5f * (change(t, x, y) + change(t + 1, x, y));
                graph_.addEdges(node(t, x, y), node(t + 1, x, y), units(both), kNever);
            }
        }
    }

    // A smooth random number from 0 to 1 for every cell, uniformly distributed over the surface, so
    // that the same share of any surface changes in each frame.
    [[nodiscard]] ImageF1 in_turn() const {
        ImageF1 order = smooth_noise(size_, options_.seed);
        std::vector<std::pair<float, int>> line;
        for (int k = 0; k < size_.width * size_.height; ++k) {
            const int x = k % size_.width, y = k / size_.width;
            const bool changes =
                std::any_of(frames_.begin(), frames_.end(),
                            [&](const TrackEvidence& f) { return f.mismatch.at(x, y) > 0; });
            if (changes) line.emplace_back(order.at(x, y), k);
        }
        std::sort(line.begin(), line.end());
        for (std::size_t n = 0; n < line.size(); ++n) {
            const int k = line[n].second;
            order.at(k % size_.width, k / size_.width) =
                (static_cast<float>(n) + 0.5f) / static_cast<float>(line.size());
        }
        return order;
    }

    void hold_to_their_times() {
        // Cost of a change away from the cell's time, in levels per pixel and frame: a share of the
        // mismatch, like the cost of a seam, because a flash is more visible where the textures
        // differ more.
        constexpr float kLeastHold = 3.0f, kHold = 0.5f;
        constexpr float kEarliest = 0.15f, kLatest = 0.85f;
        const ImageF1 order = in_turn();
        const auto length = static_cast<float>(frames_.size());
        for (std::size_t t = 0; t < frames_.size(); ++t) {
            for (int y = 0; y < size_.height; ++y) {
                for (int x = 0; x < size_.width; ++x) {
                    const auto& [mismatch, pixels] = frames_[t];
                    if (!(mismatch.at(x, y) > 0)) continue;
                    const float at = (static_cast<float>(t) + 0.5f) / length;
                    const float due = kEarliest + (kLatest - kEarliest) * order.at(x, y);
                    const Weight w =
                        units(std::max(kLeastHold, kHold * mismatch.at(x, y)) * pixels.at(x, y));
                    if (at < due)
                        graph_.addTermWeights(node(t, x, y), w, 0);
                    else
                        graph_.addTermWeights(node(t, x, y), 0, w);
                }
            }
        }
    }

    const std::vector<TrackEvidence>& frames_;
    const TrackCutOptions& options_;
    Size size_;
    cv::detail::GCGraph<Weight> graph_;
};

}  // namespace

TrackLayers spread_disagreement(const LatticeField& before, const LatticeField& after, float weight,
                                float limit_px, ViewU8x1 extent) {
    TrackLayers out{before, after, false};
    const Size size = before.nodes().size();
    for (int j = 0; j < size.height; ++j) {
        for (int i = 0; i < size.width; ++i) {
            const Vec2 d = after.node(i, j) - before.node(i, j);
            const float beyond =
                std::clamp(std::hypot(d.x, d.y) / std::max(limit_px, 1e-6f) - 1.0f, 0.0f, 1.0f);
            const float slides = 1.0f - smooth_rise(beyond);
            out.before.set_node(i, j, before.node(i, j) + weight * slides * d);
            // The same expression for both, so that they agree bit for bit.
            if (slides == 1.0f)
                out.after.set_node(i, j, out.before.node(i, j));
            else
                out.after.set_node(i, j, after.node(i, j) - (1.0f - weight) * slides * d);
            out.apart |= slides < 1.0f && near_surface(before, extent, i, j);
        }
    }
    return out;
}

std::vector<Labels> cut_between_tracks(const std::vector<TrackEvidence>& frames,
                                       const TrackCutOptions& options) {
    if (frames.empty() || frames.front().pixels.empty()) return {};
    return TrackCutGraph(frames, options).solve();
}

float TrackSeam::share_after(int frame, Vec2 ref) const {
    const Labels& labels = after[static_cast<std::size_t>(frame - first - 1)];
    const auto cell = static_cast<float>(cell_px);
    const float x = (ref.x - static_cast<float>(origin.x)) / cell - 0.5f;
    const float y = (ref.y - static_cast<float>(origin.y)) / cell - 0.5f;
    const auto label = [&](float cx, float cy) {
        const int i = std::clamp(static_cast<int>(cx), 0, labels.width() - 1);
        const int j = std::clamp(static_cast<int>(cy), 0, labels.height() - 1);
        return static_cast<float>(labels.at(i, j));
    };
    const float x0 = std::floor(x), y0 = std::floor(y), fx = x - x0, fy = y - y0;
    const float top = label(x0, y0) + fx * (label(x0 + 1, y0) - label(x0, y0));
    const float low = label(x0, y0 + 1) + fx * (label(x0 + 1, y0 + 1) - label(x0, y0 + 1));
    const float between = top + fy * (low - top);
    constexpr float kFeather = 1.5f;  // px
    return std::clamp((between - 0.5f) * cell / kFeather + 0.5f, 0.0f, 1.0f);
}

}  // namespace weft
