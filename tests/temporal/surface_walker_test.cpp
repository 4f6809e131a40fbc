#include "engine/temporal/surface_walker.h"

#include <gtest/gtest.h>

#include <glm/matrix.hpp>
#include <numeric>

#include "engine/motion/motion_blur.h"
#include "tests/motion/pictures.h"
#include "tests/temporal/picture_flow.h"

namespace weft {
namespace {

constexpr Size kShotFrame{256, 176};
constexpr int kFrames = 21;

// A textured plane that turns, comes nearer and tilts away, while something crosses in front of it.
class Shot {
  public:
    // Where the plane's points lie on frame t.
    static Mat3 frame_from_plane(int t) {
        const float s = static_cast<float>(t) / (kFrames - 1);
        const float angle = 0.10f * s, zoom = 1 + 0.12f * s;
        const Mat3 to_centre{1, 0, 0, 0, 1, 0, -128, -88, 1};
        const Mat3 turn{zoom * std::cos(angle),
                        zoom * std::sin(angle),
                        0.00025f * s,
                        -zoom * std::sin(angle),
                        zoom * std::cos(angle),
                        -0.00015f * s,
                        0,
                        0,
                        1};
        const Mat3 back{1, 0, 0, 0, 1, 0, 128 + 14 * s, 88 - 8 * s, 1};
        return back * turn * to_centre;
    }
    // Where a pixel of frame `from` lies on frame `to`.
    static Vec2 move(Vec2 p, int to, int from) {
        return project(frame_from_plane(to) * glm::inverse(frame_from_plane(from)), p);
    }
    static bool occluded(Vec2 p, int t) { return distance(p, Vec2(-30 + 15 * t, 96)) < 26; }

    Shot() {
        const WaveTexture plane(7), occluder(8);
        for (int t = 0; t < kFrames; ++t) {
            const Mat3 map = glm::inverse(frame_from_plane(t));
            luma.push_back(draw(kShotFrame, [&](Vec2 p) {
                return occluded(p, t) ? occluder(p - Vec2(15 * t, 0)) : plane(project(map, p));
            }));
            visible.push_back(
                draw(kShotFrame, [&](Vec2 p) { return occluded(p, t) ? 0.0f : 1.0f; }));
        }
    }

    std::vector<Matte> luma, visible;
};

// Mean distance, over the visible pixels of frame t, between where the walker says they were on the
// reference frame and where they were.
float mean_error(const LatticeField& ref_from_cur, const Shot& shot, int t, int reference) {
    double sum = 0;
    int count = 0;
    for (int y = 0; y < kShotFrame.height; y += 3) {
        for (int x = 0; x < kShotFrame.width; x += 3) {
            if (!shot.visible[static_cast<std::size_t>(t)].at(x, y)) continue;
            const Vec2 p = centre_of(x, y), truth = Shot::move(p, reference, t);
            if (!rect_of(kShotFrame).contains(static_cast<int>(truth.x), static_cast<int>(truth.y)))
                continue;
            sum += distance(p + ref_from_cur.at(p), truth);
            ++count;
        }
    }
    return static_cast<float>(sum / count);
}

const std::vector<int>& forwards() {
    static const std::vector<int> frames = [] {
        std::vector<int> f(kFrames);
        std::iota(f.begin(), f.end(), 0);
        return f;
    }();
    return frames;
}

// Walks over `frames`, the first of which is the reference; the error on each further one.
std::vector<float> walk(const Shot& shot, const std::vector<int>& frames) {
    const auto at = [](const std::vector<Matte>& list, int t) -> const Matte& {
        return list[static_cast<std::size_t>(t)];
    };
    SurfaceWalker walker(at(shot.luma, frames[0]), at(shot.visible, frames[0]), {});
    std::vector<float> errors;
    for (std::size_t k = 1; k < frames.size(); ++k) {
        const Matte& cur = at(shot.luma, frames[k]);
        walker.advance(cur, at(shot.visible, frames[k]),
                       flow_between(cur, at(shot.luma, frames[k - 1])));
        errors.push_back(mean_error(walker.ref_from_cur(), shot, frames[k], frames[0]));
    }
    return errors;
}

float mean(const std::vector<float>& v, std::size_t from, std::size_t to) {
    return std::accumulate(v.begin() + static_cast<std::ptrdiff_t>(from),
                           v.begin() + static_cast<std::ptrdiff_t>(to), 0.0f) /
           static_cast<float>(to - from);
}

void expect_close_without_drift(const std::vector<float>& errors, float bound) {
    for (std::size_t k = 0; k < errors.size(); ++k)
        EXPECT_LT(errors[k], bound) << "step " << k + 1;
    EXPECT_LT(mean(errors, 15, 20), mean(errors, 4, 9) + 0.04f);
}

TEST(SurfaceWalker, FollowsAPlaneBehindAnOccluder) {
    expect_close_without_drift(walk(Shot(), forwards()), 0.08f);
}

TEST(SurfaceWalker, WalksBackwards) {
    expect_close_without_drift(walk(Shot(), {forwards().rbegin(), forwards().rend()}), 0.08f);
}

TEST(SurfaceWalker, IsNotMisledByChangesOfBrightness) {
    Shot shot;
    for (int t = 0; t < kFrames; ++t) {
        const float gain = 1 - 0.3f * static_cast<float>(t) / (kFrames - 1);
        Matte& luma = shot.luma[static_cast<std::size_t>(t)];
        for (int y = 0; y < kShotFrame.height; ++y) {
            for (int x = 0; x < kShotFrame.width; ++x) {
                luma.at(x, y) = code_of(gain * static_cast<float>(luma.at(x, y)) / 255.0f);
            }
        }
    }
    expect_close_without_drift(walk(shot, forwards()), 0.08f);
}

TEST(SurfaceWalker, ChainsTrueMotionClosely) {
    const Shot shot;
    SurfaceWalkerOptions options;
    options.exact_motion = true;
    options.spacing_px = 4;
    SurfaceWalker walker(shot.luma[0], shot.visible[0], options);
    for (std::size_t t = 1; t < kFrames; ++t) {
        FlowField motion(kShotFrame);
        motion.valid = shot.visible[t];
        for (int y = 0; y < kShotFrame.height; ++y) {
            for (int x = 0; x < kShotFrame.width; ++x) {
                const Vec2 p = centre_of(x, y);
                const Vec2 d =
                    Shot::occluded(p, static_cast<int>(t))
                        ? Vec2(-15, 0)
                        : Shot::move(p, static_cast<int>(t) - 1, static_cast<int>(t)) - p;
                motion.d.at(x, y, 0) = d.x;
                motion.d.at(x, y, 1) = d.y;
            }
        }
        walker.advance(shot.luma[t], shot.visible[t], motion);
        EXPECT_LT(mean_error(walker.ref_from_cur(), shot, static_cast<int>(t), 0), 0.03f) << t;
    }
}

TEST(SurfaceWalker, TheStepIsTheLastMotion) {
    const Shot shot;
    SurfaceWalker walker(shot.luma[0], shot.visible[0], {});
    walker.advance(shot.luma[1], shot.visible[1], flow_between(shot.luma[1], shot.luma[0]));
    const LatticeField first = walker.prev_from_cur();
    walker.advance(shot.luma[2], shot.visible[2], flow_between(shot.luma[2], shot.luma[1]));
    const Vec2 p(180, 60);
    EXPECT_LT(distance(p + walker.prev_from_cur().at(p), Shot::move(p, 1, 2)), 0.15f);
    EXPECT_LT(distance(p + first.at(p), Shot::move(p, 0, 1)), 0.15f);
}

TEST(SurfaceWalker, BeginsWhereAnEarlierWalkEnded) {
    const Shot shot;
    LatticeField base(kShotFrame, 8);
    for (int j = 0; j < base.nodes().height(); ++j) {
        for (int i = 0; i < base.nodes().width(); ++i)
            base.set_node(i, j, {30, -12});
    }
    SurfaceWalker walker(shot.luma[0], shot.visible[0], {}, &base),
        plain(shot.luma[0], shot.visible[0], {});
    EXPECT_EQ(walker.ref_from_cur().nodes(), base.nodes());
    const FlowField motion = flow_between(shot.luma[1], shot.luma[0]);
    const Vec2 p(90, 40);
    const Vec2 moved = walker.advance(shot.luma[1], shot.visible[1], motion).at(p);
    const Vec2 alone = plain.advance(shot.luma[1], shot.visible[1], motion).at(p);
    EXPECT_LT(distance(moved, alone + Vec2(30, -12)), 1e-3f);
    // A new anchor changes what further frames are compared with, not where this one is.
    const LatticeField before = walker.ref_from_cur();
    walker.anchor_here();
    EXPECT_EQ(walker.ref_from_cur().nodes(), before.nodes());
}

TEST(SurfaceWalker, StandsStillWhereNothingIsVisible) {
    const Shot shot;
    const Matte nothing(kShotFrame);
    SurfaceWalker walker(shot.luma[0], nothing, {});
    walker.advance(shot.luma[1], nothing, flow_between(shot.luma[1], shot.luma[0]));
    EXPECT_EQ(walker.ref_from_cur().at({100, 100}), Vec2(0, 0));
}

// A textured card that swings to and fro, and how a frame of it looks.
struct Swing {
    WaveTexture texture{12};
    static Vec2 offset(int t) {
        const auto s = static_cast<float>(t);
        return {60 * std::sin(s / 7.0f), 14 * std::sin(s / 5.0f)};
    }
    static Vec2 to_card(Vec2 p, int t) { return p - offset(t); }
    static Matte visible(int t) {
        return draw(kShotFrame, [&](Vec2 p) {
            const Vec2 q = to_card(p, t) - Vec2(128, 88);
            return std::abs(q.x) < 50 && std::abs(q.y) < 45 ? 1.0f : 0.0f;
        });
    }
    [[nodiscard]] Matte luma(int t) const {
        return draw(kShotFrame, [&](Vec2 p) { return texture(to_card(p, t)); });
    }
    static float error(const LatticeField& ref_from_cur, int t) {
        const Vec2 p = Vec2(128, 88) + offset(t);
        float worst = 0;
        for (const Vec2 q : {p + Vec2(-30, -20), p + Vec2(30, -20), p, p + Vec2(0, 25)})
            worst = std::max(worst, distance(q + ref_from_cur.at(q), q - offset(t)));
        return worst;
    }
};

TEST(SurfaceWalker, FindsTheSurfaceAgainAfterItWasHidden) {
    const Swing swing;
    Matte before = swing.luma(0);
    SurfaceWalker walker(before, Swing::visible(0), {});
    for (int t = 1; t < 24; ++t) {
        const Matte cur = swing.luma(t);
        const bool hidden = t >= 4 && t < 15;
        walker.advance(cur, hidden ? Matte(kShotFrame) : Swing::visible(t),
                       flow_between(cur, before));
        if (!hidden) {
            EXPECT_LT(Swing::error(walker.ref_from_cur(), t), 0.15f) << t;
        }
        before = cur;
    }
}

TEST(SurfaceWalker, WaitsForTheSurfaceWithoutForgettingIt) {
    // Something else is in the matte for a while: it must not become what is followed.
    const Swing swing;
    const WaveTexture other(77);
    Matte before = swing.luma(0);
    SurfaceWalker walker(before, Swing::visible(0), {});
    for (int t = 1; t < 16; ++t) {
        const Matte cur = t == 6 || t == 7
                              ? draw(kShotFrame, [&](Vec2 p) { return other(p * 1.3f); })
                              : swing.luma(t);
        const bool hidden = t == 4 || t == 5;
        walker.advance(cur, hidden ? Matte(kShotFrame) : Swing::visible(t),
                       flow_between(cur, before));
        before = cur;
    }
    EXPECT_LT(Swing::error(walker.ref_from_cur(), 15), 0.15f);
}

TEST(SurfaceWalker, GoesOnWhenTheSurfaceComesIntoView) {
    const Shot shot;
    SurfaceWalker walker(shot.luma[0], Matte(kShotFrame), {});
    const FlowField motion = flow_between(shot.luma[1], shot.luma[0]);
    walker.advance(shot.luma[1], shot.visible[1], motion);
    EXPECT_LT(mean_error(walker.ref_from_cur(), shot, 1, 0), 0.2f);
}

// What turns away until it is less than a third as wide, and is not said to be a plane: the texture
// is let go once, and what it was is carried beside it, on the surface, for the seam to choose
// from.
TEST(SurfaceWalker, ReleasesAStretchedTextureAndKeepsTrackingIt) {
    const WaveTexture plane(7);
    const auto width_at = [](int t) { return std::pow(0.92f, static_cast<float>(t)); };
    const auto luma_at = [&](int t) {
        return draw(kShotFrame, [&](Vec2 p) {
            return plane({128 + (p.x - 128) / width_at(t), p.y});
        });
    };
    const auto visible_at = [&](int t) {
        return draw(kShotFrame,
                    [&](Vec2 p) { return std::abs(p.x - 128) < 120 * width_at(t) ? 1.0f : 0.0f; });
    };
    SurfaceWalkerOptions options;
    options.kind = SurfaceKind::kCloth;
    SurfaceWalker walker(luma_at(0), visible_at(0), options);
    walker.hide_reanchoring(true);
    int let_go = 0, carried = 0;
    for (int t = 1; t <= 20; ++t) {
        const LatticeField& ref_from_cur =
            walker.advance(luma_at(t), visible_at(t), flow_between(luma_at(t), luma_at(t - 1)));
        const auto slope = [](const LatticeField& f) {
            return 1 + (f.at({136, 88}).x - f.at({120, 88}).x) / 16;
        };
        if (!walker.stretched()) continue;
        if (let_go == 0) {
            let_go = t;
            EXPECT_NEAR(slope(*walker.stretched()), 3.5f, 0.5f);
            EXPECT_LT(slope(ref_from_cur), 1.5f);
        }
        ++carried;
        EXPECT_NEAR(slope(*walker.stretched()), 1 / width_at(t), 0.4f) << t;
    }
    EXPECT_GE(let_go, 14);
    EXPECT_LE(let_go, 17);
    EXPECT_EQ(carried, 21 - let_go);
}

// A camera that begins to pan, with the shutter open for half of each frame: a blurred frame fits
// a sharp one best somewhere beside its place.
TEST(SurfaceWalker, StaysInPlaceWhenAPanBlursThePicture) {
    const WaveTexture wall(14);
    const auto pan = [](int t) { return 1.2f * static_cast<float>(t * t); };
    const Matte all = draw(kShotFrame, [](Vec2) { return 1.0f; });
    const auto taken = [&](int t) {
        const Matte sharp =
            draw(kShotFrame, [&](Vec2 p) { return wall((p + Vec2(pan(t), 0)) * 1.2f); });
        const float way = t > 0 ? 0.5f * (pan(t) - pan(t - 1)) : 0;
        return exposed_along(sharp, all, moved_by(kShotFrame, {way, 0})).luma;
    };
    Matte before = taken(0);
    SurfaceWalker walker(before, all, {});
    for (int t = 1; t < 8; ++t) {
        const Matte cur = taken(t);
        walker.advance(cur, all, flow_between(cur, before));
        for (const Vec2 p : {Vec2(60, 50), Vec2(110, 90), Vec2(160, 120)})
            EXPECT_LT(distance(walker.ref_from_cur().at(p), Vec2(pan(t), 0)), 0.25f) << t;
        before = cur;
    }
}

// Raw motion that knows nothing of a fold that jerks: what is lost in one step comes back.
TEST(SurfaceWalker, FindsAgainWhatAStepHasLost) {
    const WaveTexture cloth(15);
    const Matte all = draw(kShotFrame, [](Vec2) { return 1.0f; });
    const Vec2 middle(150, 90);
    const auto fold = [&](Vec2 p, int t) {
        const float r = distance(p, middle);
        return t < 2 ? Vec2(0) : Vec2(8, 3) * std::exp(-r * r / (2 * 28 * 28));
    };
    const auto taken = [&](int t) {
        return draw(kShotFrame, [&](Vec2 p) { return cloth(p + fold(p, t)); });
    };
    FlowField still(kShotFrame);
    std::fill_n(still.valid.data(), still.valid.size_bytes(), std::uint8_t{255});
    SurfaceWalker walker(taken(0), all, {});
    for (int t = 1; t < 6; ++t)
        walker.advance(taken(t), all, still);
    for (const Vec2 p : {middle, middle + Vec2(20, 10), Vec2(50, 50)})
        EXPECT_LT(distance(walker.ref_from_cur().at(p), fold(p, 5)), 0.5f);
}

// A drawn sign, a flat fill with one line, that swings on and back: 12° from drawing to drawing.
class DrawnSign : public ::testing::TestWithParam<SurfaceKind> {};

TEST_P(DrawnSign, IsLaidOnTheReferenceDrawingAgain) {
    constexpr int kDrawings = 8;
    const auto turn = [](int t) { return 0.21f * static_cast<float>(t < 5 ? t : 8 - t); };
    const Vec2 hook(128, 40);
    const auto on_sign = [&](Vec2 p, int t) {
        const float c = std::cos(turn(t)), s = std::sin(turn(t));
        const Vec2 q = p - hook;
        return Vec2(c * q.x + s * q.y, -s * q.x + c * q.y) - Vec2(0, 45);
    };
    const auto inside = [](Vec2 q) {
        return std::abs(q.x) < 36 + 0.2f * q.y && std::abs(q.y) < 30;
    };
    const auto extent = [&](int t) {
        return draw(kShotFrame, [&](Vec2 p) { return inside(on_sign(p, t)) ? 1.0f : 0.0f; });
    };
    const auto luma = [&](int t) {
        return draw(kShotFrame, [&](Vec2 p) {
            const Vec2 q = on_sign(p, t);
            return !inside(q) ? 0.8f : std::abs(q.y - 6) < 1.5f ? 0.1f : 0.5f;
        });
    };
    SurfaceWalkerOptions options;
    options.kind = GetParam();
    SurfaceWalker walker(luma(0), extent(0), options);
    FlowField still(kShotFrame);
    std::fill_n(still.valid.data(), still.valid.size_bytes(), std::uint8_t{255});
    for (int t = 1; t <= kDrawings; ++t) {
        walker.advance(luma(t), extent(t), still);
        const float c = std::cos(turn(t)), s = std::sin(turn(t));
        for (const Vec2 q : {Vec2(-25, 25), Vec2(20, 60), Vec2(5, 30)}) {
            const Vec2 here = hook + Vec2(c * q.x - s * q.y, s * q.x + c * q.y);
            EXPECT_LT(distance(here + walker.ref_from_cur().at(here), hook + q), 0.6f)
                << "drawing " << t;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, DrawnSign,
                         ::testing::Values(SurfaceKind::kFound, SurfaceKind::kPlane));

}  // namespace
}  // namespace weft
