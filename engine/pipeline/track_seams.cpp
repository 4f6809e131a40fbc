#include "engine/pipeline/track_seams.h"

#include <algorithm>
#include <cmath>

#include "engine/compute/plane_sampler.h"
#include "engine/core/parallel.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_form.h"
#include "engine/pipeline/region_mattes.h"
#include "engine/temporal/stretch_limit.h"

namespace weft {
namespace {

constexpr int kStride = 2;  // every other pixel of a frame is evidence

// The tracks of one frame and what is seen of the region on it; empty where they agree.
struct Layers {
    LatticeField before, after, place;  // place: where both are held to lie on the reference frame
    Matte visible;
};

// The extent's pixels by kStride, as their centres.
Vec2 sample_at(int i, int j) {
    return {(static_cast<float>(i) + 0.5f) * kStride, (static_cast<float>(j) + 0.5f) * kStride};
}
bool seen(const Layers& frame, int i, int j) {
    return frame.visible.at(i * kStride, j * kStride) >= 128;
}
Size samples_of(const Layers& frame) {
    return {frame.visible.width() / kStride, frame.visible.height() / kStride};
}

class SeamMaker {
  public:
    SeamMaker(const ShotSource& source, const ShotPlan& plan, const AnalysisStore& store,
              int region, const PlanePyramid& plane, const std::shared_ptr<const SurfaceForm>& form)
        : source_(source),
          plan_(plan),
          region_(plan.regions[static_cast<std::size_t>(region)]),
          store_(store),
          index_(region),
          plane_(plane),
          form_(form) {}

    Expected<std::optional<TrackSeam>> make(int first, int last) {
        std::vector<Layers> frames(static_cast<std::size_t>(last - first - 1));
        bool any = false;
        for (int f = first + 1; f < last; ++f) {
            if (!store_.has({index_, f, AnalysisKind::kTrackAfter})) continue;
            WEFT_TRY(layers, layers_at(f));
            frames[static_cast<std::size_t>(f - first - 1)] = std::move(layers);
            any = true;
        }
        if (!any) return std::optional<TrackSeam>();
        TrackSeam seam;
        seam.first = first;
        seam.last = last;
        const Size cells = choose_cells(frames, frames.size(), seam);
        if (cells.empty()) return std::optional<TrackSeam>();
        std::vector<TrackEvidence> evidence;
        std::vector<std::size_t> drawing;  // of every frame: frames that are held change together
        for (std::size_t t = 0; t < frames.size(); ++t) {
            const int frame = first + 1 + static_cast<int>(t);
            if (evidence.empty() || !store_.has({index_, frame, AnalysisKind::kHeldBetween})) {
                WEFT_TRY(one, evidence_of(frames[t], frame, seam, cells));
                evidence.push_back(std::move(one));
            }
            drawing.push_back(evidence.size() - 1);
        }
        const std::uint64_t seed = plan_.seed ^ region_.random_key;
        const auto labels = cut_between_tracks(evidence, {.lambda = region_.weight, .seed = seed});
        for (const std::size_t k : drawing)
            seam.after.push_back(labels[k]);
        return std::optional<TrackSeam>(std::move(seam));
    }

    // Over the frames first to last, which follow (or, walked backwards, precede) a frame on which
    // a stretched texture was let go. Both textures lie still on the surface, so what that one
    // frame shows of them stands for all: the seam does not depend on how many frames there are.
    Expected<TrackSeam> make_release(int first, int last, bool backwards) {
        TrackSeam seam;
        seam.first = first - 1;
        seam.last = last + 1;
        const int event = backwards ? last : first;
        std::vector<Layers> seen(1);
        WEFT_TRY(layers, layers_at(event));
        seen[0] = std::move(layers);
        WEFT_TRY(bytes, store_.get({index_, event, AnalysisKind::kHidingFrames}));
        WEFT_TRY(frames, decode_number(bytes));
        const auto hiding = static_cast<std::size_t>(std::lround(std::max(1.0f, frames)));
        const Size cells = choose_cells(seen, hiding, seam);
        if (cells.empty()) return seam;
        WEFT_TRY(evidence, evidence_of(seen[0], event, seam, cells));
        const std::uint64_t seed = plan_.seed ^ region_.random_key;
        const auto labels = cut_between_tracks(std::vector(hiding, evidence),
                                               {.lambda = region_.weight, .seed = seed});
        std::size_t drawing = 0;
        for (int f = event;; f += backwards ? -1 : 1) {
            const bool held =
                store_.has({index_, backwards ? f + 1 : f, AnalysisKind::kHeldBetween});
            if (f != event && !held) ++drawing;
            seam.after.push_back(labels[std::min(drawing, labels.size() - 1)]);
            if (f == (backwards ? first : last)) break;
        }
        if (!backwards) return seam;
        std::reverse(seam.after.begin(), seam.after.end());
        for (auto& label : seam.after) {
            for (int y = 0; y < label.height(); ++y) {
                std::uint8_t* row = label.row(y);
                std::transform(row, row + label.width(), row,
                               [](std::uint8_t l) { return static_cast<std::uint8_t>(1 - l); });
            }
        }
        return seam;
    }

  private:
    Expected<LatticeField> stored(int frame, AnalysisKind kind) const {
        WEFT_TRY(bytes, store_.get({index_, frame, kind}));
        return decode_lattice(bytes);
    }

    Expected<Layers> layers_at(int frame) const {
        Layers out;
        WEFT_TRY(before, stored(frame, AnalysisKind::kTrackBefore));
        WEFT_TRY(after, stored(frame, AnalysisKind::kTrackAfter));
        WEFT_TRY(place, stored(frame, AnalysisKind::kCoords));
        WEFT_TRY(extent, extent_matte(source_, plan_, store_, index_, frame));
        WEFT_TRY(holdout, holdout_matte(source_, plan_, store_, index_, frame));
        out.before = std::move(before);
        out.after = std::move(after);
        out.place = std::move(place);
        out.visible = without_holdout(extent, holdout);
        return out;
    }

    // Cells over all of the surface that is seen, as small as the graph's size allows.
    static Size choose_cells(const std::vector<Layers>& frames, std::size_t times,
                             TrackSeam& seam) {
        Vec2 low(1e9f), high(-1e9f);
        for (const Layers& frame : frames) {
            if (frame.visible.empty()) continue;
            const Size size = samples_of(frame);
            for (int j = 0; j < size.height; j += 4) {
                for (int i = 0; i < size.width; i += 4) {
                    if (!seen(frame, i, j)) continue;
                    const Vec2 p = sample_at(i, j), x = p + frame.place.at(p);
                    low = {std::min(low.x, x.x), std::min(low.y, x.y)};
                    high = {std::max(high.x, x.x), std::max(high.y, x.y)};
                }
            }
        }
        if (high.x < low.x) return {};
        constexpr int kMargin = 16, kLargestPx = 1 << 16;
        constexpr std::int64_t kMostNodes = 400'000;
        const int x0 = std::max(-kLargestPx, static_cast<int>(std::floor(low.x)) - kMargin);
        const int y0 = std::max(-kLargestPx, static_cast<int>(std::floor(low.y)) - kMargin);
        const int width = std::min(kLargestPx, static_cast<int>(high.x) + kMargin) - x0;
        const int height = std::min(kLargestPx, static_cast<int>(high.y) + kMargin) - y0;
        seam.origin = {x0, y0};
        for (seam.cell_px = 4;; seam.cell_px += 2) {
            const Size cells{(width + seam.cell_px - 1) / seam.cell_px,
                             (height + seam.cell_px - 1) / seam.cell_px};
            const std::int64_t nodes =
                std::int64_t{cells.width} * cells.height * static_cast<std::int64_t>(times);
            if (nodes <= kMostNodes) return cells;
        }
    }

    // The texture as a track shows it, at every sample, in display codes.
    ImageF3 shown(const LatticeField& ref_from_cur, const Layers& frame,
                  const TextureMapping& mapping) const {
        const Size size = samples_of(frame);
        ImageF2 coords(size);
        Matte inside(size);
        parallel_rows(size.height, 16, [&](int j0, int j1) {
            for (int j = j0; j < j1; ++j) {
                for (int i = 0; i < size.width; ++i) {
                    const Vec2 p = sample_at(i, j);
                    const Vec2 u = mapping.texel(p + ref_from_cur.at(p));
                    coords.pixel(i, j)[0] = u.x;
                    coords.pixel(i, j)[1] = u.y;
                    inside.at(i, j) = seen(frame, i, j) ? 255 : 0;
                }
            }
        });
        ImageF3 out(size);
        SampleRequest request;
        request.plane = &plane_;
        request.coords = coords;
        request.matte = inside;
        request.quality = SampleQuality::kDraft;
        sample_plane_cpu(request, out);
        plan_.display_from_working->apply(out);
        return out;
    }

    Expected<TrackEvidence> evidence_of(const Layers& frame, int number, const TrackSeam& seam,
                                        Size cells) const {
        TrackEvidence out{ImageF1(cells), ImageF1(cells)};
        if (frame.visible.empty()) return out;
        WEFT_TRY(placed, texture_mapping(region_.placement_at(number)));
        const TextureMapping mapping = placed.with_form(form_on(region_, form_, number));
        const ImageF3 a = shown(frame.before, frame, mapping);
        const ImageF3 b = shown(frame.after, frame, mapping);
        for (int j = 0; j < a.height(); ++j) {
            for (int i = 0; i < a.width(); ++i) {
                if (!seen(frame, i, j)) continue;
                const Vec2 p = sample_at(i, j), x = p + frame.place.at(p);
                const int cx =
                    static_cast<int>(x.x - static_cast<float>(seam.origin.x)) / seam.cell_px;
                const int cy =
                    static_cast<int>(x.y - static_cast<float>(seam.origin.y)) / seam.cell_px;
                if (cx < 0 || cy < 0 || cx >= cells.width || cy >= cells.height) continue;
                const float* pa = a.pixel(i, j);
                const float* pb = b.pixel(i, j);
                const float d = std::sqrt((pa[0] - pb[0]) * (pa[0] - pb[0]) +
                                          (pa[1] - pb[1]) * (pa[1] - pb[1]) +
                                          (pa[2] - pb[2]) * (pa[2] - pb[2]));
                out.mismatch.at(cx, cy) += 255.0f * d;
                out.pixels.at(cx, cy) += 1;
            }
        }
        for (int y = 0; y < cells.height; ++y) {
            for (int x = 0; x < cells.width; ++x) {
                float& n = out.pixels.at(x, y);
                if (n > 0) out.mismatch.at(x, y) /= n;
                n *= kStride * kStride;
            }
        }
        return out;
    }

    const ShotSource& source_;
    const ShotPlan& plan_;
    const RegionPlan& region_;
    const AnalysisStore& store_;
    int index_;
    const PlanePyramid& plane_;
    const std::shared_ptr<const SurfaceForm>& form_;
};

}  // namespace

Expected<std::vector<TrackSeam>> make_track_seams(const ShotSource& source, const ShotPlan& plan,
                                                  const AnalysisStore& store, int region,
                                                  const PlanePyramid& plane,
                                                  const std::shared_ptr<const SurfaceForm>& form) {
    std::vector<TrackSeam> out;
    const RegionPlan& settings = plan.regions[static_cast<std::size_t>(region)];
    if (settings.temporal != TemporalMode::kLocked) return out;
    std::vector<int> references = settings.reference_frames;
    std::sort(references.begin(), references.end());
    SeamMaker maker(source, plan, store, region, plane, form);
    for (std::size_t k = 1; k < references.size(); ++k) {
        WEFT_TRY(seam, maker.make(references[k - 1], references[k]));
        if (seam) out.push_back(std::move(*seam));
    }
    const auto released = [&](int frame) {
        return store.has({region, frame, AnalysisKind::kTrackAfter});
    };
    const FrameSpan span = analysed_span(plan, settings);
    for (int first = span.first; first <= span.last; ++first) {
        const bool between = first > references.front() && first < references.back();
        if (between || !released(first)) continue;
        int last = first;
        while (last < span.last && released(last + 1))
            ++last;
        WEFT_TRY(seam, maker.make_release(first, last, first < references.front()));
        if (!seam.after.empty()) out.push_back(std::move(seam));
        first = last;
    }
    return out;
}

}  // namespace weft
