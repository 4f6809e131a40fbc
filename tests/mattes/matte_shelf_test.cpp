// Repeated requests read a matte once.
#include "app/mattes/matte_shelf.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>

namespace weft::test {
namespace {

bool wait(const std::function<bool()>& done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!done()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::yield();
    }
    return true;
}

// Every frame that is drawn asks, also while the matte is being read.
TEST(MatteShelf, APendingMatteIsNotReadAgain) {
    MatteShelf shelf;
    std::atomic<int> reads = 0;
    std::atomic<bool> go = false;
    const auto read = [&]() -> Expected<Matte> {
        ++reads;
        wait([&] { return go.load(); });
        return Matte(4, 3, 9);
    };
    EXPECT_EQ(shelf.get("matte", read), nullptr);
    ASSERT_TRUE(wait([&] { return reads == 1; }));
    for (int frame = 0; frame < 20; ++frame)
        EXPECT_EQ(shelf.get("matte", read), nullptr);
    go = true;
    ASSERT_TRUE(wait([&] { return shelf.get("matte", read) != nullptr; }));
    // What was asked for behind it has been read by then.
    ASSERT_TRUE(wait([&] {
        return shelf.get("another", []() -> Expected<Matte> { return Matte(4, 3); }) != nullptr;
    }));
    EXPECT_EQ(reads, 1);
    EXPECT_EQ(shelf.get("matte", read)->at(2, 1), 9);
}

TEST(MatteShelf, UnwrittenMattesStayInMemory) {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("weft_mattes_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "file") << "no folder";
    const std::string good = (folder / "m.png").string(), bad = (folder / "file/m.png").string();
    MatteShelf shelf(1);  // no room at all
    shelf.write(bad, std::make_shared<const Matte>(4, 3, std::uint8_t{7}));
    shelf.write(good, std::make_shared<const Matte>(4, 3, std::uint8_t{8}));
    shelf.flush();
    EXPECT_FALSE(shelf.writing());
    EXPECT_FALSE(shelf.take_write_error().empty());
    ASSERT_EQ(shelf.unwritten().size(), 1u);
    EXPECT_EQ(shelf.unwritten().begin()->first, bad);
    const MattePtr kept = shelf.get(bad, {});
    ASSERT_NE(kept, nullptr) << "the artist's work is not lost while the program runs";
    EXPECT_EQ(kept->at(1, 1), 7);
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace weft::test
