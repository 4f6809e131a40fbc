#include "engine/pipeline/plate_alpha.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/compute/backend_registry.h"
#include "engine/pipeline/render_frame.h"
#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

using ::testing::ElementsAre;

PlateAlpha alpha_of(std::initializer_list<float> values, AlphaKind kind) {
    auto coverage = std::make_shared<ImageF1>(static_cast<int>(values.size()), 1);
    std::copy(values.begin(), values.end(), coverage->data());
    return {coverage, kind};
}

std::vector<int> shares(std::initializer_list<int> matte, const PlateAlpha& alpha) {
    Matte out(static_cast<int>(matte.size()), 1);
    std::copy(matte.begin(), matte.end(), out.data());
    take_share_of_element(out, alpha);
    return {out.data(), out.data() + out.width()};
}

TEST(PlateAlpha, AMatteThatIsTheAlphaTakesAllOfTheElement) {
    const auto kinds = {AlphaKind::kStraight, AlphaKind::kAssociated};
    for (const AlphaKind kind : kinds) {
        EXPECT_THAT(shares({255, 128, 64, 13, 0}, alpha_of({1, 0.5f, 0.25f, 0.05f, 0.5f}, kind)),
                    ElementsAre(255, 255, 255, 255, 0));
        // A pane of half alpha; a quarter of a pixel of which half is covered.
        EXPECT_THAT(shares({255, 64, 51}, alpha_of({0.5f, 0.5f, 1}, kind)),
                    ElementsAre(255, 128, 51));
    }
    EXPECT_THAT(shares({200}, alpha_of({0}, AlphaKind::kStraight)), ElementsAre(200));
    EXPECT_THAT(shares({200}, alpha_of({0}, AlphaKind::kAssociated)), ElementsAre(0));
    EXPECT_THAT(shares({200}, {}), ElementsAre(200));
}

// The wall with a soft left edge and a right half of half alpha, stored either way.
class ElementShot : public MemoryShot {
  public:
    explicit ElementShot(AlphaKind kind) : MemoryShot(make_wall(false)), kind_(kind) {
        auto coverage = std::make_shared<ImageF1>(kShotSize, 1.0f);
        for (int y = 0; y < kShotSize.height; ++y) {
            for (int x = 0; x < kShotSize.width; ++x) {
                const float edge = std::clamp(static_cast<float>(x - 30) / 8.0f, 0.0f, 1.0f);
                coverage->at(x, y) = x > 100 ? 0.5f : edge;
            }
        }
        coverage_ = coverage;
        for (auto& [frame, plate] : plates) {
            auto stored = std::make_shared<ImageF3>(*plate);
            if (kind == AlphaKind::kAssociated) associate(*stored, *coverage_);
            plate = stored;
        }
    }
    [[nodiscard]] Expected<PlateAlpha> alpha(int) const override {
        return PlateAlpha{coverage_, kind_};
    }
    [[nodiscard]] const ImageF1& coverage() const { return *coverage_; }

  private:
    AlphaKind kind_;
    std::shared_ptr<const ImageF1> coverage_;
};

ImageF3 rendered_element(const ElementShot& shot, RegionPlan region) {
    const ShotPlan plan = make_plan(std::move(region));
    MemoryAnalysisStore store;
    EXPECT_TRUE(analyse_shot(shot, plan, store, {}, {}));
    auto scene = make_scene(shot, plan, store, 0, {}, {});
    EXPECT_TRUE(scene);
    std::vector<RegionScene> scenes;
    scenes.push_back(std::move(*scene));
    auto frame = render_frame(shot, plan, scenes, store, *make_cpu_backend(), kFirst);
    EXPECT_TRUE(frame);
    return std::move(frame->pixels);
}

TEST(PlateAlpha, BothConventionsGiveTheSamePicture) {
    ElementShot straight(AlphaKind::kStraight), associated(AlphaKind::kAssociated);
    for (ElementShot* shot : {&straight, &associated}) {
        for (auto& [key, matte] : shot->mattes) {
            for (int y = 0; y < kShotSize.height; ++y) {
                for (int x = 0; x < 60; ++x)
                    matte.at(x, y) = static_cast<std::uint8_t>(
                        std::min(255.0f * shot->coverage().at(x, y) + 0.5f,
                                 static_cast<float>(matte.at(x, y))));
            }
        }
    }
    RegionPlan region = make_region(flat_texture({0.2f, 0.6f, 0.4f}));
    ImageF3 a = rendered_element(straight, region);
    const ImageF3 b = rendered_element(associated, region);
    // Straight: the texture itself, at the soft edge and on the half transparent part.
    for (const int x : {33, 36, 50, 110}) {
        EXPECT_NEAR(a.at(x, 50, 0), a.at(80, 50, 0), 2e-3f) << x;
        EXPECT_NEAR(a.at(x, 50, 1), a.at(80, 50, 1), 2e-3f) << x;
    }
    // What no matte reaches is the plate's, to the bit.
    EXPECT_EQ(a.at(5, 5, 1), straight.plates[kFirst]->at(5, 5, 1));
    EXPECT_EQ(b.at(150, 5, 1), associated.plates[kFirst]->at(150, 5, 1));
    associate(a, straight.coverage());
    for (int y = 20; y < 90; ++y) {
        for (int x = 0; x < kShotSize.width; ++x)
            ASSERT_NEAR(a.at(x, y, 1), b.at(x, y, 1), 4e-3f) << x << ", " << y;
    }
}

}  // namespace
}  // namespace weft
