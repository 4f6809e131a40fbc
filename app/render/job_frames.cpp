#include "app/render/job_frames.h"

#include <algorithm>
#include <atomic>
#include <mutex>

#include "app/render/burn_in.h"
#include "app/render/layer_files.h"
#include "app/render/st_map_files.h"
#include "app/render/version_up.h"
#include "engine/core/parallel.h"
#include "engine/core/stopwatch.h"
#include "engine/media/image_files.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_mattes.h"
#include "engine/pipeline/render_frame.h"
#include "engine/pipeline/sweep.h"

namespace weft {
namespace {

Status write_frame(const JobSetup& setup, int frame, const std::string& path,
                   const RenderedFrame& rendered, const PlateFrame& plate) {
    const Shot& shot = *setup.shot;
    const WriteOptions write = setup.write_of(frame);
    std::vector<ExrLayer> layers;
    if (rendered.layers) layers = exr_layers(*rendered.layers, shot.project.output.layers);
    if (setup.layer_pattern) {
        const ExrFrame apart{rendered.pixels, {}, {}, {}, {}, std::move(layers)};
        WriteOptions half = write;
        half.depth = PixelDepth::kHalf;
        WEFT_CHECK_OK(write_exr(setup.layer_pattern->path_for(frame), apart, half));
        layers.clear();
    }
    const std::string source = shot.plate->path_of(frame);
    if (!is_exr(shot.project.output.path)) {
        WriteOptions kept = write;
        kept.source = source;
        kept.alpha = plate.alpha_kind;
        return write_image(path, rendered.pixels, plate.alpha, kept);
    }
    ImageF3 associated;
    if (!plate.alpha.empty() && plate.alpha_kind == AlphaKind::kStraight) {
        associated = rendered.pixels;
        associate(associated, plate.alpha);
    }
    ExrFrame exr{associated.empty() ? rendered.pixels : associated,
                 plate.alpha,
                 {},
                 {},
                 {},
                 std::move(layers)};
    const std::string& layer = shot.project.plate.layer;
    if (is_exr_with_colour(source, layer)) {
        exr.source = source;
        exr.source_layer = layer;
        if (shot.spaces.plate == shot.spaces.out) exr.touched = rendered.touched;
    }
    return write_exr(path, exr, write);
}

// The replacement of a missing frame where it is to be black.
bool is_black(const Shot& shot, int frame) {
    return shot.project.plate.missing == MissingFrames::kBlack &&
           shot.plate->shown_frame(frame) != frame;
}

// A black frame shows nothing of any surface.
Status write_maps(const FrameInputs& in, int frame) {
    if (!in.setup.st_map_pattern) return {};
    const Shot& shot = *in.setup.shot;
    const Size size = shot.plate->size();
    StMaps maps{{ImageF2(size), ImageF1(size)}, {ImageF2(size), ImageF1(size)}};
    if (!is_black(shot, frame)) {
        WEFT_TRY(found, st_maps(*shot.source, in.plan, in.store, shot.plate->shown_frame(frame)));
        maps = std::move(found);
    }
    return write_st_maps(in.setup.st_map_pattern->path_for(frame), maps, in.setup.write_of(frame));
}

Status make_frame(const FrameInputs& in, FrameResult& result) {
    const Shot& shot = *in.setup.shot;
    WEFT_CHECK_OK(write_maps(in, result.frame));
    if (is_black(shot, result.frame))
        return write_image(result.path, ImageF3(shot.plate->size()), {},
                           in.setup.write_of(result.frame));
    // A held frame equals the frame it repeats, grain included.
    const int shown = shot.plate->shown_frame(result.frame);
    WEFT_TRY(rendered,
             render_frame(*shot.source, in.plan, in.scenes, in.store, *in.setup.backend, shown));
    WEFT_TRY(decoded, shot.plate->read_shared(result.frame));
    WEFT_CHECK_OK(write_frame(in.setup, result.frame, result.path, rendered, *decoded));
    result.above_one = rendered.above_one;
    result.filled = rendered.filled;
    result.nonfinite = decoded->nonfinite;
    result.untouched = !rendered.burnt_out && matte_bounds(rendered.touched).empty();
    return {};
}

std::string burnt_text(const Shot& shot, int frame) {
    const auto version = version_in(shot.project.output.path);
    char text[96];
    std::snprintf(text, sizeof text, "%d   %s%s", frame,
                  version ? ("v" + std::to_string(*version)).c_str() : "", version ? "   " : "");
    return text + shot.spaces.out.name;
}

// The movie of a job; it receives the frames in order.
struct ReviewMovie {
    std::unique_ptr<MovieWriter> writer;
    std::shared_ptr<const ColorTransform> display_from_out;

    static Expected<ReviewMovie> open(const JobSetup& setup, const std::string& path) {
        const Shot& shot = *setup.shot;
        const double fps = movie_fps(shot);
        ReviewMovie movie;
        WEFT_TRY(display_from_out, make_color_transform(shot.spaces.out, {"srgb"}));
        movie.display_from_out = display_from_out;
        WEFT_TRY(writer, open_movie(path, shot.plate->size(), fps, shot.plate->pixel_aspect(),
                                    setup.movie_rule));
        movie.writer = std::move(writer);
        return movie;
    }

    // Reads the frame back from disk, so that the movie of a resumed run is the same.
    [[nodiscard]] Expected<ImageF3> display(const Shot& shot, const FrameResult& frame) const {
        WEFT_TRY(written, read_image(frame.path));
        if (!written.alpha.empty() && written.alpha_kind == AlphaKind::kStraight)
            associate(written.rgb, written.alpha);  // over black
        display_from_out->apply(written.rgb);
        if (shot.project.output.burn_in) burn_in(written.rgb, burnt_text(shot, frame.frame));
        return std::move(written.rgb);
    }
};

// The first of the frames that failed. No later one is begun; earlier ones are still made, so that
// any number of threads reports the same frame.
class FirstFailure {
  public:
    explicit FirstFailure(std::size_t none) : at_(none) {}
    [[nodiscard]] bool is_before(std::size_t frame) const { return at_.load() < frame; }
    void note(std::size_t frame) {
        std::size_t known = at_.load();
        while (frame < known && !at_.compare_exchange_weak(known, frame)) {
        }
    }

  private:
    std::atomic<std::size_t> at_;
};

// A movie receives its frames in order, so they are rendered in batches; so they are where memory
// allows fewer frames side by side than there are threads. Otherwise no thread waits for another.
std::size_t frames_in_batch(const JobSetup& setup, std::size_t frames, bool movie) {
    const auto threads = static_cast<std::size_t>(thread_count());
    if (movie || setup.frames_at_once < threads) return std::min(2 * threads, setup.frames_at_once);
    return frames;
}

}  // namespace

double movie_fps(const Shot& shot) {
    const double given = shot.project.plate.fps, of_plate = shot.plate->fps();
    return given > 0 ? given : of_plate > 0 ? of_plate : 24.0;
}

bool is_exr(const std::string& path) {
    return path.ends_with(".exr") || path.ends_with(".EXR");
}

Status render_frames(const FrameInputs& in, const std::string& movie_path,
                     const CancelToken& cancel, const ProgressFn& progress,
                     std::vector<FrameResult>& frames, std::int64_t& done) {
    std::optional<ReviewMovie> movie;
    if (!movie_path.empty()) {
        WEFT_TRY(opened, ReviewMovie::open(in.setup, movie_path));
        movie = std::move(opened);
    }
    std::mutex progress_mutex;
    const auto one_frame = [&](FrameResult& result, ImageF3* display) -> Status {
        if (cancel.cancelled()) return cancelled(cancel);
        const auto start = Clock::now();
        if (!result.skipped) WEFT_CHECK_OK(make_frame(in, result));
        if (display) {
            WEFT_TRY(shown, movie->display(*in.setup.shot, result));
            *display = std::move(shown);
        }
        result.seconds = seconds_since(start);
        const std::lock_guard lock(progress_mutex);
        ++done;
        if (progress) {
            progress({WorkStage::kRender, done, static_cast<std::int64_t>(frames.size()),
                      result.frame, result.seconds});
        }
        return {};
    };
    const std::size_t batch = frames_in_batch(in.setup, frames.size(), movie.has_value());
    for (std::size_t first = 0; first < frames.size(); first += batch) {
        const std::size_t count = std::min(batch, frames.size() - first);
        std::vector<Status> status(count);
        std::vector<ImageF3> display(movie ? count : 0);
        FirstFailure failure{count};
        parallel_for(count, [&](std::size_t k) {
            if (failure.is_before(k)) return;
            try {
                status[k] = one_frame(frames[first + k], movie ? &display[k] : nullptr);
            } catch (...) {
                failure.note(k);
                throw;
            }
            if (!status[k]) failure.note(k);
        });
        for (std::size_t k = 0; k < count; ++k) {
            if (!status[k]) {
                return fail_in(std::move(status[k]).error(),
                               "Frame " + std::to_string(frames[first + k].frame));
            }
            if (movie) WEFT_CHECK_OK(movie->writer->add(display[k]));
        }
    }
    return movie ? movie->writer->close() : Status{};
}

}  // namespace weft
