#pragma once
// A folder of its own for every test, and pictures to put there.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/core/rng.h"
#include "engine/media/frame_writer.h"

namespace weft {

inline constexpr auto kForward = MotionDirection::kForward;
inline constexpr auto kBackward = MotionDirection::kBackward;

class MediaTest : public ::testing::Test {
  protected:
    void SetUp() override {
        std::string name = (std::filesystem::temp_directory_path() / "weft_media_XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        folder_ = name;
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::string in(const std::string& name) const { return (folder_ / name).string(); }

    /// Every name in the folder, hidden ones too.
    std::vector<std::string> names() const {
        std::vector<std::string> found;
        for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
            found.push_back(entry.path().filename().string());
        }
        std::sort(found.begin(), found.end());
        return found;
    }

    std::filesystem::path folder_;
};

inline std::vector<char> bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return std::vector<char>(std::istreambuf_iterator<char>(file), {});
}

inline void put_bytes(const std::string& path, const std::vector<char>& bytes, std::size_t count) {
    std::ofstream(path, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(std::min(count, bytes.size())));
}

/// Random codes of an integer depth, scaled to [0, 1] as a reader would.
inline ImageF3 random_codes(Size size, int max_code, std::uint64_t seed) {
    ImageF3 image(size);
    Rng rng(seed);
    for (std::size_t i = 0; i < image.size_bytes() / sizeof(float); ++i) {
        image.data()[i] = static_cast<float>(rng.below(static_cast<std::uint64_t>(max_code) + 1)) /
                          static_cast<float>(max_code);
    }
    return image;
}

/// Smooth colours with a little detail, so that codecs have something to predict.
inline ImageF3 picture(Size size, int phase) {
    ImageF3 image(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            image.at(x, y, 0) = static_cast<float>((x * 3 + phase * 5) % 256) / 255.0f;
            image.at(x, y, 1) = static_cast<float>((y * 2 + x / 8) % 256) / 255.0f;
            image.at(x, y, 2) = static_cast<float>((x + y + phase * 9) % 256) / 255.0f;
        }
    }
    return image;
}

inline void put_frame(const std::string& path, const ImageF3& image,
                      PixelDepth depth = PixelDepth::kU8) {
    WriteOptions options;
    options.depth = depth;
    options.rule = WriteRule::own();
    const Status status = write_image(path, image, {}, options);
    ASSERT_TRUE(status) << status.error().text();
}

/// Files that are read back after they were written, here under the name "shown.…".
class ReadBackTest : public MediaTest {
  protected:
    static constexpr Size kSize{40, 30};

    void cut(const std::string& name, double share) const {
        const auto bytes = bytes_of(in(name));
        put_bytes(in(name), bytes, static_cast<std::size_t>(share * double(bytes.size())));
    }
    static void expect_refused(const Status& status, const std::string& part) {
        ASSERT_FALSE(status);
        EXPECT_EQ(status.error().code, ErrorCode::kRenderFailed);
        EXPECT_THAT(status.error().sentence(), ::testing::HasSubstr("shown."));
        EXPECT_THAT(status.error().sentence(), ::testing::HasSubstr(part));
    }
};

}  // namespace weft
