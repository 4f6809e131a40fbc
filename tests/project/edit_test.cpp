#include "app/project/codec/edit_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/project/region_names.h"
#include "tests/project/sample_project.h"

namespace weft {
namespace {

using testing::HasSubstr;

/// One of each kind, in the order of the variant.
std::vector<Edit> every_edit() {
    const Project full = test::full_project();
    const Region& region = *full.regions[0];
    Region added = region;
    added.id = 0;
    added.name = "New";
    MatteSource painted;
    painted.keyframes = {{1, {"a.png", {}}}};
    return {SetPlate{full.plate},
            SetOutput{full.output},
            SetProjectParameter{"settings.quality", std::string("draft")},
            AddRegion{added, 1},
            RemoveRegion{{2, {}}},
            MoveRegion{{7, {}}, 1},
            RenameRegion{{0, "New"}, "Renamed"},
            SetRegionParameter{{7, {}}, "placement.offset_px", std::vector<double>{1, 2.5}},
            SetMatte{{7, {}}, painted},
            SetMatteKeyframe{{7, {}}, 40, "b.png"},
            RemoveMatteKeyframe{{7, {}}, 1},
            SetHoldouts{{7, {}}, {painted}},
            SetZones{{7, {}}, {{ZoneKind::kLight, 0.5, {}, painted, {}}}},
            SetTexture{{7, {}}, region.texture},
            SetCorrection{{7, {}}, 12, {{{1, 2}, {3, 4.5}}}},
            SetAmendments{{7, {}}, {{PlaneAmendment::Kind::kAgain, 3, {{1, 2, 40, 5, 6, 0, 0}}}}}};
}

TEST(Edits, ChangingSamplesClearsAmendments) {
    const Project before = test::full_project();
    ASSERT_FALSE(before.regions[0]->amendments->empty());
    TextureSource texture = before.regions[0]->texture;
    texture.space = "srgb";
    auto same = apply_edit(before, SetTexture{{7, {}}, texture});
    ASSERT_TRUE(same) << same.error().text();
    EXPECT_EQ(same->regions[0]->amendments, before.regions[0]->amendments);
    texture.sample = "other.jpg";
    const auto other = apply_edit(before, SetTexture{{7, {}}, texture});
    ASSERT_TRUE(other);
    EXPECT_TRUE(other->regions[0]->amendments->empty());
    const auto key =
        apply_edit(before, SetRegionParameter{{7, {}}, "texture.sample", std::string("x.jpg")});
    ASSERT_TRUE(key);
    EXPECT_TRUE(key->regions[0]->amendments->empty());
    // Edits that make one region of another keep what the other has kept.
    const auto there = apply_edits(*other, region_edits(*other->regions[0], *before.regions[0]));
    ASSERT_TRUE(there) << there.error().text();
    EXPECT_EQ(there->regions[0]->amendments, before.regions[0]->amendments);
    EXPECT_FALSE(apply_edit(
        before,
        SetAmendments{{7, {}}, {{PlaneAmendment::Kind::kKeep, 0, {{0, 0, 0, 0, 0, 0, 0}}}}}));
}

TEST(Edits, EachSurvivesJson) {
    const std::vector<Edit> edits = every_edit();
    for (std::size_t i = 0; i < edits.size(); ++i)
        ASSERT_EQ(edits[i].index(), i) << "an edit is missing from the test";
    ASSERT_EQ(edits.size(), std::variant_size_v<Edit>);
    const auto text = edits_to_json(edits);
    ASSERT_TRUE(text);
    const auto again = edits_from_json(*text);
    ASSERT_TRUE(again) << again.error().text();
    ASSERT_EQ(again->size(), edits.size());
    const auto direct = apply_edits(test::full_project(), edits);
    const auto replayed = apply_edits(test::full_project(), *again);
    ASSERT_TRUE(direct) << direct.error().text();
    ASSERT_TRUE(replayed) << replayed.error().text();
    EXPECT_EQ(*direct, *replayed);
    const auto twice = edits_to_json(*again);
    ASSERT_TRUE(twice);
    EXPECT_EQ(*twice, *text);
}

TEST(Edits, ApplyLeavesTheOldProjectAlone) {
    const Project before = test::full_project();
    Project current = before;
    for (const Edit& edit : every_edit()) {
        const Project copy = current;
        const auto next = apply_edit(current, edit);
        ASSERT_TRUE(next) << edit_label(current, edit) << ": " << next.error().text();
        EXPECT_EQ(current, copy) << edit_label(current, edit);
        const bool sets_what_is_there = std::holds_alternative<SetPlate>(edit) ||
                                        std::holds_alternative<SetOutput>(edit) ||
                                        std::holds_alternative<SetProjectParameter>(edit) ||
                                        std::holds_alternative<SetTexture>(edit);
        if (!sets_what_is_there) {
            EXPECT_NE(*next, current) << edit_label(current, edit);
        }
        current = *next;
    }
    EXPECT_EQ(before, test::full_project());
}

TEST(Edits, UnchangedPartsAreShared) {
    const Project before = test::full_project();
    const auto after = apply_edit(before, SetRegionParameter{{7, {}}, "placement.scale", 2.0});
    ASSERT_TRUE(after);
    EXPECT_NE(after->regions[0].identity(), before.regions[0].identity());
    EXPECT_EQ(after->regions[1].identity(), before.regions[1].identity());
    EXPECT_EQ(after->regions[0]->matte.identity(), before.regions[0]->matte.identity());
}

TEST(Edits, IdsAreNeverReused) {
    Project project;
    for (const char* name : {"a", "b"}) {
        Region region;
        region.name = name;
        project = apply_edit(project, AddRegion{region, {}}).value();
    }
    EXPECT_EQ(project.regions[1]->id, 2u);
    project = apply_edit(project, RemoveRegion{{2, {}}}).value();
    project = apply_edit(project, AddRegion{Region(), {}}).value();
    EXPECT_EQ(project.regions[1]->id, 3u);
    Region taken;
    taken.id = 1;
    EXPECT_FALSE(apply_edit(project, AddRegion{taken, {}}));
}

TEST(Edits, NoTwoRegionsGetTheSameName) {
    Project project;
    for (const char* name : {"a", "b"}) {
        Region region;
        region.name = name;
        project = apply_edit(project, AddRegion{region, {}}).value();
    }
    const RegionRef b{2, {}};
    Region another;
    another.name = "a";
    for (const Edit& edit : {Edit(AddRegion{another, {}}), Edit(RenameRegion{b, "a"}),
                             Edit(SetRegionParameter{b, "name", std::string("a")})}) {
        const auto refused = apply_edit(project, edit);
        ASSERT_FALSE(refused) << edit_label(project, edit);
        EXPECT_EQ(refused.error().code, ErrorCode::kUsage);
        EXPECT_THAT(refused.error().text(), testing::HasSubstr("'a' already (id 1)"));
    }
    EXPECT_TRUE(apply_edit(project, RenameRegion{b, "b"})) << "its own name";
    EXPECT_EQ(free_region_name(project, "a"), "a 2");
    EXPECT_EQ(free_region_name(project, "c"), "c");
    // Written elsewhere, two have one name: either gets another.
    project.regions[1] = project.regions[1].with([](Region& region) { region.name = "a"; });
    EXPECT_TRUE(apply_edit(project, RenameRegion{b, "c"}));
    EXPECT_TRUE(apply_edit(project, SetRegionParameter{b, "placement.scale", 2.0}));
}

TEST(Edits, RegionsMoveToTheGivenIndex) {
    Project project;
    for (const char* name : {"a", "b", "c"}) {
        Region region;
        region.name = name;
        project = apply_edit(project, AddRegion{region, {}}).value();
    }
    const auto order = [](const Project& p) {
        std::string out;
        for (const auto& region : p.regions)
            out += region->name;
        return out;
    };
    EXPECT_EQ(order(apply_edit(project, MoveRegion{{0, "a"}, 2}).value()), "bca");
    EXPECT_EQ(order(apply_edit(project, MoveRegion{{0, "c"}, 0}).value()), "cab");
    EXPECT_EQ(order(apply_edit(project, MoveRegion{{0, "b"}, 1}).value()), "abc");
    EXPECT_FALSE(apply_edit(project, MoveRegion{{0, "b"}, 3}));
    EXPECT_FALSE(apply_edit(project, MoveRegion{{0, "b"}, -1}));
}

TEST(Edits, KeyframesAreRefusedBesideFiles) {
    Project project;
    Region region;
    MatteSource files;
    files.files = "m/####.png";
    region.matte = files;
    project = apply_edit(project, AddRegion{region, {}}).value();
    const auto refused = apply_edit(project, SetMatteKeyframe{{1, {}}, 3, "a.png"});
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().sentence(), HasSubstr("m/####.png"));
    project =
        apply_edit(project, SetRegionParameter{{1, {}}, "matte.files", std::string()}).value();
    project = apply_edit(project, SetMatteKeyframe{{1, {}}, 3, "a.png"}).value();
    EXPECT_EQ(project.regions[0]->matte->keyframes.at(3).path, "a.png");
    EXPECT_FALSE(apply_edit(project, RemoveMatteKeyframe{{1, {}}, 4}));
}

TEST(Edits, RefusalsSayWhy) {
    const Project project = test::full_project();
    const auto says = [&](const Edit& edit) {
        const auto result = apply_edit(project, edit);
        if (result) return std::string("applied");
        EXPECT_EQ(result.error().code, ErrorCode::kUsage);
        return result.error().text();
    };
    EXPECT_THAT(says(RemoveRegion{{0, "Roof"}}), HasSubstr("'Floor'"));
    EXPECT_THAT(says(RemoveRegion{{99, {}}}), HasSubstr("99"));
    EXPECT_THAT(says(SetRegionParameter{{2, {}}, "placement.scael", 1.0}),
                HasSubstr("placement.scale"));
    EXPECT_THAT(says(SetRegionParameter{{2, {}}, "placement.scale", 0.0}),
                HasSubstr("0.001 to 1000"));
    Plate plate;
    plate.fps = -1;
    EXPECT_THAT(says(SetPlate{plate}), HasSubstr("plate.fps"));
    const auto list = apply_edits(project, {RenameRegion{{2, {}}, "x"}, RemoveRegion{{99, {}}}});
    ASSERT_FALSE(list);
    EXPECT_THAT(list.error().text(), HasSubstr("Action 2: "));
}

TEST(ActionFile, BothFormsAreRead) {
    const std::string list =
        R"([{"action": "rename_region", "region": "Floor", "name": "Ground"}])";
    const auto bare = edits_from_json(list);
    const auto wrapped =
        edits_from_json(R"({"schema": "weft.actions/1", "actions": )" + list + "}");
    ASSERT_TRUE(bare);
    ASSERT_TRUE(wrapped);
    const Edit expected = RenameRegion{{0, "Floor"}, "Ground"};
    EXPECT_EQ(bare->at(0), expected);
    EXPECT_EQ(wrapped->at(0), expected);
}

TEST(ActionFile, MistakesAreReportedWithTheirPlace) {
    const auto says = [](const char* text) {
        const auto edits = edits_from_json(text);
        return edits ? std::string("read") : edits.error().text();
    };
    EXPECT_THAT(says(R"([{"action": "explode"}])"),
                HasSubstr("actions[0].action: Unknown action 'explode'"));
    EXPECT_THAT(says(R"([{"action": "remove_region", "region": 1, "indx": 2}])"),
                HasSubstr("actions[0].indx: "));
    EXPECT_THAT(says(R"([{"action": "remove_region"}])"),
                HasSubstr("actions[0].region: This key is missing"));
    EXPECT_THAT(
        says(R"([{"action": "set_region_parameter", "region": 1, "key": "placement.scale"}])"),
        HasSubstr("actions[0].value: "));
    EXPECT_THAT(says(R"([7])"), HasSubstr("actions[0]: "));
    EXPECT_THAT(says(R"({"schema": "weft.actions/2", "actions": []})"),
                HasSubstr("weft.actions/1"));
    EXPECT_THAT(says(R"("x")"), HasSubstr("a list of actions"));
}

TEST(Edits, LabelsNameTheRegion) {
    const Project project = test::full_project();
    EXPECT_EQ(edit_label(project, SetRegionParameter{{2, {}}, "placement.scale", 2.0}),
              "Set placement.scale of Floor");
    EXPECT_EQ(edit_label(project, RemoveRegion{{0, "Floor"}}), "Remove Floor");
}

}  // namespace
}  // namespace weft
