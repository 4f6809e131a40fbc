#include "app/render/analysis_key.h"

#include <functional>

#include "app/shot/painted_mattes.h"
#include "engine/media/frame_writer.h"
#include "tests/render/shot_fixture.h"

namespace weft::test {
namespace {

class AnalysisKeyTest : public ShotTest {
  protected:
    std::string key_after(const std::function<void(Region&)>& change) const {
        JobSpec job = spec("out");
        Region region = *job.project.regions[0];
        change(region);
        job.project.regions[0] = region;
        const auto shot = open_shot(job.project);
        EXPECT_TRUE(shot) << (shot ? "" : shot.error().text());
        const auto key = shot ? region_key(**shot, 0, {}) : Expected<std::string>(std::string());
        EXPECT_TRUE(key) << (key ? "" : key.error().text());
        return key.value_or("");
    }
    static Zone zone(double value, MatteSource matte) {
        Zone out;
        out.value = value;
        out.matte = std::move(matte);
        return out;
    }
};

TEST_F(AnalysisKeyTest, NamesWhatTheAnalysisDependsOnAndNothingElse) {
    const std::string plain = key_after([](Region&) {});
    EXPECT_EQ(plain.size(), 32u);
    EXPECT_EQ(key_after([](Region& r) { r.placement.scale = 3; }), plain);
    EXPECT_EQ(key_after([](Region& r) { r.light.strength = 0.2; }), plain);
    EXPECT_NE(key_after([](Region& r) {
                  r.matte = r.matte.with([](MatteSource& m) { m.select.invert = true; });
              }),
              plain);
    EXPECT_NE(key_after([](Region& r) { r.reference_frames = {3}; }), plain);
}

TEST_F(AnalysisKeyTest, OfZonesItNamesWhatIsPropagated) {
    ASSERT_TRUE(write_matte(in("zone.png"), card_matte(1), WriteRule::own()));
    MatteSource files, painted, elsewhere;
    files.files = in("zone.png");
    painted.keyframes[2] = {in("zone.png")};
    elsewhere.keyframes[3] = {in("zone.png")};
    const auto key = [&](double value, const MatteSource& matte) {
        return key_after([&](Region& r) { r.zones = std::vector<Zone>{zone(value, matte)}; });
    };
    EXPECT_EQ(key(0, files), key_after([](Region&) {}));
    EXPECT_NE(key(0, painted), key(0, files));
    EXPECT_EQ(key(1.5, painted), key(0, painted)) << "values are applied when a frame is rendered";
    EXPECT_NE(key(0, elsewhere), key(0, painted));
}

}  // namespace
}  // namespace weft::test
