#include "texture_db/catalogue/licence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace weft {
namespace {

struct Case {
    const char* licence;
    const char* excluded;
    bool refused;
};
class Policy : public testing::TestWithParam<Case> {};
TEST_P(Policy, JudgesAsMeant) {
    EXPECT_EQ(licence_excluded(GetParam().licence, {GetParam().excluded}), GetParam().refused);
}
INSTANTIATE_TEST_SUITE_P(
    Licences, Policy,
    testing::Values(Case{"GPL-2+", "GPL", true}, Case{"gpl-3", "GPL", true},
                    Case{"LGPL-2.1", "GPL", false}, Case{"GPL-2+", "GPL-2+", true},
                    Case{"GPL-3", "GPL-2", false}, Case{"CC-BY-SA-3.0", "CC-BY-SA", true},
                    Case{"CC-BY-SA-3.0", "CC-BY", false}, Case{"CC-BY-3.0", "CC-BY", true},
                    Case{"CC-BY-3.0", "CC-BY-SA", false}, Case{"CC-BY-SA-3.0", "copyleft", true},
                    Case{"CC-BY-3.0", "copyleft", false},
                    Case{"CC-BY-NC-4.0", "non-commercial", true},
                    Case{"CC0-1.0", "attribution", false}, Case{"CC-BY-4.0", "attribution", true},
                    Case{"unknown", "unknown", true}, Case{"", "unknown", true},
                    Case{"GPL-2+ or CC-BY-3.0", "GPL", false},
                    Case{"GPL-2+ and CC-BY-3.0", "GPL", true}));

TEST(Policy, RefusesWithTheExitCodeAndNamesTheTextures) {
    const std::vector<TextureCredit> used{{"wall", "1", "bricks", "brick", "Jane", "GPL-2+", "x"},
                                          {"floor", "2", "oak", "wood", "", "CC0-1.0", "y"}};
    EXPECT_TRUE(check_licences(used, {}));
    EXPECT_TRUE(check_licences(used, {"CC-BY-SA"}));
    const Status refused = check_licences(used, {"GPL"});
    ASSERT_FALSE(refused);
    EXPECT_EQ(exit_code(refused.error().code), 7);
    EXPECT_THAT(refused.error().sentence(),
                testing::AllOf(testing::HasSubstr("bricks"), testing::HasSubstr("wall"),
                               testing::HasSubstr("Jane")));
    EXPECT_THAT(refused.error().sentence(), testing::Not(testing::HasSubstr("oak")));
}

TEST(Policy, RefusesNamesThatNobodyKnows) {
    const std::vector<TextureCredit> used{
        {"wall", "1", "bricks", "brick", "Jane", "Studio-internal", "x"}};
    for (const char* known : {"gpl", "GPL-2+", "BSD-3-Clause", "CC-BY-NC-SA-4.0", "copyleft",
                              "unknown", "public-domain"})
        EXPECT_TRUE(check_licences(used, {known})) << known;
    const Status slip = check_licences(used, {"GPL", "GLP"});
    ASSERT_FALSE(slip);
    EXPECT_EQ(slip.error().code, ErrorCode::kUsage);
    EXPECT_THAT(slip.error().sentence(),
                testing::AllOf(testing::HasSubstr("'GLP'"), testing::HasSubstr("CC-BY-SA"),
                               testing::HasSubstr("non-commercial")));
    // A studio's own licence is known where a texture has it.
    const Status own = check_licences(used, {"Studio-internal"});
    ASSERT_FALSE(own);
    EXPECT_EQ(own.error().code, ErrorCode::kRefused);
}

}  // namespace
}  // namespace weft
