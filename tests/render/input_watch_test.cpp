// An input that is replaced while a run goes on.
#include "app/shot/input_watch.h"

#include <sys/stat.h>

#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "app/render/report.h"
#include "engine/media/frame_writer.h"
#include "engine/media/image_files.h"
#include "tests/render/shot_fixture.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Watch : public ShotTest {
  protected:
    void put(const std::string& name, const std::string& text) const {
        std::ofstream(in(name), std::ios::binary) << text;
    }
    // Gives a file the time that it had before.
    void keep_time(const std::string& name, const std::function<void()>& change) const {
        const auto time = fs::last_write_time(in(name));
        change();
        fs::last_write_time(in(name), time);
    }
    InputWatch watch_;
};

TEST_F(Watch, ChangedBytesAreFoundWhateverTheTime) {
    for (const char* name : {"same", "longer", "same_size", "same_time", "renamed", "gone"}) {
        put(name, "first");
        watch_.before_read(in(name));
    }
    EXPECT_THAT(watch_.changed(), IsEmpty());
    put("longer", "second");
    put("same_size", "other");
    keep_time("same_time", [&] { put("same_time", "other"); });
    put("new", "other");
    fs::rename(in("new"), in("renamed"));
    fs::remove(in("gone"));
    watch_.before_read(in("longer"));  // once more: the first read counts
    EXPECT_THAT(watch_.changed(), ElementsAre(in("gone"), in("longer"), in("renamed"),
                                              in("same_size"), in("same_time")));
}

TEST_F(Watch, TheSameBytesAreTheSameFile) {
    for (const char* name : {"touched", "rights", "copied"}) {
        put(name, "first");
        watch_.before_read(in(name));
    }
    fs::last_write_time(in("touched"), fs::file_time_type::clock::now() + std::chrono::hours(1));
    fs::permissions(in("rights"), fs::perms::owner_read);
    put("copy", "first");
    fs::rename(in("copy"), in("copied"));
    EXPECT_THAT(watch_.changed(), IsEmpty());
}

TEST_F(Watch, TheFileReadMustBeTheOneReliedOn) {
    put("replaced", "first");
    put("never_read", "first");
    put("kept", "first");
    for (const char* name : {"replaced", "never_read", "kept"})
        watch_.relied_on(in(name));
    put("replaced", "other words");
    put("never_read", "other words");
    watch_.before_read(in("replaced"));
    watch_.before_read(in("kept"));
    EXPECT_THAT(watch_.changed(), ElementsAre(in("replaced")));
}

TEST_F(Watch, NonRegularFilesAreNotWatched) {
    ASSERT_EQ(mkfifo(in("pipe").c_str(), 0600), 0);
    for (const char* name : {"pipe", "frames", "missing"})
        watch_.before_read(in(name));
    put("missing", "there now");
    EXPECT_THAT(watch_.changed(), IsEmpty());
}

// One frame is replaced as soon as the first one is rendered.
TEST_F(Watch, ARunNamesTheReplacedInput) {
    for (const char* name : {"frames/0002.png", "masks/0004.png", "tile.png"}) {
        SCOPED_TRACE(name);
        const std::string path = in(name);
        const auto image = read_image(path);
        ASSERT_TRUE(image);
        bool replaced = false;
        const JobSpec job = spec(std::string("out_") + fs::path(name).stem().string());
        const auto result = run_job(job, {}, [&](const ProgressEvent& event) {
            if (event.stage != WorkStage::kRender || replaced) return;
            replaced = true;
            ImageF3 other = image->rgb;
            other.pixel(3, 3)[0] = 1 - other.pixel(3, 3)[0];
            WriteOptions replacing;
            replacing.rule = WriteRule::own();
            ASSERT_TRUE(write_image(path, other, {}, replacing));
        });
        ASSERT_TRUE(result) << result.error().text();
        EXPECT_TRUE(replaced);
        EXPECT_THAT(result->changed_inputs, ElementsAre(path));
        const Status status = check_unchanged(result->changed_inputs);
        ASSERT_FALSE(status);
        EXPECT_EQ(status.error().code, ErrorCode::kUnreadable);
        EXPECT_THAT(status.error().sentence(), HasSubstr(path));
        EXPECT_THAT(status.error().sentence(), HasSubstr("run.overwrite"));
        const auto report = nlohmann::json::parse(report_json(job, *result));
        EXPECT_EQ(report["changed_inputs"], (std::vector<std::string>{path}));
    }
    const JobSpec job = spec("quiet");
    const auto quiet = run_job(job, {}, {});
    ASSERT_TRUE(quiet);
    EXPECT_THAT(quiet->changed_inputs, IsEmpty());
    EXPECT_FALSE(nlohmann::json::parse(report_json(job, *quiet)).contains("changed_inputs"));
}

}  // namespace
}  // namespace weft::test
