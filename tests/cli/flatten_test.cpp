// weft flatten: a surface as one picture, and the picture as the surface again.
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/media/image_files.h"
#include "tests/cli/cli_fixture.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using ::testing::HasSubstr;

// What hides the card on the first frames, and goes away to the left.
constexpr int kBarX = 60, kBarWidth = 10;
bool bar_covers(int step, int x, int y) {
    const int left = kBarX - 8 * step;
    return x >= left && x < left + kBarWidth && y >= 20 && y < 100;
}

class FlattenCommand : public CliTest {
  protected:
    void make_project(int frames, bool bar = false) {
        make_shot(frames, 1001, ".png", PixelDepth::kU8, [&](int frame, ImageF3& plate) {
            if (!bar) return;
            for (int y = 0; y < plate.height(); ++y)
                for (int x = 0; x < plate.width(); ++x)
                    if (bar_covers(frame - 1001, x, y))
                        plate.at(x, y, 0) = 0.9f, plate.at(x, y, 1) = plate.at(x, y, 2) = 0.1f;
        });
        if (bar) fs::create_directory(in("bar"));
        for (int step = 0; bar && step < frames; ++step) {
            Matte hidden(Card::kPlate);
            for (int y = 0; y < hidden.height(); ++y)
                for (int x = 0; x < hidden.width(); ++x)
                    hidden.at(x, y) = bar_covers(step, x, y) ? 255 : 0;
            put_matte("bar/" + std::to_string(1001 + step) + ".png", hidden);
        }
        expect_success(run({"new", "shot.weft", "--plate", "frames/####.png"}));
        Words add{"region",
                  "add",
                  "shot.weft",
                  "--name",
                  "card",
                  "--matte",
                  "masks/####.png",
                  "--texture",
                  "sample.png",
                  "--reference-frame",
                  "1001"};
        if (bar) add.insert(add.end(), {"--holdout", "bar/####.png"});
        expect_success(run(add));
    }
    Outcome flatten(const std::string& output, const Words& more = {}) const {
        return run(with_options({"flatten", "shot.weft", "-o", output, "--cache", "cache"}, more));
    }
    PlateFrame read(const std::string& name) const {
        const auto found = read_image(in(name));
        EXPECT_TRUE(found) << (found ? "" : found.error().text());
        return found ? *found : PlateFrame{ImageF3(Card::kPlate), ImageF1(Card::kPlate)};
    }
    // Codes of 255 that two pictures are apart over the card on a frame, without its border.
    static double apart(const ImageF3& a, const ImageF3& b, int step, int border = 4) {
        const Vec2i c = Card::corner(step);
        double sum = 0;
        int count = 0;
        for (int y = c.y + border; y < c.y + Card::kHeight - border; ++y) {
            for (int x = c.x + border; x < c.x + Card::kWidth - border; ++x) {
                for (int k = 0; k < 3; ++k) {
                    const double d = 255.0 * (a.at(x, y, k) - b.at(x, y, k));
                    sum += d * d, ++count;
                }
            }
        }
        return std::sqrt(sum / count);
    }
    void render(const std::string& pattern) const {
        expect_success(run({"render", "shot.weft", "-o", pattern, "--cache", "cache"}));
    }
    void set_card(const Words& options) const {
        Words words{"region", "set", "shot.weft", "card"};
        words.insert(words.end(), options.begin(), options.end());
        expect_success(run(words));
    }
};

TEST_F(FlattenCommand, WritesTheSurfaceAndWhereItIs) {
    make_project(5);
    const Outcome outcome = flatten("card.png", {"--texels", "1", "--margin", "0", "--json"});
    expect_success(outcome);
    ASSERT_EQ(outcome.exit, 0);
    const Json answer = Json::parse(outcome.out);
    EXPECT_EQ(answer["reference_frame"], 1001);
    EXPECT_EQ(answer["picture"]["width"], 160);
    EXPECT_NEAR(answer["covered"].get<double>(), 80 * 60 / (160.0 * 120), 0.02);
    const PlateFrame flat = read("card.png");
    ASSERT_EQ(flat.rgb.size(), Card::kPlate);
    ASSERT_FALSE(flat.alpha.empty());
    EXPECT_EQ(flat.alpha.at(50, 50), 1);
    EXPECT_EQ(flat.alpha.at(10, 10), 0);
    EXPECT_EQ(flat.alpha.at(140, 110), 0);
    // The light of these frames is even, so without it they look as they are.
    EXPECT_LT(apart(flat.rgb, card_plate(0), 0), 8);
}

// A passer-by is not in it, nor a hole where it stood.
TEST_F(FlattenCommand, FillsWhatIsHiddenFromFramesThatShowIt) {
    make_project(7, true);
    expect_success(flatten("card.png", {"--texels", "1", "--margin", "0"}));
    const PlateFrame flat = read("card.png");
    double worst = 0;
    for (int y = 40; y < 70; ++y) {
        for (int x = kBarX; x < kBarX + kBarWidth; ++x) {
            EXPECT_EQ(flat.alpha.at(x, y), 1) << x << ", " << y;
            worst = std::max(worst, 255.0 * (flat.rgb.at(x, y, 0) - card_plate(0).at(x, y, 0)));
        }
    }
    EXPECT_LT(worst, 60);  // the bar is 229 there
    EXPECT_LT(apart(flat.rgb, card_plate(0), 0), 10);
}

// 40 dB are 2.55 codes.
TEST_F(FlattenCommand, UneditedItGivesThePlateBack) {
    make_project(5);
    expect_success(flatten("card.ora"));
    const Outcome back = run({"flatten", "shot.weft", "--back", "card.ora", "--json"});
    expect_success(back);
    EXPECT_EQ(Json::parse(back.out)["picture"]["scale"], 2);
    set_card({"--grain", "0", "--focus", "0", "--shutter", "0"});
    render("out/####.png");
    for (const int step : {0, 2, 4})
        EXPECT_LT(
            apart(read("out/100" + std::to_string(1 + step) + ".png").rgb, card_plate(step), step),
            2.55)
            << step;
}

TEST_F(FlattenCommand, ACrossPaintedFlatGoesWithTheSurface) {
    make_project(6);
    expect_success(flatten("card.png", {"--texels", "2", "--margin", "0"}));
    PlateFrame flat = read("card.png");
    // About (70.5, 55.5) of the reference frame.
    for (int d = -8; d < 10; ++d)
        for (int w = 0; w < 2; ++w)
            for (const Vec2i at : {Vec2i(140 + d, 110 + w), Vec2i(140 + w, 110 + d)})
                flat.rgb.at(at.x, at.y, 0) = 1, flat.rgb.at(at.x, at.y, 1) = 0,
                                        flat.rgb.at(at.x, at.y, 2) = 1;
    WriteOptions write;
    write.depth = PixelDepth::kU16;
    write.rule.existing = Existing::kReplace;
    ASSERT_TRUE(write_image(in("card.png"), flat.rgb, flat.alpha, write));
    expect_success(run({"flatten", "shot.weft", "--back", "card.png"}));
    set_card({"--grain", "0", "--focus", "0", "--shutter", "0"});
    render("out/####.png");
    for (const int step : {0, 3, 5}) {
        const ImageF3 shown = read("out/100" + std::to_string(1 + step) + ".png").rgb;
        Vec2 sum(0);
        float weight = 0;
        for (int y = 40; y < 80; ++y) {
            for (int x = 50; x < 100; ++x) {
                const float green = shown.at(x, y, 1), before = card_plate(step).at(x, y, 1);
                // The share of paint, whatever lies below; the rest is rounding.
                const float share = (before - green) / before;
                const float paint = share > 0.3f ? share : 0.0f;
                sum += paint * Vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
                weight += paint;
            }
        }
        const Vec2 truth(70.5f + static_cast<float>(Card::kStepX * step),
                         55.5f + static_cast<float>(Card::kStepY * step));
        EXPECT_GT(weight, 3) << step;
        EXPECT_LT(glm::length(sum / weight - truth), 0.3f) << step;
    }
}

TEST_F(FlattenCommand, LayersShowTheSurfaceAlone) {
    make_project(4);
    const Words plain{"--texels", "1", "--margin", "0"};
    const Outcome outcome = flatten("card.ora", {"--texels", "1", "--margin", "0", "--json"});
    expect_success(outcome);
    EXPECT_EQ(Json::parse(outcome.out)["layers"], (Json{"Surface", "Texture", "Paint"}));
    expect_success(flatten("card.tif", plain));
    const PlateFrame ora = read("card.ora"), tif = read("card.tif");
    ASSERT_EQ(ora.rgb.size(), tif.rgb.size());
    EXPECT_LT(apart(ora.rgb, tif.rgb, 0), 0.5);
    // The same bytes again, and as the format wants it: the type first, as it is.
    const std::string once = bytes("card.ora");
    EXPECT_EQ(once.substr(30, 24), "mimetypeimage/openraster");
    EXPECT_THAT(once, HasSubstr("visibility=\"hidden\""));
    expect_success(flatten("card.ora", with_options(plain, {"--overwrite", "--threads", "1"})));
    EXPECT_EQ(bytes("card.ora"), once);
}

TEST_F(FlattenCommand, RefusesWhatItCannotWrite) {
    make_project(3);
    put("there.png", "mine");
    expect_failure(flatten("there.png"), 2, {"there.png", "--overwrite"});
    EXPECT_EQ(bytes("there.png"), "mine");
    expect_failure(flatten("card.psd"), 2, {"card.psd", ".ora"});
    expect_failure(flatten("frames/1001.png", {"--overwrite"}), 2, {"frames/1001.png"});
    expect_failure(flatten("card.png", {"--region", "wall"}), 2, {"wall", "card"});
    expect_failure(flatten("card.png", {"--margin", "80"}), 2, {"80", "160"});
    expect_failure(flatten("card.png", {"--frames", "1-3"}), 4, {"1-3", "1001-1003"});
    expect_failure(run({"flatten", "shot.weft"}), 2, {"-o", "--back"});
    EXPECT_FALSE(fs::exists(in("card.png")));
}

TEST_F(FlattenCommand, TakesNoPictureBackThatIsNotOne) {
    make_project(3);
    expect_success(flatten("card.ora"));
    const std::string project = bytes("shot.weft"), ora = bytes("card.ora");
    const auto refused = [&](const std::string& name, int exit, const Words& parts) {
        expect_failure(run({"flatten", "shot.weft", "--back", name}), exit, parts);
        EXPECT_EQ(bytes("shot.weft"), project) << name;
    };
    put("cut.ora", ora.substr(0, ora.size() / 2));
    refused("cut.ora", 3, {"cut.ora"});
    // A damaged picture in a sound archive.
    std::string broken = ora;
    const std::size_t at = broken.find("mergedimage.png");
    for (std::size_t k = at + 200; k < at + 1200; ++k)
        broken[k] = static_cast<char>(broken[k] ^ 0x55);
    put("broken.ora", broken);
    refused("broken.ora", 3, {"broken.ora"});
    std::string other = ora;
    other.replace(other.find("image/openraster"), 16, "text/plain      ");
    put("other.ora", other);
    refused("other.ora", 3, {"other.ora"});
    // A path that leads out of the archive is none of its pictures.
    std::string out = ora;
    for (std::size_t k = 0; (k = out.find("mergedimage.png", k)) != std::string::npos;)
        out.replace(k, 15, "../../image.png");
    put("out.ora", out);
    refused("out.ora", 3, {"out.ora", "mergedimage.png"});
    put("text.ora", "not a picture");
    refused("text.ora", 3, {"text.ora"});
    refused("missing.ora", 3, {"missing.ora"});
    put_picture("small.png", ImageF3(Size{100, 100}, 0.5f));
    refused("small.png", 2, {"small.png", "100x100", "160x120", "320x240"});
    put_picture("cropped.png", ImageF3(Size{200, 140}, 0.5f));
    refused("cropped.png", 2, {"cropped.png", "200x140"});
}

// What is transparent shows what is around it, not what is stored there.
TEST_F(FlattenCommand, APictureWithHolesGoesOnAroundThem) {
    make_project(3);
    expect_success(flatten("card.exr", {"--texels", "1", "--margin", "0"}));
    PlateFrame flat = read("card.exr");
    for (int y = 50; y < 60; ++y)
        for (int x = 60; x < 70; ++x) {
            flat.alpha.at(x, y) = 0;
            std::fill_n(flat.rgb.pixel(x, y), 3, 0.0f);
        }
    WriteOptions write;
    write.depth = PixelDepth::kFloat;
    write.rule.existing = Existing::kReplace;
    write.alpha = flat.alpha_kind;
    ASSERT_TRUE(write_image(in("card.exr"), flat.rgb, flat.alpha, write));
    expect_success(run({"flatten", "shot.weft", "--back", "card.exr"}));
    render("out/####.png");
    const ImageF3 shown = read("out/1001.png").rgb;
    for (int c = 0; c < 3; ++c)
        EXPECT_GT(shown.at(65, 55, c), 0.15f);  // 0 is stored there
}

}  // namespace
}  // namespace weft::test
