// A surface that is painted flat. Most programs here are scripts: one that writes the picture that
// it was given beforehand, as `weft flatten` does, and a paint program that says what it was
// started with.
#include <fstream>

#include "app/exchange/flat_picture.h"
#include "tests/session/session_fixture.h"
#include "tests/support/places.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

class FlatPaintingByActions : public test::SessionByActions {
  protected:
    void open_with(const std::string& flatten) { open_by(script("weft", flatten)); }
    void open_by(const std::string& program) {
        SessionOptions options;
        options.program = program;
        options.state_folder = in("state");
        options.cache.folder = in("cache");
        options.trust_file = in("trusted.json");
        session_ = std::make_unique<Session>(options);
        act(OpenAny{in("frames")});
        ASSERT_TRUE(wait([&] { return view().plate_picture != nullptr; }));
        Region wall;
        wall.name = "the wall";
        act(DoEdit{AddRegion{wall, {}}});
        update();
        paint();
        act(SaveAs{in("shot.weft")});
        ASSERT_TRUE(wait([&] { return view().path == in("shot.weft") && !view().saving; }));
    }
    std::string script(const std::string& name, const std::string& text) {
        std::string path = in(name);
        std::ofstream(path) << "#!/bin/sh\n" << text << "\n";
        fs::permissions(path, fs::perms::owner_all);
        return path;
    }
    // A flat picture of the shot: twice the plate's size.
    std::string picture(const std::string& name, float grey) {
        EXPECT_TRUE(write_image(in(name), ImageF3(192, 128, grey), {}, {}));
        return in(name);
    }
    // Takes -o's value, the argument after it.
    static std::string copies(const std::string& from) {
        return "while [ \"$1\" != -o ]; do shift; done\n"
               "echo '{\"stage\":\"analyse\",\"done\":1,\"total\":4}'\ncp '" +
               from + "' \"$2\"";
    }
    std::string painter() { return script("painter", "echo \"$1\" > '" + in("opened") + "'"); }
    bool says(const std::string& part) {
        return std::any_of(view().notices.begin(), view().notices.end(), [&](const Notice& one) {
            return one.text.find(part) != std::string::npos;
        });
    }
    std::string opened() {
        std::string line;
        std::ifstream file(in("opened"));
        std::getline(file, line);
        return line;
    }
};

TEST_F(FlatPaintingByActions, WritesThePictureTakesItAndOpensIt) {
    open_with(copies(picture("flat.tif", 0.5f)));
    const auto before = view().history_position;
    act(PaintFlat{region().id, painter()});
    update();
    ASSERT_TRUE(view().flattening);
    EXPECT_EQ(view().flattening->region, region().id);
    ASSERT_TRUE(wait([&] { return !opened().empty(); }));
    EXPECT_EQ(opened(), in("shot_flat/the_wall.tif"));
    EXPECT_FALSE(view().flattening);
    EXPECT_EQ(region().texture.plane, "shot_flat/the_wall.tif");
    EXPECT_EQ(view().history_position, before + 1);
    EXPECT_EQ(view().undo_label, "Paint flat: the wall");
    // It is opened again, not written again.
    fs::remove(in("opened"));
    act(PaintFlat{region().id, painter()});
    ASSERT_TRUE(wait([&] { return !opened().empty(); }));
    EXPECT_EQ(opened(), in("shot_flat/the_wall.tif"));
    EXPECT_EQ(view().history_position, before + 1);
}

TEST_F(FlatPaintingByActions, GathersTheSurfaceByTheRealProgram) {
    setenv("XDG_CACHE_HOME", in("cache").c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
    open_by(test::weft_program());
    act(PaintFlat{region().id, painter()});
    ASSERT_TRUE(wait([&] { return !opened().empty() || !view().flattening; }));
    unsetenv("XDG_CACHE_HOME");  // NOLINT(concurrency-mt-unsafe)
    ASSERT_TRUE(wait([&] { return !opened().empty(); })) << view().notices.back().text;
    const auto written = read_image(in("shot_flat/the_wall.tif"));
    ASSERT_TRUE(written);
    EXPECT_TRUE(flat_layout_of(written->rgb.size(), {96, 64}));
    EXPECT_FALSE(written->alpha.empty());
}

TEST_F(FlatPaintingByActions, ShowsWhatIsSaved) {
    open_with(copies(picture("flat.tif", 0.5f)));
    act(PaintFlat{region().id, painter()});
    ASSERT_TRUE(wait([&] { return view().result_current; }));
    const PicturePtr before = view().result_picture;
    // As Krita saves: another file takes its place.
    ASSERT_TRUE(wait([&, end = std::chrono::steady_clock::now() + std::chrono::milliseconds(1500)] {
        return std::chrono::steady_clock::now() > end;  // as it is seen first
    }));
    fs::rename(picture("saved.tif", 0.1f), in("shot_flat/the_wall.tif"));
    std::vector<std::string> saved;
    ASSERT_TRUE(wait([&] {
        const auto& now = view().saved_textures;
        saved.insert(saved.end(), now.begin(), now.end());
        return !saved.empty();
    }));
    EXPECT_EQ(saved, std::vector{in("shot_flat/the_wall.tif")});
    EXPECT_TRUE(says("as it was saved just now"));
    ASSERT_TRUE(wait([&] { return view().result_current && view().result_picture != before; }));
    // In the middle of what was painted.
    const auto red_of = [](const Picture& p) {
        return p.at(p.size.width * 40 / 96, p.size.height / 2).x;
    };
    EXPECT_LT(red_of(*view().result_picture), red_of(*before) - 0.15f);
}

TEST_F(FlatPaintingByActions, KeepsTheDocumentIfNothingIsWritten) {
    open_with(
        "echo '{\"exit_code\":4,\"error\":{\"message\":\"Frame 3 is missing.\"}}' > "
        "\"$WEFT_ANSWER_FILE\"; exit 4");
    const auto before = view().history_position;
    act(PaintFlat{region().id, painter()});
    ASSERT_TRUE(wait([&] { return says("Frame 3 is missing."); }));
    EXPECT_TRUE(opened().empty());
    EXPECT_EQ(view().history_position, before);
    EXPECT_FALSE(view().flattening);
}

TEST_F(FlatPaintingByActions, TakesNoPictureOfAnotherSize) {
    ASSERT_TRUE(write_image(in("small.tif"), ImageF3(50, 40, 0.5f), {}, {}));
    open_with(copies(in("small.tif")));
    act(PaintFlat{region().id, painter()});
    ASSERT_TRUE(wait([&] { return says("50"); }));
    EXPECT_TRUE(region().texture.plane.empty());
    EXPECT_TRUE(opened().empty());
}

TEST_F(FlatPaintingByActions, CanBeStopped) {
    open_with("sleep 600");
    act(PaintFlat{region().id, painter()});
    update();
    ASSERT_TRUE(view().flattening);
    act(StopPaintFlat{});
    update();
    EXPECT_FALSE(view().flattening);
    session_->flush();
    EXPECT_TRUE(region().texture.plane.empty());
}

TEST_F(FlatPaintingByActions, SaysThatThereIsNoSuchProgram) {
    open_with("exit 0");
    act(PaintFlat{region().id, "/no/such/program"});
    update();
    EXPECT_TRUE(says("There is no program /no/such/program."));
    EXPECT_FALSE(view().flattening);
}

}  // namespace
}  // namespace weft
