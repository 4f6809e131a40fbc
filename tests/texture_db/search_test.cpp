// What a search must find. The table is the promise: what must stand on the first page of eight.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/texture_db/small_library.h"
#include "texture_db/describe/material_words.h"
#include "texture_db/search/wordnet.h"

namespace weft {
namespace {

constexpr int kPage = 8;

struct Asked {
    const char* words;
    const char* materials;  ///< Of which the first page must be, space separated; empty: any.
    const char* look = "";  ///< Attribute words that must hold for what is shown.
    bool needs_wordnet = false;
};

// One test for the whole table: each test of this program may run in a process of its own, and all
// of them ask the same library.
const Asked kAsked[]{

    // Materials by their names.
    Asked{"brick", "brick"}, Asked{"stone", "stone"}, Asked{"wood", "wood"},
    Asked{"leather", "leather"}, Asked{"fur", "fur"}, Asked{"knit", "knit"},
    Asked{"grass", "grass"}, Asked{"water", "water"}, Asked{"marble", "marble"},
    Asked{"snow", "snow"}, Asked{"tiles", "tiles"}, Asked{"carpets", "carpet"},
    // Synonyms.
    Asked{"masonry", "brick stone"}, Asked{"timber", "wood"}, Asked{"hide", "leather skin"},
    Asked{"lawn", "grass"}, Asked{"rusty iron", "rust"}, Asked{"cloth", "fabric knit carpet"},
    Asked{"tarmac", "asphalt"}, Asked{"cement", "concrete"}, Asked{"soil", "dirt"},
    Asked{"pebbles", "gravel"}, Asked{"stucco", "plaster"}, Asked{"thatch", "straw"},
    Asked{"porcelain", "ceramic"}, Asked{"magma", "lava"}, Asked{"ocean", "water"},
    Asked{"planks", "wood"}, Asked{"denim", "fabric"}, Asked{"shingles", "roof gravel"},
    Asked{"sweater", "knit"},
    // Wider and narrower words.
    Asked{"textile", "fabric knit carpet"}, Asked{"plant", "grass foliage bark wood straw"},
    Asked{"rock", "stone gravel marble cobblestone"},
    Asked{"ground", "grass dirt sand gravel asphalt snow cobblestone"},
    Asked{"gneiss", "stone gravel marble cobblestone", "", true}, Asked{"mahogany", "wood"},
    Asked{"chinchilla", "fur", "", true}, Asked{"limestone", "stone"}, Asked{"teak", "wood"},
    // What it looks like.
    Asked{"smooth", "", "smooth"}, Asked{"coarse", "", "coarse"}, Asked{"striped", ""},
    Asked{"woven", "fabric straw"}, Asked{"dark green", "", "dark green"}, Asked{"red", ""},
    Asked{"blue fabric", "fabric"}, Asked{"rough grey stone", "stone", "rough grey"},
    Asked{"dark leather", "leather", "dark"}, Asked{"light marble", "marble", "light"},
    Asked{"mossy stone", "stone cobblestone"},
    Asked{"cracked", "plaster dirt concrete leather asphalt ceramic lava"},
    Asked{"brown wood", "wood"}, Asked{"regular tiles", "tiles", "regular"},
    Asked{"wooden floor", "wood tiles carpet"},
    // Misspellings.
    Asked{"leathr", "leather"}, Asked{"timbr", "wood"}, Asked{"cobbelstone", "cobblestone"},
    Asked{"conrete", "concrete"}, Asked{"mable", "marble"}, Asked{"gravle", "gravel"},
    Asked{"striped fabirc", "fabric"}, Asked{"grene grass", "grass"},
    Asked{"concreet wall", "concrete plaster brick stone tiles wallpaper"}};

void check_first_page(TextureLibrary& library, const Asked& asked) {
    SearchQuery query;
    query.text = asked.words;
    query.limit = kPage;
    const auto result = library.search(query);
    ASSERT_TRUE(result) << result.error().text();
    ASSERT_GE(result->hits.size(), 1u) << "nothing was found";
    const auto materials = split_words(asked.materials), looks = split_words(asked.look);
    int right = 0;
    for (const SearchHit& hit : result->hits) {
        const bool material = materials.empty() || std::find(materials.begin(), materials.end(),
                                                             hit.material) != materials.end();
        const auto info = library.info(hit.id);
        const bool look = std::all_of(looks.begin(), looks.end(), [&](const std::string& word) {
            return attribute_match(word, info->measured) > 0.05f;
        });
        right += material && look ? 1 : 0;
        EXPECT_FALSE(hit.reasons.empty()) << hit.name;
    }
    // Nine of ten.
    EXPECT_GE(10 * right, 9 * static_cast<int>(result->hits.size()))
        << right << " of " << result->hits.size() << ", first: " << result->hits[0].material << " "
        << result->hits[0].name;
}

TEST(Search, FirstPagesOfSixtyQueries) {
    const auto library = small_library();
    ASSERT_TRUE(library);
    EXPECT_GE(std::size(kAsked), 60u);
    const bool wordnet = WordNet::open().has_value();
    for (const Asked& asked : kAsked) {
        SCOPED_TRACE(asked.words);
        if (asked.needs_wordnet && !wordnet) continue;
        check_first_page(*library, asked);
    }
}

TEST(Search, PagesDoNotOverlapAndCountsAgree) {
    const auto library = small_library();
    ASSERT_TRUE(library);
    SearchQuery query;
    query.text = "stone";
    query.limit = 5;
    const auto first = library->search(query);
    query.offset = 5;
    const auto second = library->search(query);
    std::set<std::string> ids;
    for (const auto* page : {&*first, &*second})
        for (const SearchHit& hit : page->hits)
            ids.insert(hit.id);
    EXPECT_EQ(ids.size(), 10u);
    int counted = 0;
    for (const FacetCount& f : first->materials)
        counted += f.count;
    EXPECT_EQ(counted, first->total);
    query.offset = first->total + 3;
    EXPECT_TRUE(library->search(query)->hits.empty());
}

TEST(Search, FiltersHoldTogether) {
    const auto library = small_library();
    ASSERT_TRUE(library);
    SearchQuery query;
    query.materials = {"brick", "wood"};
    query.excluded_licences = {"GPL"};
    const auto result = library->search(query);
    ASSERT_EQ(result->total, 10);
    for (const SearchHit& hit : result->hits) {
        EXPECT_THAT(hit.material, testing::AnyOf("brick", "wood"));
        EXPECT_EQ(library->info(hit.id)->licence, "CC0-1.0");
    }
    query.origins = {TextureOrigin::kFile};
    EXPECT_EQ(library->search(query)->total, 0);
}

TEST(Search, SortsAndTurnsRound) {
    const auto library = small_library();
    SearchQuery query;
    query.sort = TextureSort::kBrightness;
    query.limit = 1000;
    const auto up = library->search(query);
    query.descending = true;
    const auto down = library->search(query);
    ASSERT_EQ(up->hits.size(), down->hits.size());
    EXPECT_EQ(up->hits.front().id, down->hits.back().id);
    EXPECT_LT(library->info(up->hits.front().id)->measured.mean.l,
              library->info(up->hits.back().id)->measured.mean.l);
}

TEST(Search, SaysWhatItUnderstoodAndWhatNot) {
    const auto library = small_library();
    SearchQuery query;
    query.text = "timbr";
    EXPECT_THAT(library->search(query)->understood,
                testing::Contains(testing::HasSubstr("timber")));
    query.text = "xqzzkw";
    const auto nothing = library->search(query);
    EXPECT_EQ(nothing->total, 0);
    EXPECT_THAT(nothing->ignored, testing::ElementsAre("xqzzkw"));
    query.text = "wood cable";
    const auto nearest = library->search(query);
    EXPECT_GT(nearest->total, 0);
    EXPECT_THAT(nearest->missing, testing::ElementsAre("cable"));
    query.text = "wood";
    EXPECT_THAT(library->search(query)->missing, testing::IsEmpty());
    query.text = "\"wood\" AND ( OR *";
    EXPECT_TRUE(library->search(query)) << "no syntax of the index gets through";
}

TEST(Search, NotTakesAway) {
    const auto library = small_library();
    SearchQuery query;
    query.text = "rock -stone";
    const auto found = library->search(query);
    ASSERT_TRUE(found);
    for (const SearchHit& hit : found->hits)
        EXPECT_NE(hit.material, "stone");
}

}  // namespace
}  // namespace weft
