#include "engine/pipeline/render_frame.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "engine/compute/backend_registry.h"
#include "engine/core/parallel.h"
#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

// An analysed shot, ready to render.
class Renderer {
  public:
    Renderer(const MemoryShot& shot, ShotPlan plan) : shot_(shot), plan_(std::move(plan)) {
        const Status status = analyse_shot(shot_, plan_, store_, {}, {});
        EXPECT_TRUE(status) << (status ? "" : status.error().text());
        for (std::size_t k = 0; k < plan_.regions.size(); ++k) {
            auto scene = make_scene(shot_, plan_, store_, static_cast<int>(k), {}, {});
            EXPECT_TRUE(scene) << (scene ? "" : scene.error().text());
            if (scene) scenes_.push_back(std::move(*scene));
        }
    }

    [[nodiscard]] Expected<RenderedFrame> try_frame(int frame) const {
        return render_frame(shot_, plan_, scenes_, store_, *backend_, frame);
    }
    [[nodiscard]] RenderedFrame frame(int frame) const {
        auto rendered = try_frame(frame);
        EXPECT_TRUE(rendered) << (rendered ? "" : rendered.error().text());
        return rendered ? std::move(*rendered) : RenderedFrame{};
    }

  private:
    const MemoryShot& shot_;
    ShotPlan plan_;
    MemoryAnalysisStore store_;
    std::vector<RegionScene> scenes_;
    std::shared_ptr<const Backend> backend_ = make_cpu_backend();
};

bool same_bits(const float* a, const float* b) {
    return std::memcmp(a, b, 3 * sizeof(float)) == 0;
}

// 8-bit levels between two pictures, mean over the inside of the region.
double difference(const ImageF3& a, const ImageF3& b) {
    const Recti box = kRegionBox.grown(-4);
    double sum = 0;
    for (int y = box.y0; y < box.y1; ++y) {
        for (int x = box.x0; x < box.x1; ++x)
            sum += std::abs(a.at(x, y, 1) - b.at(x, y, 1));
    }
    return 255 * sum / (static_cast<double>(box.width()) * box.height());
}

TEST(RenderFrame, OutsideTheMattesEveryBitIsThePlates) {
    MemoryShot shot = make_wall(true);
    auto plate = std::make_shared<ImageF3>(*shot.plates[3]);
    plate->at(2, 3, 0) = std::numeric_limits<float>::quiet_NaN();
    plate->at(4, 100, 1) = std::numeric_limits<float>::infinity();
    plate->at(150, 5, 2) = -0.0f;
    plate->at(151, 5, 2) = 37.5f;
    plate->at(152, 5, 2) = -1e-40f;  // denormal
    shot.plates[3] = plate;
    RegionPlan region = make_region(flat_texture({0.9f, 0.9f, 0.9f}));
    region.has_holdout = true;
    region.light_source = LightSource::kPlate;
    const RenderedFrame out = Renderer(shot, make_plan(region)).frame(3);
    int kept = 0, changed = 0, behind = 0;
    const Matte disc = disc_matte(3);
    for (int y = 0; y < kShotSize.height; ++y) {
        for (int x = 0; x < kShotSize.width; ++x) {
            const bool same = same_bits(out.pixels.pixel(x, y), plate->pixel(x, y));
            if (out.touched.at(x, y) == 0) {
                ASSERT_TRUE(same) << x << ", " << y;
                ++kept;
            }
            changed += !same;
            if (disc.at(x, y)) {
                EXPECT_EQ(out.touched.at(x, y), 0) << x << ", " << y;
                ++behind;
            }
        }
    }
    EXPECT_GT(kept, 6000);
    EXPECT_GT(changed, 8000);
    EXPECT_GT(behind, 500);
    EXPECT_EQ(out.filled, 0);
}

TEST(RenderFrame, WhereTheMatteIsFullOnlyTheTextureShows) {
    const MemoryShot shot = make_wall();
    const Vec3 colour(0.25f, 0.5f, 0.75f);
    const RenderedFrame out = Renderer(shot, make_plan(make_region(flat_texture(colour)))).frame(4);
    for (int y = kRegionBox.y0 + 6; y < kRegionBox.y1 - 6; ++y) {
        for (int x = kRegionBox.x0 + 6; x < kRegionBox.x1 - 6; ++x) {
            ASSERT_EQ(out.touched.at(x, y), 255);
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(out.pixels.at(x, y, c), colour[c], 1e-4f);
        }
    }
}

TEST(RenderFrame, FillsWhatIsNoNumberInsideTheMatte) {
    MemoryShot shot = make_wall();
    auto plate = std::make_shared<ImageF3>(*shot.plates[2]);
    plate->at(60, 50, 0) = std::numeric_limits<float>::quiet_NaN();
    plate->at(61, 50, 1) = std::numeric_limits<float>::infinity();
    shot.plates[2] = plate;
    const RenderedFrame out =
        Renderer(shot, make_plan(make_region(flat_texture({0.5f, 0.5f, 0.5f})), 1, 3)).frame(2);
    EXPECT_EQ(out.filled, 2);
    EXPECT_NEAR(out.pixels.at(60, 50, 0), 0.5f, 1e-4f);
    EXPECT_NEAR(out.pixels.at(61, 50, 1), 0.5f, 1e-4f);
}

TEST(RenderFrame, LaterRegionsLieOnTop) {
    MemoryShot shot = make_wall();
    for (int frame = kFirst; frame <= kLast; ++frame) {
        shot.mattes[{0, frame}] = box_matte({10, 10, 100, 100});
        shot.mattes[{1, frame}] = box_matte({60, 10, 150, 100});
    }
    const RegionPlan red = make_region(flat_texture({0.8f, 0.1f, 0.1f}));
    const RegionPlan green = make_region(flat_texture({0.1f, 0.8f, 0.1f}));
    const auto at = [&](const RegionPlan& first, const RegionPlan& second, int x) {
        ShotPlan plan = make_plan(first, 1, 2);
        plan.regions.push_back(second);
        const RenderedFrame out = Renderer(shot, plan).frame(2);
        const float* p = out.pixels.pixel(x, 50);
        return p[0] > p[1] ? "red" : "green";
    };
    EXPECT_STREQ(at(red, green, 30), "red");
    EXPECT_STREQ(at(red, green, 80), "green");
    EXPECT_STREQ(at(red, green, 130), "green");
    EXPECT_STREQ(at(green, red, 80), "red");
}

TEST(RenderFrame, KeysMoveThePlacementOverTime) {
    // Left half black, right half white, one texel a pixel.
    auto texture = std::make_shared<TexturePicture>();
    texture->is_plane = true;
    texture->wrap = WrapMode::kClamp;
    texture->pixels = ImageF3(kShotSize);
    for (int y = 0; y < kShotSize.height; ++y) {
        for (int x = kShotSize.width / 2; x < kShotSize.width; ++x)
            std::fill_n(texture->pixels.pixel(x, y), 3, 1.0f);
    }
    const MemoryShot shot = make_wall(false, false);
    RegionPlan region = make_region(texture);
    region.offset_keys.keys = {{2, {0, 0}}, {4, {20, 0}}};
    const Renderer renderer(shot, make_plan(region, 1, 5));
    const int edges[] = {80, 80, 90, 100, 100};
    for (int frame = 1; frame <= 5; ++frame) {
        const RenderedFrame out = renderer.frame(frame);
        const int edge = edges[frame - 1];
        EXPECT_LT(out.pixels.at(edge - 3, 56, 0), 0.05f) << frame;
        EXPECT_GT(out.pixels.at(edge + 3, 56, 0), 0.95f) << frame;
    }
}

TEST(RenderFrame, IsAPureFunction) {
    const MemoryShot shot = make_wall(true);
    RegionPlan region = make_region(sample_texture());
    region.has_holdout = true;
    region.light_source = LightSource::kPlate;
    const Renderer renderer(shot, make_plan(region, 1, 6));
    set_thread_count(1);
    const RenderedFrame fifth = renderer.frame(5), second = renderer.frame(2);
    set_thread_count(3);
    EXPECT_EQ(renderer.frame(2).pixels, second.pixels);
    EXPECT_EQ(renderer.frame(5).pixels, fifth.pixels);
    set_thread_count(0);
    // A part of the shot, worked out on another machine.
    EXPECT_EQ(Renderer(shot, make_plan(region, 5, 5)).frame(5).pixels, fifth.pixels);
}

TEST(RenderFrame, AMissingPlateIsToldWithItsFrame) {
    const MemoryShot shot = make_wall();
    const auto rendered =
        Renderer(shot, make_plan(make_region(flat_texture({0.5f, 0.5f, 0.5f})), 1, 2))
            .try_frame(99);
    ASSERT_FALSE(rendered);
    EXPECT_EQ(rendered.error().code, ErrorCode::kMissingFrames);
    EXPECT_NE(rendered.error().text().find("99"), std::string::npos);
}

TEST(RenderFrame, AFrameThatWasNotAnalysedIsTold) {
    const MemoryShot shot = make_wall();
    const auto rendered =
        Renderer(shot, make_plan(make_region(flat_texture({0.5f, 0.5f, 0.5f})), 1, 2)).try_frame(7);
    ASSERT_FALSE(rendered);
    EXPECT_EQ(rendered.error().code, ErrorCode::kRenderFailed);
    EXPECT_NE(rendered.error().text().find("analysed"), std::string::npos);
}

TEST(RenderFrame, ARegionOutOfSightChangesNothing) {
    MemoryShot shot = make_wall();
    for (auto& [key, matte] : shot.mattes)
        matte = Matte(kShotSize);
    const RenderedFrame out =
        Renderer(shot, make_plan(make_region(flat_texture({0.5f, 0.5f, 0.5f})), 1, 2)).frame(2);
    EXPECT_EQ(out.pixels, *shot.plates[2]);
    EXPECT_EQ(out.touched, Matte(kShotSize));
}

// Mean change from frame to frame under a camera that stands.
double flicker(const MemoryShot& shot, TemporalMode mode, float blend,
               int* frames_alike = nullptr) {
    RegionPlan region = make_region(sample_texture());
    region.temporal = mode;
    region.blend = blend;
    const Renderer renderer(shot, make_plan(region, 1, 4));
    double sum = 0;
    ImageF3 last = renderer.frame(1).pixels;
    for (int frame = 2; frame <= 4; ++frame) {
        ImageF3 picture = renderer.frame(frame).pixels;
        if (frames_alike) *frames_alike += difference(picture, last) < 0.5;
        sum += difference(picture, last) / 3;
        last = std::move(picture);
    }
    return sum;
}

TEST(TemporalModes, FlickerAsTheyAreKnownTo) {
    const MemoryShot shot = make_wall(false, false);
    int alike = 0;
    const double anew = flicker(shot, TemporalMode::kNone, 1, &alike);
    EXPECT_GT(anew, 8);
    EXPECT_EQ(alike, 0);
    const double paper = flicker(shot, TemporalMode::kPaper, 0.2f);
    const double half = flicker(shot, TemporalMode::kPaper, 0.6f);
    EXPECT_LT(paper, 0.6 * anew);
    EXPECT_LT(paper, half);
    EXPECT_LT(flicker(shot, TemporalMode::kLocked, 1), 0.5);
}

TEST(TemporalModes, FurtherReferencesMeanNothingToThePaper) {
    const MemoryShot shot = make_wall();
    RegionPlan region = make_region(sample_texture());
    region.temporal = TemporalMode::kPaper;
    region.reference_frames = {2};
    const RenderedFrame one = Renderer(shot, make_plan(region, 1, 4)).frame(3);
    region.reference_frames = {2, 4};
    EXPECT_EQ(Renderer(shot, make_plan(region, 1, 4)).frame(3).pixels, one.pixels);
}

}  // namespace
}  // namespace weft
