#include "app/mattes/edged_matte.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace weft::test {
namespace {

MattePtr square() {
    auto matte = std::make_shared<Matte>(40, 30);
    for (int y = 10; y < 20; ++y)
        for (int x = 10; x < 30; ++x)
            matte->at(x, y) = 255;
    return matte;
}

TEST(EdgedMatte, ShowsTheLastEdgeUntilTheNextIsMade) {
    MatteShelf shelf;
    EdgedMatte edged;
    const MattePtr matte = square();
    EXPECT_EQ(edged.of(matte, {}, "m", shelf), nullptr);
    const auto made = [&](float choke) {
        const Matte wanted = with_edge(*matte, {.choke_px = choke});
        const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
        while (std::chrono::steady_clock::now() < end) {
            const MattePtr shown = edged.of(matte, {.choke_px = choke}, "m", shelf);
            if (shown && *shown == wanted) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return false;
    };
    EXPECT_TRUE(made(2));
    const MattePtr other = edged.of(matte, {.choke_px = 3}, "m", shelf);
    EXPECT_NE(other, nullptr) << "the one before is shown";
    EXPECT_TRUE(made(4));
    EXPECT_EQ(edged.of(matte, {}, "m", shelf), nullptr);
    EXPECT_EQ(edged.of(square(), {.choke_px = 5}, "n", shelf), nullptr) << "another matte";
}

}  // namespace
}  // namespace weft::test
