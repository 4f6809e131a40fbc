// Meshes of surfaces, and their files read again.
#include "engine/form/surface_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

#include "engine/form/mesh_depth.h"

namespace weft {
namespace {

// 32×24 with a surface from (8, 6) to (24, 18).
SurfaceMesh small_mesh() {
    Matte matte(Size{32, 24});
    for (int y = 6; y < 18; ++y)
        for (int x = 8; x < 24; ++x)
            matte.at(x, y) = 255;
    return mesh_over(matte, 10, 4);
}

float float_at(const std::string& bytes, std::size_t at) {
    float out = 0;
    std::memcpy(&out, bytes.data() + at, sizeof out);
    return out;
}

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
    std::uint32_t out = 0;
    std::memcpy(&out, bytes.data() + at, sizeof out);
    return out;
}

TEST(SurfaceMesh, CoversTheMatteAndNoMore) {
    const SurfaceMesh mesh = small_mesh();
    EXPECT_EQ(mesh.faces.size(), 4u * 4u);  // rows 4–20, columns 8–24
    EXPECT_EQ(mesh.uv.size(), 25u);
    Vec3 low(1e6f), high(-1e6f);
    for (const Vec3 p : mesh.corners.at(10))
        low = glm::min(low, p), high = glm::max(high, p);
    EXPECT_EQ(low, Vec3(8, 4, 0));
    EXPECT_EQ(high, Vec3(24, 20, 0));
    EXPECT_TRUE(mesh_over(Matte(Size{32, 24}), 0, 4).faces.empty());
}

TEST(SurfaceMesh, FacesLookAtTheCameraAndUvsAreThePicture) {
    const SurfaceMesh mesh = small_mesh();
    const auto& corners = mesh.corners.at(10);
    for (const auto& face : mesh.faces) {
        const Vec3 a = corners[face[0]], b = corners[face[1]], c = corners[face[2]];
        EXPECT_GT((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x), 0);
    }
    for (std::size_t k = 0; k < corners.size(); ++k) {
        EXPECT_FLOAT_EQ(mesh.uv[k].x, corners[k].x / 32);
        EXPECT_FLOAT_EQ(mesh.uv[k].y, corners[k].y / 24);
    }
}

TEST(SurfaceMesh, TheObjHoldsAllOfIt) {
    const SurfaceMesh mesh = small_mesh();
    std::istringstream lines(mesh_obj(mesh, "card"));
    std::vector<Vec3> corners;
    std::size_t textures = 0, faces = 0;
    for (std::string word; lines >> word;) {
        if (word == "v") {
            Vec3 p;
            lines >> p.x >> p.y >> p.z;
            corners.push_back(p);
        }
        textures += word == "vt" ? 1 : 0;
        faces += word == "f" ? 1 : 0;
    }
    EXPECT_EQ(corners, mesh.corners.at(10));
    EXPECT_EQ(textures, mesh.uv.size());
    EXPECT_EQ(faces, mesh.faces.size());
}

TEST(SurfaceMesh, TheCacheHasASampleForEachFrame) {
    SurfaceMesh mesh = small_mesh();
    mesh.corners[13] = mesh.corners[10];
    for (Vec3& p : mesh.corners[13])
        p += Vec3(3, -6, 9);
    const std::string cache = mesh_pc2(mesh, {10, 13});
    const std::size_t points = mesh.uv.size();
    ASSERT_EQ(cache.size(), 32 + 4 * points * 12);
    EXPECT_EQ(cache.substr(0, 12), std::string("POINTCACHE2\0", 12));
    EXPECT_EQ(number_at(cache, 12), 1u);
    EXPECT_EQ(number_at(cache, 16), points);
    EXPECT_EQ(float_at(cache, 20), 10);
    EXPECT_EQ(float_at(cache, 24), 1);
    EXPECT_EQ(number_at(cache, 28), 4u);
    for (std::size_t frame = 0; frame < 4; ++frame)
        for (std::size_t k = 0; k < points; ++k) {
            const std::size_t at = 32 + (frame * points + k) * 12;
            const Vec3 start = mesh.corners.at(10)[k];
            const auto t = static_cast<float>(frame);
            EXPECT_NEAR(float_at(cache, at), start.x + t, 1e-5f);
            EXPECT_NEAR(float_at(cache, at + 4), start.y - 2 * t, 1e-5f);
            EXPECT_NEAR(float_at(cache, at + 8), start.z + 3 * t, 1e-5f);
        }
}

TEST(SurfaceMesh, UsdHasTimeSamples) {
    SurfaceMesh mesh = small_mesh();
    mesh.corners[11] = mesh.corners[10];
    const std::string text = mesh_usd(mesh, "mesh_card", {10, 11}, 23.976);
    EXPECT_THAT(text, testing::StartsWith("#usda 1.0\n"));
    EXPECT_THAT(text, testing::HasSubstr("timeCodesPerSecond = 23.976\n"));
    EXPECT_THAT(text, testing::HasSubstr("        10: [("));
    EXPECT_THAT(text, testing::HasSubstr("        11: [("));
    EXPECT_EQ(std::count(text.begin(), text.end(), '{'), std::count(text.begin(), text.end(), '}'));
    EXPECT_EQ(std::count(text.begin(), text.end(), '('), std::count(text.begin(), text.end(), ')'));
}

// A rigid thing that turns: what is hidden lies where the rest says.
TEST(MeshDepth, HiddenCornersFollowTheRigidMotion) {
    std::vector<SeenCorner> corners;
    std::vector<double> truth;
    for (int k = 0; k < 60; ++k) {
        const glm::dvec3 p(0.1 * (k % 8), 0.1 * (k / 8), 2 + 0.03 * ((k * 7) % 11));
        const double depth = 0.2 * p.x - 0.1 * p.y + 0.97 * p.z + 0.4;
        truth.push_back(depth);
        corners.push_back({p, k % 3 == 0 ? 0.0 : depth});
    }
    const std::vector<double> found = depths_of(corners);
    ASSERT_EQ(found.size(), truth.size());
    for (std::size_t k = 0; k < truth.size(); ++k)
        EXPECT_NEAR(found[k], truth[k], 1e-4);
    for (SeenCorner& corner : corners)
        corner.depth = 0;
    EXPECT_TRUE(depths_of(corners).empty());
}

TEST(MeshDepth, PlacesLieOnTheirRays) {
    const Size picture{64, 48};
    FormMap form;
    form.relief = LatticeField(picture, 8);
    for (int j = 0; j < form.relief.nodes().height(); ++j)
        for (int i = 0; i < form.relief.nodes().width(); ++i)
            form.relief.set_node(i, j, Vec2(std::log(3.0f), 1));
    form.relief_fov_deg = 90;
    const auto places = places_in_space(form, {{32, 24}, {64, 24}}, picture);
    EXPECT_NEAR(places[0].z, 3, 1e-5);
    EXPECT_NEAR(places[0].x, 0, 1e-5);
    EXPECT_NEAR(places[1].x, 3, 1e-5);
}

}  // namespace
}  // namespace weft
