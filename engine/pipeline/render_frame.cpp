#include "engine/pipeline/render_frame.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/composite/blend_mode.h"
#include "engine/composite/composite.h"
#include "engine/composite/line_layer.h"
#include "engine/core/blur_inside.h"
#include "engine/core/parallel.h"
#include "engine/core/rng.h"
#include "engine/mask/edge_softening.h"
#include "engine/pipeline/frame_focus.h"
#include "engine/pipeline/frame_light.h"
#include "engine/pipeline/motion_zones.h"
#include "engine/pipeline/plate_alpha.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_form.h"
#include "engine/pipeline/region_mattes.h"
#include "engine/pipeline/region_surface.h"
#include "engine/pipeline/uv_coords.h"

namespace weft {
namespace {

enum class Place { kDevice, kCpu };

// A region's mattes, without its holdouts.
struct Mattes {
    Matte shown;   // where the new surface goes
    Matte covers;  // where the plate shows the old one, if that differs; else empty

    [[nodiscard]] const Matte& old() const { return covers.empty() ? shown : covers; }
    [[nodiscard]] Mattes crop(const Recti& box) const {
        return {cropped(shown, box), covers.empty() ? Matte() : cropped(covers, box)};
    }
};

// Renders one frame and holds what its regions share. On a device the frame stays there from the
// first region to the last.
class FrameRenderer {
  public:
    FrameRenderer(const ShotSource& source, const ShotPlan& plan, const AnalysisStore& store,
                  const Backend& backend, int frame, std::shared_ptr<const ImageF3> plate,
                  PlateAlpha alpha, Place place)
        : source_(source),
          plan_(plan),
          store_(store),
          backend_(backend),
          frame_(frame),
          plate_(std::move(plate)),
          alpha_(std::move(alpha)),
          working_(plate_->size()),
          canvas_(plate_->size()),
          ready_(static_cast<std::size_t>(plate_->height())),
          touched_(plate_->size()) {
        if (plan.layers) layers_.emplace(plate_->size(), plan.form_layers);
        if (place == Place::kDevice) {
            make_ready(rect_of(plate_->size()));
            device_ = backend.open_frame(canvas_);
        }
    }

    /// After an error: true if the device failed, so that the CPU can still render the frame.
    [[nodiscard]] bool device_failed() const { return device_failed_; }
    Status add(int index, const RegionScene& scene);
    Expected<RenderedFrame> finish();

  private:
    // Fills working_ and canvas_ over the box, where that has not been done.
    void make_ready(const Recti& box);
    [[nodiscard]] Expected<Mattes> composite_mattes(int index);
    void put_grain(int index, const RegionScene& scene, const Recti& box, ViewU8x1 matte,
                   ImageF3& texture) const;
    // The texture in the working space, finished and composited over the canvas. `matte` covers the
    // frame, `inside` the box.
    Status add_on_cpu(int index, const RegionSurface& surface, const Recti& box,
                      const RegionScene& scene, const Matte& matte, const Mattes& inside,
                      const FrameLight& light);
    // The region's contribution to the frame's layers, except for the patch. `share` has its
    // pictures.
    Status note_share(int index, const RegionSurface& surface, const RegionScene& scene,
                      LayerShare share);
    Status add_on_device(int index, const RegionSurface& surface, const Recti& box,
                         const RegionScene& scene, const Mattes& inside, const FrameLight& light);
    // Remembers that an error came from the device.
    template <class T>
    Expected<T> of_device(Expected<T> result) {
        device_failed_ = device_failed_ || !result;
        return result;
    }
    // Lays the region's ink, from its pass or extracted from the plate, over the lit texture. The
    // old surface gets it too, because ink across the edge belongs to neither.
    Status lay_ink(int index, const Recti& box, const Matte& matte, ImageF3& texture,
                   ImageF3& old_surface);

    const ShotSource& source_;
    const ShotPlan& plan_;
    const AnalysisStore& store_;
    const Backend& backend_;
    int frame_;
    std::shared_ptr<const ImageF3> plate_;
    PlateAlpha alpha_;
    ImageF3 working_;  // the plate's straight colours in the working space; only spans of ready_
    ImageF3 canvas_;   // layers go over it; the same
    struct Span {
        int x0 = 0, x1 = 0;
    };
    std::vector<Span> ready_;  // of each row
    Recti rendered_;           // around all regions
    Matte touched_;
    std::optional<FrameLayers> layers_;
    std::optional<PlateViews> views_;
    bool lit_ = false;
    float peak_ = 1;  // fullest_white() of all regions
    std::unique_ptr<FrameCanvas> device_;
    Recti device_box_;  // where the canvas on the device differs from canvas_
    bool device_failed_ = false;
    bool burnt_out_ = false;
};

// True if a device supports all that a region needs: texture, a gain of light, composite.
bool fits_device(const RegionPlan& region, const RegionScene& scene) {
    const bool tints = region.cast ? *region.cast > 0 : scene.light_has_colour();
    const bool light = !region.lights() || (region.light.form == LightForm::kGain && !tints &&
                                            region.highlights <= 0 && region.keep_detail <= 0);
    const bool grain = region.grain > 0 && scene.grain.present();
    return light && region.grade == Grade{} && !region.blends() && !grain && !region.has_uv &&
           !region.exact_light && !(region.focus > 0) && !region.has_lines && !region.extract_lines;
}

// True if a region's light follows from the plate beyond the region.
bool needs_whole_plate(const RegionPlan& region) {
    return region.light_pass == RegionPlan::Pass::kAlbedo;
}

void FrameRenderer::make_ready(const Recti& box) {
    const auto convert = [&](int x0, int x1, int y) {
        if (x0 >= x1) return;
        float* to = working_.pixel(x0, y);
        std::copy(plate_->pixel(x0, y), plate_->pixel(x1, y), to);
        if (alpha_.associated()) unassociate_row(to, alpha_.coverage->pixel(x0, y), x1 - x0);
        plan_.working_from_plate->apply(working_.view().crop({x0, y, x1, y + 1}));
        std::copy(to, to + static_cast<std::ptrdiff_t>(3) * (x1 - x0), canvas_.pixel(x0, y));
    };
    parallel_rows(box.height(), 16, [&](int r0, int r1) {
        for (int y = box.y0 + r0; y < box.y0 + r1; ++y) {
            Span& ready = ready_[static_cast<std::size_t>(y)];
            if (ready.x0 == ready.x1) ready = {box.x0, box.x0};
            convert(box.x0, ready.x0, y);
            convert(ready.x1, box.x1, y);
            ready = {std::min(ready.x0, box.x0), std::max(ready.x1, box.x1)};
        }
    });
}

Expected<Mattes> FrameRenderer::composite_mattes(int index) {
    const RegionPlan& region = region_of(plan_, index);
    WEFT_TRY(extent, extent_matte(source_, plan_, store_, index, frame_));
    WEFT_TRY(holdout, holdout_matte(source_, plan_, store_, index, frame_));
    if (const float hardness = edge_hardness(extent); hardness > 0) {
        if (!views_) views_ = make_views(*plate_, *plan_.display_from_plate);
        const Matte softened = soften_hard_edge(views_->display, extent);
        std::transform(
            extent.data(), extent.data() + extent.size_bytes(), softened.data(), extent.data(),
            [&](std::uint8_t as_given, std::uint8_t soft) {
                const float away = static_cast<float>(soft) - as_given;
                return static_cast<std::uint8_t>(std::lround(as_given + hardness * away));
            });
    }
    Matte covers = without_holdout(extent, holdout);
    take_share_of_element(covers, alpha_);
    if (shows_as_followed(region, frame_)) return Mattes{std::move(covers), {}};
    WEFT_TRY(edged, edged_holdout(source_, plan_, store_, index, frame_));
    Matte shown =
        without_holdout(with_edge(std::move(extent), region.matte_edge.at(frame_)), edged);
    take_share_of_element(shown, alpha_);
    return Mattes{std::move(shown), std::move(covers)};
}

void FrameRenderer::put_grain(int index, const RegionScene& scene, const Recti& box, ViewU8x1 matte,
                              ImageF3& texture) const {
    const RegionPlan& region = region_of(plan_, index);
    if (!(region.grain > 0) || !scene.grain.present()) return;
    const auto frame = static_cast<std::uint64_t>(static_cast<std::int64_t>(frame_));
    ImageF3 display = transformed(texture, *plan_.display_from_working);
    add_grain(display, matte, {box.x0, box.y0}, scene.grain, region.grain,
              mix64(mix64(mix64(plan_.seed) ^ region.random_key) ^ frame));
    texture = transformed(display, *region.working_from_display);
}

Status FrameRenderer::lay_ink(int index, const Recti& box, const Matte& matte, ImageF3& texture,
                              ImageF3& old_surface) {
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
    lay_lines(old_surface, working_.view().crop(box), ink.view().crop(box));
    return {};
}

Status FrameRenderer::add_on_cpu(int index, const RegionSurface& surface, const Recti& box,
                                 const RegionScene& scene, const Matte& matte, const Mattes& mattes,
                                 const FrameLight& light) {
    const Matte& inside = mattes.shown;
    WEFT_TRY(texture, surface.texture(box, inside));
    apply_grade(texture, inside, grade_on(region_of(plan_, index), scene));
    // Before the light, which has the plate's blur already.
    WEFT_CHECK_OK(match_focus(light, inside, texture));
    const ImageF3 unlit = layers_ ? texture : ImageF3();
    WEFT_TRY(gloss, light.apply(inside, texture));
    if (layers_) {
        LayerShare share{box, inside, unlit, texture, gloss};
        if (light.shading()) share.light = &*light.shading();
        WEFT_CHECK_OK(note_share(index, surface, scene, share));
        if (plan_.form_layers) {
            WEFT_TRY(form, region_form_on(scene, store_, index, frame_, inside, box));
            add_form(*layers_, box, inside, form);
        }
    }
    put_grain(index, scene, box, inside, texture);
    const ImageView<float, 3> area = canvas_.view().crop(box);
    ImageF3 old_surface = unmix_surface(area, mattes.old(), inside);
    blend_layer(texture, old_surface, inside, region_of(plan_, index).blend_mode,
                region_of(plan_, index).opacity);
    // The ink already has the plate's grain.
    WEFT_CHECK_OK(lay_ink(index, box, matte, texture, old_surface));
    if (layers_) add_patch(*layers_, box, inside, texture);
    composite_over(area, area, old_surface, inside, texture);
    return {};
}

Status FrameRenderer::note_share(int index, const RegionSurface& surface, const RegionScene& scene,
                                 LayerShare share) {
    share.plane = scene.plane.size();
    share.wrap = scene.plane.wrap();
    share.plane_seams = scene.plane_seams;
    share.id = static_cast<float>(region_of(plan_, index).random_key);
    if (scene.plane.empty()) {
        add_share(*layers_, share);
        return {};
    }
    WEFT_TRY(lookup, surface.lookup(share.box));
    share.coords = &lookup.coords;
    add_share(*layers_, share);
    return {};
}

Status FrameRenderer::add_on_device(int index, const RegionSurface& surface, const Recti& box,
                                    const RegionScene& scene, const Mattes& mattes,
                                    const FrameLight& light) {
    const Matte& inside = mattes.shown;
    WEFT_TRY(lookup, surface.lookup(box));
    const ImageView<float, 3> area = canvas_.view().crop(box);
    // Over another region, the old surface is what that region shows.
    if (!device_box_.intersected(box).empty()) {
        WEFT_CHECK_OK(of_device(device_->read(box, area)));
    }
    const ImageF3 old_surface = unmix_surface(area, mattes.old(), inside);
    LayerRequest layer;
    layer.texture.plane = lookup.shown();
    layer.texture.coords = lookup.coords.uv;
    layer.texture.matte = inside;
    layer.texture.quality = surface.quality();
    layer.origin = {box.x0, box.y0};
    layer.old_surface = old_surface;
    layer.multiply = grade_on(region_of(plan_, index), scene).multiply;
    if (const auto& shading = light.shading()) {
        layer.gain = GainRequest{
            shading->value,           shading->downscale,         scene.reference_shading,
            light.options().strength, light.options().least_gain, light.options().most_gain};
    }
    device_box_ = device_box_.united(box);
    return of_device(device_->add(layer));
}

Status FrameRenderer::add(int index, const RegionScene& scene) {
    // Of all regions, also of those that are not in this frame: the roll-off is the shot's.
    peak_ = std::max(peak_, fullest_white(region_of(plan_, index), scene));
    WEFT_TRY(mattes, composite_mattes(index));
    const Matte& matte = mattes.shown;
    if (matte_bounds(matte).empty()) return {};
    // The old surface is read off its own matte, wherever the new one goes.
    const Recti box = matte_bounds(matte).united(matte_bounds(mattes.old()));
    const Mattes inside = mattes.crop(box);
    make_ready(needs_whole_plate(region_of(plan_, index)) ? rect_of(plate_->size()) : box);
    rendered_ = rendered_.united(box);
    lit_ = lit_ || region_of(plan_, index).lights() || region_of(plan_, index).grades();
    WEFT_TRY(light, FrameLight::find({source_, plan_, store_, index, frame_, working_, scene,
                                      mattes.old(), box}));
    if (light.all_white()) {
        burnt_out_ = true;
        return {};
    }
    device_failed_ = device_ && light.white() > 0;  // which no device adds
    if (device_failed_)
        return fail(ErrorCode::kNoBackend, "White over a frame is added on the CPU.");
    RegionSurface surface(plan_, index, scene, store_, backend_, frame_, plate_->size());
    TextureCoords exact;
    if (region_of(plan_, index).has_uv) {
        WEFT_TRY(uv, source_.uv(index, frame_));
        exact = coords_from_uv(uv, box, inside.old(), inside.shown, scene.plane.size(),
                               region_of(plan_, index).placement_at(frame_).scale);
        surface.use_coords(exact);
    }
    if (device_) {
        WEFT_CHECK_OK(add_on_device(index, surface, box, scene, inside, light));
    } else {
        WEFT_CHECK_OK(add_on_cpu(index, surface, box, scene, matte, inside, light));
    }
    for (int y = 0; y < box.height(); ++y) {
        std::uint8_t* touched = touched_.pixel(box.x0, box.y0 + y);
        std::transform(inside.shown.row(y), inside.shown.row(y) + box.width(), touched, touched,
                       [](std::uint8_t a, std::uint8_t b) { return std::max(a, b); });
    }
    return {};
}

Expected<RenderedFrame> FrameRenderer::finish() {
    RenderedFrame out;
    if (layers_) {
        finish_layers(*layers_, working_, canvas_);
        put_alpha_back(layers_->patch, touched_, alpha_);
        put_alpha_back(layers_->edge, touched_, alpha_);
        note_finish(*layers_);
        out.layers = std::move(layers_);
    }
    const bool rolls_off = lit_ && plan_.display_referred;
    const auto knee = rolls_off ? std::optional(roll_off_knee(peak_)) : std::nullopt;
    if (device_) {
        WEFT_TRY(above_one, of_device(device_->finish(knee, canvas_)));
        out.above_one = above_one;
    } else if (knee) {
        out.above_one =
            roll_off(canvas_.view().crop(rendered_), touched_.view().crop(rendered_), *knee);
    }
    out.pixels = plate_in(*plate_, alpha_, *plan_.out_from_plate);
    if (!rendered_.empty()) plan_.out_from_working->apply(canvas_.view().crop(rendered_));
    put_alpha_back(canvas_, touched_, alpha_);
    for (int y = rendered_.y0; y < rendered_.y1; ++y) {
        for (int x = rendered_.x0; x < rendered_.x1; ++x) {
            if (touched_.at(x, y) == 0) continue;
            const float* p = plate_->pixel(x, y);
            if (!std::isfinite(p[0] + p[1] + p[2])) ++out.filled;
            std::copy_n(canvas_.pixel(x, y), 3, out.pixels.pixel(x, y));
        }
    }
    out.touched = std::move(touched_);
    out.burnt_out = burnt_out_;
    return out;
}

}  // namespace

Expected<RenderedFrame> render_frame(const ShotSource& source, const ShotPlan& plan,
                                     const std::vector<RegionScene>& scenes,
                                     const AnalysisStore& analysis, const Backend& backend,
                                     int frame) {
    WEFT_TRY(plate, source.plate(frame));
    WEFT_TRY(alpha, source.alpha(frame));
    const ZonedAnalysis store(source, plan, analysis);
    const auto on = [&](Place place, bool& again) -> Expected<RenderedFrame> {
        FrameRenderer renderer(source, plan, store, backend, frame, plate, alpha, place);
        const auto draw = [&]() -> Expected<RenderedFrame> {
            for (std::size_t k = 0; k < scenes.size(); ++k) {
                WEFT_CHECK_OK(renderer.add(static_cast<int>(k), scenes[k]));
            }
            return renderer.finish();
        };
        auto rendered = draw();
        again = renderer.device_failed();
        return rendered;
    };
    bool fits = !plan.layers, again = false;
    for (std::size_t k = 0; k < scenes.size(); ++k) {
        const RegionSurface surface(plan, static_cast<int>(k), scenes[k], store, backend, frame,
                                    plate->size());
        fits = fits && fits_device(plan.regions[k], scenes[k]) && surface.is_one_lookup();
    }
    // A device that fails half-way has reported the reason to its backend; the CPU then renders the
    // frame.
    if (fits) {
        auto rendered = on(Place::kDevice, again);
        if (!again) return rendered;
    }
    return on(Place::kCpu, again);
}

}  // namespace weft
