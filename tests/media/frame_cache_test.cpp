#include "engine/media/frame_cache.h"

#include <gmock/gmock.h>

#include <atomic>
#include <map>
#include <mutex>
#include <thread>

#include "engine/media/frame_reader.h"

namespace weft {
namespace {

constexpr std::size_t kFrame_bytes = 10 * 10 * 3 * sizeof(float) + sizeof(PlateFrame);

// Frame n is filled with n. Counts how often each was decoded.
class CountingReader final : public FrameReader {
  public:
    const std::vector<int>& frames() const override { return frames_; }
    Size size() const override { return {10, 10}; }
    double fps() const override { return 25; }
    PixelDepth depth() const override { return PixelDepth::kU8; }
    bool display_encoded() const override { return true; }
    std::string path_of(int frame) const override { return std::to_string(frame); }
    Expected<PlateFrame> read(int frame) const override {
        {
            const std::lock_guard lock(mutex);
            ++reads[frame];
        }
        std::this_thread::sleep_for(delay);
        if (frame == 99) return fail(ErrorCode::kUnreadable, "broken");
        PlateFrame plate;
        plate.rgb = ImageF3(10, 10, static_cast<float>(frame));
        return plate;
    }
    Expected<Hash128> stamp(int frame) const override {
        return Hash128{version.load(), static_cast<std::uint64_t>(frame)};
    }

    mutable std::mutex mutex;
    mutable std::map<int, int> reads;
    std::atomic<std::uint64_t> version{0};
    std::chrono::milliseconds delay{0};

  private:
    std::vector<int> frames_{1, 2, 3, 4, 99};
};

TEST(FrameCache, DecodesOnceWithinTheBudget) {
    const auto reader = std::make_shared<CountingReader>();
    const auto cache = cached(reader, 2 * kFrame_bytes);
    const auto first = cache->read_shared(1).value();
    EXPECT_EQ(first, cache->read_shared(1).value());
    EXPECT_EQ(cache->read(1).value().rgb, ImageF3(10, 10, 1.0f));
    EXPECT_EQ(reader->reads[1], 1);
    EXPECT_EQ(cache->size_bytes(), kFrame_bytes);
    EXPECT_EQ(cache->fps(), 25);
}

TEST(FrameCache, LongestUnusedGoesFirst) {
    const auto reader = std::make_shared<CountingReader>();
    const auto cache = cached(reader, 2 * kFrame_bytes);
    const auto one = cache->read_shared(1).value();
    for (const int f : {2, 1, 3, 1, 2})
        ASSERT_TRUE(cache->read_shared(f));
    EXPECT_EQ(reader->reads[1], 1);
    EXPECT_EQ(reader->reads[2], 2);  // pushed out by 3
    EXPECT_EQ(reader->reads[3], 1);
    EXPECT_LE(cache->size_bytes(), 2 * kFrame_bytes);
    ASSERT_TRUE(cache->read_shared(3));
    ASSERT_TRUE(cache->read_shared(4));
    EXPECT_EQ(one->rgb, ImageF3(10, 10, 1.0f));  // dropped from the cache, still ours
}

TEST(FrameCache, BudgetOfNothingKeepsNothing) {
    const auto reader = std::make_shared<CountingReader>();
    const auto cache = cached(reader, 0);
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(cache->read_shared(2).value()->rgb, ImageF3(10, 10, 2.0f));
    EXPECT_EQ(reader->reads[2], 3);
    EXPECT_EQ(cache->size_bytes(), 0u);
}

TEST(FrameCache, ChangedFileIsReadAgain) {
    const auto reader = std::make_shared<CountingReader>();
    const auto cache = cached(reader, 4 * kFrame_bytes);
    ASSERT_TRUE(cache->read_shared(1));
    reader->version = 1;
    ASSERT_TRUE(cache->read_shared(1));
    EXPECT_EQ(reader->reads[1], 2);
    EXPECT_EQ(cache->size_bytes(), kFrame_bytes);
}

TEST(FrameCache, ErrorsAreNotKept) {
    const auto reader = std::make_shared<CountingReader>();
    const auto cache = cached(reader, 4 * kFrame_bytes);
    EXPECT_EQ(cache->read_shared(99).error().code, ErrorCode::kUnreadable);
    EXPECT_EQ(cache->read(99).error().sentence(), "broken");
    EXPECT_EQ(reader->reads[99], 2);
}

TEST(FrameCache, ThreadsThatAskTogetherDecodeOnce) {
    const auto reader = std::make_shared<CountingReader>();
    reader->delay = std::chrono::milliseconds(30);
    const auto cache = cached(reader, 4 * kFrame_bytes);
    std::vector<std::shared_ptr<const PlateFrame>> seen(8);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < seen.size(); ++t) {
        threads.emplace_back([&, t] { seen[t] = cache->read_shared(t % 2 ? 1 : 2).value(); });
    }
    for (auto& thread : threads)
        thread.join();
    EXPECT_EQ(reader->reads[1], 1);
    EXPECT_EQ(reader->reads[2], 1);
    for (std::size_t t = 0; t < seen.size(); ++t)
        EXPECT_EQ(seen[t], seen[t % 2]);
}

}  // namespace
}  // namespace weft
