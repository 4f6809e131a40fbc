// 3840×2160: the memory of a render does not grow with the shot.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/cli/cli_fixture.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;

class Memory : public CliTest {
  protected:
    // Eight different panning plates, forwards and backwards; the rest are links to them.
    void make_4k(int count) {
        constexpr Size kSize{3840, 2160};
        constexpr int kPictures = 8, kPan_px = 5;
        fs::create_directories(folder_ / "big");
        const ImageF3 wide = pattern_picture({kSize.width + kPictures * kPan_px, kSize.height}, 5);
        for (int k = 0; k < kPictures; ++k) {
            ImageF3 plate(kSize);
            for (int y = 0; y < kSize.height; ++y)
                std::copy_n(wide.pixel(k * kPan_px, y), 3 * kSize.width, plate.pixel(0, y));
            put_picture("k" + std::to_string(k) + ".jpg", plate);
        }
        for (int frame = 0; frame < count; ++frame) {
            const int phase = frame % (2 * kPictures - 2);
            const int k = phase < kPictures ? phase : 2 * kPictures - 2 - phase;
            char name[32];
            std::snprintf(name, sizeof name, "big/%04d.jpg", frame + 1);
            fs::create_symlink(in("k" + std::to_string(k) + ".jpg"), in(name));
        }
        Matte matte(kSize, 0);
        for (int y = 400; y < 1800; ++y)
            std::fill_n(matte.pixel(600, y), 2600, std::uint8_t{255});
        put_matte("big.png", matte);
    }

    double peak_bytes(const std::string& frames, const std::string& quality,
                      const std::string& threads = "2", const std::string& memory = "0") const {
        const Outcome outcome = run(
            {"replace",    "--plate",    "big/####.jpg", "--matte",  "big.png",
             "--texture",  "sample.png", "--frames",     frames,     "--quality",
             quality,      "--threads",  threads,        "--memory", memory,
             "--no-cache", "--backend",  "cpu",          "-o",       "out_" + frames + "/####.jpg",
             "--json",     "--progress", "none"});
        expect_success(outcome);
        fs::remove_all(folder_ / ("out_" + frames));
        return outcome.exit == 0
                   ? nlohmann::json::parse(outcome.out)["peak_rss_bytes"].get<double>()
                   : 0;
    }
};

TEST_F(Memory, DoesNotGrowWithTheNumberOfFrames) {
    make_4k(100);
    const double twenty = peak_bytes("1-20", "draft"), hundred = peak_bytes("1-100", "draft");
    std::printf("draft: 20 frames %.0f MB, 100 frames %.0f MB\n", twenty / 1e6, hundred / 1e6);
    // How many frames are in flight at the peak varies by one between runs: a picture of floats,
    // decoded samples and its views. One byte a pixel kept of each frame would be 660 MB.
    EXPECT_LT(hundred - twenty, 3840.0 * 2160 * 18);
    EXPECT_LT(std::max(twenty, hundred), 3e9);
    const double best = peak_bytes("1-6", "final");
    std::printf("final: 6 frames %.0f MB\n", best / 1e6);
    EXPECT_LT(best, 3e9);
}

TEST_F(Memory, AJobRespectsItsLimit) {
    make_4k(8);
    const double kept = peak_bytes("1-8", "final", "4", "2G");
    std::printf("final, 8 frames, four threads, --memory 2G: %.0f MB\n", kept / 1e6);
    EXPECT_LT(kept, 2.0 * (1u << 30));
}

}  // namespace
}  // namespace weft::test
