#include "gpu/gpu_plane_search.h"

#include <algorithm>
#include <cstring>

namespace weft {
namespace {

using kernels::Cost;
using kernels::KernelId;
using kernels::SearchArgs;

constexpr std::size_t kStagingBytes = std::size_t{1} << 20;
constexpr char kSearchedInstead[] = "The CPU searched for placements instead.";

std::uint32_t word_of(const std::uint8_t* rgb) {
    return std::uint32_t{rgb[0]} | std::uint32_t{rgb[1]} << 8 | std::uint32_t{rgb[2]} << 16;
}

// The choice, then a byte for each candidate.
constexpr std::size_t kGoodOffset = 64;
static_assert(sizeof(kernels::SearchResult) <= kGoodOffset);

}  // namespace

Expected<std::unique_ptr<GpuPlaneSearch>> GpuPlaneSearch::open(std::shared_ptr<GpuState> state,
                                                               SearchStrategy strategy,
                                                               const PlaneSearchSetup& setup) {
    std::unique_ptr<GpuPlaneSearch> search(new GpuPlaneSearch(std::move(state), strategy));
    WEFT_CHECK_OK(search->prepare(setup));
    return search;
}

GpuPlaneSearch::~GpuPlaneSearch() {
    // The queue must be empty before the buffers are released. A failure here cannot be reported.
    if (queue_.get()) (void)state_->device()->wait(queue_.get()).has_value();
}

Status GpuPlaneSearch::prepare(const PlaneSearchSetup& setup) {
    if (setup.canvas.empty() || setup.samples.empty() ||
        (!setup.guide.empty() &&
         (setup.guide.size() != setup.canvas || setup.guide_known.size() != setup.canvas))) {
        return fail(ErrorCode::kUsage,
                    "A plane search needs a canvas, a sample, and a guide as "
                    "large as the canvas or none.");
    }
    canvas_size_ = setup.canvas;
    torus_ = setup.torus;
    fill_weight_ = setup.fill_weight;
    guide_weight_ = setup.guide_weight;
    const std::size_t words = area(canvas_size_);
    WEFT_CHECK_OK(queue_.open(state_->device()));
    WEFT_CHECK_OK(state_->reserve(canvas_, words * sizeof(std::uint32_t)));
    WEFT_CHECK_OK(
        state_->device()->clear(queue_.get(), canvas_.as<void>(), words * sizeof(std::uint32_t)));
    if (!setup.guide.empty()) {
        WEFT_CHECK_OK(state_->reserve(guide_, words * sizeof(std::uint32_t)));
        WEFT_CHECK_OK(upload(rect_of(canvas_size_), setup.guide, setup.guide_known, guide_));
    }
    for (const ViewU8x3& sample : setup.samples)
        WEFT_CHECK_OK(add_sample(sample));
    return wait();
}

Status GpuPlaneSearch::add_sample(ViewU8x3 sample) {
    if (sample.empty()) return fail(ErrorCode::kUsage, "A sample to search with is empty.");
    const auto w = static_cast<std::size_t>(sample.width()),
               h = static_cast<std::size_t>(sample.height());
    const std::size_t pixel_bytes = w * h * sizeof(std::uint32_t),
                      square_bytes = (w + 1) * h * sizeof(std::uint32_t);
    // It stays after a failure, until the queue is empty.
    Sample& s = samples_.emplace_back();
    s.size = sample.size();
    WEFT_CHECK_OK(state_->reserve(s.pixels, pixel_bytes));
    WEFT_CHECK_OK(state_->reserve(s.squares, square_bytes));
    WEFT_TRY(pixels_at, stage(pixel_bytes));
    auto* pixels = staging_.host<std::uint32_t>(pixels_at);
    for (int y = 0; y < sample.height(); ++y) {
        for (int x = 0; x < sample.width(); ++x)
            *pixels++ = word_of(sample.pixel(x, y));
    }
    WEFT_CHECK_OK(state_->device()->copy(
        queue_.get(), {s.pixels.as<void>(), pixel_bytes, staging_.host<void>(pixels_at),
                       pixel_bytes, pixel_bytes, 1}));
    WEFT_TRY(squares_at, stage(square_bytes));
    auto* squares = staging_.host<std::uint32_t>(squares_at);
    for (int y = 0; y < sample.height(); ++y) {
        // Only differences within a row are used, and no window's exceeds 32 bits by far.
        std::uint32_t sum = 0;
        *squares++ = sum;
        for (int x = 0; x < sample.width(); ++x) {
            const std::uint32_t word = word_of(sample.pixel(x, y));
            *squares++ = sum = kernels::dot_bytes(word, word, sum);
        }
    }
    WEFT_CHECK_OK(state_->device()->copy(
        queue_.get(), {s.squares.as<void>(), square_bytes, staging_.host<void>(squares_at),
                       square_bytes, square_bytes, 1}));
    return {};
}

// Reserves pinned memory that copies read from. If none is left, waits for everything queued.
Expected<std::size_t> GpuPlaneSearch::stage(std::size_t bytes) {
    const std::size_t rounded = (bytes + 255) / 256 * 256;
    if (staged_bytes_ + rounded > staging_.bytes()) {
        WEFT_CHECK_OK(wait());
        WEFT_CHECK_OK(state_->reserve(staging_, std::max(kStagingBytes, rounded)));
    }
    const std::size_t at = staged_bytes_;
    staged_bytes_ += rounded;
    return at;
}

Status GpuPlaneSearch::flush() {
    for (const CopyRows& rows : pending_)
        WEFT_CHECK_OK(state_->device()->copy(queue_.get(), rows));
    pending_.clear();
    return {};
}

Status GpuPlaneSearch::wait() {
    WEFT_CHECK_OK(flush());
    WEFT_CHECK_OK(state_->device()->wait(queue_.get()));
    staged_bytes_ = 0;
    return {};
}

Status GpuPlaneSearch::upload(const Recti& rect, ViewU8x3 pixels, ViewU8x1 takes_part,
                              DeviceBuffer& to) {
    const std::size_t row_bytes = static_cast<std::size_t>(rect.width()) * sizeof(std::uint32_t);
    const std::size_t pitch = static_cast<std::size_t>(canvas_size_.width) * sizeof(std::uint32_t);
    WEFT_TRY(at, stage(row_bytes * static_cast<std::size_t>(rect.height())));
    auto* words = staging_.host<std::uint32_t>(at);
    for (int y = 0; y < rect.height(); ++y) {
        const std::uint8_t* known = takes_part.row(y);
        for (int x = 0; x < rect.width(); ++x)
            *words++ = known[x] ? word_of(pixels.pixel(x, y)) | kernels::kTakesPart : 0;
    }
    auto* first = to.as<std::uint32_t>() +
                  static_cast<std::ptrdiff_t>(rect.y0) * canvas_size_.width + rect.x0;
    pending_.push_back({first, pitch, staging_.host<void>(at), row_bytes, row_bytes,
                        static_cast<std::size_t>(rect.height())});
    return {};
}

template <class T>
Expected<T> GpuPlaneSearch::noted(Expected<T> result) {
    if (!result && result.error().code != ErrorCode::kUsage) {
        broken_ = true;
        state_->note(result.error(), kSearchedInstead);
    }
    return result;
}

Status GpuPlaneSearch::update(const Recti& rect, ViewU8x3 pixels, ViewU8x1 filled) {
    if (broken_) return fail(ErrorCode::kNoBackend, "The GPU's search has failed before.");
    if (rect.empty()) return {};
    if (rect != rect.intersected(rect_of(canvas_size_)) || pixels.size() != rect.size() ||
        filled.size() != rect.size()) {
        return fail(ErrorCode::kUsage, "An update of a plane search is outside its canvas.");
    }
    return noted(upload(rect, pixels, filled, canvas_));
}

Status GpuPlaneSearch::check(const PlaneSearchRequest& r) const {
    const bool sample = r.sample >= 0 && r.sample < static_cast<int>(samples_.size());
    const int turn_x = torus_ ? canvas_size_.width : 0, turn_y = torus_ ? canvas_size_.height : 0;
    const Recti reach{-turn_x, -turn_y, canvas_size_.width + turn_x, canvas_size_.height + turn_y};
    const bool block = !r.block.empty() && (!torus_ || r.block == r.block.intersected(reach));
    const auto within = [](const Recti& inner, Size outer) {
        return !inner.empty() && inner == inner.intersected(rect_of(outer));
    };
    const bool allowed = r.allowed.empty() || r.allowed.size() == r.count();
    constexpr std::size_t kMost = std::size_t{1} << 26;
    if (sample && block && allowed && r.count() > 0 && r.count() <= kMost &&
        within(r.window, samples_[static_cast<std::size_t>(r.sample)].size)) {
        return {};
    }
    return fail(ErrorCode::kUsage, "A plane search was asked for what its setup does not have.");
}

Expected<PlaneSearchResult> GpuPlaneSearch::find(const PlaneSearchRequest& request) {
    if (broken_) return fail(ErrorCode::kNoBackend, "The GPU's search has failed before.");
    WEFT_CHECK_OK(check(request));
    PlaneSearchResult result;
    WEFT_CHECK_OK(noted(search(request, result)));
    return result;
}

Status GpuPlaneSearch::search(const PlaneSearchRequest& request, PlaneSearchResult& result) {
    Device& device = *state_->device();
    const std::size_t count = request.count();
    if (costs_.bytes() < count * sizeof(Cost) || found_.bytes() < kGoodOffset + count) {
        WEFT_CHECK_OK(wait());
        WEFT_CHECK_OK(state_->reserve(costs_, count * sizeof(Cost)));
        WEFT_CHECK_OK(state_->reserve(found_, kGoodOffset + count));
        WEFT_CHECK_OK(state_->reserve(allowed_, count));
    }
    if (request.want_time) WEFT_CHECK_OK(device.start_timer(queue_.get()));
    WEFT_CHECK_OK(flush());
    const bool some_forbidden =
        std::find(request.allowed.begin(), request.allowed.end(), 0) != request.allowed.end() &&
        std::find_if(request.allowed.begin(), request.allowed.end(),
                     [](std::uint8_t a) { return a != 0; }) != request.allowed.end();
    if (some_forbidden) std::memcpy(allowed_.host<void>(), request.allowed.data(), count);
    WEFT_CHECK_OK(compare(request));
    WEFT_CHECK_OK(select(request, some_forbidden));
    if (request.want_time) WEFT_CHECK_OK(device.stop_timer(queue_.get()));
    std::vector<Cost> costs(request.want_costs ? count : 0);
    if (request.want_costs) {
        const std::size_t bytes = count * sizeof(Cost);
        WEFT_CHECK_OK(
            device.copy(queue_.get(), {costs.data(), bytes, costs_.as<void>(), bytes, bytes, 1}));
    }
    WEFT_CHECK_OK(wait());
    if (request.want_time) {
        WEFT_TRY(ms, device.timed_ms(queue_.get()));
        result.device_ms = ms;
    }
    const auto& found = *found_.host<kernels::SearchResult>();
    result.best = found.best;
    result.best_cost = {found.ssd, found.weight};
    const auto* good = found_.host<std::uint8_t>(kGoodOffset);
    for (std::uint32_t i = 0; i < count; ++i) {
        if (good[i]) result.good.push_back(i);
    }
    for (const Cost& c : costs)
        result.costs.push_back({c.ssd, c.weight});
    return {};
}

Status GpuPlaneSearch::compare(const PlaneSearchRequest& r) {
    Device& device = *state_->device();
    const Sample& sample = samples_[static_cast<std::size_t>(r.sample)];
    WEFT_CHECK_OK(device.clear(queue_.get(), costs_.as<void>(), r.count() * sizeof(Cost)));
    SearchArgs args{};
    args.canvas_w = canvas_size_.width, args.canvas_h = canvas_size_.height;
    args.torus = torus_;
    args.block_x = r.block.x0, args.block_y = r.block.y0;
    args.block_w = r.block.width(), args.block_h = r.block.height();
    args.sample_pitch = sample.size.width;
    args.squares_pitch = sample.size.width + 1;
    args.sample = sample.pixels.as<std::uint32_t>() +
                  static_cast<std::ptrdiff_t>(r.window.y0) * args.sample_pitch + r.window.x0;
    args.squares = sample.squares.as<std::uint32_t>() +
                   static_cast<std::ptrdiff_t>(r.window.y0) * args.squares_pitch + r.window.x0;
    args.window_w = r.window.width(), args.window_h = r.window.height();
    args.lo_x = r.lo.x, args.lo_y = r.lo.y;
    args.count_x = r.hi.x - r.lo.x + 1, args.count_y = r.hi.y - r.lo.y + 1;
    args.costs = costs_.as<Cost>();

    const auto picture = [&](const DeviceBuffer& canvas, std::uint32_t weight) -> Status {
        args.canvas = canvas.as<std::uint32_t>();
        args.weight = weight;
        switch (strategy_) {
            case SearchStrategy::kPixel:
                return launch<kernels::SearchPixelLevel>(device, queue_.get(),
                                                         KernelId::kSearchPixelLevel, args);
            case SearchStrategy::kCandidate:
                return launch<kernels::SearchCandidateLevel>(device, queue_.get(),
                                                             KernelId::kSearchCandidateLevel, args);
            case SearchStrategy::kTiled:
                break;
        }
        return launch<kernels::SearchTiled>(device, queue_.get(), KernelId::kSearchTiled, args);
    };
    WEFT_CHECK_OK(picture(canvas_, fill_weight_));
    return guide_.bytes() > 0 ? picture(guide_, guide_weight_) : Status{};
}

Status GpuPlaneSearch::select(const PlaneSearchRequest& r, bool some_forbidden) {
    kernels::SelectArgs args{};
    args.costs = costs_.as<Cost>();
    args.allowed = some_forbidden ? allowed_.device<std::uint8_t>() : nullptr;
    args.count = static_cast<std::uint32_t>(r.count());
    args.numerator = r.good_numerator;
    args.denominator = r.good_denominator;
    args.result = found_.device<kernels::SearchResult>();
    args.good = found_.device<std::uint8_t>(kGoodOffset);
    return launch<kernels::SearchSelect>(*state_->device(), queue_.get(), KernelId::kSearchSelect,
                                         args);
}

}  // namespace weft
