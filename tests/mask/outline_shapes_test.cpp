// Mattes as shapes over time, of which the motion is known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "engine/mask/outline_fit.h"
#include "engine/mask/outline_lives.h"
#include "engine/mask/shape_text.h"
#include "tests/support/drawn_shapes.h"
#include "tests/support/places.h"

namespace weft::test {
namespace {

using Json = nlohmann::json;
constexpr Size kPlate{240, 180};

// A surface that turns and grows about its middle, which moves.
struct TurningSurface {
    [[nodiscard]] static Vec2 at(Vec2 from_middle, int t) {
        const auto step = static_cast<float>(t);
        const float angle = 0.05f * step, scale = 1 + 0.02f * step;
        const Vec2 turned(std::cos(angle) * from_middle.x - std::sin(angle) * from_middle.y,
                          std::sin(angle) * from_middle.x + std::cos(angle) * from_middle.y);
        return Vec2(100 + 2.5f * step, 90 + step) + scale * turned;
    }
    [[nodiscard]] static Vec2 from_middle(Vec2 p, int t) {
        const auto step = static_cast<float>(t);
        const float angle = -0.05f * step, scale = 1 + 0.02f * step;
        const Vec2 q = (p - Vec2(100 + 2.5f * step, 90 + step)) / scale;
        return {std::cos(angle) * q.x - std::sin(angle) * q.y,
                std::sin(angle) * q.x + std::cos(angle) * q.y};
    }
    [[nodiscard]] static LatticeField between(int from, int to) {
        LatticeField out(kPlate, 8);
        for (int j = 0; j < out.nodes().height(); ++j)
            for (int i = 0; i < out.nodes().width(); ++i) {
                const Vec2 p = out.node_position(i, j);
                out.set_node(i, j, at(from_middle(p, from), to) - p);
            }
        return out;
    }
};

// A leaf with two tips, and lobes in between.
std::vector<Vec2> leaf(int t, float scale) {
    std::vector<Vec2> out;
    for (int k = 0; k < 360; ++k) {
        const float a = static_cast<float>(k) * 0.017453293f;
        const float r = 50 * std::abs(std::cos(a)) + 18 + 4 * std::sin(6 * a);
        out.push_back(TurningSurface::at(scale * r * Vec2(std::cos(a), 0.7f * std::sin(a)), t));
    }
    return out;
}

Matte leaf_matte(int t, bool hole) {
    Matte out = polygon_matte(leaf(t, 1), kPlate);
    if (!hole) return out;
    const Matte off = polygon_matte(leaf(t, 0.4f), kPlate);
    for (int y = 0; y < kPlate.height; ++y)
        for (int x = 0; x < kPlate.width; ++x)
            out.at(x, y) = static_cast<std::uint8_t>(out.at(x, y) * (255 - off.at(x, y)) / 255);
    return out;
}

std::vector<OutlinedFrame> outlined(const std::vector<Matte>& mattes, int reference) {
    std::vector<OutlinedFrame> out;
    for (std::size_t k = 0; k < mattes.size(); ++k) {
        const int t = static_cast<int>(k), last = t + (t > reference ? -1 : t < reference ? 1 : 0);
        out.push_back({outlines_of_matte(mattes[k], 10), TurningSurface::between(last, t),
                       TurningSurface::between(reference, t)});
    }
    return out;
}

std::vector<MatteShape> leaf_shapes(int frames, int reference, bool hole) {
    std::vector<Matte> mattes;
    mattes.reserve(static_cast<std::size_t>(frames));
    for (int t = 0; t < frames; ++t)
        mattes.push_back(leaf_matte(t, hole));
    const auto outlines = outlined(mattes, reference);
    return matte_shapes(outlines, static_cast<std::size_t>(reference), kPlate);
}

TEST(OutlineShapes, DrawTheMatteAgain) {
    const auto shapes = leaf_shapes(9, 4, true);
    ASSERT_EQ(shapes.size(), 2u);
    EXPECT_EQ(shapes[0].level, 0);
    EXPECT_EQ(shapes[1].level, 1);
    for (int t = 0; t < 9; ++t) {
        const Matte matte = leaf_matte(t, true);
        EXPECT_GT(overlap_at_half(drawn_shapes(shapes, t, kPlate), matte), 0.98) << t;
        for (const MatteOutline& outline : outlines_of_matte(matte, 10)) {
            const OutlinePath drawn(
                outline_of(shapes[static_cast<std::size_t>(outline.level)].keys.at(t)));
            double off = 0;
            for (const Vec2 p : outline.path.points())
                off += static_cast<double>(drawn.nearest(p).distance_px);
            EXPECT_LT(off / static_cast<double>(outline.path.points().size()), 0.5) << t;
        }
    }
    // Not by a point for every pixel.
    EXPECT_LT(shapes[0].keys.at(4).points.size(), 60u);
}

// A point belongs to one place of the surface on all frames.
TEST(OutlineShapes, PointsGoWithTheSurface) {
    const auto shapes = leaf_shapes(9, 4, false);
    ASSERT_EQ(shapes.size(), 1u);
    const RotoShape& first = shapes[0].keys.at(4);
    ASSERT_EQ(shapes[0].keys.size(), 9u);
    double worst = 0, sum = 0;
    for (const auto& [t, shape] : shapes[0].keys) {
        ASSERT_EQ(shape.points.size(), first.points.size());
        for (std::size_t k = 0; k < first.points.size(); ++k) {
            const Vec2 moved =
                TurningSurface::at(TurningSurface::from_middle(first.points[k].at, 4), t);
            const auto off = static_cast<double>(glm::length(shape.points[k].at - moved));
            worst = std::max(worst, off);
            sum += off / static_cast<double>(9 * first.points.size());
        }
    }
    EXPECT_LT(sum, 0.4);
    EXPECT_LT(worst, 1.5);
}

Matte with_box(Matte matte, int x0, int x1, std::uint8_t value) {
    for (int y = 0; y < kPlate.height; ++y)
        for (int x = x0; x < x1; ++x)
            matte.at(x, y) = value;
    return matte;
}

TEST(OutlineShapes, WhereTheTopologyChangesOthersBegin) {
    // It is cut in two on frames 3 and 4, and whole again.
    std::vector<Matte> mattes;
    mattes.reserve(7);
    for (int t = 0; t < 7; ++t)
        mattes.push_back(t == 3 || t == 4 ? with_box(leaf_matte(t, false), 106, 116, 0)
                                          : leaf_matte(t, false));
    const auto shapes = matte_shapes(outlined(mattes, 1), 1, kPlate);
    ASSERT_EQ(shapes.size(), 4u);
    std::vector<std::pair<int, int>> lives;
    lives.reserve(shapes.size());
    for (const MatteShape& shape : shapes)
        lives.emplace_back(shape.keys.begin()->first, shape.keys.rbegin()->first);
    EXPECT_THAT(lives, testing::UnorderedElementsAre(std::pair(0, 2), std::pair(3, 4),
                                                     std::pair(3, 4), std::pair(5, 6)));
    for (int t = 0; t < 7; ++t)
        EXPECT_GT(
            overlap_at_half(drawn_shapes(shapes, t, kPlate), mattes[static_cast<std::size_t>(t)]),
            0.98)
            << t;
}

TEST(OutlineShapes, AnEmptyFrameEndsThem) {
    std::vector<Matte> mattes{leaf_matte(0, false), Matte(kPlate), leaf_matte(2, false)};
    const auto shapes = matte_shapes(outlined(mattes, 0), 0, kPlate);
    ASSERT_EQ(shapes.size(), 2u);
    EXPECT_EQ(shapes[0].keys.size(), 1u);
    EXPECT_EQ(shapes[1].keys.begin()->first, 2);
}

// ---- mattes of filmed clips --------------------------------------------------------------------

Matte filed_matte(const std::filesystem::path& path) {
    const cv::Mat picture = cv::imread(path.string(), cv::IMREAD_GRAYSCALE);
    Matte out(picture.cols, picture.rows);
    for (int y = 0; y < picture.rows; ++y)
        std::copy(picture.ptr(y), picture.ptr(y) + picture.cols, out.row(y));
    return out;
}

// Without any motion: what is left is where the outlines themselves go.
void expect_drawn_again(const std::vector<Matte>& mattes) {
    const Size size = mattes.front().size();
    std::vector<OutlinedFrame> frames;
    frames.reserve(mattes.size());
    for (const Matte& matte : mattes)
        frames.push_back(
            {outlines_of_matte(matte, 12), LatticeField(size, 16), LatticeField(size, 16)});
    const auto shapes = matte_shapes(frames, 0, size);
    for (std::size_t k = 0; k < mattes.size(); ++k) {
        const int t = static_cast<int>(k);
        std::vector<OutlinePath> drawn;
        for (const MatteShape& shape : shapes)
            if (shape.keys.count(t) > 0) drawn.emplace_back(outline_of(shape.keys.at(t)));
        double off = 0, points = 0;
        for (const MatteOutline& outline : frames[k].outlines)
            for (const Vec2 p : outline.path.points()) {
                float least = 1e9f;
                for (const OutlinePath& path : drawn)
                    least = std::min(least, path.nearest(p).distance_px);
                off += static_cast<double>(least), ++points;
            }
        EXPECT_LT(off / points, 0.5) << t;
        auto by_level = shapes;
        std::stable_sort(by_level.begin(), by_level.end(),
                         [](const auto& a, const auto& b) { return a.level < b.level; });
        EXPECT_GT(overlap_at_half(drawn_shapes(by_level, t, size), mattes[k]), 0.98) << t;
    }
}

TEST(OutlineShapes, DrawAPaintedWallAgain) {
    const auto path = std::filesystem::path(shared_data_folder()) / "hands" / "bedroom_wall_1.png";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "the evaluation clips are not here";
    expect_drawn_again({filed_matte(path)});
}

TEST(OutlineShapes, DrawADancerAgain) {
    const auto folder =
        std::filesystem::path(shared_data_folder()) / "sequences" / "davis_dance-twirl" / "masks";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the evaluation clips are not here";
    std::vector<Matte> mattes;
    for (const char* name : {"00000.png", "00001.png", "00002.png", "00003.png", "00004.png"})
        mattes.push_back(filed_matte(folder / name));
    expect_drawn_again(mattes);
}

TEST(OutlineShapes, CornersStayCorners) {
    const OutlinePath square({{10, 10}, {60, 10}, {60, 60}, {10, 60}});
    const auto shapes = fitted_shapes({{&square, bend_places(square, 1.5)}});
    ASSERT_EQ(shapes[0].points.size(), 4u);
    for (const Vec2 p : outline_of(shapes[0]))
        EXPECT_LT(square.nearest(p).distance_px, 1e-3f);
}

// ---- as text ----------------------------------------------------------------------------------

// The list of a script, which is JSON as well.
Json shape_list_of(const std::string& script) {
    const std::size_t from = script.find("SHAPES = ") + 9, to = script.find("\n]\n", from) + 2;
    return Json::parse(script.substr(from, to - from));
}

Vec2 vec_of(const Json& numbers, std::size_t from = 0) {
    return {numbers[from].get<float>(), numbers[from + 1].get<float>()};
}

using ReadPoint = std::function<RotoPoint(const Json&)>;

std::vector<MatteShape> shapes_of_list(const Json& list, const ReadPoint& read) {
    std::vector<MatteShape> out;
    for (const Json& entry : list) {
        MatteShape shape;
        shape.level = entry["level"];
        for (std::size_t k = 0; k < entry["frames"].size(); ++k)
            for (const Json& point : entry["points"][k])
                shape.keys[entry["frames"][k]].points.push_back(read(point));
        out.push_back(shape);
    }
    return out;
}

void expect_same_shapes(const std::vector<MatteShape>& a, const std::vector<MatteShape>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
        EXPECT_EQ(a[k].level, b[k].level);
        ASSERT_EQ(a[k].keys.size(), b[k].keys.size());
        for (const auto& [frame, shape] : a[k].keys) {
            const auto& others = b[k].keys.at(frame).points;
            ASSERT_EQ(shape.points.size(), others.size());
            for (std::size_t n = 0; n < others.size(); ++n) {
                EXPECT_LT(glm::length(shape.points[n].at - others[n].at), 2e-3f);
                EXPECT_LT(glm::length(shape.points[n].in - others[n].in), 2e-3f);
                EXPECT_LT(glm::length(shape.points[n].out - others[n].out), 2e-3f);
            }
        }
    }
}

TEST(ShapeText, NukesNumbersArePixelsUpwards) {
    const auto shapes = leaf_shapes(4, 0, true);
    const std::string text = nuke_shapes(shapes, {kPlate, "leaf"});
    expect_same_shapes(shapes, shapes_of_list(shape_list_of(text), [](const Json& n) {
                           return RotoPoint{Vec2(n[0], 180 - n[1].get<float>()),
                                            Vec2(n[2], -n[3].get<float>()),
                                            Vec2(n[4], -n[5].get<float>()), 0};
                       }));
    EXPECT_THAT(text, testing::HasSubstr("name='leaf_%d' % level"));
}

TEST(ShapeText, BlendersSpanTheLongerSide) {
    const auto shapes = leaf_shapes(4, 0, true);
    const std::string text = blender_shapes(shapes, {kPlate, "leaf"});
    const auto pixels = [](Vec2 p) {
        return Vec2(240 * (p.x - 0.5f) + 120, 90 - 240 * (p.y - 0.5f));
    };
    expect_same_shapes(
        shapes, shapes_of_list(shape_list_of(text), [&](const Json& n) {
            const Vec2 at = pixels(vec_of(n));
            return RotoPoint{at, pixels(vec_of(n, 2)) - at, pixels(vec_of(n, 4)) - at, 0};
        }));
}

TEST(ShapeText, MltsAreOfThePictureFromTheTop) {
    const auto shapes = leaf_shapes(4, 0, true);
    const Json list = Json::parse(mlt_shapes(shapes, {kPlate, "leaf"}, -10));
    ASSERT_EQ(list.size(), 3u);
    EXPECT_EQ(list[0]["alpha_operation"], "clear");
    EXPECT_EQ(list[0]["in"], 10);
    EXPECT_EQ(list[0]["out"], 13);
    std::vector<MatteShape> back;
    const Vec2 size(240, 180);
    for (const Json& entry : {list[1], list[2]}) {
        MatteShape shape;
        shape.level = entry["alpha_operation"] == "sub" ? 1 : 0;
        for (const auto& [key, points] : entry["spline"].items())
            for (const Json& p : points) {
                const Vec2 at = size * vec_of(p[1]);
                shape.keys[entry["in"].get<int>() - 10 + std::stoi(key)].points.push_back(
                    {at, size * vec_of(p[0]) - at, size * vec_of(p[2]) - at, 0});
            }
        back.push_back(shape);
    }
    expect_same_shapes(shapes, back);
}

TEST(ShapeText, NamesSayWhatIsAHole) {
    const auto shapes = leaf_shapes(1, 0, true);
    EXPECT_EQ(shape_name(shapes, 0), "outline_1");
    EXPECT_EQ(shape_name(shapes, 1), "hole_2");
}

}  // namespace
}  // namespace weft::test
