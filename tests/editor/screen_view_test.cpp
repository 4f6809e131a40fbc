// OpenColorIO views in the viewer: the screen must match OpenColorIO's CPU processor.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>

#include "engine/color/screen_view.h"
#include "engine/media/frame_writer.h"
#include "engine/media/image_files.h"
#include "tests/editor/program.h"

namespace weft::test {
namespace {

// Three ways that configs in use go: a curve, a table behind logarithms, and the ACES transform
// that OpenColorIO brings along.
constexpr const char* kConfig = R"(ocio_profile_version: 2
search_path: luts
strictparsing: true
roles: {default: raw, scene_linear: lin_rec709}
file_rules:
  - !<Rule> {name: Default, colorspace: default}
displays:
  monitor:
    - !<View> {name: Plain, colorspace: curve}
    - !<View> {name: Film, colorspace: film}
    - !<View> {name: Video, view_transform: aces, display_colorspace: sRGB display}
  projector:
    - !<View> {name: Halved, colorspace: halved}
active_displays: []
active_views: []
view_transforms:
  - !<ViewTransform>
    name: aces
    from_scene_reference: !<GroupTransform>
      children:
        - !<MatrixTransform> {matrix: [0.439632981919, 0.382988698152, 0.177378319929, 0, 0.089776443588, 0.813439428748, 0.096784127664, 0, 0.017541170383, 0.111546553302, 0.870912276314, 0, 0, 0, 0, 1]}
        - !<BuiltinTransform> {style: ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0}
display_colorspaces:
  - !<ColorSpace>
    name: sRGB display
    from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_sRGB}
colorspaces:
  - !<ColorSpace>
    name: raw
    isdata: true
  - !<ColorSpace>
    name: lin_rec709
  - !<ColorSpace>
    name: curve
    from_scene_reference: !<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055, direction: inverse}
  - !<ColorSpace>
    name: halved
    from_scene_reference: !<MatrixTransform> {matrix: [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1]}
  - !<ColorSpace>
    name: film
    from_scene_reference: !<GroupTransform>
      children:
        - !<LogAffineTransform> {base: 2, lin_side_offset: 0.01, log_side_slope: 0.08, log_side_offset: 0.55}
        - !<FileTransform> {src: film.cube, interpolation: tetrahedral}
)";

void write_config(const Sandbox& sandbox) {
    std::filesystem::create_directories(sandbox.in("luts"));
    std::ofstream(sandbox.in("config.ocio")) << kConfig;
    std::ofstream cube(sandbox.in("luts/film.cube"));
    constexpr int kEdge = 17;
    cube << "LUT_3D_SIZE " << kEdge << "\n";
    const auto curve = [](double v) { return v * v * (3 - 2 * v); };
    for (int b = 0; b < kEdge; ++b)
        for (int g = 0; g < kEdge; ++g)
            for (int r = 0; r < kEdge; ++r) {
                const double rgb[] = {curve(r / 16.0), curve(g / 16.0), curve(b / 16.0)};
                const double grey = (rgb[0] + rgb[1] + rgb[2]) / 3;
                for (const double v : rgb)
                    cube << 0.8 * v + 0.2 * grey << " ";
                cube << "\n";
            }
    setenv("OCIO", sandbox.in("config.ocio").c_str(), 1);
}

// Patches of 40 × 40 pixels, from black to far above 1, grey and in colours.
constexpr int kPatch = 40, kColumns = 12, kRows = 8;

Vec3 patch_color(int column, int row) {
    const float level = std::exp2(static_cast<float>(column) - 7.0f);  // to 16
    constexpr std::array kTints{Vec3(1, 1, 1),       Vec3(1, 0.2f, 0.1f),   Vec3(0.1f, 1, 0.2f),
                                Vec3(0.1f, 0.2f, 1), Vec3(1, 0.9f, 0.1f),   Vec3(0.8f, 0.1f, 1),
                                Vec3(0.1f, 1, 0.9f), Vec3(0.9f, 0.7f, 0.6f)};
    return kTints[static_cast<std::size_t>(row)] * level;
}

void write_patches(const Sandbox& sandbox) {
    std::filesystem::create_directories(sandbox.in("shot"));
    ImageF3 frame(kPatch * kColumns, kPatch * kRows);
    for (int y = 0; y < frame.height(); ++y)
        for (int x = 0; x < frame.width(); ++x) {
            const Vec3 color = patch_color(x / kPatch, y / kPatch);
            for (int c = 0; c < 3; ++c)
                frame.pixel(x, y)[c] = color[c];
        }
    WriteOptions options;
    options.depth = PixelDepth::kFloat;
    ASSERT_TRUE(write_image(sandbox.in("shot/0001.exr"), frame, {}, options));
}

// The corner of the canvas's middle on the screen, out of a list of widgets.
bool canvas_middle(const std::string& path, float& x, float& y) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        float a = 0, b = 0, c = 0, d = 0;
        if (std::sscanf(line.c_str(), "Viewer/Canvas %f %f %f %f", &a, &b, &c, &d) != 4) continue;
        x = (a + c) / 2;
        y = (b + d) / 2;
        return true;
    }
    return false;
}

class ScreenViews : public ::testing::Test {
  protected:
    void TearDown() override { unsetenv("OCIO"); }
    // The worst and the mean difference in codes of a screenshot from the view on the CPU.
    void compare(const Sandbox& sandbox, const ScreenName& name, float gain, double& worst,
                 double& mean) {
        const auto picture = read_image(sandbox.in(name.view + ".png"));
        ASSERT_TRUE(picture) << picture.error().text();
        const auto view = make_screen_view(name);
        ASSERT_TRUE(view) << view.error().text();
        float x0 = 0, y0 = 0;
        ASSERT_TRUE(canvas_middle(sandbox.in("items.txt"), x0, y0));
        worst = mean = 0;
        for (int row = 0; row < kRows; ++row)
            for (int column = 0; column < kColumns; ++column) {
                ImageF3 one(1, 1);
                for (int c = 0; c < 3; ++c)
                    one.pixel(0, 0)[c] = patch_color(column, row)[c] * gain;
                (*view)->pixels->apply(one);
                const int x = static_cast<int>(x0) + kPatch * (column - kColumns / 2) + kPatch / 2;
                const int y = static_cast<int>(y0) + kPatch * (row - kRows / 2) + kPatch / 2;
                for (int c = 0; c < 3; ++c) {
                    const double want = 255 * std::clamp(one.pixel(0, 0)[c], 0.0f, 1.0f);
                    const double off = std::abs(255 * picture->rgb.pixel(x, y)[c] - want);
                    worst = std::max(worst, off);
                    mean += off / (3 * kRows * kColumns);
                }
            }
    }
};

TEST_F(ScreenViews, AreWhatOpenColorIOShows) {
    const Sandbox sandbox;
    write_config(sandbox);
    write_patches(sandbox);
    {
        std::ofstream script(sandbox.in("script.json"));
        script << R"([{"wait_for": "plate"}, {"key": "Ctrl+1"}, {"settle": true, "timeout": 20},
            {"items": ")"
               << sandbox.in("items.txt") << R"("})";
        for (const char* view : {"monitor Plain", "monitor Film", "monitor Video"}) {
            const std::string name = std::string(view).substr(8);
            script << R"(, {"click": "View/Screen"}, {"click": "View/Screen )" << view
                   << R"("}, {"settle": true, "timeout": 20}, {"hover": "Top/File"},
                   {"screenshot": ")"
                   << sandbox.in(name + ".png") << R"("})";
        }
        // Two stops down: what was above 1 must not have been clamped before the view.
        script << R"(, {"click": "View/Screen"}, {"click": "View/Screen projector Halved"},
            {"settle": true, "timeout": 20}, {"repeat": 8, "steps": [{"key": ","}]},
            {"hover": "Top/File"}, {"screenshot": ")"
               << sandbox.in("Halved.png") << R"("}])";
    }
    const Finished done =
        run(sandbox, without_library({"edit", sandbox.in("shot"), "--script",
                                      sandbox.in("script.json"), "--size", "1280x720"}));
    if (cannot_draw(done)) GTEST_SKIP() << done.errors;
    ASSERT_EQ(done.code, 0) << done.errors;
    double worst = 0, mean = 0;
    for (const char* view : {"Plain", "Film", "Video"}) {
        compare(sandbox, {"monitor", view}, 1, worst, mean);
        EXPECT_LE(worst, 1.0) << view;
        EXPECT_LE(mean, 0.35) << view;
    }
    compare(sandbox, {"projector", "Halved"}, 0.25f, worst, mean);
    EXPECT_LE(worst, 1.0);
}

TEST_F(ScreenViews, TheConfigsOwnDefaultIsShownAtFirst) {
    const Sandbox sandbox;
    write_config(sandbox);
    write_patches(sandbox);
    std::ofstream(sandbox.in("script.json"))
        << R"([{"wait_for": "plate"}, {"settle": true, "timeout": 20}, {"key": "Ctrl+1"},
            {"click": "View/Screen"}, {"settle": true, "timeout": 5}, {"items": ")"
        << sandbox.in("items.txt") << R"("}, {"key": "Esc"}, {"hover": "Top/File"},
            {"screenshot": ")"
        << sandbox.in("Plain.png") << R"("}])";
    const Finished done =
        run(sandbox, without_library({"edit", sandbox.in("shot"), "--script",
                                      sandbox.in("script.json"), "--size", "1280x720"}));
    if (cannot_draw(done)) GTEST_SKIP() << done.errors;
    ASSERT_EQ(done.code, 0) << done.errors;
    double worst = 0, mean = 0;
    compare(sandbox, {"monitor", "Plain"}, 1, worst, mean);
    EXPECT_LE(worst, 1.0);
    std::ifstream items(sandbox.in("items.txt"));
    const std::string all(std::istreambuf_iterator<char>(items), {});
    for (const char* name : {"View/Screen sRGB", "View/Screen monitor Film",
                             "View/Screen monitor Video", "View/Screen projector Halved"})
        EXPECT_NE(all.find(name), std::string::npos) << name;
}

}  // namespace
}  // namespace weft::test
