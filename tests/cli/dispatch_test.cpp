// The same bytes for all instruction sets of Weft and the libraries.
#include <cmath>

#include "engine/media/frame_writer.h"
#include "tests/cli/cli_fixture.h"

namespace weft::test {
namespace {

class Dispatch : public CliTest {
  protected:
    // Motion, form, a rotated synthesized texture, light, grain and defocus: everything that
    // computes with floats.
    std::map<std::string, std::string> rendered_with(const std::string& variable,
                                                     const std::string& value) {
        options_.environment[variable] = value;
        const std::string out = "out_" + std::to_string(runs_++);
        expect_success(
            run({"replace", "--plate", "frames/####.exr", "--matte", "masks/####.png", "--texture",
                 "sample.png", "--rotate", "17", "--position-pass", "column.exr", "-o",
                 out + "/####.exr", "--layers", "all", "--backend", "cpu", "--no-cache"}));
        options_.environment.erase(variable);
        return contents(out);
    }
    // A column that turns away to both sides.
    void write_column() const {
        ImageF3 place(Card::kPlate);
        for (int y = 0; y < place.height(); ++y) {
            for (int x = 0; x < place.width(); ++x) {
                const float s = (static_cast<float>(x) - 70) / 120;
                float* p = place.pixel(x, y);
                p[0] = s, p[1] = 0.01f * static_cast<float>(y), p[2] = std::sqrt(1 - s * s);
            }
        }
        WriteOptions options;
        options.depth = PixelDepth::kFloat;
        ASSERT_TRUE(write_image(in("column.exr"), place, {}, options));
    }
    int runs_ = 0;
};

TEST_F(Dispatch, InstructionSetsGiveTheSameBytes) {
    make_shot(3, 1, ".exr", PixelDepth::kFloat);
    write_column();
    const auto plain = rendered_with("UNSET", "");
    ASSERT_EQ(plain.size(), 3u);
    EXPECT_EQ(rendered_with("WEFT_ISA", "scalar"), plain);
    if (__builtin_cpu_supports("avx2")) {
        EXPECT_EQ(rendered_with("WEFT_ISA", "avx2"), plain);
    }
    if (__builtin_cpu_supports("avx512bw")) {
        EXPECT_EQ(rendered_with("WEFT_ISA", "avx512"), plain);
    }
    EXPECT_EQ(rendered_with("OPENCV_CPU_DISABLE", "AVX512-SKX,AVX2,FMA3,AVX,SSE4.2,SSE4.1,SSSE3"),
              plain);
    EXPECT_EQ(rendered_with("OPENCV_CPU_DISABLE", "AVX2"), plain);
    EXPECT_EQ(rendered_with("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX512F,-AVX2,-FMA,-FMA4"), plain);
    EXPECT_EQ(rendered_with("OPENBLAS_CORETYPE", "Prescott"), plain);
    EXPECT_EQ(rendered_with("JSIMD_FORCENONE", "1"), plain);
}

}  // namespace
}  // namespace weft::test
