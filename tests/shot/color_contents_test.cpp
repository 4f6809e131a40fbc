// What a shot's colour spaces are read from.
#include "app/shot/color_contents.h"

#include <cstdlib>
#include <fstream>

#include "tests/render/shot_fixture.h"

namespace weft::test {
namespace {

class ColorContents : public ShotTest {
  protected:
    void TearDown() override {
        unsetenv("OCIO");
        ShotTest::TearDown();
    }
    void put_table(const std::string& name, const std::string& white) const {
        std::ofstream(in(name)) << "Version 1\nFrom 0 1\nLength 2\nComponents 1\n{\n0\n"
                                << white << "\n}\n";
    }
    // As a new process finds them.
    [[nodiscard]] std::optional<Hash128> contents(const std::string& plate_space) const {
        Project project = spec("out").project;
        project.plate.space = plate_space;
        const auto shot = open_shot(project);
        EXPECT_TRUE(shot) << (shot ? "" : shot.error().text());
        return shot ? color_contents(**shot) : std::nullopt;
    }
};

TEST_F(ColorContents, AreTheConfigAndTheTablesThatAreUsed) {
    put_table("graded.spi1d", ".5");
    put_table("unused.spi1d", ".5");
    std::ofstream(in("config.ocio")) << R"(ocio_profile_version: 2
roles: {default: raw, scene_linear: lin_rec709_srgb}
file_rules:
  - !<Rule> {name: Default, colorspace: default}
displays:
  screen:
    - !<View> {name: Raw, colorspace: raw}
colorspaces:
  - !<ColorSpace> {name: raw, isdata: true}
  - !<ColorSpace> {name: lin_rec709_srgb}
  - !<ColorSpace>
    name: graded
    to_scene_reference: !<FileTransform> {src: graded.spi1d, interpolation: linear}
  - !<ColorSpace>
    name: unused
    to_scene_reference: !<FileTransform> {src: unused.spi1d, interpolation: linear}
)";
    setenv("OCIO", in("config.ocio").c_str(), 1);
    EXPECT_FALSE(contents("srgb")) << "built in";
    const auto before = contents("graded");
    ASSERT_TRUE(before);
    put_table("unused.spi1d", ".25");
    EXPECT_EQ(contents("graded"), before);
    put_table("graded.spi1d", ".25");
    EXPECT_NE(contents("graded"), before);
    put_table("graded.spi1d", ".5");
    EXPECT_EQ(contents("graded"), before);
}

}  // namespace
}  // namespace weft::test
