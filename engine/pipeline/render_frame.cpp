#include "engine/pipeline/render_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "engine/composite/composite.h"
#include "engine/composite/focus.h"
#include "engine/composite/line_layer.h"
#include "engine/core/parallel.h"
#include "engine/core/rng.h"
#include "engine/lighting/plate_transfer.h"
#include "engine/mask/edge_softening.h"
#include "engine/pipeline/paper_walker.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_light.h"
#include "engine/pipeline/region_mattes.h"
#include "engine/pipeline/synthesis_inputs.h"

namespace weft {
namespace {

// How many instants stand for the time that the shutter is open: one for every pixel that the
// surface moves in it; a single one where that is less than half of one.
int shutter_samples(const LatticeField& motion, const Recti& box, const Matte& matte, float open) {
    constexpr int kStep = 8, kMost = 32;
    float longest = 0;
    for (int y = 0; y < box.height(); y += kStep) {
        for (int x = 0; x < box.width(); x += kStep) {
            if (matte.at(x, y) == 0) continue;
            const Vec2 v =
                motion.at({static_cast<float>(box.x0 + x), static_cast<float>(box.y0 + y)});
            longest = std::max(longest, open * std::hypot(v.x, v.y));
        }
    }
    if (longest < 0.5f) return 1;
    return std::clamp(static_cast<int>(std::ceil(longest)) + 1, 2, kMost);
}

// The texture coordinates `time` frames later: what is at x then was at x − time · v.
ImageF2 coords_at_time(const LatticeField& ref_from_cur, const ImageF2& velocity,
                       const Mat3& plane_from_plate, const Recti& box, float time) {
    ImageF2 out(box.size());
    parallel_rows(box.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < box.width(); ++x) {
                const float* v = velocity.pixel(x, y);
                const Vec2 p(static_cast<float>(box.x0 + x) + 0.5f - time * v[0],
                             static_cast<float>(box.y0 + y) + 0.5f - time * v[1]);
                const Vec2 u = project(plane_from_plate, p + ref_from_cur.at(p));
                out.pixel(x, y)[0] = u.x;
                out.pixel(x, y)[1] = u.y;
            }
        }
    });
    return out;
}

// The renderer of one frame, with what its regions share.
class FrameRenderer {
  public:
    FrameRenderer(const ShotSource& source, const ShotPlan& plan, const AnalysisStore& store,
                  const Backend& backend, int frame, std::shared_ptr<const ImageF3> plate)
        : source_(source),
          plan_(plan),
          store_(store),
          backend_(backend),
          frame_(frame),
          plate_(std::move(plate)),
          working_(transformed(*plate_, *plan.working_from_plate)),
          canvas_(working_),
          touched_(plate_->size()) {}

    Status add(int index, const RegionScene& scene);
    RenderedFrame finish();

  private:
    [[nodiscard]] Expected<Matte> composite_matte(int index);
    // The texture as the region shows it, in the working space and before light, H×W of `box`.
    [[nodiscard]] Expected<ImageF3> texture(int index, const RegionScene& scene, const Recti& box,
                                            const Matte& matte) const;
    // In locked mode: a history's texture, with the motion's blur.
    [[nodiscard]] Expected<ImageF3> layer(int index, const RegionScene& scene,
                                          const LatticeField& ref_from_cur, const Recti& box,
                                          const Matte& matte) const;
    // How the surface moves while the shutter is open, px a frame; empty where there is no blur.
    [[nodiscard]] Expected<LatticeField> velocity(int index, const RegionScene& scene) const;
    // The same between two references whose histories do not agree: each on its side of the seam.
    [[nodiscard]] Expected<ImageF3> two_histories(int index, const RegionScene& scene,
                                                  const HistorySeam& seam, const Recti& box,
                                                  const Matte& matte) const;
    [[nodiscard]] const HistorySeam* seam_at(const RegionScene& scene, int index) const;
    [[nodiscard]] Expected<LatticeField> stored(int index, AnalysisKind kind) const;
    [[nodiscard]] Expected<Mat3> placement(int index, const RegionScene& scene) const;
    [[nodiscard]] SampleQuality sample_quality() const {
        return plan_.quality == FlowQuality::kDraft ? SampleQuality::kDraft : SampleQuality::kFinal;
    }
    Status light(int index, const RegionScene& scene, const Recti& box, const Matte& matte,
                 ImageF3& texture);
    // What the plate's camera does to a picture: its blur before light, which has it already, and
    // its grain after.
    void match_focus(int index, const Recti& box, const Matte& matte, ImageF3& texture) const;
    void put_grain(int index, const RegionScene& scene, const Recti& box, const Matte& matte,
                   ImageF3& texture) const;
    // The region's ink, from its pass or found in the plate, over the lit texture.
    Status lay_ink(int index, const Recti& box, const Matte& matte, ImageF3& texture);

    const ShotSource& source_;
    const ShotPlan& plan_;
    const AnalysisStore& store_;
    const Backend& backend_;
    int frame_;
    std::shared_ptr<const ImageF3> plate_;
    const ImageF3 working_;  // the plate in the working space
    ImageF3 canvas_;         // layers go over it
    Matte touched_;
    std::optional<PlateViews> views_;
    bool lit_ = false;
};

const RegionPlan& region_of(const ShotPlan& plan, int index) {
    return plan.regions[static_cast<std::size_t>(index)];
}

Expected<Matte> FrameRenderer::composite_matte(int index) {
    WEFT_TRY(extent, extent_matte(source_, plan_, store_, index, frame_));
    WEFT_TRY(holdout, holdout_matte(source_, plan_, index, frame_));
    if (is_hard(extent)) {
        if (!views_) views_ = make_views(*plate_, *plan_.display_from_plate);
        extent = soften_hard_edge(views_->display, extent);
    }
    return without_holdout(extent, holdout);
}

Expected<LatticeField> FrameRenderer::stored(int index, AnalysisKind kind) const {
    WEFT_TRY(bytes, store_.get({index, frame_, kind}));
    return decode_lattice(bytes);
}

Expected<Mat3> FrameRenderer::placement(int index, const RegionScene& scene) const {
    const RegionPlan& region = region_of(plan_, index);
    if (!region.placement_moves()) return scene.plane_from_plate;
    return plane_from_plate(region.placement_at(frame_));
}

// Towards the reference, so that a frame does not depend on what else is rendered.
Expected<LatticeField> FrameRenderer::velocity(int index, const RegionScene& scene) const {
    const RegionPlan& region = region_of(plan_, index);
    if (!(scene.shutter_deg > 0) || region.shutter_evidence.empty()) return LatticeField();
    const int step = frame_ > region.reference_frames.front() ? -1 : 1;
    WEFT_TRY(here, stored(index, AnalysisKind::kCoords));
    WEFT_TRY(bytes, store_.get({index, frame_ + step, AnalysisKind::kCoords}));
    WEFT_TRY(there, decode_lattice(bytes));
    LatticeField motion = compose(here, inverse(there));
    if (step < 0) {
        for (int j = 0; j < motion.nodes().height(); ++j) {
            for (int i = 0; i < motion.nodes().width(); ++i)
                motion.set_node(i, j, -motion.node(i, j));
        }
    }
    return motion;
}

Expected<ImageF3> FrameRenderer::layer(int index, const RegionScene& scene,
                                       const LatticeField& ref_from_cur, const Recti& box,
                                       const Matte& matte) const {
    WEFT_TRY(plane_from, placement(index, scene));
    WEFT_TRY(motion, velocity(index, scene));
    SampleRequest request;
    request.plane = &scene.plane;
    request.matte = matte;
    request.quality = sample_quality();
    ImageF3 out(box.size());
    const float open = scene.shutter_deg / 360.0f;
    const int times = motion.empty() ? 1 : shutter_samples(motion, box, matte, open);
    if (times == 1) {
        const TextureCoords at = texture_coords(ref_from_cur, plane_from, box);
        request.coords = at.uv;
        backend_.sample_plane(request, out);
        return out;
    }
    // The blur hides what a coarser lookup loses.
    request.quality = SampleQuality::kDraft;
    const ImageF2 path = motion.dense(box);
    ImageF3 instant(box.size());
    for (int k = 0; k < times; ++k) {
        const float time =
            open * ((static_cast<float>(k) + 0.5f) / static_cast<float>(times) - 0.5f);
        const ImageF2 at = coords_at_time(ref_from_cur, path, plane_from, box, time);
        request.coords = at;
        backend_.sample_plane(request, instant);
        const float share = 1.0f / static_cast<float>(times);
        std::transform(out.data(), out.data() + 3 * box.width() * box.height(), instant.data(),
                       out.data(), [&](float sum, float v) { return sum + share * v; });
    }
    return out;
}

const HistorySeam* FrameRenderer::seam_at(const RegionScene& scene, int index) const {
    for (const HistorySeam& seam : scene.seams) {
        if (seam.covers(frame_) && store_.has({index, frame_, AnalysisKind::kHistoryAfter}))
            return &seam;
    }
    return nullptr;
}

Expected<ImageF3> FrameRenderer::two_histories(int index, const RegionScene& scene,
                                               const HistorySeam& seam, const Recti& box,
                                               const Matte& matte) const {
    WEFT_TRY(place, stored(index, AnalysisKind::kCoords));
    const ImageF2 d = place.dense(box);
    ImageF1 share(box.size());
    std::array<Matte, 2> inside{Matte(box.size()), Matte(box.size())};
    parallel_rows(box.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < box.width(); ++x) {
                if (matte.at(x, y) == 0) continue;
                const Vec2 p(static_cast<float>(box.x0 + x) + 0.5f,
                             static_cast<float>(box.y0 + y) + 0.5f);
                const float after =
                    seam.share_after(frame_, p + Vec2(d.pixel(x, y)[0], d.pixel(x, y)[1]));
                share.at(x, y) = after;
                inside[0].at(x, y) = after < 1 ? 255 : 0;
                inside[1].at(x, y) = after > 0 ? 255 : 0;
            }
        }
    });
    ImageF3 out;
    for (const bool after : {false, true}) {
        const auto kind = after ? AnalysisKind::kHistoryAfter : AnalysisKind::kHistoryBefore;
        WEFT_TRY(ref_from_cur, stored(index, kind));
        WEFT_TRY(shown, layer(index, scene, ref_from_cur, box, inside[after ? 1 : 0]));
        if (!after) {
            out = std::move(shown);
            continue;
        }
        for (int y = 0; y < box.height(); ++y) {
            for (int x = 0; x < box.width(); ++x) {
                const float w = share.at(x, y);
                if (w <= 0) continue;
                for (int c = 0; c < 3; ++c)
                    out.at(x, y, c) = (1 - w) * out.at(x, y, c) + w * shown.at(x, y, c);
            }
        }
    }
    return out;
}

Expected<ImageF3> FrameRenderer::texture(int index, const RegionScene& scene, const Recti& box,
                                         const Matte& matte) const {
    const RegionPlan& region = region_of(plan_, index);
    if (const HistorySeam* seam = seam_at(scene, index))
        return two_histories(index, scene, *seam, box, matte);
    if (region.temporal == TemporalMode::kLocked) {
        WEFT_TRY(ref_from_cur, stored(index, AnalysisKind::kCoords));
        return layer(index, scene, ref_from_cur, box, matte);
    }
    constexpr int kCoarse = 64;
    TextureCoords at =
        texture_coords(LatticeField(plate_->size(), kCoarse), scene.plane_from_plate, box);
    ImageF3 out(box.size());
    SampleRequest request;
    request.coords = at.uv;
    request.matte = matte;
    request.quality = sample_quality();
    if (!scene.plane.empty()) {
        request.plane = &scene.plane;
        backend_.sample_plane(request, out);
        return out;
    }

    // A plane of this frame alone, which begins at a texel of its own.
    WEFT_TRY(frame_area, frame_plane(region.placement, plate_->size()));
    ImageF3 picture;
    if (region.temporal == TemporalMode::kPaper) {
        WEFT_TRY(bytes, store_.get({index, frame_, AnalysisKind::kPaperTexture}));
        WEFT_TRY(codes, decode_picture(bytes));
        picture = ImageF3(codes.size());
        std::transform(codes.data(), codes.data() + codes.size_bytes(), picture.data(),
                       [](std::uint8_t v) { return static_cast<float>(v) / 255.0f; });
        region.working_from_display->apply(picture);
    } else {
        PlaneOptions options = plane_options(region, plan_.seed, frame_area.size);
        options.frame = static_cast<std::uint64_t>(static_cast<std::int64_t>(frame_));
        WEFT_TRY(plane, grow_plane(synthesis_sample(region), options));
        picture = plane_in_working_space(region, plane);
    }
    const PlanePyramid pyramid(picture, WrapMode::kMirror);
    for (int y = 0; y < at.uv.height(); ++y) {
        for (int x = 0; x < at.uv.width(); ++x) {
            at.uv.pixel(x, y)[0] -= static_cast<float>(frame_area.origin.x);
            at.uv.pixel(x, y)[1] -= static_cast<float>(frame_area.origin.y);
        }
    }
    request.plane = &pyramid;
    backend_.sample_plane(request, out);
    return out;
}

Status FrameRenderer::light(int index, const RegionScene& scene, const Recti& box,
                            const Matte& matte, ImageF3& texture) {
    const RegionPlan& region = region_of(plan_, index);
    if (!region.lights()) return {};
    LightOptions options = region.light;
    options.strength = region.strength_at(frame_);
    const Vec2i origin(box.x0, box.y0);
    const ViewF3 old_surface = working_.view().crop(box);
    lit_ = true;
    if (is_transfer(options.form)) {
        if (options.form == LightForm::kStatistics)
            transfer_statistics(texture, old_surface, matte, options.strength);
        else
            match_histogram(texture, old_surface, matte, options.strength);
        return {};
    }
    if (scene.picture_light) {
        apply_light(texture, origin, matte, *scene.picture_light, scene.reference_shading, options);
        return {};
    }
    WEFT_TRY(shading, region_shading(source_, region, store_, index, frame_, working_));
    if (!shading) return {};
    apply_light(texture, origin, matte, *shading, scene.reference_shading, options);
    if (region.cast > 0) {
        WEFT_TRY(whole, composite_matte(index));
        apply_cast(texture, origin, matte, *shading, scene.reference_shading,
                   light_colour(working_, whole, *shading), scene.reference_colour, region.cast);
    }
    add_highlights(texture, origin, old_surface, matte, *shading, region.highlights);
    return {};
}

void FrameRenderer::match_focus(int index, const Recti& box, const Matte& matte,
                                ImageF3& texture) const {
    const float strength = region_of(plan_, index).focus;
    if (!(strength > 0)) return;
    const float plate_px = edge_blur_px(working_.view().crop(box), matte);
    if (!(plate_px > 0)) return;
    blur_inside(texture, matte, strength * blur_between(edge_blur_px(texture, matte), plate_px));
}

void FrameRenderer::put_grain(int index, const RegionScene& scene, const Recti& box,
                              const Matte& matte, ImageF3& texture) const {
    const RegionPlan& region = region_of(plan_, index);
    if (!(region.grain > 0) || !scene.grain.present()) return;
    const auto frame = static_cast<std::uint64_t>(static_cast<std::int64_t>(frame_));
    ImageF3 display = transformed(texture, *plan_.display_from_working);
    add_grain(display, matte, {box.x0, box.y0}, scene.grain, region.grain,
              mix64(mix64(mix64(plan_.seed) ^ region.random_key) ^ frame));
    texture = transformed(display, *region.working_from_display);
}

Status FrameRenderer::lay_ink(int index, const Recti& box, const Matte& matte, ImageF3& texture) {
    const RegionPlan& region = region_of(plan_, index);
    if (!region.has_lines && !region.extract_lines) return {};
    Matte ink;
    if (region.has_lines) {
        WEFT_TRY(pass, source_.lines(index, frame_));
        ink = std::move(pass);
    } else {
        if (!views_) views_ = make_views(*plate_, *plan_.display_from_plate);
        ink = extract_ink(views_->display, matte, {.width_px = region.line_width_px});
    }
    lay_lines(texture, working_.view().crop(box), ink.view().crop(box));
    return {};
}

Status FrameRenderer::add(int index, const RegionScene& scene) {
    WEFT_TRY(matte, composite_matte(index));
    const Recti box = matte_bounds(matte);
    if (box.empty()) return {};
    Matte inside(box.size());
    for (int y = 0; y < box.height(); ++y) {
        const std::uint8_t* row = matte.pixel(box.x0, box.y0 + y);
        std::copy(row, row + box.width(), inside.row(y));
    }
    WEFT_TRY(surface, texture(index, scene, box, inside));
    match_focus(index, box, inside, surface);
    WEFT_CHECK_OK(light(index, scene, box, inside, surface));
    put_grain(index, scene, box, inside, surface);
    // The ink has the plate's grain already.
    WEFT_CHECK_OK(lay_ink(index, box, matte, surface));

    const ImageView<float, 3> area = canvas_.view().crop(box);
    const ImageF3 old_surface = unmix_surface(area, inside);
    composite_over(area, area, old_surface, inside, surface);
    std::transform(matte.data(), matte.data() + matte.size_bytes(), touched_.data(),
                   touched_.data(), [](std::uint8_t a, std::uint8_t b) { return std::max(a, b); });
    return {};
}

RenderedFrame FrameRenderer::finish() {
    RenderedFrame out;
    if (lit_ && plan_.display_referred) out.above_one = roll_off(canvas_, touched_);
    plan_.out_from_working->apply(canvas_);
    out.pixels = transformed(*plate_, *plan_.out_from_plate);
    for (int y = 0; y < touched_.height(); ++y) {
        for (int x = 0; x < touched_.width(); ++x) {
            if (touched_.at(x, y) == 0) continue;
            const float* p = plate_->pixel(x, y);
            if (!std::isfinite(p[0] + p[1] + p[2])) ++out.filled;
            std::copy_n(canvas_.pixel(x, y), 3, out.pixels.pixel(x, y));
        }
    }
    out.touched = std::move(touched_);
    return out;
}

}  // namespace

Expected<RenderedFrame> render_frame(const ShotSource& source, const ShotPlan& plan,
                                     const std::vector<RegionScene>& scenes,
                                     const AnalysisStore& store, const Backend& backend,
                                     int frame) {
    WEFT_TRY(plate, source.plate(frame));
    FrameRenderer renderer(source, plan, store, backend, frame, std::move(plate));
    for (std::size_t k = 0; k < scenes.size(); ++k) {
        WEFT_CHECK_OK(renderer.add(static_cast<int>(k), scenes[k]));
    }
    return renderer.finish();
}

}  // namespace weft
