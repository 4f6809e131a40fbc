// The measures on a rendered clip with true motion: what each kind of transport scores there.

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "engine/metrics/ideal.h"
#include "engine/metrics/motion_chain.h"
#include "engine/metrics/region.h"
#include "engine/metrics/sharpness.h"
#include "engine/metrics/tde.h"
#include "tests/support/places.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

const fs::path kClip = fs::path(test::shared_data_folder()) / "sequences/blender_fox_gt";
constexpr int kBall = 3;

std::string file(const char* folder, int frame) {
    char name[16];
    std::snprintf(name, sizeof name, "%05d.png", frame);
    return (kClip / folder / name).string();
}

Matte ball_matte(int frame) {
    const cv::Mat ids = cv::imread(file("masks_ids", frame), cv::IMREAD_UNCHANGED);
    Matte m(ids.cols, ids.rows);
    for (int y = 0; y < ids.rows; ++y) {
        for (int x = 0; x < ids.cols; ++x)
            m.at(x, y) = ids.ptr(y)[x * ids.channels()] == kBall ? 255 : 0;
    }
    return m;
}

FlowField true_motion(int frame) {
    const cv::Mat png = cv::imread(file("flow_fwd_kitti16", frame), cv::IMREAD_UNCHANGED);
    FlowField f(Size{png.cols, png.rows});
    for (int y = 0; y < png.rows; ++y) {
        for (int x = 0; x < png.cols; ++x) {
            const auto* bgr = png.ptr<std::uint16_t>(y) + 3 * x;
            f.valid.at(x, y) = bgr[0] != 0 ? 255 : 0;
            f.d.at(x, y, 0) = (static_cast<float>(bgr[2]) - 32768.0f) / 64.0f;
            f.d.at(x, y, 1) = (static_cast<float>(bgr[1]) - 32768.0f) / 64.0f;
        }
    }
    return f;
}

ImageU8x3 brick() {
    const fs::path path =
        fs::path(test::shared_data_folder()) / "textures/brick/ufoai_wall_bricks005.jpg";
    const cv::Mat bgr = cv::imread(path.string());
    ImageU8x3 out(bgr.cols, bgr.rows);
    for (int y = 0; y < bgr.rows; ++y) {
        for (int x = 0; x < bgr.cols; ++x) {
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) = bgr.ptr(y)[3 * x + 2 - c];
        }
    }
    return out;
}

TEST(RenderedClip, TellsIdealStillFreshAndRewarpedTransportApart) {
    if (!fs::exists(kClip)) GTEST_SKIP() << "no evaluation data at " << kClip;
    const IdealTexture texture(brick());
    MotionChain chain(ball_matte(0));
    FlowField motion;
    ImageF1 ideal;
    ImageF1 still;
    ImageF1 fresh;
    ImageF1 rewarped;
    Matte region;
    RowSum floor;
    RowSum still_tde;
    RowSum fresh_tde;
    for (int t = 0; t < 5; ++t) {
        Matte matte = ball_matte(t);
        MotionChain step(t > 0 ? ball_matte(t - 1) : matte, 0);
        if (t > 0) {
            chain.advance(motion, matte);
            step.advance(motion, matte);
        }
        const FlowField ref = chain.ref_from_cur();
        FlowField here(ref.size());
        here.valid = ref.valid;
        Mat3 elsewhere(1);
        elsewhere[2][0] = static_cast<float>(97 * t);
        const ImageF1 next = texture.render_luma(ref, {});
        const ImageF1 next_still = texture.render_luma(here, {});
        const ImageF1 next_fresh = texture.render_luma(ref, TextureMapping(elsewhere));
        if (t > 0) {
            const Matte visible = visible_in_both(motion, region, ref.valid);
            const TemporalError e = measure_tde(ideal, next, motion, visible);
            EXPECT_GT(e.pixels, 5000);
            floor.add(e.tde);
            still_tde.add(measure_tde(still, next_still, motion, visible).tde);
            fresh_tde.add(measure_tde(fresh, next_fresh, motion, visible).tde);
        }
        rewarped = t == 0 ? next : moved(rewarped, step.ref_from_cur());
        ideal = next;
        still = next_still;
        fresh = next_fresh;
        region = ref.valid;
        if (t < 4) motion = true_motion(t);
    }
    EXPECT_LT(floor.mean(), 2);
    EXPECT_GT(still_tde.mean(), 8 * floor.mean());
    EXPECT_GT(fresh_tde.mean(), still_tde.mean());
    EXPECT_EQ(sharpness_kept(ideal, ideal, region).laplacian, 1);
    EXPECT_LT(sharpness_kept(rewarped, ideal, region).laplacian, 0.9);
}

}  // namespace
}  // namespace weft
