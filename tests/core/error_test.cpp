#include "engine/core/error.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(Error, PutsItsRemedyBehindItsMessage) {
    Error error = fail(ErrorCode::kUsage, "It is there.", "Choose another.").value();
    EXPECT_EQ(error.sentence(), "It is there. Choose another.");
    error.context = {"frame 7", "wall.weft"};
    EXPECT_EQ(error.text(), "wall.weft: frame 7: It is there. Choose another.");
}

TEST(Error, WithoutAFullStopIsFollowedByAClause) {
    EXPECT_EQ(fail(ErrorCode::kUsage, "it is no name", "remove it").value().sentence(),
              "it is no name; remove it");
}

TEST(Error, MayHaveNoRemedy) {
    EXPECT_EQ(fail(ErrorCode::kInterrupted, "Interrupted.").value().text(), "Interrupted.");
    EXPECT_EQ(fail(ErrorCode::kUsage, "it is no name").value().text(), "it is no name");
}

}  // namespace
}  // namespace weft
