// Locked patches, layers, originals and Cryptomattes in a real session: from the action to the
// document and the picture.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <limits>
#include <thread>

#include "app/textures/larger_original.h"
#include "app/textures/patch_pick.h"
#include "engine/media/cryptomatte.h"
#include "engine/media/image_files.h"
#include "tests/ui/ui_harness.h"
#include "texture_db/library/library.h"

namespace weft::test {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

class WholeWay : public SessionTest {
  protected:
    void open(const std::string& frames = "frames") {
        session->act(OpenAny{(folder / frames).string()});
        ASSERT_TRUE(wait([&] { return session->view().plate_picture != nullptr; }))
            << session->view().plate.error;
        robot->frames(3);
    }
    void paint_region() {
        robot->key("Ctrl+Shift+N");
        robot->key("B");
        robot->frames(3);
        robot->stroke({at(20, 24), at(75, 26), at(75, 44), at(20, 42)});
        robot->frames(3);
    }
    void paint_and_texture() {
        paint_region();
        session->act(SetPreviewQuality{Quality::kDraft});
        session->act(ApplyTexture{(folder / "tile.png").string(), 0});
        ASSERT_TRUE(settled()) << session->view().preview.error;
    }
    bool settled() {
        return wait(
            [&] { return session->view().result_current && !session->view().stages.approximate; });
    }
    std::shared_ptr<const Provenance> provenance() {
        session->act(ShowOverlay{Overlay::kSourceMap});
        if (!wait([&] {
                const auto& over = session->view().overlay_picture;
                return over && over->provenance && over->provenance->plane;
            }))
            return nullptr;
        return session->view().overlay_picture->provenance;
    }
    [[nodiscard]] const Region& region() const { return *session->view().project.regions.back(); }
    // The sample pixels that the plane shows in a run, from its map.
    static bool shows(const PlaneMap& plane, const PlaneAmendment& kept) {
        for (const TexelRun& run : kept.runs) {
            for (int k = 0; k < run.count; ++k) {
                const std::int32_t* from =
                    plane.source.pixel((run.x + k) % plane.source.width(), run.y);
                if (from[0] != run.from_x + k || from[1] != run.from_y) return false;
            }
        }
        return true;
    }
};

// The first texture is chosen from what it would look like, too.
TEST_F(WholeWay, SuggestionsAreShownOnARegionWithoutATexture) {
    open();
    paint_region();
    session->act(SetPreviewQuality{Quality::kDraft});
    const auto shows = [&] {
        const StripView& strip = session->view().strip;
        return strip.kind == StripKind::kSuggested && strip.cards.size() == 1 &&
               strip.cards[0].picture != nullptr;
    };
    // The panels ask for the strip that they show.
    set_workspace(shell->state(), Workspace::kTexture);
    for (int k = 0; k < 4000 && !shows(); ++k) {
        if (session->view().strip.kind != StripKind::kSuggested)
            session->act(ShowStrip{StripKind::kSuggested, {(folder / "tile.png").string()}});
        session->update(now_s += 0.02);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ASSERT_TRUE(shows());
    EXPECT_FALSE(session->view().result_current) << "the texture was not applied";
    EXPECT_FALSE(session->view().result_wanted);
    session->act(ApplyTexture{(folder / "tile.png").string(), 0});
    EXPECT_TRUE(settled()) << session->view().preview.error;
}

// One number that only grows: it began at 0% again with whatever interrupted the analysis.
TEST_F(WholeWay, WhatIsThereAlreadyCountsAsAnalysed) {
    open();
    paint_region();
    const SessionView& view = session->view();
    session->act(SetPreviewQuality{Quality::kDraft});
    ASSERT_TRUE(wait([&] {
        return !view.plate.frames.empty() && view.reached.size() == view.plate.frames.size();
    }));
    session->act(ApplyTexture{(folder / "tile.png").string(), 0});
    int least = std::numeric_limits<int>::max();
    EXPECT_TRUE(wait([&] {
        if (view.preview.analysing && view.preview.total > 0)
            least = std::min(least, view.preview.done);
        return view.result_current && !view.preview.analysing;
    })) << view.preview.error;
    EXPECT_GT(least, 0) << "the mattes are there";
}

TEST_F(WholeWay, StabilityIsMeasuredAsThePreviewFills) {
    open();
    paint_and_texture();
    const auto known = [&] {
        int count = 0;
        for (const FrameMarks& mark : session->view().marks)
            count += mark.flicker >= 0 && mark.flicker_plate >= 0 && mark.flicker_floor >= 0 &&
                     mark.chatter >= 0;
        return count;
    };
    // Every frame but the first has one before it.
    ASSERT_TRUE(wait([&] { return known() == 3; })) << known();
    EXPECT_LT(session->view().marks[0].flicker, 0);
    // Another light changes the picture, and what is measured on it. (That it is unknown meanwhile
    // may pass between two looks.)
    const auto flicker = [&] {
        std::vector<float> values;
        for (const FrameMarks& mark : session->view().marks)
            values.push_back(mark.flicker);
        return values;
    };
    const std::vector<float> before = flicker();
    session->act(DoEdit{SetRegionParameter{{region().id, {}}, "light.strength", 0.25}});
    ASSERT_TRUE(wait([&] { return known() == 3 && flicker() != before; })) << known();
}

TEST_F(WholeWay, ALockedPatchStaysWhenTheSeedChanges) {
    open();
    paint_and_texture();
    const auto before = provenance();
    ASSERT_TRUE(before);
    const auto piece = patch_at(*before, {45.5f, 33.5f});
    ASSERT_TRUE(piece);
    const std::vector<int> frames = session->view().plate.frames;
    session->act(DoEdit{SetAmendments{{region().id, {}}, {*piece}}});
    session->act(DoEdit{SetProjectParameter{"settings.seed", std::int64_t{5}}});
    robot->frames(2);
    ASSERT_TRUE(settled());
    ASSERT_TRUE(wait([&] {
        const auto& over = session->view().overlay_picture;
        return over && over->provenance && over->provenance->plane &&
               over->provenance->plane != before->plane;
    }));
    const auto after = session->view().overlay_picture;
    EXPECT_TRUE(shows(*after->provenance->plane, *piece));
    EXPECT_NE(after->provenance->plane->source, before->plane->source) << "the rest is new";
    EXPECT_FALSE(after->marked.empty());
    EXPECT_EQ(after->marked.at(45, 33), 255);
    // Without it the patch changes.
    robot->key("Ctrl+Z");
    robot->key("Ctrl+Z");
    session->act(DoEdit{SetProjectParameter{"settings.seed", std::int64_t{5}}});
    robot->frames(2);
    ASSERT_TRUE(settled());
    ASSERT_TRUE(wait([&] {
        const auto& over = session->view().overlay_picture;
        return over && over->provenance && over->provenance->plane && over->marked.empty() &&
               over->provenance->plane != before->plane;
    }));
    EXPECT_FALSE(shows(*session->view().overlay_picture->provenance->plane, *piece));
}

TEST_F(WholeWay, LayersForCompositingAreShownInPlaceOfTheResult) {
    open();
    paint_and_texture();
    for (const LayerInfo& layer : kLayers) {
        session->act(ShowLayer{layer.kind});
        ASSERT_TRUE(wait([&] {
            const PreviewFrame& shown = session->view().stages;
            return shown.layer_kind == layer.kind && shown.layer;
        })) << layer.name;
    }
    session->act(ShowLayer{LayerKind::kMatte});
    ASSERT_TRUE(wait([&] { return session->view().stages.layer_kind == LayerKind::kMatte; }));
    const PicturePtr matte = session->view().stages.layer;
    EXPECT_GT(matte->at(45, 25).x, 0.9f);
    EXPECT_LT(matte->at(3, 3).x, 0.1f);
    session->act(ShowLayer{});
    robot->frames(3);
    EXPECT_FALSE(session->view().layer);
}

TEST_F(WholeWay, DriftStretchAndSeamsAreMeasuredInTheBackground) {
    open();
    paint_and_texture();
    ASSERT_TRUE(wait([&] {
        const auto& marks = session->view().marks;
        return std::all_of(marks.begin(), marks.end(),
                           [](const FrameMarks& m) { return m.drift >= 0 && m.stretch >= 0; });
    }));
    for (const FrameMarks& mark : session->view().marks) {
        EXPECT_GE(mark.stretch, 1.0f);
        EXPECT_LT(mark.stretch, 1.5f) << "the card moves as it is";
        EXPECT_LT(mark.drift, 0.5f);
    }
}

TEST_F(WholeWay, TheLargerOriginalReplacesTheSample) {
    // A photograph of 384 px, of which the sample is the upper left half at half its size.
    const std::string path = (folder / "library.wtl").string();
    std::string id;
    {
        auto library = TextureLibrary::open(path);
        ASSERT_TRUE(library) << library.error().text();
        ImageU8x3 large(384, 384);
        for (int y = 0; y < 384; ++y)
            for (int x = 0; x < 384; ++x)
                for (int c = 0; c < 3; ++c)
                    large.pixel(x, y)[c] = static_cast<std::uint8_t>(
                        120 + 60 * std::sin(0.11 * x + c) * std::cos(0.07 * y) +
                        (x * 7 + y * 5) % 9);
        NewTexture texture;
        texture.pixels = ImageU8x3(96, 96);
        for (int y = 0; y < 96; ++y)
            for (int x = 0; x < 96; ++x)
                std::copy_n(large.pixel(2 * x, 2 * y), 3, texture.pixels.pixel(x, y));
        texture.name = "plaster";
        texture.material = "plaster";
        texture.author = "Ada";
        texture.licence = "CC0-1.0";
        texture.source = "plaster.png";
        texture.original = std::make_shared<const ImageU8x3>(large);
        texture.original_size = large.size();
        texture.original_crop = {0, 0, 192, 192};
        ASSERT_EQ((*library)->add({texture}), 1);
        SearchQuery all;
        const auto found = (*library)->search(all);
        ASSERT_TRUE(found);
        ASSERT_THAT(found->hits, SizeIs(1));
        id = found->hits[0].id;
    }
    const auto scale = original_scale(path, id);
    ASSERT_TRUE(scale) << scale.error().text();
    EXPECT_FLOAT_EQ(*scale, 2.0f);
    const auto kept = keep_larger_original(path, "db:" + id, (folder / "kept").string());
    ASSERT_TRUE(kept) << kept.error().text();
    EXPECT_FLOAT_EQ(kept->scale, 2.0f);
    const auto picture = read_image(kept->path);
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->rgb.size(), (Size{384, 384}));
    const auto credit = read_texture_credit(kept->path);
    ASSERT_TRUE(credit);
    EXPECT_EQ(credit->author, "Ada");
    EXPECT_FALSE(keep_larger_original(path, (folder / "tile.png").string(), folder.string()))
        << "a picture of one's own has no original";

    restart_session(path);
    open();
    robot->key("Ctrl+Shift+N");
    robot->frames(2);
    session->act(ApplyTexture{"db:" + id, 0});
    ASSERT_TRUE(wait([&] { return !region().texture.sample.empty(); }));
    session->act(DoEdit{SetRegionParameter{{region().id, {}}, "placement.scale", 3.0}});
    robot->frames(2);
    ASSERT_DOUBLE_EQ(region().placement.scale, 3.0);
    session->act(UseLargerOriginal{0});
    ASSERT_TRUE(wait([&] { return region().placement.scale != 3.0; }));
    EXPECT_DOUBLE_EQ(region().placement.scale, 1.5);
    EXPECT_THAT(region().texture.sample, HasSubstr("_larger.png"));
    robot->key("Ctrl+Z");
    robot->frames(2);
    EXPECT_DOUBLE_EQ(region().placement.scale, 3.0) << "one step of the history";
}

TEST_F(WholeWay, ACryptomatteObjectIsAddedAndRemoved) {
    std::filesystem::create_directory(folder / "cg");
    for (int frame = 1; frame <= 2; ++frame) {
        OIIO::ImageSpec spec(96, 64, 7, OIIO::TypeFloat);
        spec.channelnames = {"R", "G", "B", "obj00.r", "obj00.g", "obj00.b", "obj00.a"};
        spec.attribute("cryptomatte/1234567/name", "obj");
        spec.attribute("cryptomatte/1234567/hash", "MurmurHash3_32");
        spec.attribute("cryptomatte/1234567/conversion", "uint32_to_float32");
        spec.attribute("cryptomatte/1234567/manifest", R"({"Wall":"2c388f97","Ball":"74d3ebe9"})");
        std::vector<float> data;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 96; ++x) {
                const float id = std::bit_cast<float>(cryptomatte_id(x < 48 ? "Wall" : "Ball"));
                data.insert(data.end(), {0.2f, 0.3f, 0.4f, id, 1, 0, 0});
            }
        const std::string file =
            (folder / "cg" / ("000" + std::to_string(frame) + ".exr")).string();
        auto output = OIIO::ImageOutput::create(file);
        ASSERT_TRUE(output->open(file, spec));
        ASSERT_TRUE(output->write_image(OIIO::TypeFloat, data.data()));
        ASSERT_TRUE(output->close());
    }
    open("cg");
    robot->key("Ctrl+Shift+N");
    robot->frames(2);
    session->act(PickCryptomatte{{10, 10}, false});
    ASSERT_TRUE(wait([&] { return region().matte->select.crypto == "Wall"; }));
    ASSERT_TRUE(wait([&] {
        const auto& mattes = session->view().mattes;
        return !mattes.empty() && mattes.back().keep;
    }));
    EXPECT_EQ(session->view().mattes.back().pixels.at(10, 10), 255);
    EXPECT_EQ(session->view().mattes.back().pixels.at(80, 10), 0);
    session->act(PickCryptomatte{{80, 10}, false});
    ASSERT_TRUE(wait([&] { return region().matte->select.crypto == "Wall,Ball"; }));
    session->act(PickCryptomatte{{10, 10}, true});
    ASSERT_TRUE(wait([&] { return region().matte->select.crypto == "Ball"; }));
    robot->key("Ctrl+Z");
    robot->frames(2);
    EXPECT_EQ(region().matte->select.crypto, "Wall,Ball");
}

TEST_F(WholeWay, PickingWithoutACryptomatteIsReported) {
    open();
    robot->key("Ctrl+Shift+N");
    robot->frames(2);
    session->act(PickCryptomatte{{10, 10}, false});
    ASSERT_TRUE(wait([&] { return !session->view().notices.empty(); }));
    EXPECT_TRUE(region().matte->empty());
}

}  // namespace
}  // namespace weft::test
