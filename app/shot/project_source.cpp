#include "app/shot/project_source.h"

#include <algorithm>
#include <filesystem>

#include "app/shot/drawn_mattes.h"
#include "app/shot/form_files.h"
#include "app/shot/matte_movies.h"
#include "engine/color/color_space.h"
#include "engine/core/text.h"
#include "engine/media/form_passes.h"
#include "engine/media/image_files.h"
#include "engine/media/light_passes.h"
#include "engine/media/sequence_pattern.h"

namespace weft {
namespace {

class ProjectSource final : public ShotSource {
  public:
    ProjectSource(std::shared_ptr<const CachedReader> plate, std::vector<Leaf<Region>> regions,
                  std::shared_ptr<CutWatch> cuts, std::shared_ptr<InputWatch> inputs,
                  PaintedMattes painted)
        : plate_(std::move(plate)),
          regions_(std::move(regions)),
          cuts_(std::move(cuts)),
          inputs_(std::move(inputs)),
          painted_(std::move(painted)),
          drawn_(plate_->size(), plate_->frames().empty() ? 0 : plate_->frames().front(),
                 PixelAspect(plate_->pixel_aspect())) {}

    [[nodiscard]] Size size() const override { return plate_->size(); }

    [[nodiscard]] Expected<std::shared_ptr<const ImageF3>> plate(int frame) const override {
        if (inputs_) inputs_->before_read(plate_->path_of(frame));
        WEFT_TRY(decoded, plate_->read_shared(frame));
        if (cuts_) cuts_->look_at(frame, decoded->rgb, plate_->display_encoded());
        return std::shared_ptr<const ImageF3>(decoded, &decoded->rgb);
    }

    [[nodiscard]] Expected<PlateAlpha> alpha(int frame) const override {
        WEFT_TRY(decoded, plate_->read_shared(frame));
        if (!has_coverage(decoded->alpha)) return PlateAlpha();
        return PlateAlpha{std::shared_ptr<const ImageF1>(decoded, &decoded->alpha),
                          decoded->alpha_kind};
    }

    [[nodiscard]] Expected<Matte> matte(int region, int frame) const override {
        return read(*at(region).matte, frame);
    }

    [[nodiscard]] Expected<Matte> matte_key(int region, int frame) const override {
        return read_keyframe(*at(region).matte, frame);
    }

    [[nodiscard]] Expected<Matte> holdout_key(int region, int painted, int frame) const override {
        for (const MatteSource& holdout : *at(region).holdouts)
            if (!holdout.by_frame() && painted-- == 0) return read_keyframe(holdout, frame);
        return ShotSource::holdout_key(region, painted, frame);
    }

    [[nodiscard]] Expected<ConfirmedPart> confirmed_part(int region, int layer,
                                                         int frame) const override {
        const MatteSource& source = painted_layer(region, layer);
        const ConfirmedEdge& edge = source.confirmed.at(frame);
        WEFT_TRY(matte, read_painted(source.select, edge.path));
        WEFT_TRY(area, read_painted({}, edge.area));
        return ConfirmedPart{std::move(matte), std::move(area)};
    }

    [[nodiscard]] Expected<std::optional<Matte>> holdout(int region, int frame) const override {
        std::optional<Matte> all;
        for (const MatteSource& holdout : *at(region).holdouts) {
            if (!holdout.by_frame()) continue;
            WEFT_TRY(one, read(holdout, frame));
            if (!all) {
                all = std::move(one);
                continue;
            }
            std::transform(one.data(), one.data() + one.size_bytes(), all->data(), all->data(),
                           [](std::uint8_t a, std::uint8_t b) { return std::max(a, b); });
        }
        return all;
    }

    [[nodiscard]] Expected<Matte> given_holdout(int region, int given, int frame) const override {
        for (const MatteSource& holdout : *at(region).holdouts)
            if (!holdout.files.empty() && given-- == 0) return read(holdout, frame);
        return ShotSource::given_holdout(region, given, frame);
    }

    [[nodiscard]] Expected<Matte> zone(int region, int zone, int frame) const override {
        return read(at(region).zones->at(static_cast<std::size_t>(zone)).matte, frame);
    }

    [[nodiscard]] Expected<Matte> zone_key(int region, int zone, int frame) const override {
        return read_keyframe(at(region).zones->at(static_cast<std::size_t>(zone)).matte, frame);
    }

    [[nodiscard]] Expected<Matte> lines(int region, int frame) const override {
        const LineParams& lines = at(region).lines;
        if (lines.files.empty()) return Matte();
        MatteSelect select;
        select.invert = lines.invert;
        return read_files(lines.files, select, frame);
    }

    [[nodiscard]] Expected<ImageF1> depth(int region, int frame) const override {
        const FinishParams& finish = at(region).finish;
        const std::string& files = finish.depth;
        if (files.empty()) return ImageF1();
        if (lower_case(std::filesystem::path(files).extension().string()) == ".exr") {
            // The picture comes first in a renderer's file; the depth has a channel of its own.
            WEFT_TRY(pattern, SequencePattern::parse(files));
            WEFT_TRY(near,
                     read_depth(watched(path_on(pattern, frame)), finish.depth_layer, size()));
            std::transform(near.data(), near.data() + near.size_bytes() / sizeof(float),
                           near.data(), [](float v) { return v > 0 ? 1.0f / v : 0.0f; });
            return near;
        }
        const std::string path = pass_on(files, frame);
        WEFT_TRY(picture, read_image(path));
        WEFT_CHECK_OK(check_size(path, picture));
        // A float file holds distances; an integer file holds a depth map made for viewing.
        const bool coded = picture.depth == PixelDepth::kU8 || picture.depth == PixelDepth::kU16;
        ImageF1 out(picture.rgb.size());
        for (int y = 0; y < out.height(); ++y) {
            for (int x = 0; x < out.width(); ++x) {
                const float v = picture.rgb.pixel(x, y)[0];
                out.row(y)[x] = coded ? v : v > 0 ? 1.0f / v : 0.0f;
            }
        }
        return out;
    }

    [[nodiscard]] Expected<FlowField> motion(int region, int frame) const override {
        const MotionSource& motion = at(region).motion;
        WEFT_TRY(pattern, SequencePattern::parse(motion.files));
        return read_motion(watched(pattern.path_for(frame)),
                           {motion.convention, motion.direction, motion.layer}, size());
    }

    [[nodiscard]] Expected<ImageF2> uv(int region, int frame) const override {
        const Placement& placement = at(region).placement;
        WEFT_TRY(pattern, SequencePattern::parse(placement.uv));
        return read_uv(watched(path_on(pattern, frame)), placement.uv_layer, size());
    }

    [[nodiscard]] Expected<ImageF3> positions(int region, int frame) const override {
        WEFT_TRY(pattern, SequencePattern::parse(form_files(at(region)).pattern));
        return read_form_places(at(region), watched(path_on(pattern, frame)), pass_plate());
    }

    [[nodiscard]] Expected<NormalPass> normals(int region, int frame) const override {
        WEFT_TRY(pattern, SequencePattern::parse(form_files(at(region)).pattern));
        return read_form_normals(at(region), watched(path_on(pattern, frame)), pass_plate());
    }

    [[nodiscard]] Expected<ImageF3> light_pass(int region, int frame) const override {
        const LightParams& light = at(region).light;
        const bool albedo = light.lighting.empty();
        const std::string path = pass_on(albedo ? light.albedo : light.lighting, frame);
        WEFT_TRY(picture, read_light_pass(path, albedo ? LightPass::kAlbedo : LightPass::kLighting,
                                          light.pass_layer));
        WEFT_CHECK_OK(check_size(path, picture));
        if (picture.alpha_kind == AlphaKind::kAssociated) {
            // The passes of a renderer are associated by the alpha of its picture.
            WEFT_TRY(of_plate, alpha(frame));
            if (!picture.alpha.empty())
                unassociate(picture.rgb, picture.alpha);
            else if (of_plate.associated())
                unassociate(picture.rgb, *of_plate.coverage);
        }
        WEFT_TRY(to_linear, make_color_transform({picture.color.space}, {"linear"}));
        to_linear->apply(picture.rgb);
        return std::move(picture.rgb);
    }

  private:
    [[nodiscard]] const Region& at(int region) const {
        return *regions_[static_cast<std::size_t>(region)];
    }
    [[nodiscard]] PassPlate pass_plate() const {
        return {size(), PixelAspect(plate_->pixel_aspect())};
    }
    // The file of a pass: one per frame, or one for all.
    [[nodiscard]] std::string pass_on(const std::string& files, int frame) const {
        const auto pattern = SequencePattern::parse(files);
        return watched(pattern && !pattern->is_single() ? path_on(*pattern, frame) : files);
    }
    [[nodiscard]] Status check_size(const std::string& path, const PlateFrame& picture) const {
        if (picture.rgb.size() == size()) return {};
        return fail(ErrorCode::kUnreadable,
                    path + " is " + std::to_string(picture.rgb.width()) + " x " +
                        std::to_string(picture.rgb.height()) + ", but the plate is not.",
                    "Give a pass of the plate's size.");
    }
    [[nodiscard]] Expected<Matte> read(const MatteSource& source, int frame) const {
        if (!source.shape.empty()) {
            if (source.shape.follow != ShapeFollow::kNone) (void)watched(source.shape.track);
            return drawn_.matte(source.shape, source.select.invert, frame);
        }
        return read_files(source.files, source.select, frame);
    }
    [[nodiscard]] Expected<Matte> read_files(const std::string& text, const MatteSelect& select,
                                             int frame) const {
        WEFT_TRY(files, matte_files(text, *plate_));
        const int given = matte_frame(files, frame, *plate_);
        static_cast<void>(watched(files.path_for(given)));
        return files.read(given, select, size());
    }
    [[nodiscard]] Expected<Matte> read_keyframe(const MatteSource& source, int frame) const {
        return read_painted(source.select, source.keyframes.at(frame).path);
    }
    [[nodiscard]] Expected<Matte> read_painted(const MatteSelect& select,
                                               const std::string& path) const {
        if (painted_.contains(path)) return read_matte(path, select, size(), painted_);
        return read_matte(watched(path), select, size());
    }
    // A layer of the analysis: holdouts from files have no number there.
    [[nodiscard]] const MatteSource& painted_layer(int region, int layer) const {
        const Region& of = at(region);
        if (is_zone_layer(layer))
            return of.zones->at(static_cast<std::size_t>(zone_of_layer(layer))).matte;
        for (const MatteSource& holdout : *of.holdouts)
            if (layer > 0 && !holdout.by_frame() && --layer == 0) return holdout;
        return *of.matte;
    }
    // Returns `path` after telling `inputs_` that it will be read.
    [[nodiscard]] std::string watched(std::string path) const {
        if (inputs_) inputs_->before_read(path);
        return path;
    }
    // Where the plate repeats a frame in place of a missing one, a missing file is repeated too.
    [[nodiscard]] std::string path_on(const SequencePattern& pattern, int frame) const {
        const int shown = plate_->shown_frame(frame);
        std::error_code ignored;
        const std::string path = pattern.path_for(frame);
        if (shown == frame || std::filesystem::exists(path, ignored)) return path;
        return pattern.path_for(shown);
    }

    std::shared_ptr<const CachedReader> plate_;
    std::vector<Leaf<Region>> regions_;
    std::shared_ptr<CutWatch> cuts_;
    std::shared_ptr<InputWatch> inputs_;
    PaintedMattes painted_;
    DrawnMattes drawn_;
};

}  // namespace

std::shared_ptr<const ShotSource> make_project_source(std::shared_ptr<const CachedReader> plate,
                                                      std::vector<Leaf<Region>> regions,
                                                      std::shared_ptr<CutWatch> cuts,
                                                      std::shared_ptr<InputWatch> inputs,
                                                      PaintedMattes painted) {
    return std::make_shared<ProjectSource>(std::move(plate), std::move(regions), std::move(cuts),
                                           std::move(inputs), std::move(painted));
}

}  // namespace weft
