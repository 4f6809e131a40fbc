#pragma once
// A small shot in memory: a textured wall that pans, and whatever a test puts into it.

#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <memory>
#include <utility>

#include "engine/pipeline/analyse.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/shot_source.h"
#include "tests/motion/pictures.h"

namespace weft {

class MemoryShot : public ShotSource {
  public:
    using Key = std::pair<int, int>;  // region, frame

    explicit MemoryShot(Size size) : size_(size) {}

    std::map<int, std::shared_ptr<const ImageF3>> plates;
    std::map<Key, Matte> mattes, keys, holdouts;
    std::map<Key, FlowField> motions;
    std::shared_ptr<std::atomic<int>> reads = std::make_shared<std::atomic<int>>(0);
    [[nodiscard]] int plates_read() const { return *reads; }

    [[nodiscard]] Size size() const override { return size_; }
    [[nodiscard]] Expected<std::shared_ptr<const ImageF3>> plate(int frame) const override {
        ++*reads;
        const auto found = plates.find(frame);
        if (found == plates.end()) {
            return fail(ErrorCode::kMissingFrames,
                        "The plate has no frame " + std::to_string(frame) + ".");
        }
        return found->second;
    }
    [[nodiscard]] Expected<Matte> matte(int region, int frame) const override {
        return lookup(mattes, {region, frame}, "matte");
    }
    [[nodiscard]] Expected<Matte> matte_key(int region, int frame) const override {
        return lookup(keys, {region, frame}, "matte keyframe");
    }
    [[nodiscard]] Expected<std::optional<Matte>> holdout(int region, int frame) const override {
        const auto found = holdouts.find({region, frame});
        return found == holdouts.end() ? std::nullopt : std::optional<Matte>(found->second);
    }
    [[nodiscard]] Expected<FlowField> motion(int region, int frame) const override {
        return lookup(motions, {region, frame}, "motion");
    }

  private:
    template <class T>
    static Expected<T> lookup(const std::map<Key, T>& map, Key key, const std::string& what) {
        const auto found = map.find(key);
        if (found == map.end()) {
            return fail(ErrorCode::kMissingFrames,
                        "No " + what + " for frame " + std::to_string(key.second) + ".");
        }
        return found->second;
    }

    Size size_;
};

constexpr Size kShotSize{160, 112};
constexpr int kFirst = 1, kLast = 10;
constexpr Recti kRegionBox{20, 16, 140, 96};

/// Where the tests of zones put one.
constexpr Recti kZoneBox{40, 30, 90, 70};

/// Where the wall's point p (as on frame 0) lies on a frame.
inline Vec2 wall_moved(Vec2 p, int frame) {
    const auto t = static_cast<float>(frame);
    return p + Vec2(1.3f * t, -0.6f * t);
}

inline Matte box_matte(const Recti& box) {
    Matte out(kShotSize);
    for (int y = box.y0; y < box.y1; ++y)
        std::fill(out.row(y) + box.x0, out.row(y) + box.x1, 255);
    return out;
}

/// The disc that crosses the wall: centre and radius on a frame.
inline Matte disc_matte(int frame) {
    const Vec2 centre(-10.0f + 18.0f * static_cast<float>(frame), 56);
    return draw(kShotSize, [&](Vec2 p) { return distance(p, centre) < 16 ? 1.0f : 0.0f; });
}

/// The wall on the frames 1 to 10, a matte of kRegionBox on each; with `disc` the disc in front,
/// as the region's holdout. `moving` false: the camera stands.
inline MemoryShot make_wall(bool disc = false, bool moving = true) {
    MemoryShot shot(kShotSize);
    const WaveTexture red(21), green(22), blue(23), paint(24);
    for (int frame = kFirst; frame <= kLast; ++frame) {
        auto plate = std::make_shared<ImageF3>(kShotSize);
        const Matte front = disc ? disc_matte(frame) : Matte(kShotSize);
        for (int y = 0; y < kShotSize.height; ++y) {
            for (int x = 0; x < kShotSize.width; ++x) {
                const Vec2 p = centre_of(x, y), q = moving ? p - (wall_moved(p, frame) - p) : p;
                float* o = plate->pixel(x, y);
                o[0] = static_cast<float>(code_of(red(q))) / 255.0f;
                o[1] = static_cast<float>(code_of(green(q))) / 255.0f;
                o[2] = static_cast<float>(code_of(blue(q))) / 255.0f;
                if (front.at(x, y)) o[0] = o[1] = o[2] = paint(p - Vec2(18 * frame, 0));
            }
        }
        shot.plates[frame] = std::move(plate);
        shot.mattes[{0, frame}] = box_matte(kRegionBox);
        if (disc) shot.holdouts[{0, frame}] = front;
    }
    return shot;
}

inline std::shared_ptr<const ColorTransform> color(const std::string& from, const std::string& to) {
    return *make_color_transform({from}, {to});
}

/// A plane of one colour, sRGB codes in [0, 1].
inline std::shared_ptr<const TexturePicture> flat_texture(Vec3 rgb) {
    auto texture = std::make_shared<TexturePicture>();
    texture->is_plane = true;
    texture->pixels = ImageF3(16, 16);
    for (int k = 0; k < 256; ++k) {
        for (int c = 0; c < 3; ++c)
            texture->pixels.data()[3 * k + c] = rgb[c];
    }
    return texture;
}

/// A sample of 96 × 96 to be grown.
inline std::shared_ptr<const TexturePicture> sample_texture() {
    auto texture = std::make_shared<TexturePicture>();
    texture->pixels = ImageF3(96, 96);
    const WaveTexture wave(31);
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 96; ++x) {
            const float v = static_cast<float>(code_of(wave(centre_of(x, y)))) / 255.0f;
            for (int c = 0; c < 3; ++c)
                texture->pixels.at(x, y, c) = v;
        }
    }
    return texture;
}

/// A region that follows the wall from frame 1 on, without light.
inline RegionPlan make_region(std::shared_ptr<const TexturePicture> texture) {
    RegionPlan region;
    region.random_key = 5;
    region.reference_frames = {kFirst};
    region.texture = std::move(texture);
    region.working_from_texture = color("srgb", "linear");
    region.display_from_texture = color("srgb", "srgb");
    region.working_from_display = color("srgb", "linear");
    region.light_source = LightSource::kNone;
    return region;
}

/// A grey region that takes its light from the plate.
inline RegionPlan plate_lit() {
    RegionPlan region = make_region(flat_texture({0.5f, 0.5f, 0.5f}));
    region.light_source = LightSource::kPlate;
    return region;
}

inline ShotPlan make_plan(RegionPlan region, int first = kFirst, int last = kLast) {
    ShotPlan plan;
    for (int f = first; f <= last; ++f)
        plan.frames.push_back(f);
    plan.working_from_plate = color("srgb", "linear");
    plan.display_from_plate = color("srgb", "srgb");
    plan.out_from_working = color("linear", "srgb");
    plan.out_from_plate = color("srgb", "srgb");
    plan.regions.push_back(std::move(region));
    return plan;
}

inline void expect_ok(const Status& status) {
    EXPECT_TRUE(status) << (status ? "" : status.error().text());
}

inline void analyse(const ShotSource& shot, const ShotPlan& plan, AnalysisStore& store) {
    expect_ok(analyse_shot(shot, plan, store, {}, {}));
}

inline LatticeField stored_coords(const AnalysisStore& store, int frame, int region = 0) {
    const auto bytes = store.get({region, frame, AnalysisKind::kCoords});
    return bytes ? *decode_lattice(*bytes) : LatticeField();
}

}  // namespace weft
