#include "tests/render/shot_fixture.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "engine/core/hash.h"
#include "engine/media/frame_writer.h"

namespace weft::test {

namespace fs = std::filesystem;

void ShotTest::SetUp() {
    std::string name = (fs::temp_directory_path() / "weft_session_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    for (const char* part : {"frames", "masks"})
        fs::create_directory(folder_ / part);
    for (int step = 0; step < kFrames; ++step) {
        const std::string file = "/000" + std::to_string(step + 1) + ".png";
        ASSERT_TRUE(write_image(in("frames" + file), card_plate(step), {}, {}));
        ASSERT_TRUE(write_matte(in("masks" + file), card_matte(step)));
    }
    ASSERT_TRUE(write_image(in("tile.png"), pattern_picture({128, 128}, 5), {}, {}));
}

JobSpec ShotTest::spec(const std::string& out) const {
    JobSpec job;
    job.project.plate.path = in("frames/####.png");
    job.project.output.path = in(out + "/####.png");
    job.project.settings.quality = Quality::kDraft;
    Region region;
    region.id = job.project.next_region_id++;
    region.name = "card";
    MatteSource matte;
    matte.files = in("masks/####.png");
    region.matte = matte;
    region.texture.plane = in("tile.png");
    job.project.regions.emplace_back(std::move(region));
    job.backend = "cpu";
    job.threads = 2;
    job.cache.folder = in("cache");
    return job;
}

std::map<std::string, std::string> ShotTest::contents(const std::string& folder) const {
    std::map<std::string, std::string> all;
    std::error_code missing;
    for (const auto& entry : fs::directory_iterator(folder_ / folder, missing)) {
        std::ifstream file(entry.path(), std::ios::binary);
        const std::string whole{std::istreambuf_iterator<char>(file), {}};
        Hasher hasher;
        hasher.bytes(whole.data(), whole.size());
        all[entry.path().filename().string()] = hasher.finish().hex();
    }
    return all;
}

int ShotTest::analysed_steps(const JobSpec& job) const {
    int steps = 0;
    const auto result = run_job(
        job, {}, [&](const ProgressEvent& event) { steps += event.stage == WorkStage::kAnalyse; });
    EXPECT_TRUE(result) << result.error().text();
    return steps;
}

}  // namespace weft::test
