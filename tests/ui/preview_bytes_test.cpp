// The full-size preview equals a render byte for byte, with locked patches, pins and an animated
// placement.
#include "app/render/render_job.h"
#include "app/textures/patch_pick.h"
#include "engine/media/image_files.h"
#include "tests/ui/ui_harness.h"

namespace weft::test {
namespace {

class PreviewBytes : public SessionTest {
  protected:
    void open_with_region() {
        session->act(OpenAny{(folder / "frames").string()});
        ASSERT_TRUE(wait([&] { return session->view().plate_picture != nullptr; }))
            << session->view().plate.error;
        robot->frames(3);
        robot->key("Ctrl+Shift+N");
        robot->key("B");
        robot->frames(3);
        robot->stroke({at(20, 24), at(75, 26), at(75, 44), at(20, 42)});
        robot->frames(3);
        session->act(ApplyTexture{(folder / "tile.png").string(), 0});
        ASSERT_TRUE(settled()) << session->view().preview.error;
    }
    bool settled() {
        robot->frames(2);
        return wait([&] {
            const SessionView& v = session->view();
            return v.result_current && !v.stages.approximate && v.stages.proxy == 1;
        });
    }
    void set(const char* key, ParameterValue value) {
        session->act(DoEdit{SetRegionParameter{{region().id, {}}, key, std::move(value)}});
        robot->frames(2);
    }
    [[nodiscard]] const Region& region() const { return *session->view().project.regions.back(); }
    [[nodiscard]] ImageU8x3 shown(int frame) {
        session->act(GoToFrame{frame});
        if (!settled()) return {};
        const auto final = static_cast<std::size_t>(Stage::kFinal);
        return session->view().stages.stages[final]->srgb;
    }
    // As `weft render` does it, with a cache of its own and another number of threads.
    void render(Quality quality) {
        session->flush();
        JobSpec spec;
        spec.project = session->view().project;
        spec.project.settings.quality = quality;
        spec.project.output.path = (folder / "out" / "####.png").string();
        spec.cache.folder = (folder / "render_cache").string();
        spec.backend = "cpu";
        spec.threads = 1;
        spec.existing = ExistingFrames::kOverwrite;
        const auto done = run_job(spec, {}, {});
        ASSERT_TRUE(done) << done.error().text();
        ASSERT_EQ(done->frames.size(), 4u);
    }
    [[nodiscard]] ImageU8x3 written(int frame) const {
        const auto file =
            read_image((folder / "out" / ("000" + std::to_string(frame) + ".png")).string());
        if (!file) return {};
        ImageU8x3 out(file->rgb.size());
        std::transform(file->rgb.data(), file->rgb.data() + out.size_bytes(), out.data(),
                       [](float v) { return static_cast<std::uint8_t>(v * 255.0f + 0.5f); });
        return out;
    }
    void expect_same_bytes(const char* what) {
        for (const Quality quality : {Quality::kDraft, Quality::kFinal}) {
            session->act(SetPreviewQuality{quality});
            render(quality);
            for (int frame = 1; frame <= 4; ++frame) {
                const ImageU8x3 preview = shown(frame), file = written(frame);
                ASSERT_FALSE(preview.empty()) << session->view().preview.error;
                ASSERT_EQ(preview.size(), file.size());
                EXPECT_EQ(changed(preview, file), 0) << "pixels: " << what << ", frame " << frame
                                                     << ", quality " << static_cast<int>(quality);
            }
        }
    }
    // Number of pixels of a frame that differ from before.
    static int changed(const ImageU8x3& a, const ImageU8x3& b) {
        int count = 0;
        for (int y = 0; y < a.height(); ++y)
            for (int x = 0; x < a.width(); ++x)
                count += !std::equal(a.pixel(x, y), a.pixel(x, y) + 3, b.pixel(x, y));
        return count;
    }
};

TEST_F(PreviewBytes, EqualARenderWithALockedPatchAndSeam) {
    open_with_region();
    session->act(ShowOverlay{Overlay::kSourceMap});
    ASSERT_TRUE(wait([&] {
        const auto& over = session->view().overlay_picture;
        return over && over->provenance && over->provenance->plane;
    }));
    const auto from = session->view().overlay_picture->provenance;
    const auto piece = patch_at(*from, {45.5f, 33.5f});
    const auto seam = seam_at(*from, {60.5f, 30.5f});
    auto again = places_in(*from, {26, 20}, {36, 30});
    ASSERT_TRUE(piece && seam && again);
    again->kind = PlaneAmendment::Kind::kAgain;
    again->seed = 7;
    session->act(DoEdit{SetAmendments{{region().id, {}}, {*piece, *seam, *again}}});
    session->act(DoEdit{SetProjectParameter{"settings.seed", std::int64_t{5}}});
    robot->frames(2);
    expect_same_bytes("kept and made again");
}

TEST_F(PreviewBytes, EqualARenderWithPinsAndAnAnimatedPlacement) {
    open_with_region();
    const ImageU8x3 before = shown(3);
    session->act(
        DoEdit{SetCorrection{{region().id, {}}, 3, {{{40, 30}, {44, 31}}, {{60, 36}, {60, 36}}}}});
    robot->frames(2);
    set("placement.scale_keys", std::string("1:1 4:1.5"));
    set("placement.rotate_keys", std::string("1:0 4:20"));
    set("placement.offset_keys", std::string("1:0,0 4:6,-3"));
    EXPECT_GT(changed(before, shown(3)), 200) << "the keys do something";
    expect_same_bytes("pins and keys");
}

}  // namespace
}  // namespace weft::test
