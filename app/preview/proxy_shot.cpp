#include "app/preview/proxy_shot.h"

#include <algorithm>
#include <utility>

#include "engine/core/block_means.h"

namespace weft {
namespace {

KeyedNumbers divided(KeyedNumbers keys, double factor) {
    for (auto& [frame, values, after] : keys.keys)
        for (double& v : values)
            v /= factor;
    return keys;
}

// Places of a lamp are in pixels; its brightness and angle are not.
Lamp divided(Lamp lamp, double factor) {
    const std::size_t places = info_of(lamp.kind).places;
    for (auto& [frame, values, after] : lamp.numbers.keys)
        for (std::size_t k = 0; k < std::min(places, values.size()); ++k)
            values[k] /= factor;
    return lamp;
}

FormGuide divided(FormGuide guide, double factor) {
    const std::size_t pixels = std::min(info_of(guide.kind).pixels, guide.numbers.size());
    for (std::size_t k = 0; k < pixels; ++k)
        guide.numbers[k] /= factor;
    return guide;
}

RegionPlan divided(const RegionPlan& full, int factor) {
    const auto by = static_cast<float>(factor);
    RegionPlan plan = full;
    // The source below has a matte for every frame.
    plan.matte_keys.clear();
    plan.matte_confirmed.clear();
    plan.matte_edge = divided(plan.matte_edge, factor);
    for (MatteEdgePlan& edge : plan.given_holdout_edges)
        edge = divided(edge, factor);
    for (PaintedMatte& holdout : plan.painted_holdouts)
        holdout.edge = divided(holdout.edge, factor);
    for (ZonePlan& zone : plan.zones)
        zone.edge = divided(zone.edge, factor);
    plan.placement.scale /= by;
    plan.placement.offset_px /= by;
    if (plan.placement.corners)
        for (Vec2& corner : *plan.placement.corners)
            corner /= by;
    plan.scale_keys = divided(plan.scale_keys, factor);
    plan.offset_keys = divided(plan.offset_keys, factor);
    if (plan.warp) {
        plan.warp = on_smaller_frame(std::move(*plan.warp), factor);
        const int first = plan.warp->moves() ? plan.warp->keys.front().first : 0;
        plan.placement.warp = std::make_shared<const PlaneWarp>(*plan.warp, first);
    }
    for (Lamp& lamp : plan.lamps)
        lamp = divided(std::move(lamp), factor);
    for (FormGuide& guide : plan.form_guides)
        guide = divided(std::move(guide), factor);
    plan.grain = plan.focus = 0;
    plan.shutter_deg = 0.0f;
    plan.shutter_evidence.clear();
    plan.line_width_px /= by;
    return plan;
}

class ProxySource final : public ShotSource {
  public:
    ProxySource(const Shot& shot, const AnalysisStore& store, ProxyPlates& plates, int factor)
        : shot_(shot), store_(store), plates_(plates), factor_(factor) {}

    [[nodiscard]] Size size() const override { return blocks_of(shot_.source->size(), factor_); }
    [[nodiscard]] Expected<std::shared_ptr<const ImageF3>> plate(int frame) const override {
        return plates_.plate(*shot_.source, frame, factor_);
    }
    [[nodiscard]] Expected<PlateAlpha> alpha(int frame) const override {
        WEFT_TRY(full, shot_.source->alpha(frame));
        if (full.coverage)
            full.coverage = std::make_shared<const ImageF1>(block_means(*full.coverage, factor_));
        return full;
    }
    [[nodiscard]] Expected<Matte> matte(int region, int frame) const override {
        if (!shot_.plan.regions[static_cast<std::size_t>(region)].propagated()) {
            WEFT_TRY(matte, shot_.source->matte(region, frame));
            return shrunk(matte, factor_);
        }
        WEFT_TRY(bytes, store_.get({region, frame, AnalysisKind::kMatte}));
        WEFT_TRY(stored, decode_matte(bytes));
        return shrunk(stored.matte, factor_);
    }
    [[nodiscard]] Expected<Matte> matte_key(int region, int frame) const override {
        return matte(region, frame);
    }
    [[nodiscard]] Expected<std::optional<Matte>> holdout(int region, int frame) const override {
        WEFT_TRY(full, shot_.source->holdout(region, frame));
        if (!full) return full;
        return std::optional<Matte>(shrunk(*full, factor_));
    }
    [[nodiscard]] Expected<Matte> given_holdout(int region, int given, int frame) const override {
        WEFT_TRY(full, shot_.source->given_holdout(region, given, frame));
        return shrunk(full, factor_);
    }
    [[nodiscard]] Expected<Matte> zone(int region, int zone, int frame) const override {
        WEFT_TRY(full, shot_.source->zone(region, zone, frame));
        return shrunk(full, factor_);
    }
    [[nodiscard]] Expected<Matte> lines(int region, int frame) const override {
        WEFT_TRY(full, shot_.source->lines(region, frame));
        return full.empty() ? std::move(full) : shrunk(full, factor_);
    }
    [[nodiscard]] Expected<FlowField> motion(int region, int frame) const override {
        return shot_.source->motion(region, frame);
    }
    // Coordinates are not averaged: across a border of the pass that would be a third place.
    [[nodiscard]] Expected<ImageF2> uv(int region, int frame) const override {
        WEFT_TRY(full, shot_.source->uv(region, frame));
        return picked(full);
    }
    [[nodiscard]] Expected<ImageF3> positions(int region, int frame) const override {
        WEFT_TRY(full, shot_.source->positions(region, frame));
        return picked(full);
    }
    [[nodiscard]] Expected<NormalPass> normals(int region, int frame) const override {
        WEFT_TRY(full, shot_.source->normals(region, frame));
        const auto by = static_cast<float>(factor_);
        return NormalPass{picked(full.normals),
                          {full.camera.focal_px / factor_, full.camera.centre / by},
                          full.camera_from_world};
    }
    [[nodiscard]] Expected<ImageF3> light_pass(int region, int frame) const override {
        WEFT_TRY(full, shot_.source->light_pass(region, frame));
        return shrunk(full, factor_);
    }

  private:
    // The middle pixel of each block.
    template <int kChannels>
    [[nodiscard]] Image<float, kChannels> picked(const Image<float, kChannels>& full) const {
        Image<float, kChannels> out(size());
        for (int y = 0; y < out.height(); ++y) {
            for (int x = 0; x < out.width(); ++x) {
                const float* from =
                    full.pixel(std::min(full.width() - 1, x * factor_ + factor_ / 2),
                               std::min(full.height() - 1, y * factor_ + factor_ / 2));
                std::copy_n(from, kChannels, out.pixel(x, y));
            }
        }
        return out;
    }

    const Shot& shot_;
    const AnalysisStore& store_;
    ProxyPlates& plates_;
    int factor_;
};

class ProxyStore final : public AnalysisStore {
  public:
    ProxyStore(const AnalysisStore& store, int factor) : store_(store), factor_(factor) {}

    [[nodiscard]] bool has(const AnalysisKey& key) const override { return store_.has(key); }
    [[nodiscard]] Status put(const AnalysisKey&, const Bytes&) override {
        return fail(ErrorCode::kRenderFailed, "A proxy keeps no analysis.");
    }
    [[nodiscard]] Expected<Bytes> get(const AnalysisKey& key) const override {
        WEFT_TRY(bytes, store_.get(key));
        switch (key.kind) {
            case AnalysisKind::kCoords:
            case AnalysisKind::kCoordsOneWay:
            case AnalysisKind::kTrackBefore:
            case AnalysisKind::kTrackAfter: {
                WEFT_TRY(field, decode_lattice(bytes));
                return encode(shrunk(field, factor_));
            }
            case AnalysisKind::kForm: {
                WEFT_TRY(form, decode_form(bytes));
                FormMap small{form.origin / static_cast<float>(factor_),
                              shrunk(form.displacement, factor_), form.finding};
                small.aspect = form.aspect;
                return encode(small);
            }
            case AnalysisKind::kStillSurface: {
                WEFT_TRY(still, decode_still_surface(bytes));
                still.pixel_px /= static_cast<float>(factor_);
                return encode(still);
            }
            case AnalysisKind::kMatte: {
                WEFT_TRY(stored, decode_matte(bytes));
                return encode(StoredMatte{shrunk(stored.matte, factor_), stored.confidence});
            }
            case AnalysisKind::kShading: {
                WEFT_TRY(shading, decode_shading(bytes));
                return encode(shrunk(shading, factor_));
            }
            default:
                return bytes;
        }
    }

  private:
    const AnalysisStore& store_;
    int factor_;
};

}  // namespace

int proxy_factor(Size plate, std::int64_t pixels) {
    int factor = 1;
    while (factor < 8 && std::int64_t{plate.width} * plate.height > pixels * factor * factor)
        factor *= 2;
    return factor;
}

ImageF3 shrunk(const ImageF3& picture, int factor) {
    return block_means(picture, factor);
}

Matte shrunk(const Matte& matte, int factor) {
    return block_means(matte, factor);
}

LatticeField shrunk(const LatticeField& field, int factor) {
    const LatticeField from =
        field.spacing() % factor == 0 ? field : field.resampled(field.spacing() * factor);
    LatticeField out(blocks_of(from.full_size(), factor), from.spacing() / factor);
    for (int j = 0; j < out.nodes().height(); ++j)
        for (int i = 0; i < out.nodes().width(); ++i)
            out.set_node(i, j, from.node(i, j) / static_cast<float>(factor));
    return out;
}

Shading shrunk(const Shading& shading, int factor) {
    Shading out;
    out.full = blocks_of(shading.full, factor);
    if (shading.downscale % factor == 0) {
        out.value = shading.value;
        out.inside = shading.inside;
        out.sure = shading.sure;
        out.downscale = shading.downscale / factor;
        return out;
    }
    const int further = factor / shading.downscale;
    out.downscale = 1;
    out.value = block_means(shading.value, further);
    if (!shading.inside.empty()) out.inside = shrunk(shading.inside, further);
    if (!shading.sure.empty()) out.sure = shrunk(shading.sure, further);
    return out;
}

Expected<std::shared_ptr<const ImageF3>> ProxyPlates::plate(const ShotSource& source, int frame,
                                                            int factor) {
    const std::pair key(factor, frame);
    {
        const std::lock_guard lock(mutex_);
        if (const auto found = kept_.find(key); found != kept_.end()) return found->second;
    }
    WEFT_TRY(full, source.plate(frame));
    auto small = std::make_shared<const ImageF3>(shrunk(*full, factor));
    const std::lock_guard lock(mutex_);
    if (kept_.emplace(key, small).second) bytes_ += small->size_bytes();
    while (bytes_ > budget_bytes_ && kept_.size() > 1) {
        // The one furthest from where the artist is.
        const auto distance = [&](const auto& kept) { return std::abs(kept.first.second - frame); };
        const auto far = std::max_element(
            kept_.begin(), kept_.end(),
            [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
        bytes_ -= far->second->size_bytes();
        kept_.erase(far);
    }
    return small;
}

bool ProxyShot::possible(const Shot& shot) {
    return std::all_of(
        shot.plan.regions.begin(), shot.plan.regions.end(), [](const RegionPlan& region) {
            return region.temporal == TemporalMode::kLocked || region.texture->is_plane;
        });
}

ProxyShot::ProxyShot(const Shot& shot, const AnalysisStore& store, ProxyPlates& plates, int factor)
    : plan_(shot.plan),
      source_(std::make_unique<ProxySource>(shot, store, plates, factor)),
      store_(std::make_unique<ProxyStore>(store, factor)) {
    for (RegionPlan& region : plan_.regions)
        region = divided(region, factor);
}

ProxyShot::~ProxyShot() = default;

std::vector<RegionScene> proxy_scenes(const std::vector<RegionScene>& scenes, int factor) {
    std::vector<RegionScene> out;
    for (const RegionScene& scene : scenes) {
        RegionScene& small = out.emplace_back(scene);
        small.mapping = scene.mapping.on_smaller_frame(static_cast<float>(factor));
        small.smaller = scene.smaller * static_cast<float>(factor);
        if (small.picture_light) small.picture_light = shrunk(*small.picture_light, factor);
        small.seams.clear();
    }
    return out;
}

}  // namespace weft
