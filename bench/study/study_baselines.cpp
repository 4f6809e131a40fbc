// Baselines that the renderer itself does not have.

#include <algorithm>
#include <cmath>
#include <mutex>

#include "bench/baselines/patch_match.h"
#include "bench/baselines/poisson_clone.h"
#include "bench/study/study_methods.h"
#include "engine/compute/backend_registry.h"
#include "engine/core/parallel.h"
#include "engine/core/stopwatch.h"
#include "engine/media/frame_writer.h"
#include "engine/media/image_files.h"
#include "engine/media/sequence_pattern.h"
#include "engine/metrics/ideal.h"
#include "engine/pipeline/paper_walker.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/render_frame.h"
#include "engine/pipeline/sweep.h"
#include "engine/pipeline/synthesis_inputs.h"

namespace weft {
namespace {

class BaselineRenderer {
  public:
    BaselineRenderer(const StudyMethod& method, const WriteRule& rule, const CancelToken& cancel,
                     const ProgressFn& progress)
        : method_(method), cancel_(cancel), progress_(progress) {
        write_.rule = rule;
    }

    Expected<StageSeconds> run(const std::string& plane) {
        const auto start = Clock::now();
        StageSeconds seconds;
        WEFT_CHECK_OK(open(plane));
        seconds.open = seconds_since(start);
        const std::vector<int>& frames = shot_->plan.frames;
        std::vector<Status> status(frames.size());
        const auto work = Clock::now();
        parallel_for(frames.size(), [&](std::size_t k) { status[k] = one_frame(frames[k]); });
        for (std::size_t k = 0; k < frames.size(); ++k) {
            if (!status[k]) {
                return fail_in(std::move(status[k]).error(), "Frame " + std::to_string(frames[k]));
            }
        }
        seconds.render = seconds_since(work);
        seconds.total = seconds_since(start);
        return seconds;
    }

  private:
    Status open(const std::string& plane) {
        WEFT_TRY(shot, open_shot(method_.project));
        shot_ = shot;
        WEFT_TRY(pattern, SequencePattern::parse(method_.run.pattern));
        pattern_ = pattern;
        write_.depth = output_depth(method_.project.output, shot_->plate->depth());
        WEFT_CHECK_OK(make_folder_of(pattern_->path_for(shot_->plan.frames.front()), write_.rule));
        WEFT_TRY(choice, BackendRegistry().choose("cpu"));
        backend_ = choice.backend;
        WEFT_TRY(scene,
                 make_scene(*shot_->source, shot_->plan, MemoryAnalysisStore(), 0, cancel_, {}));
        scenes_.push_back(std::move(scene));
        if (method_.kind != StudyMethod::Kind::kPoisson) return {};
        WEFT_TRY(picture, read_image(plane));
        WEFT_TRY(same, make_color_transform({"srgb"}, {"srgb"}));
        tile_.emplace(make_views(picture.rgb, *same).display);
        WEFT_TRY(matte, visible_matte(*shot_, region().reference_frames.front()));
        reference_box_ = matte_bounds(matte);
        return {};
    }

    [[nodiscard]] const RegionPlan& region() const { return shot_->plan.regions.front(); }

    Status one_frame(int frame) {
        if (cancel_.cancelled()) return cancelled(cancel_);
        const auto start = Clock::now();
        WEFT_TRY(pixels, method_.kind == StudyMethod::Kind::kPoisson ? blended(frame)
                                                                     : resynthesised(frame));
        WEFT_CHECK_OK(write_image(pattern_->path_for(frame), pixels, {}, write_));
        const std::lock_guard lock(progress_mutex_);
        ++done_;
        if (progress_) {
            progress_({WorkStage::kRender, done_,
                       static_cast<std::int64_t>(shot_->plan.frames.size()), frame,
                       seconds_since(start)});
        }
        return {};
    }

    // The part of a frame's own plane that its matte shows, by PatchMatch; then as any other frame.
    Expected<ImageF3> resynthesised(int frame) {
        WEFT_TRY(area, frame_plane(region().placement, shot_->plate->size()));
        WEFT_TRY(matte, visible_matte(*shot_, frame));
        const Recti box = texel_box(matte_bounds(matte), area);
        ImageU8x3 picture(area.size);
        if (!box.empty()) {
            PatchMatchOptions options;
            options.size = box.size();
            options.seed = shot_->plan.seed;
            options.region = region().random_key;
            options.frame = static_cast<std::uint64_t>(static_cast<std::int64_t>(frame));
            const ImageU8x3 made =
                patch_match_texture(synthesis_samples(region()).front(), options);
            for (int y = 0; y < made.height(); ++y)
                std::copy_n(made.row(y), 3 * made.width(), picture.pixel(box.x0, box.y0 + y));
        }
        MemoryAnalysisStore store;
        WEFT_CHECK_OK(store.put({0, frame, AnalysisKind::kPaperTexture}, encode(picture)));
        WEFT_TRY(rendered,
                 render_frame(*shot_->source, shot_->plan, scenes_, store, *backend_, frame));
        return std::move(rendered.pixels);
    }

    // A plate rectangle on the frame's plane, with a rim for the sampling filter.
    [[nodiscard]] Recti texel_box(const Recti& plate, const FramePlane& area) const {
        if (plate.empty()) return {};
        constexpr int kRim = 4;
        const auto [first, last] = scenes_.front().mapping.bounds_of(plate);
        const Vec2 low = first - Vec2(area.origin), high = last - Vec2(area.origin);
        return {std::max(0, static_cast<int>(low.x) - kRim),
                std::max(0, static_cast<int>(low.y) - kRim),
                std::min(area.size.width, static_cast<int>(high.x) + kRim + 1),
                std::min(area.size.height, static_cast<int>(high.y) + kRim + 1)};
    }

    // The tile moves with the region's box.
    Expected<ImageF3> blended(int frame) {
        WEFT_TRY(plate, shot_->source->plate(frame));
        WEFT_TRY(matte, visible_matte(*shot_, frame));
        ImageF3 out = transformed(*plate, *shot_->plan.out_from_plate);
        const Recti box = matte_bounds(matte);
        if (box.empty()) return out;
        FlowField at(plate->size());
        for (int y = 0; y < at.d.height(); ++y) {
            for (int x = 0; x < at.d.width(); ++x) {
                at.d.at(x, y, 0) = static_cast<float>(middle(reference_box_).x - middle(box).x);
                at.d.at(x, y, 1) = static_cast<float>(middle(reference_box_).y - middle(box).y);
            }
        }
        const ImageF3 texture = tile_->render(at, scenes_.front().mapping);
        WEFT_TRY(same, make_color_transform({"srgb"}, {"srgb"}));
        const ImageU8x3 codes =
            poisson_clone(make_views(*plate, *shot_->plan.display_from_plate).display,
                          make_views(texture, *same).display, matte);
        ImageF3 surface(codes.size());
        std::transform(codes.data(), codes.data() + codes.size_bytes(), surface.data(),
                       [](std::uint8_t v) { return static_cast<float>(v) / 255.0f; });
        region().working_from_display->apply(surface);
        shot_->plan.out_from_working->apply(surface);
        for (int y = 0; y < out.height(); ++y) {
            for (int x = 0; x < out.width(); ++x) {
                if (matte.at(x, y) > 0) std::copy_n(surface.pixel(x, y), 3, out.pixel(x, y));
            }
        }
        return out;
    }

    static Vec2i middle(const Recti& r) { return {(r.x0 + r.x1) / 2, (r.y0 + r.y1) / 2}; }

    const StudyMethod& method_;
    CancelToken cancel_;
    const ProgressFn& progress_;
    std::shared_ptr<const Shot> shot_;
    std::optional<SequencePattern> pattern_;
    WriteOptions write_;
    std::shared_ptr<const Backend> backend_;
    std::vector<RegionScene> scenes_;
    std::optional<IdealTexture> tile_;
    Recti reference_box_;
    std::mutex progress_mutex_;
    std::int64_t done_ = 0;
};

}  // namespace

Expected<StageSeconds> render_baseline(const StudyMethod& method, const std::string& plane,
                                       const WriteRule& rule, const CancelToken& cancel,
                                       const ProgressFn& progress) {
    return BaselineRenderer(method, rule, cancel, progress).run(plane);
}

}  // namespace weft
