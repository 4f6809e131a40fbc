#include "texture_db/starter/starter.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "engine/core/parallel.h"
#include "tests/texture_db/scratch.h"
#include "texture_db/describe/near_duplicates.h"
#include "texture_db/describe/sample_codec.h"

namespace weft {
namespace {

TEST(Starter, HasEnoughOfEverything) {
    std::map<std::string, int> materials;
    for (const StarterItem& item : starter_catalogue())
        ++materials[std::string(item.material)];
    EXPECT_GE(starter_catalogue().size(), 1600u);
    EXPECT_GE(materials.size(), 24u);
    for (const char* material : {"fabric", "knit", "leather", "fur"})
        EXPECT_GE(materials[material], 100) << material;
}

TEST(Starter, IsTheSameEveryTimeAndDiffersFromOneToTheNext) {
    // Every 37th: a few of each family.
    NearDuplicates seen;
    int duplicates = 0, made = 0;
    for (std::size_t i = 0; i < starter_catalogue().size(); i += 37) {
        const StarterItem& item = starter_catalogue()[i];
        const StarterPicture once = make_starter(item, 96);
        ASSERT_EQ(once.pixels.size(), (Size{96, 96}));
        if (made % 8 == 0) {
            EXPECT_EQ(once.pixels, make_starter(item, 96).pixels) << item.family;
        }
        EXPECT_FALSE(once.name.empty());
        duplicates += seen.add_if_new(once.pixels) ? 0 : 1;
        ++made;
    }
    EXPECT_LE(duplicates, made / 100);
}

TEST(Starter, ALargerOneShowsMoreOfTheSame) {
    for (const char* family : {"weave", "brick", "fur", "marble"}) {
        StarterItem item;
        for (const StarterItem& i : starter_catalogue())
            if (i.family == family) item = i;
        const ImageU8x3 small = make_starter(item, 96).pixels,
                        large = make_starter(item, 160).pixels;
        // Hollows are darkened by what is around them, which the small one does not see at its far
        // sides; and the border stretches further there.
        std::int64_t difference = 0;
        for (int y = 0; y < 80; ++y)
            for (int x = 0; x < 80; ++x)
                for (int c = 0; c < 3; ++c)
                    difference += std::abs(small.at(x, y, c) - large.at(x, y, c));
        EXPECT_LT(static_cast<double>(difference) / (80 * 80 * 3), 0.5) << family;
    }
}

TEST(Starter, IsTakenUpWhereItWasInterrupted) {
    const Scratch scratch;
    const auto library = open_or_die(scratch.at("a.db"));
    const CancelToken cancel;
    const Status stopped =
        add_starter_textures(*library, cancel, [&](const ProgressEvent&) { cancel.cancel(130); });
    ASSERT_FALSE(stopped);
    EXPECT_EQ(exit_code(stopped.error().code), 130);
    const auto first = *library->size();
    EXPECT_GT(first, 0);
    EXPECT_FALSE(*has_starter_textures(*library));
    int events = 0;
    const CancelToken again;
    ASSERT_FALSE(add_starter_textures(*library, again, [&](const ProgressEvent& e) {
        EXPECT_GT(e.done, first);
        if (++events == 1) again.cancel();
    }));
    EXPECT_GT(*library->size(), first);
}

TEST(Starter, SourcesLeadBackToThePicture) {
    const auto picture = starter_original("brick/3");
    ASSERT_TRUE(picture);
    EXPECT_GT(picture->width(), 96);
    EXPECT_FALSE(starter_original("brick/100000"));
    EXPECT_FALSE(starter_original("../../etc/passwd"));
}

}  // namespace
}  // namespace weft
