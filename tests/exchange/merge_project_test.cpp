#include "app/exchange/merge_project.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/project/edit.h"
#include "app/project/validate.h"
#include "tests/project/sample_project.h"

namespace weft::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

Region region_of(const std::string& name) {
    Region region;
    region.name = name;
    MatteSource matte;
    matte.keyframes[10] = {"shot_mattes/" + name + "_10.png", {}};
    region.matte = matte;
    region.texture.sample = "brick.png";
    region.reference_frames = {10};
    return region;
}

// Two regions: wall (1) below floor (2).
Project base() {
    Project project;
    project.name = "sh010";
    project.plate.path = "frames/####.png";
    project.output.path = "out/####.png";
    for (const char* name : {"wall", "floor"})
        project = *apply_edit(project, AddRegion{region_of(name), {}});
    return project;
}

template <class Change>
Project changed(const Project& project, std::size_t index, Change&& change) {
    Project out = project;
    out.regions[index] = out.regions[index].with(change);
    return out;
}

const Region& named(const Project& project, const std::string& name) {
    return *project.regions[find_region(project, name).value()];
}

MergedProject merge(const Project& before, const Project& mine, const Project& theirs,
                    MergeSide wins = MergeSide::kMine) {
    auto merged = merge_projects(before, mine, theirs, wins);
    EXPECT_TRUE(merged) << merged.error().text();
    return merged ? *merged : MergedProject();
}

TEST(MergeProject, WhatOneSideChangedIsTaken) {
    Project mine = changed(base(), 0, [](Region& r) { r.placement.scale = 2; });
    mine.settings.seed = 7;
    Project theirs = changed(base(), 0, [](Region& r) { r.placement.rotate_deg = 30; });
    theirs = changed(theirs, 1, [](Region& r) { r.light.strength = 0.5; });
    theirs.output.path = "theirs/####.png";
    const MergedProject merged = merge(base(), mine, theirs);
    EXPECT_THAT(merged.conflicts, IsEmpty());
    EXPECT_THAT(merged.changed, ElementsAre("the project", "wall", "floor"));
    Project expected = changed(mine, 0, [](Region& r) { r.placement.rotate_deg = 30; });
    expected = changed(expected, 1, [](Region& r) { r.light.strength = 0.5; });
    expected.output.path = "theirs/####.png";
    EXPECT_EQ(merged.project, expected);
    EXPECT_EQ(merge(base(), theirs, mine).project, expected) << "from the other side, too";
}

TEST(MergeProject, ADocumentWithAllThereIsStaysAsItIs) {
    const Project full = full_project();
    Project theirs = full;
    theirs.name = "theirs";
    const MergedProject merged = merge(full, full, theirs);
    EXPECT_EQ(merged.project, theirs);
    EXPECT_THAT(merged.conflicts, IsEmpty());
    EXPECT_EQ(merge(full, theirs, full).project, theirs);
    EXPECT_THAT(merge(full, theirs, full).changed, IsEmpty());
}

TEST(MergeProject, AConflictNamesBothValuesAndIsDecidedByOneSide) {
    const Project mine = changed(base(), 0, [](Region& r) { r.placement.scale = 2; });
    const Project theirs = changed(base(), 0, [](Region& r) { r.placement.scale = 3.5; });
    const MergedProject kept = merge(base(), mine, theirs);
    EXPECT_THAT(kept.conflicts,
                ElementsAre(MergeConflict{"wall", "placement.scale", {}, "2.0", "3.5"}));
    EXPECT_EQ(kept.project, mine);
    EXPECT_EQ(merge(base(), mine, theirs, MergeSide::kTheirs).project, theirs);
    EXPECT_THAT(merge(base(), mine, mine).conflicts, IsEmpty()) << "both did the same";
}

TEST(MergeProject, KeysAreMergedByFrame) {
    const auto key = [](Region& r, int frame, const std::string& path) {
        r.matte = r.matte.with([&](MatteSource& m) { m.keyframes[frame] = {path, {}}; });
    };
    Project mine = changed(base(), 0, [&](Region& r) {
        key(r, 20, "mine_20.png");
        key(r, 40, "mine_40.png");
        r.light.strength_keys = {{{1, {0}}, {24, {1}}}};
        r.corrections[12] = {{{1, 1}, {2, 2}}};
        r.reference_frames = {10, 30};
    });
    Project theirs = changed(base(), 0, [&](Region& r) {
        key(r, 30, "theirs_30.png");
        key(r, 40, "theirs_40.png");
        r.light.strength_keys = {{{12, {2}}}};
        r.corrections[14] = {{{3, 3}, {4, 4}}};
        r.reference_frames = {10, 50};
    });
    const MergedProject merged = merge(base(), mine, theirs, MergeSide::kTheirs);
    ASSERT_THAT(merged.conflicts, SizeIs(1));
    EXPECT_EQ(merged.conflicts[0].key, "matte.keyframes");
    EXPECT_EQ(merged.conflicts[0].frame, 40);
    const Region& wall = named(merged.project, "wall");
    EXPECT_EQ(wall.matte->keyframes.size(), 4u);
    EXPECT_EQ(wall.matte->keyframes.at(10).path, "shot_mattes/wall_10.png");
    EXPECT_EQ(wall.matte->keyframes.at(20).path, "mine_20.png");
    EXPECT_EQ(wall.matte->keyframes.at(30).path, "theirs_30.png");
    EXPECT_EQ(wall.matte->keyframes.at(40).path, "theirs_40.png");
    EXPECT_EQ(wall.light.strength_keys.keys.size(), 3u);
    EXPECT_EQ(wall.corrections.size(), 2u);
    EXPECT_EQ(wall.reference_frames, (std::vector{10, 50, 30}));
}

TEST(MergeProject, ARemovedKeyStaysRemoved) {
    Project before = changed(base(), 0, [](Region& r) {
        r.corrections[12] = {{{1, 1}, {2, 2}}};
        r.corrections[14] = {{{3, 3}, {4, 4}}};
    });
    const Project mine = changed(before, 0, [](Region& r) { r.corrections.erase(12); });
    const Project theirs = changed(before, 0, [](Region& r) {
        r.corrections[16] = {{{5, 5}, {6, 6}}};
    });
    const MergedProject merged = merge(before, mine, theirs);
    EXPECT_THAT(merged.conflicts, IsEmpty());
    const auto& kept = named(merged.project, "wall").corrections;
    EXPECT_FALSE(kept.contains(12));
    EXPECT_TRUE(kept.contains(14) && kept.contains(16));
}

TEST(MergeProject, RegionsThatBothAddedAreKeptUnderOwnIdsAndNames) {
    const Project mine = *apply_edit(base(), AddRegion{region_of("door"), {}});
    Project theirs = *apply_edit(base(), AddRegion{region_of("door"), 0});
    theirs = changed(theirs, 0, [](Region& r) { r.placement.scale = 4; });
    const MergedProject merged = merge(base(), mine, theirs);
    EXPECT_THAT(merged.conflicts, IsEmpty());
    EXPECT_THAT(merged.renumbered, ElementsAre(std::pair(3u, 4u)));
    ASSERT_THAT(merged.project.regions, SizeIs(4));
    const auto& regions = merged.project.regions;
    EXPECT_EQ(regions[0]->name, "door");
    EXPECT_EQ(regions[0]->id, 3u);
    EXPECT_EQ(regions[0]->placement.scale, 4);
    EXPECT_EQ(regions[3]->name, "door 2") << "on top, where it was added";
    EXPECT_EQ(regions[3]->id, 4u);
    EXPECT_EQ(merged.project.next_region_id, 5u);
}

TEST(MergeProject, ARegionIsRemovedUnlessTheOtherChangedIt) {
    const Project mine = *apply_edit(base(), RemoveRegion{{1, {}}});
    Project theirs = changed(base(), 1, [](Region& r) { r.placement.scale = 4; });
    MergedProject merged = merge(base(), mine, theirs);
    EXPECT_THAT(merged.conflicts, IsEmpty());
    ASSERT_THAT(merged.project.regions, SizeIs(1));
    EXPECT_EQ(merged.project.regions[0]->placement.scale, 4);

    theirs = changed(base(), 0, [](Region& r) { r.placement.scale = 4; });
    merged = merge(base(), mine, theirs);
    EXPECT_THAT(merged.conflicts, ElementsAre(MergeConflict{"wall", "", {}, "removed", "changed"}));
    EXPECT_THAT(merged.project.regions, SizeIs(1));
    EXPECT_THAT(merge(base(), mine, theirs, MergeSide::kTheirs).project.regions, SizeIs(2));
}

TEST(MergeProject, LayersKeepTheOrderThatOneSideGaveThem) {
    const Project mine = *apply_edit(base(), MoveRegion{{1, {}}, 1});
    const Project theirs = *apply_edit(base(), AddRegion{region_of("door"), {}});
    const MergedProject merged = merge(base(), mine, theirs);
    EXPECT_THAT(merged.conflicts, IsEmpty());
    std::vector<std::string> names;
    for (const Leaf<Region>& region : merged.project.regions)
        names.push_back(region->name);
    EXPECT_THAT(names, ElementsAre("floor", "wall", "door"));
}

TEST(MergeProject, LockedPatchesBelongToTheirSample) {
    const Project mine = changed(base(), 0, [](Region& r) {
        r.amendments = std::vector<PlaneAmendment>{
            {PlaneAmendment::Kind::kKeep, 0, {{10, 20, 30, 1, 2, 0, 0}}}};
    });
    const Project theirs = changed(base(), 0, [](Region& r) { r.texture.sample = "stone.png"; });
    const MergedProject merged = merge(base(), mine, theirs, MergeSide::kTheirs);
    ASSERT_THAT(merged.conflicts, SizeIs(1));
    EXPECT_EQ(merged.conflicts[0].key, "amendments");
    EXPECT_EQ(merged.project, theirs);
    EXPECT_EQ(merge(base(), mine, theirs).project, mine);
}

TEST(MergeProject, APlacementBelongsToItsReferenceFrame) {
    const Project mine = changed(base(), 0, [](Region& r) { r.reference_frames = {20, 10}; });
    const Project theirs = changed(base(), 0, [](Region& r) { r.placement.offset_px = {5, 6}; });
    const MergedProject merged = merge(base(), mine, theirs);
    ASSERT_THAT(merged.conflicts, SizeIs(1));
    EXPECT_EQ(merged.conflicts[0].key, "reference_frames");
    EXPECT_EQ(merged.project, mine);
    EXPECT_EQ(merge(base(), mine, theirs, MergeSide::kTheirs).project, theirs);
}

TEST(MergeProject, AMatteOfAnotherKindOrFrozenIsTakenWhole) {
    const Project mine = changed(base(), 0, [](Region& r) {
        MatteSource files;
        files.files = "rotos/####.png";
        r.matte = files;
    });
    const Project theirs = changed(base(), 0, [](Region& r) {
        r.matte = r.matte.with([](MatteSource& m) { m.keyframes[20] = {"theirs.png", {}}; });
    });
    MergedProject merged = merge(base(), mine, theirs);
    ASSERT_THAT(merged.conflicts, SizeIs(1));
    EXPECT_EQ(merged.conflicts[0].key, "matte");
    EXPECT_EQ(merged.project, mine);

    const Project frozen = changed(base(), 0, [](Region& r) {
        r.matte = r.matte.with([](MatteSource& m) {
            m.frozen = {20, 21};
            m.frozen_files = "frozen/####.png";
        });
    });
    merged = merge(base(), frozen, theirs);
    ASSERT_THAT(merged.conflicts, SizeIs(1));
    EXPECT_EQ(merged.project, frozen) << "frame 20 is frozen as it was before their correction";
}

TEST(MergeProject, HoldoutsAreMergedInTheirPlacesAndAddedOnesKept) {
    const auto matte = [](const std::string& files) {
        MatteSource out;
        out.files = files;
        return out;
    };
    const Project before = changed(base(), 0, [&](Region& r) {
        r.holdouts = std::vector{matte("a/####.png"), matte("b/####.png")};
    });
    const Project mine = changed(before, 0, [&](Region& r) {
        r.holdouts = r.holdouts.with([&](auto& list) { list[0].edge.choke_px = 2; });
    });
    const Project theirs = changed(before, 0, [&](Region& r) {
        r.holdouts = r.holdouts.with([&](auto& list) { list.push_back(matte("c/####.png")); });
    });
    MergedProject merged = merge(before, mine, theirs);
    EXPECT_THAT(merged.conflicts, IsEmpty());
    const auto& list = *named(merged.project, "wall").holdouts;
    ASSERT_THAT(list, SizeIs(3));
    EXPECT_EQ(list[0].edge.choke_px, 2);
    EXPECT_EQ(list[2].files, "c/####.png");

    const Project shifted = changed(before, 0, [&](Region& r) {
        r.holdouts = std::vector{matte("b/####.png"), matte("d/####.png")};
    });
    merged = merge(before, mine, shifted);
    ASSERT_THAT(merged.conflicts, SizeIs(1)) << "their first one is another than mine";
    EXPECT_EQ(merged.project, mine);
}

TEST(MergeProject, SettingsThatAreWrongTogetherAreTakenFromOneSide) {
    const Project mine = changed(base(), 0, [](Region& r) {
        r.matte = r.matte.with([](MatteSource& m) { m.propagate_from = 50; });
    });
    const Project theirs = changed(base(), 0, [](Region& r) {
        r.matte = r.matte.with([](MatteSource& m) { m.propagate_to = 40; });
    });
    const MergedProject merged = merge(base(), mine, theirs);
    EXPECT_THAT(merged.conflicts, ElementsAre(MergeConflict{"wall", "", {}, "changed", "changed"}));
    EXPECT_EQ(merged.project, mine);
    EXPECT_FALSE(has_errors(validate(merged.project)));
}

TEST(MergeProject, KeysOfNewerVersionsAreMergedToo) {
    Project mine = base(), theirs = base();
    mine.extra["future"] = "1";
    theirs.settings.extra["later"] = R"({"a":1})";
    const MergedProject merged = merge(base(), mine, theirs);
    EXPECT_THAT(merged.conflicts, IsEmpty());
    EXPECT_EQ(merged.project.extra, mine.extra);
    EXPECT_EQ(merged.project.settings.extra, theirs.settings.extra);
}

TEST(MergeProject, WhatCannotBeWrittenIsAnError) {
    Project mine = base();
    mine.name = "\xff";
    EXPECT_FALSE(merge_projects(base(), mine, base(), MergeSide::kMine));
}

}  // namespace
}  // namespace weft::test
