#include "app/shot/texture_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(TextureFile, WhatIsNotThereIsNamed) {
    const auto file = read_texture("/nowhere/wool.png", "");
    ASSERT_FALSE(file);
    EXPECT_THAT(file.error().text(), testing::HasSubstr("/nowhere/wool.png"));
    const auto sample = read_texture("db:00000000", "/nowhere/library.db");
    ASSERT_FALSE(sample);
    EXPECT_THAT(sample.error().text(), testing::HasSubstr("/nowhere/library.db"));
}

}  // namespace
}  // namespace weft
