// What a change of the document makes the preview do again.
#include <gtest/gtest.h>

#include "app/preview/preview.h"

namespace weft::test {
namespace {

Project project_of(Region region) {
    Project project;
    project.regions.emplace_back(std::move(region));
    return project;
}

TEST(PreviewKeys, EdgeToolsRenderAgainAndAnalyseNothing) {
    Region region;
    MatteSource matte;
    matte.files = "m.####.png";
    region.matte = matte;
    region.holdouts = std::vector<MatteSource>{matte};
    Zone zone;
    zone.matte = matte;
    region.zones = std::vector<Zone>{zone};
    const Project before = project_of(region);
    matte.edge.choke_px = 2;
    matte.edge.blur_keys = {{{1, {0}}, {9, {3}}}};
    Region edged = region;
    edged.matte = matte;
    Region holdout_edged = region;
    holdout_edged.holdouts = std::vector<MatteSource>{matte};
    Region zone_edged = region;
    zone.matte = matte;
    zone_edged.zones = std::vector<Zone>{zone};
    for (const Region& changed : {edged, holdout_edged, zone_edged}) {
        EXPECT_NE(pixel_key(project_of(changed)), pixel_key(before));
        EXPECT_EQ(analysis_key(project_of(changed)), analysis_key(before));
    }
    matte.steadiness = 0;
    edged.matte = matte;
    EXPECT_NE(analysis_key(project_of(edged)), analysis_key(before));
}

}  // namespace
}  // namespace weft::test
