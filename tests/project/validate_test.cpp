#include "app/project/validate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "app/project/edit.h"

namespace weft {
namespace {

using testing::HasSubstr;

/// With one region; nothing is wrong with it.
Project good_project(const std::function<void(Region&)>& change = {}) {
    Project project;
    project.plate.path = "frames/####.png";
    project.output.path = "out/####.png";
    Region region;
    region.id = 1;
    region.name = "wall";
    MatteSource matte;
    matte.files = "masks/####.png";
    region.matte = matte;
    region.texture.sample = "brick.jpg";
    if (change) change(region);
    project.regions.emplace_back(region);
    return project;
}

/// The texts of the issues, errors with "E ", warnings with "W " in front.
std::vector<std::string> texts(const Project& project) {
    std::vector<std::string> out;
    for (const Issue& issue : validate(project)) {
        EXPECT_FALSE(issue.what.empty() || issue.where.empty() || issue.what_to_do.empty());
        out.push_back((issue.severity == Severity::kError ? "E " : "W ") + issue.text());
    }
    return out;
}

void expect_one(const Project& project, const std::string& begins, const std::string& holds) {
    const auto found = texts(project);
    ASSERT_EQ(found.size(), 1u) << testing::PrintToString(found);
    EXPECT_TRUE(found[0].starts_with(begins)) << found[0];
    EXPECT_THAT(found[0], HasSubstr(holds));
}

TEST(Validate, AGoodProjectHasNoIssues) {
    EXPECT_EQ(texts(good_project()), std::vector<std::string>{});
}

TEST(Validate, FindsWhatIsMissing) {
    const auto issues = validate(Project{});
    EXPECT_TRUE(has_errors(issues));
    EXPECT_EQ(issues.size(), 3u);  // plate, output, regions
    expect_one(good_project([](Region& r) { r.texture.sample.clear(); }),
               "E regions[0] 'wall': texture", "texture.sample");
    expect_one(good_project([](Region& r) { r.matte = MatteSource{}; }),
               "E regions[0] 'wall': matte", "No matte");
    expect_one(good_project([](Region& r) { r.light.source = LightSource::kImage; }),
               "E regions[0] 'wall': light.image", "light.source");
    expect_one(good_project([](Region& r) { r.holdouts = std::vector<MatteSource>(1); }),
               "E regions[0] 'wall': holdouts[0]", "No matte");
    expect_one(good_project([](Region& r) { r.zones = std::vector<Zone>(1); }),
               "E regions[0] 'wall': zones[0].matte", "No matte");
    Project no_output = good_project();
    no_output.output.path.clear();
    expect_one(no_output, "W output.path", "Set one");
    EXPECT_FALSE(has_errors(validate(no_output)));
}

TEST(Validate, FindsContradictions) {
    expect_one(good_project([](Region& r) { r.texture.plane = "p.png"; }),
               "E regions[0] 'wall': texture", "both");
    expect_one(good_project([](Region& r) {
                   r.matte = r.matte.with([](MatteSource& m) { m.keyframes[1].path = "a"; });
               }),
               "E regions[0] 'wall': matte", "Keep one");
    expect_one(good_project([](Region& r) {
                   r.texture = {};
                   r.texture.plane = "p.png";
                   r.temporal.mode = TemporalMode::kPaper;
               }),
               "W regions[0] 'wall': temporal.mode", "'paper'");
    expect_one(good_project([](Region& r) { r.light.image = "E.png"; }),
               "W regions[0] 'wall': light.image", "'plate'");
    expect_one(good_project([](Region& r) { r.synthesis.feather_px = 40; }),
               "W regions[0] 'wall': synthesis.feather_px", "36 px");
    for (const auto& [kind, expected] :
         {std::pair{ZoneKind::kDetail, "1 is all"}, {ZoneKind::kCalmer, "1 is in full"}}) {
        Zone zone;
        zone.kind = kind;
        zone.value = 1.5;
        zone.matte.files = "zone/####.png";
        expect_one(good_project([&](Region& r) { r.zones = std::vector<Zone>{zone}; }),
                   "W regions[0] 'wall': zones[0]", expected);
    }
    Project overwriting = good_project();
    overwriting.output.path = overwriting.plate.path;
    expect_one(overwriting, "E output", "overwrite");
    Project frames = good_project();
    frames.settings.frames = "40-1";
    expect_one(frames, "E settings.frames", "40-1");
}

TEST(Validate, CornersMustBeConvexAndInOrder) {
    const auto with_corners = [](std::array<PlatePoint, 4> corners) {
        return good_project([&](Region& r) { r.placement.corners_px = corners; });
    };
    EXPECT_TRUE(validate(with_corners({{{0, 0}, {10, 1}, {9, 8}, {1, 7}}})).empty());
    expect_one(with_corners({{{0, 0}, {10, 0}, {0, 8}, {10, 8}}}), "E", "convex");  // crossed
    expect_one(with_corners({{{0, 0}, {10, 0}, {2, 2}, {0, 8}}}), "E", "convex");   // dented
    expect_one(with_corners({{{0, 0}, {5, 0}, {10, 0}, {0, 8}}}), "E",
               "convex");  // three on a line
    expect_one(with_corners({{{3, 3}, {3, 3}, {3, 3}, {3, 3}}}), "E", "convex");
    Project both = good_project([](Region& r) {
        r.placement.corners_px = {{{0, 0}, {10, 1}, {9, 8}, {1, 7}}};
        r.placement.scale = 2;
    });
    EXPECT_TRUE(validate(both).empty());  // the scale acts inside the perspective
}

TEST(Validate, FindsValuesSetWithoutTheTable) {
    expect_one(good_project([](Region& r) { r.placement.scale = -1; }),
               "E regions[0] 'wall': placement.scale", "0.001 to 1000");
    Project seed = good_project();
    seed.settings.seed = -4;
    expect_one(seed, "E settings.seed", "-4");
}

TEST(Validate, FindsRegionsThatShareANameOrAnId) {
    Project twice = good_project();
    twice.regions.push_back(twice.regions[0]);
    const auto found = texts(twice);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_THAT(found[0], HasSubstr("id 1"));
    EXPECT_THAT(found[1], HasSubstr("'wall'"));
    Project off = good_project([](Region& r) { r.enabled = false; });
    expect_one(off, "W regions", "disabled");
}

}  // namespace
}  // namespace weft
