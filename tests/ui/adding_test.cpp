// Importing a folder of textures into the library through the window.
#include <cmath>

#include "engine/media/frame_writer.h"
#include "tests/ui/ui_harness.h"
#include "texture_db/library/library.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

NewTexture grey_sample() {
    NewTexture one;
    one.pixels = ImageU8x3(96, 96, 90);
    one.name = "grey";
    one.material = "stone";
    one.author = "Bo";
    one.licence = "CC0-1.0";
    one.source = "grey";
    return one;
}

class Adding : public SessionTest {
  protected:
    void open_with_a_library() {
        path_ = (folder / "library.wtl").string();
        {
            auto library = TextureLibrary::open(path_);
            ASSERT_TRUE(library) << library.error().text();
            ASSERT_TRUE((*library)->add({grey_sample()}));
        }
        fs::create_directories(folder / "mine/wood");
        ImageF3 picture(220, 220);
        for (int y = 0; y < 220; ++y)
            for (int x = 0; x < 220; ++x)
                for (int c = 0; c < 3; ++c)
                    picture.at(x, y, c) =
                        0.3f +
                        0.2f *
                            std::sin(0.4f * static_cast<float>(x) + 0.05f * static_cast<float>(y)) +
                        0.002f * static_cast<float>((x * 31 + y * 17 + 7 * c) % 41);
        ASSERT_TRUE(write_image((folder / "mine/wood/plank.png").string(), picture, {}, {}));
        restart_session(path_);
        shell->textures().open_library(path_);
        session->act(OpenAny{(folder / "frames").string()});
        ASSERT_TRUE(wait([&] { return session->view().plate_picture != nullptr; }));
        set_workspace(shell->state(), Workspace::kTexture);
        ASSERT_TRUE(wait([&] { return cards() > 0; }));
        shell->state().adding.folder = (folder / "mine").string();
        shell->state().adding.open = true;
        robot->frames(3);
    }
    [[nodiscard]] std::size_t cards() const { return shell->textures().cards()->size(); }

  private:
    std::string path_;
};

TEST_F(Adding, ImagesAreImportedWithAuthorAndLicence) {
    open_with_a_library();
    shell->state().adding.author = "Ada";
    shell->state().adding.licence = "CC-BY-4.0";
    ASSERT_TRUE(robot->click("Add textures/Add"));
    ASSERT_TRUE(wait([&] { return !shell->textures().importing().running; }));
    EXPECT_THAT(shell->textures().importing().outcome, HasSubstr("from 1 image."));
    TextureCard added;
    ASSERT_TRUE(wait([&] {
        for (const TextureCard& card : *shell->textures().cards())
            if (card.name.starts_with("Plank")) added = card;
        return !added.path.empty();
    }));
    EXPECT_EQ(added.material, "Wood");
    ASSERT_TRUE(wait([&] { return !shell->textures().details(added).author.empty(); }));
    EXPECT_EQ(shell->textures().details(added).licence, "CC-BY-4.0");
    EXPECT_EQ(shell->textures().details(added).author, "Ada");
    ASSERT_TRUE(robot->click("Add textures/Close"));
    robot->frames(2);
    EXPECT_FALSE(shell->state().adding.open);
    // Importing again adds nothing, and the outcome says so.
    shell->textures().import_folder({(folder / "mine").string(), "Ada", "CC-BY-4.0", false});
    ASSERT_TRUE(wait([&] { return !shell->textures().importing().running; }));
    EXPECT_THAT(shell->textures().importing().outcome, HasSubstr("was skipped: already imported"));
    shell->textures().import_folder({(folder / "gone").string(), {}, {}, false});
    ASSERT_TRUE(wait([&] { return !shell->textures().importing().running; }));
    EXPECT_TRUE(shell->textures().importing().failed);
    EXPECT_THAT(shell->textures().importing().outcome, HasSubstr("gone"));
}

TEST_F(Adding, AFolderCanBeBrowsedWithoutImport) {
    open_with_a_library();
    ASSERT_TRUE(robot->click("Add textures/Browse folder only"));
    robot->frames(2);
    ASSERT_TRUE(robot->click("Add textures/Add"));
    robot->frames(3);
    EXPECT_FALSE(shell->state().adding.open);
    EXPECT_THAT(settings.texture_folders, ::testing::Contains((folder / "mine").string()));
}

}  // namespace
}  // namespace weft::test
