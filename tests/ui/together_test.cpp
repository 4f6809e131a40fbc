// Texture sets for all regions: requesting, browsing, keeping textures, applying.
#include <cmath>

#include "tests/ui/ui_harness.h"
#include "texture_db/library/library.h"

namespace weft::test {
namespace {

class Together : public SessionTest {
  protected:
    // A library of a few stones, cloths and woods in several colours.
    void make_library() {
        library_path_ = (folder / "library.wtl").string();
        auto library = TextureLibrary::open(library_path_);
        ASSERT_TRUE(library) << library.error().text();
        std::vector<NewTexture> all;
        int number = 0;
        for (const char* material : {"stone", "fabric", "wood"}) {
            for (int hue = 0; hue < 6; ++hue, ++number) {
                NewTexture one;
                one.pixels = ImageU8x3(96, 96);
                for (int y = 0; y < 96; ++y)
                    for (int x = 0; x < 96; ++x)
                        for (int c = 0; c < 3; ++c)
                            one.pixels.pixel(x, y)[c] = static_cast<std::uint8_t>(
                                90 + 70 * ((hue >> c) & 1) +
                                30 * std::sin(0.1 * (number + 2) * x) * std::cos(0.13 * y) +
                                (x * 5 + y * 3 + number) % 11);
                one.name = std::string(material) + " " + std::to_string(hue);
                one.material = material;
                one.author = "Ada";
                one.licence = "CC0-1.0";
                one.source = one.name;
                all.push_back(std::move(one));
            }
        }
        ASSERT_EQ((*library)->add(all), 18);
    }
    void open_two_regions() {
        restart_session(library_path_);
        shell->textures().open_library(library_path_);
        session->act(OpenAny{(folder / "frames").string()});
        ASSERT_TRUE(wait([&] { return session->view().plate_picture != nullptr; }));
        robot->frames(3);
        shell->state().brush.brush.radius_px = 8;
        for (const float x : {30.0f, 70.0f}) {
            robot->key("Ctrl+Shift+N");
            robot->key("B");
            robot->frames(3);
            robot->stroke({at(x, 20), at(x, 32), at(x, 44)});
            robot->frames(3);
        }
        session->flush();
        robot->key("F6");
        robot->frames(3);
        ASSERT_TRUE(wait([&] { return robot->find("All regions together") != nullptr; }));
        ASSERT_TRUE(robot->click("All regions together"));
    }
    [[nodiscard]] std::string texture(std::size_t region) const {
        return session->view().project.regions[region]->texture.sample;
    }
    bool offered() {
        return wait([&] { return robot->find("Together/Apply set 1") != nullptr; });
    }
    std::string library_path_;
};

TEST_F(Together, ASetIsAppliedInOneStepAndTexturesCanBeKept) {
    make_library();
    open_two_regions();
    ASSERT_TRUE(offered());
    ASSERT_TRUE(robot->click("Together/Apply set 1"));
    ASSERT_TRUE(wait([&] { return !texture(0).empty() && !texture(1).empty(); }));
    const std::string first = texture(0), second = texture(1);
    const std::size_t steps = session->view().history_position;
    // Keep the first region's, change the other's.
    const std::string name = session->view().project.regions[0]->name;
    ASSERT_TRUE(wait([&] { return robot->find("Together/Keep " + name) != nullptr; }));
    ASSERT_TRUE(robot->click("Together/Keep " + name));
    ASSERT_TRUE(offered());
    if (robot->find("Together/Shuffle")) {
        ASSERT_TRUE(robot->click("Together/Shuffle"));
        robot->frames(2);
        ASSERT_TRUE(offered());
    }
    ASSERT_TRUE(robot->click("Together/Apply set 1"));
    ASSERT_TRUE(wait([&] { return session->view().history_position > steps; }));
    EXPECT_EQ(texture(0), first) << "it was to be kept";
    EXPECT_NE(texture(1), second);
    EXPECT_EQ(session->view().history_position, steps + 1) << "one step of the history";
    robot->key("Ctrl+Z");
    robot->frames(2);
    EXPECT_EQ(texture(1), second);
    robot->key("Ctrl+Z");
    robot->frames(2);
    EXPECT_EQ(texture(0), "");
    EXPECT_EQ(texture(1), "");
}

TEST_F(Together, OneRegionIsNotEnough) {
    make_library();
    open_two_regions();
    ASSERT_TRUE(offered());
    // On another frame, before the mattes are propagated, no set of two is offered.
    session->act(
        DoEdit{SetRegionParameter{{session->view().project.regions[1]->id, {}}, "enabled", false}});
    robot->frames(3);
    EXPECT_EQ(robot->find("Together/Apply set 1"), nullptr);
}

}  // namespace
}  // namespace weft::test
