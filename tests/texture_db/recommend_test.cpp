#include "texture_db/recommend/recommend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/texture_db/small_library.h"
#include "texture_db/library/library.h"
#include "texture_db/starter/starter.h"

namespace weft {
namespace {

StarterItem starter(const char* family, int number) {
    for (const StarterItem& item : starter_catalogue())
        if (item.family == family && item.number == number) return item;
    return {};
}

// Left brick, right grass; neither of them is in the library.
struct Frame {
    ImageU8x3 plate{320, 160};
    Matte left{320, 160}, right{320, 160};
    Frame() {
        const ImageU8x3 brick = make_starter(starter("brick", 41), 160).pixels,
                        grass = make_starter(starter("grass", 41), 160).pixels;
        for (int y = 0; y < 160; ++y) {
            for (int x = 0; x < 160; ++x) {
                for (int c = 0; c < 3; ++c) {
                    plate.at(x, y, c) = brick.at(x, y, c);
                    plate.at(160 + x, y, c) = grass.at(x, y, c);
                }
                left.at(x, y) = 255;
                right.at(160 + x, y) = 255;
            }
        }
    }
};

RecommendRequest request_for(const Frame& frame) {
    RecommendRequest request;
    request.plate = frame.plate;
    request.regions = {{"wall", frame.left.view(), "", ""}};
    request.count = 8;
    return request;
}

TEST(Recommend, SeesTheRoleAndGivesReasons) {
    const Frame frame;
    RecommendRequest request = request_for(frame);
    request.diversity = 0;
    const auto advice = small_library()->recommend(request);
    ASSERT_TRUE(advice) << advice.error().text();
    const RegionSuggestions& wall = advice->regions[0];
    EXPECT_THAT(wall.seen_as, testing::HasSubstr("a wall"));
    ASSERT_EQ(wall.suggestions.size(), 8u);
    EXPECT_GE(wall.schemes.size(), 4u);
    int bricks = 0;
    for (const Suggestion& s : wall.schemes[0].suggestions) {
        bricks += s.material == "brick" ? 1 : 0;
        EXPECT_FALSE(s.reasons.empty());
        for (const float part : {s.parts.material, s.parts.colour, s.parts.style, s.parts.scale,
                                 s.parts.synthesis, s.score}) {
            EXPECT_GE(part, 0);
            EXPECT_LE(part, 1);
        }
    }
    EXPECT_GE(bricks, 4) << "'like now' finds it";
}

// A green surface without a name: the first suggestions are plants, though its place is as much a
// wall's.
TEST(Recommend, TakesWhatIsGreenForPlants) {
    const Frame frame;
    RecommendRequest request = request_for(frame);
    request.regions = {{"1", frame.right.view(), "", ""}};
    const auto advice = small_library()->recommend(request);
    const std::vector<Suggestion>& green = advice->regions[0].suggestions;
    EXPECT_THAT(green[0].material, testing::AnyOf("grass", "foliage"));
    request.regions = {{"1", frame.left.view(), "", ""}};
    const auto other = small_library()->recommend(request);
    EXPECT_THAT(other->regions[0].suggestions[0].material,
                testing::Not(testing::AnyOf("grass", "foliage")));
}

TEST(Recommend, OffersWhatServesAsTheRegion) {
    const Frame frame;
    RecommendRequest request = request_for(frame);
    const auto share_of = [&](const char* name, const std::set<std::string>& materials) {
        request.regions[0].name = name;
        const auto advice = small_library()->recommend(request);
        int fit = 0;
        for (const Suggestion& s : advice->regions[0].suggestions)
            fit += materials.contains(s.material) ? 1 : 0;
        return fit;
    };
    const std::set<std::string> worn{"fabric", "knit", "leather", "fur", "carpet"};
    EXPECT_GE(share_of("sleeve", worn), 5) << "of eight; one keeps the brick";
    EXPECT_LE(share_of("wall", worn), 1);
}

TEST(Recommend, OffersClothForClothesAmongTheFirstThree) {
    const Frame frame;
    RecommendRequest request = request_for(frame);
    const auto has_cloth = [&](const std::string& name, float diversity) {
        request.regions[0].name = name;
        request.diversity = diversity;
        const auto advice = small_library()->recommend(request);
        const std::vector<Suggestion>& s = advice->regions[0].suggestions;
        return std::any_of(s.begin(), s.begin() + 3, [](const Suggestion& one) {
            return one.material == "fabric" || one.material == "knit";
        });
    };
    for (const char* name : {"shirt", "bedspread", "left sleeve", "jeans", "curtains", "duvet"}) {
        for (const float diversity : {0.0f, 0.35f, 1.0f})
            EXPECT_TRUE(has_cloth(name, diversity)) << name << " " << diversity;
    }
    EXPECT_FALSE(has_cloth("wall", 0.35f));
}

// Sums over the scheme "In harmony".
struct Variety {
    std::set<std::string> materials;
    float score = 0;
    bool best_first = true;
};

TEST(Recommend, VarietyIsPaidForWithScoreByTheMeasureThatIsAsked) {
    const Frame frame;
    RecommendRequest request = request_for(frame);
    const auto variety = [&](float diversity) {
        request.diversity = diversity;
        const auto advice = small_library()->recommend(request);
        Variety out;
        float before = 1;
        for (const Suggestion& s : advice->regions[0].schemes[1].suggestions) {
            out.materials.insert(s.material);
            out.score += s.score;
            out.best_first = out.best_first && s.score <= before;
            before = s.score;
        }
        return out;
    };
    const Variety none = variety(0), little = variety(0.05f), much = variety(0.9f);
    EXPECT_TRUE(none.best_first);
    EXPECT_GT(none.score, little.score);
    EXPECT_GT(little.score, much.score);
    EXPECT_GT(much.materials.size(), none.materials.size());
    EXPECT_GT(little.materials.size(), none.materials.size()) << "any variety is one of materials";
}

TEST(Recommend, WishesAreMet) {
    const Frame frame;
    RecommendRequest request = request_for(frame);
    const auto mean = [&](TextureAttribute attribute) {
        double sum = 0;
        const auto advice = small_library()->recommend(request);
        for (const Suggestion& s : advice->regions[0].suggestions)
            sum += small_library()->info(s.id)->measured.attributes[attribute];
        return sum / 8;
    };
    const double plain = mean(TextureAttribute::kBrightness);
    request.adjust.brighter = 1;
    EXPECT_GT(mean(TextureAttribute::kBrightness), plain + 0.05);
    request.adjust = {};
    request.adjust.rougher = -1;
    const double smooth = mean(TextureAttribute::kRoughness);
    request.adjust.rougher = 1;
    EXPECT_GT(mean(TextureAttribute::kRoughness), smooth);
}

TEST(Recommend, KeepsToTheChosenMaterialAndTheLicences) {
    const Frame frame;
    RecommendRequest request = request_for(frame);
    request.regions[0].material = "leather";
    request.excluded_licences = {"GPL"};
    const auto advice = small_library()->recommend(request);
    ASSERT_FALSE(advice->regions[0].suggestions.empty());
    for (const Suggestion& s : advice->regions[0].suggestions) {
        EXPECT_EQ(s.material, "leather");
        EXPECT_EQ(small_library()->info(s.id)->licence, "CC0-1.0");
    }
}

TEST(Recommend, SeveralRegionsGoTogetherAndOneIsKept) {
    const Frame frame;
    RecommendRequest request = request_for(frame);
    const std::string keep = small_library()->search({})->hits[0].id;
    request.regions.push_back({"ground", frame.right.view(), keep, ""});
    const auto advice = small_library()->recommend(request);
    ASSERT_GE(advice->together.size(), 2u);
    for (const SceneSuggestion& scene : advice->together) {
        ASSERT_EQ(scene.per_region.size(), 2u);
        EXPECT_EQ(scene.per_region[1].id, keep);
        EXPECT_NE(scene.per_region[0].id, keep);
    }
    EXPECT_GE(advice->together[0].score, advice->together[1].score);
}

TEST(Recommend, RefusesWhatMakesNoSense) {
    const Frame frame;
    RecommendRequest request = request_for(frame);
    const Matte empty(320, 160), other(10, 10, 255);
    request.regions[0].matte = empty;
    EXPECT_EQ(small_library()->recommend(request).error().code, ErrorCode::kUsage);
    request.regions[0].matte = other;
    EXPECT_EQ(small_library()->recommend(request).error().code, ErrorCode::kUsage);
}

TEST(Recommend, WorksForRegionsOfEverySize) {
    const Frame frame;
    for (const int side : {4, 12, 30, 90}) {
        Matte small(320, 160);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                small.at(20 + x, 20 + y) = 255;
        RecommendRequest request = request_for(frame);
        request.regions[0].matte = small;
        const auto advice = small_library()->recommend(request);
        ASSERT_TRUE(advice) << side;
        EXPECT_FALSE(advice->regions[0].suggestions.empty()) << side;
    }
}

TEST(Similar, FindsTheOwnMaterialFirst) {
    const auto library = small_library();
    int right = 0, asked = 0;
    for (const char* family :
         {"weave", "leather", "fur", "brick", "grass", "rust", "snow", "roof"}) {
        for (const int number : {45, 46, 47}) {  // not in the library
            const StarterItem item = starter(family, number);
            const auto hits = library->similar(make_starter(item, 96).pixels, 5);
            ASSERT_TRUE(hits && hits->size() == 5u);
            right += (*hits)[0].material == item.material ? 1 : 0;
            ++asked;
        }
    }
    EXPECT_GE(right, asked * 3 / 4) << right << " of " << asked;
}

}  // namespace
}  // namespace weft
