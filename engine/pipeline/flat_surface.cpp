#include "engine/pipeline/flat_surface.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>

#include "engine/core/parallel.h"
#include "engine/core/stopwatch.h"
#include "engine/pipeline/opaque_picture.h"
#include "engine/pipeline/sweep.h"

namespace weft {
namespace {

constexpr int kMarginStep_px = 16;
constexpr std::size_t kMostStack_bytes = std::size_t{512} << 20;
// Of the square root of linear light, which noise changes about as much everywhere.
constexpr float kAlike = 0.03f;
constexpr float kAlikeBeyond = 0.1f;  // of differences: sharp edges differ where they are aliased
constexpr float kDark = 0.01f;
constexpr int kRounds = 4;            // of back-projection
constexpr float kAlikeSpread = 4.0f;  // deviations from the median that still count a little

// What the frames show of a place.
struct Shown {
    std::array<float, 3> colour{};
    float weight = 0;
};

float coded(float linear) {
    return std::sqrt(std::max(0.0f, linear));
}

// The weighted median of what `value` gives; `order` is scratch.
template <typename Value>
float middle(const std::vector<Shown>& shown, std::vector<std::pair<float, float>>& order,
             const Value& value) {
    order.clear();
    float sum = 0;
    for (const Shown& s : shown)
        order.emplace_back(value(s), s.weight), sum += s.weight;
    std::sort(order.begin(), order.end());
    float below = 0;
    for (const auto& [v, weight] : order) {
        below += weight;
        if (below >= 0.5f * sum) return v;
    }
    return order.back().first;
}

// Their common colour; returns how many agree.
int common_colour(const std::vector<Shown>& shown, std::vector<std::pair<float, float>>& order,
                  float* rgb) {
    std::array<float, 3> usual{};
    for (std::size_t c = 0; c < 3; ++c)
        usual[c] = middle(shown, order, [c](const Shown& s) { return coded(s.colour[c]); });
    const auto away = [&](const Shown& s) {
        float out = 0;
        for (std::size_t c = 0; c < 3; ++c)
            out = std::max(out, std::abs(coded(s.colour[c]) - usual[c]));
        return out;
    };
    const float reach = std::max(kAlike, kAlikeSpread * middle(shown, order, away));
    std::array<double, 3> sum{};
    double weight = 0;
    int agree = 0;
    for (const Shown& s : shown) {
        const float share = away(s) / reach;
        if (share >= 1) continue;
        const float keep = (1 - share * share) * (1 - share * share);  // Tukey's biweight
        for (std::size_t c = 0; c < 3; ++c)
            sum[c] += static_cast<double>(s.weight * keep) * s.colour[c];
        weight += static_cast<double>(s.weight * keep);
        ++agree;
    }
    for (std::size_t c = 0; c < 3; ++c)
        rgb[c] = static_cast<float>(weight > 0 ? sum[c] / weight
                                               : static_cast<double>(usual[c] * usual[c]));
    return agree;
}

// For every place that a view shows: `take` gets its x and y in the views, what they show, and
// scratch. Parallel over rows.
template <typename Take>
void over_shown(const std::vector<FlatView>& views, const Take& take) {
    const Size size = views.front().weight.size();
    parallel_rows(size.height, 4, [&](int y0, int y1) {
        std::vector<Shown> shown;
        std::vector<std::pair<float, float>> order;
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < size.width; ++x) {
                shown.clear();
                for (const FlatView& view : views) {
                    const float* p = view.colour.pixel(x, y);
                    if (view.weight.at(x, y) > 0)
                        shown.push_back({{p[0], p[1], p[2]}, view.weight.at(x, y)});
                }
                if (!shown.empty()) take(x, y, shown, order);
            }
        }
    });
}

void join_views(const std::vector<FlatView>& views, int first_row, FlatSurface& out) {
    over_shown(views, [&](int x, int y, const auto& shown, auto& order) {
        const int agree = common_colour(shown, order, out.colour.pixel(x, y + first_row));
        out.coverage.at(x, y + first_row) = 255;
        out.frames.at(x, y + first_row) =
            static_cast<std::uint8_t>(std::min(255, std::max(1, agree)));
    });
}

// Continues the surface smoothly into what is not known, for whoever interpolates at its edge.
void fill_around(FlatSurface& out) {
    ImageF1 alpha(out.coverage.size());
    std::transform(out.coverage.data(), out.coverage.data() + out.coverage.size_bytes(),
                   alpha.data(), [](std::uint8_t c) { return c > 0 ? 1.0f : 0.0f; });
    make_opaque(out.colour, alpha, AlphaKind::kStraight);
}

Expected<UnlitFrame> unlit_of(const FlatInputs& in, int frame) {
    auto found = unlit_frame(in.source, in.plan, in.store, in.region, in.scene, frame);
    if (!found) return fail_in(std::move(found).error(), "Frame " + std::to_string(frame));
    return found;
}

std::size_t bytes_of(const UnlitFrame& frame) {
    return frame.colour.size_bytes() + frame.trust.size_bytes();
}

// The unlit frames, as many as there is room for; the others are found anew each time.
class UnlitFrames {
  public:
    explicit UnlitFrames(const FlatInputs& in) : in_(in), kept_(in.frames.size()) {}

    [[nodiscard]] Expected<std::shared_ptr<const UnlitFrame>> get(std::size_t k) {
        if (kept_[k]) return kept_[k];
        WEFT_TRY(found, unlit_of(in_, in_.frames[k]));
        auto frame = std::make_shared<const UnlitFrame>(std::move(found));
        if (bytes_ + bytes_of(*frame) > kMostStack_bytes) return frame;
        bytes_ += bytes_of(*frame);
        return kept_[k] = std::move(frame);
    }

  private:
    const FlatInputs& in_;
    std::vector<std::shared_ptr<const UnlitFrame>> kept_;  // each is asked for by one thread
    std::atomic<std::size_t> bytes_ = 0;
};

// The steps of a gathering, for its progress.
class Steps {
  public:
    Steps(const ProgressFn& progress, std::int64_t total) : progress_(progress), total_(total) {}
    void done(int frame, double seconds) {
        const std::lock_guard lock(mutex_);
        ++done_;
        if (progress_) progress_({WorkStage::kExport, done_, total_, frame, seconds});
    }

  private:
    const ProgressFn& progress_;
    std::int64_t total_, done_ = 0;
    std::mutex mutex_;
};

struct Gathering {
    const FlatInputs& in;
    const FlatLayout& layout;
    const CancelToken& cancel;
    UnlitFrames frames;
    Steps steps;
    int band = 0;  // rows at a time
};

// All frames on each band of rows: `take` gets the views and the first row. With a plane, what they
// show beyond it.
template <typename Take>
Status over_bands(Gathering& g, const PlanePyramid* plane, const Take& take) {
    const int height = g.layout.size().height;
    for (int first = 0; first < height; first += g.band) {
        std::vector<FlatView> views(g.in.frames.size());
        WEFT_CHECK_OK(parallel_try(views.size(), [&](std::size_t k) -> Status {
            if (g.cancel.cancelled()) return cancelled(g.cancel);
            const auto start = Clock::now();
            WEFT_TRY(frame, g.frames.get(k));
            const int end = std::min(height, first + g.band);
            views[k] = plane ? flat_view(beyond_plane(*frame, g.layout, *plane, g.in.backend),
                                         g.layout, first, end)
                             : flat_view(*frame, g.layout, first, end);
            g.steps.done(g.in.frames[k], seconds_since(start));
            return {};
        }));
        take(views, first);
    }
    return {};
}

// Puts the frames' common difference on the picture. Where they do not agree it is what moves.
void add_difference(const std::vector<FlatView>& views, int first_row, FlatSurface& out) {
    over_shown(views, [&](int x, int y, const auto& shown, auto& order) {
        float* rgb = out.colour.pixel(x, y + first_row);
        const float slope = 2 * coded(std::max({rgb[0], rgb[1], rgb[2], kDark}));
        const auto away = [&](const Shown& s) {
            return std::max({std::abs(s.colour[0]), std::abs(s.colour[1]), std::abs(s.colour[2])}) /
                   slope;
        };
        const float reach = std::max(kAlikeBeyond, kAlikeSpread * middle(shown, order, away));
        std::array<double, 3> sum{};
        double weight = 0;
        for (const Shown& s : shown) {
            const float share = std::min(1.0f, away(s) / reach);
            const float keep = (1 - share * share) * (1 - share * share);  // Tukey's biweight
            for (std::size_t c = 0; c < 3; ++c)
                sum[c] += static_cast<double>(s.weight * keep) * s.colour[c];
            weight += static_cast<double>(s.weight * keep);
        }
        for (std::size_t c = 0; weight > 0 && c < 3; ++c)
            rgb[c] = std::max(0.0f, rgb[c] + static_cast<float>(sum[c] / weight));
    });
}

}  // namespace

Expected<int> flat_margin(const FlatInputs& in, const CancelToken& cancel) {
    const Size plate = in.source.size();
    const int most = std::min(plate.width, plate.height) / 2 / kMarginStep_px * kMarginStep_px;
    std::vector<Recti> places(in.frames.size());
    WEFT_CHECK_OK(parallel_try(in.frames.size(), [&](std::size_t k) -> Status {
        if (cancel.cancelled()) return cancelled(cancel);
        WEFT_TRY(frame, unlit_of(in, in.frames[k]));
        places[k] = places_of(frame, plate, most);
        return {};
    }));
    Recti all;
    for (const Recti& box : places)
        all = all.united(box);
    const int beyond = std::max({0, -all.x0, -all.y0, all.x1 - plate.width, all.y1 - plate.height});
    const int steps = (beyond + kMarginStep_px - 1) / kMarginStep_px;
    return std::min(most, steps * kMarginStep_px);
}

Expected<FlatSurface> gather_flat_surface(const FlatInputs& in, const FlatLayout& layout,
                                          const CancelToken& cancel, const ProgressFn& progress) {
    const Size size = layout.size();
    FlatSurface out{ImageF3(size), Matte(size), Image<std::uint8_t, 1>(size)};
    const std::size_t row_bytes =
        16 * static_cast<std::size_t>(size.width) * std::max<std::size_t>(1, in.frames.size());
    const int rows = static_cast<int>(std::clamp<std::size_t>(
        kMostStack_bytes / row_bytes, 16, static_cast<std::size_t>(size.height)));
    const std::int64_t bands = (size.height + rows - 1) / rows;
    const auto steps = static_cast<std::int64_t>(in.frames.size()) * bands * (1 + kRounds);
    Gathering gathering{in, layout, cancel, UnlitFrames(in), Steps(progress, steps), rows};
    WEFT_CHECK_OK(over_bands(gathering, nullptr,
                             [&](const auto& views, int first) { join_views(views, first, out); }));
    if (std::none_of(out.coverage.data(), out.coverage.data() + out.coverage.size_bytes(),
                     [](std::uint8_t c) { return c > 0; }))
        return fail(ErrorCode::kRenderFailed, "No frame shows the surface.",
                    "Check the region's matte and its holdouts.");
    fill_around(out);
    for (int round = 0; round < kRounds; ++round) {
        const PlanePyramid plane(out.colour, WrapMode::kClamp);
        WEFT_CHECK_OK(over_bands(gathering, &plane, [&](const auto& views, int first) {
            add_difference(views, first, out);
        }));
        fill_around(out);
    }
    return out;
}

}  // namespace weft
