#include "app/project/key_rows.h"

#include <gmock/gmock.h>

#include "app/project/edit.h"

namespace weft {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const KeyRowId kMatte{KeyRowKind::kMatte, 0};
const KeyRowId kScale{KeyRowKind::kNumbers, 0, "placement.scale_keys"};
const KeyRowId kOffset{KeyRowKind::kNumbers, 0, "placement.offset_keys"};
const KeyRowId kReference{KeyRowKind::kReference};
const KeyRowId kHoldout{KeyRowKind::kMatte, 1};

RotoShape triangle(float x) {
    RotoShape shape;
    for (const Vec2 at : {Vec2{x, 0}, Vec2{x + 9, 0}, Vec2{x, 9}})
        shape.points.push_back({at});
    return shape;
}

Region keyed() {
    Region r;
    r.id = 1;
    MatteSource matte;
    matte.keyframes[1] = {"a.png"};
    matte.keyframes[9] = {"b.png"};
    r.matte = matte;
    MatteSource front;
    front.keyframes[4] = {"h.png"};
    r.holdouts = std::vector<MatteSource>{front};
    Zone zone;
    zone.matte.shape.keys[2] = triangle(5);
    zone.value_keys = *parse_keyed_numbers("1:0 9:1");
    r.zones = std::vector<Zone>{zone};
    r.reference_frames = {7, 3};
    r.corrections[5] = {{{1, 1}, {2, 2}}};
    r.placement.scale_keys = *parse_keyed_numbers("1:1:smooth 9:2");
    r.placement.offset_keys = *parse_keyed_numbers("1:0,0 9:10,5", 2);
    r.light.lamps = *parse_lamps("point 1,2 3 4; point 1: 1 2 3 4 | 9: 2 2 3 4");
    return r;
}

// The matte's choke, its holdout's blur and the grid warp, keyed too.
Region with_edges_and_warp() {
    Region r = keyed();
    r.matte =
        r.matte.with([](MatteSource& m) { m.edge.choke_keys = *parse_keyed_numbers("1:0 9:4"); });
    r.holdouts = r.holdouts.with([](std::vector<MatteSource>& holdouts) {
        holdouts[0].edge.blur_keys = *parse_keyed_numbers("3:2");
    });
    r.placement.warp = grid_over({glm::dvec2(0, 0), {8, 0}, {8, 8}, {0, 8}}, 1, 1);
    set_key(*r.placement.warp, 2, r.placement.warp->points);
    std::vector<WarpPoint> moved = r.placement.warp->points;
    moved[0].at = {1, 1};
    set_key(*r.placement.warp, 6, moved);
    return r;
}

std::vector<int> frames_of(const Region& region, const KeyRowId& id) {
    std::vector<int> out;
    for (const KeyRow& row : key_rows(region))
        if (row.id == id)
            for (const KeyMark& key : row.keys)
                out.push_back(key.frame);
    return out;
}

TEST(KeyRows, ShowEverythingThatIsKeyedAndNothingElse) {
    std::vector<KeyRowId> ids;
    for (const KeyRow& row : key_rows(keyed()))
        ids.push_back(row.id);
    EXPECT_THAT(ids,
                ElementsAre(kMatte, kHoldout, KeyRowId{KeyRowKind::kShape, -1}, kReference,
                            KeyRowId{KeyRowKind::kCorrection}, kScale, kOffset,
                            KeyRowId{KeyRowKind::kLamp, 1}, KeyRowId{KeyRowKind::kZoneValue, 0}));
    EXPECT_THAT(key_rows(Region{}), IsEmpty());
    EXPECT_EQ(key_rows(keyed())[5].keys[0].after, KeyInterpolation::kSmooth);
}

TEST(KeyRows, EveryKeyedParameterHasARow) {
    for (const Parameter<Region>& entry : region_parameters()) {
        if (entry.kind != ParameterKind::kKeys) continue;
        const bool edge = entry.full_key().starts_with("matte.");
        const KeyRowId id{edge ? KeyRowKind::kMatteEdge : KeyRowKind::kNumbers, 0,
                          entry.full_key()};
        EXPECT_NE(numbers_of(Region{}, id), nullptr) << id.key;
        EXPECT_LT(range_of(id).min, range_of(id).max);
    }
}

TEST(KeyRows, SeveralKeysMoveTogether) {
    const Region before = keyed();
    const Region after = with_keys_moved(
        before, {{kMatte, 9}, {kScale, 1}, {kScale, 9}, {kReference, 7}, {kHoldout, 4}}, 2);
    EXPECT_THAT(frames_of(after, kMatte), ElementsAre(1, 11));
    EXPECT_EQ(after.matte->keyframes.at(11).path, "b.png");
    EXPECT_THAT(frames_of(after, kScale), ElementsAre(3, 11));
    EXPECT_EQ(after.placement.scale_keys.keys[0].after, KeyInterpolation::kSmooth);
    EXPECT_THAT(after.reference_frames, ElementsAre(9, 3)) << "the first holds the placement";
    EXPECT_THAT(frames_of(after, kHoldout), ElementsAre(6));
    EXPECT_THAT(frames_of(after, kOffset), ElementsAre(1, 9));
    // The edits of the difference lead there, as one step.
    Project project;
    project.regions = {Leaf<Region>(before)};
    const auto edited = apply_edits(project, region_edits(before, after));
    ASSERT_TRUE(edited) << edited.error().text();
    EXPECT_EQ(*edited->regions[0], after);
}

TEST(KeyRows, AMovedKeyReplacesTheOneItArrivesOn) {
    const Region after = with_keys_moved(keyed(), {{kScale, 1}}, 8);
    ASSERT_THAT(after.placement.scale_keys.keys, SizeIs(1));
    EXPECT_EQ(after.placement.scale_keys.at(9)[0], 1);
    // Past each other.
    const Region both = with_keys_moved(keyed(), {{kScale, 1}, {kScale, 9}}, 8);
    EXPECT_THAT(frames_of(both, kScale), ElementsAre(9, 17));
}

TEST(KeyRows, DeletedLayersGoToo) {
    const Region after = without_keys(keyed(), {{kHoldout, 4}, {kScale, 1}, {kScale, 9}});
    EXPECT_THAT(*after.holdouts, IsEmpty());
    EXPECT_TRUE(after.placement.scale_keys.empty());
    EXPECT_THAT(*after.zones, SizeIs(1));
    EXPECT_EQ(without_keys(keyed(), {}), keyed());
    EXPECT_EQ(without_keys(keyed(), {{kScale, 4}}), keyed()) << "no such key";
}

TEST(KeyRows, InterpolationAndValueOfAKeyAreSet) {
    const Region held =
        with_interpolation(keyed(), {{kOffset, 1}, {kMatte, 1}}, KeyInterpolation::kHold);
    EXPECT_EQ(held.placement.offset_keys.at(8), (std::vector<double>{0, 0}));
    EXPECT_EQ(*held.matte, *keyed().matte);
    const Region moved = with_key_value(keyed(), {kOffset, 9}, 1, 77);
    EXPECT_EQ(moved.placement.offset_keys.at(9), (std::vector<double>{10, 77}));
    EXPECT_EQ(with_key_value(keyed(), {kScale, 1}, 0, -5).placement.scale_keys.at(1)[0], 0.001);
    EXPECT_EQ(with_key_value(keyed(), {kScale, 1}, 3, 5), keyed());
    EXPECT_EQ(with_key_value(keyed(), {kScale, 2}, 0, 5), keyed());
    const KeyRowId zone{KeyRowKind::kZoneValue, 0};
    EXPECT_EQ((*with_key_value(keyed(), {zone, 9}, 0, 99).zones)[0].value_keys.at(9)[0], 2);
}

TEST(KeyRows, CopiesLandAtThePlayhead) {
    const Region region = keyed();
    const auto copied = copied_keys(region, {{kScale, 1}, {kOffset, 9}, {kReference, 7}});
    ASSERT_THAT(copied, SizeIs(3));
    const PastedKeys pasted = with_keys_pasted(region, copied, 21);
    EXPECT_THAT(frames_of(pasted.region, kScale), ElementsAre(1, 9, 21));
    EXPECT_EQ(pasted.region.placement.scale_keys.key(21)->after, KeyInterpolation::kSmooth);
    EXPECT_THAT(frames_of(pasted.region, kOffset), ElementsAre(1, 9, 29));
    EXPECT_THAT(pasted.region.reference_frames, ElementsAre(7, 3, 27));
    EXPECT_THAT(pasted.keys, SizeIs(3));
    // Into a region without these layers.
    const auto layers = copied_keys(region, {{kHoldout, 4}, {{KeyRowKind::kLamp, 1}, 9}});
    ASSERT_THAT(layers, SizeIs(2));
    EXPECT_THAT(with_keys_pasted(Region{}, layers, 5).keys, IsEmpty());
    EXPECT_EQ(with_keys_pasted(region, {}, 5).region, region);
}

TEST(KeyRows, AShapeKeepsItsNumberOfPoints) {
    Region region = keyed();
    const KeyRowId row{KeyRowKind::kShape, -1};
    auto copied = copied_keys(region, {{row, 2}});
    ASSERT_THAT(copied, SizeIs(1));
    EXPECT_THAT(frames_of(with_keys_pasted(region, copied, 8).region, row), ElementsAre(2, 8));
    std::get<RotoShape>(copied[0].content).points.pop_back();
    EXPECT_THAT(with_keys_pasted(region, copied, 8).keys, IsEmpty());
}

TEST(KeyRows, EdgesOfEveryMatteAndTheWarpHaveRows) {
    const KeyRowId choke{KeyRowKind::kMatteEdge, 0, "matte.choke_keys"};
    const KeyRowId blur{KeyRowKind::kMatteEdge, 1, "matte.blur_keys"};
    const KeyRowId warp{KeyRowKind::kWarp};
    const Region region = with_edges_and_warp();
    EXPECT_THAT(frames_of(region, choke), ElementsAre(1, 9));
    EXPECT_THAT(frames_of(region, blur), ElementsAre(3));
    EXPECT_THAT(frames_of(region, warp), ElementsAre(2, 6));
    EXPECT_EQ(range_of(choke).min, -200);
    EXPECT_EQ(range_of(blur).min, 0);

    const Region moved = with_keys_moved(region, {{blur, 3}, {warp, 6}}, 2);
    EXPECT_THAT(frames_of(moved, blur), ElementsAre(5));
    EXPECT_THAT(frames_of(moved, warp), ElementsAre(2, 8));
    EXPECT_EQ((*with_key_value(region, {choke, 9}, 0, 500).matte).edge.choke_keys.at(9)[0], 200);

    const Region bare = without_keys(region, {{warp, 2}, {warp, 6}, {choke, 1}, {choke, 9}});
    EXPECT_THAT(frames_of(bare, choke), IsEmpty());
    EXPECT_FALSE(bare.placement.warp->moves());
    EXPECT_EQ(bare.placement.warp->points, region.placement.warp->keys.front().second);
}

TEST(KeyRows, AWarpOfAnotherGridIsNotPasted) {
    const KeyRowId warp{KeyRowKind::kWarp};
    const std::vector<CopiedKey> copied = copied_keys(with_edges_and_warp(), {{warp, 6}});
    Region other = with_edges_and_warp();
    EXPECT_THAT(with_keys_pasted(other, copied, 9).keys, SizeIs(1));
    other.placement.warp = grid_over(other.placement.warp->corners, 2, 2);
    EXPECT_THAT(with_keys_pasted(other, copied, 9).keys, IsEmpty());
    other.placement.warp.reset();
    EXPECT_THAT(with_keys_pasted(other, copied, 9).keys, IsEmpty());
}

}  // namespace
}  // namespace weft
