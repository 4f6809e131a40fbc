#include "engine/temporal/step_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <numbers>

#include "engine/core/luma.h"
#include "engine/core/rng.h"
#include "engine/motion/contour_flow.h"
#include "engine/motion/photometric_register.h"
#include "engine/temporal/outline_evidence.h"
#include "engine/temporal/surface_walker.h"
#include "tests/motion/pictures.h"
#include "tests/temporal/picture_flow.h"

namespace weft {
namespace {

constexpr Size kFrame{256, 176};
constexpr float kStep_px = 3;

float normal(Rng& rng) {
    return static_cast<float>(std::sqrt(-2 * std::log(1 - rng.uniform())) *
                              std::cos(2 * std::numbers::pi * rng.uniform()));
}

// A picture that moves to the right, of `contrast` (of full scale) about grey, under grain.
Matte frame_of(int t, float contrast, float grain_levels) {
    const WaveTexture texture(11);
    Rng rng(100 + static_cast<std::uint64_t>(t));
    return draw(kFrame, [&](Vec2 p) {
        const float value = texture(p - Vec2(kStep_px * static_cast<float>(t), 0)) - 0.5f;
        return 0.5f + contrast * value + grain_levels / 255 * normal(rng);
    });
}

// A window that stands still while what it shows moves: its outline says that nothing moves.
Matte window() {
    return draw(kFrame, [](Vec2 p) {
        return p.x > 30 && p.x < 226 && p.y > 20 && p.y < 156 ? 1.0f : 0.0f;
    });
}

TEST(StepMotion, FollowsFaintPlasterByItsPicture) {
    constexpr int kSlideFrames = 6;
    constexpr float kContrast = 0.03f, kGrain = 1.5f;
    const Matte matte = window();
    Matte last = frame_of(0, kContrast, kGrain);
    SurfaceWalker walker(last, matte, {});
    for (int t = 1; t < kSlideFrames; ++t) {
        const Matte luma = frame_of(t, kContrast, kGrain);
        const FlowField flow = flow_between(luma, last);
        // No more structure for one pixel than a flat fill has.
        ASSERT_LT(structure_to_noise(luma, matte, last, matte, flow), 1.25f);
        walker.advance(luma, matte, flow);
        last = luma;
    }
    for (const Vec2 p : std::array{Vec2(60, 60), Vec2(128, 88), Vec2(200, 120)}) {
        const Vec2 moved = walker.ref_from_cur().at(p);
        EXPECT_NEAR(moved.x, -kStep_px * (kSlideFrames - 1), 1.0f);
        EXPECT_NEAR(moved.y, 0, 1.0f);
    }
}

TEST(StepMotion, GrainAloneIsNoEvidence) {
    const Matte matte = window();
    const Matte last = frame_of(0, 0, 2.5f), luma = frame_of(1, 0, 2.5f);
    MotionChoice choice;
    const StepMotion step =
        choose_motion(gather_evidence(StepFrame(last, matte, matte), StepFrame(luma, matte, matte),
                                      flow_between(luma, last), FlowQuality::kFinal, 8),
                      choice);
    EXPECT_TRUE(step.by_outline);
}

// A faint pattern that moves to the right, under a shade that moves down and is far stronger.
TEST(StepMotion, FollowsAFaintClothUnderAMovingShade) {
    const auto shaded = [](int t) {
        const WaveTexture texture(11);
        Rng rng(100 + static_cast<std::uint64_t>(t));
        return draw(kFrame, [&](Vec2 p) {
            const float value = texture(p - Vec2(kStep_px * static_cast<float>(t), 0)) - 0.5f;
            const float shade = 1 + 0.5f * std::sin((p.y - 4 * static_cast<float>(t)) / 14);
            return (0.5f + 0.05f * value) * shade + 1.0f / 255 * normal(rng);
        });
    };
    const Matte matte = window(), last = shaded(0), luma = shaded(1);
    MotionChoice choice;
    const StepMotion found =
        choose_motion(gather_evidence(StepFrame(last, matte, matte), StepFrame(luma, matte, matte),
                                      flow_between(luma, last), FlowQuality::kFinal, 8),
                      choice);
    ASSERT_TRUE(choice.freed());
    for (const Vec2 p : std::array{Vec2(60, 60), Vec2(128, 88), Vec2(200, 120)}) {
        const Vec2 moved = found.prev_from_cur.at(p);
        EXPECT_NEAR(moved.x, -kStep_px, 0.3f);
        EXPECT_NEAR(moved.y, 0, 0.3f);
    }
}

LatticeField moved_along_x(float x) {
    return moved_by(kFrame, {x, 0});
}

// Paint with a little detail that moves to the right, and light with some that stands still.
Matte painted_and_lit(int t, float paint, float light) {
    const WaveTexture detail(11);
    Rng rng(100 + static_cast<std::uint64_t>(t));
    return draw(kFrame, [&](Vec2 p) {
        const float moving = detail(p - Vec2(kStep_px * static_cast<float>(t), 0)) - 0.5f;
        const float still = std::sin(p.x / 2.3f) * std::sin(p.y / 1.9f);
        return 0.5f + paint * moving + light * still + 4.0f / 255 * normal(rng);
    });
}

struct Leads {
    double as_fitted, corrected;
};
Leads leads_of(float paint, float light, const LatticeField& picture, const LatticeField& outline) {
    const Matte matte = window();
    const RegistrationPicture before =
        registration_picture(painted_and_lit(0, paint, light), matte);
    const RegistrationPicture now = registration_picture(painted_and_lit(1, paint, light), matte);
    return {registration_lead(before, now, picture, outline).errors,
            picture_lead(before, now, picture, outline)};
}

TEST(PictureLead, IsNoneOfMotionThatFollowsTheLight) {
    const Leads leads = leads_of(0.03f, 0.016f, moved_along_x(0), moved_along_x(-kStep_px));
    EXPECT_GT(leads.as_fitted, 1.5) << "by itself it leads";
    EXPECT_LT(leads.corrected, 0);
}

TEST(PictureLead, IsClearWherePaintMoves) {
    EXPECT_GT(leads_of(0.06f, 0, moved_along_x(-kStep_px), moved_along_x(0)).corrected, 1);
}

TEST(PictureLead, IsNothingWhereNothingCanBeCompared) {
    EXPECT_EQ(picture_lead({}, {}, moved_along_x(0), moved_along_x(-kStep_px)), 0);
}

TEST(StepMotion, WhatIsFoundAgainEverywhereIsNotSearchedTwice) {
    constexpr float kContrast = 0.6f, kGrain = 0.5f;
    const Matte matte = window();
    const Matte last = frame_of(0, kContrast, kGrain), luma = frame_of(1, kContrast, kGrain);
    const StepEvidence found =
        gather_evidence(StepFrame(last, matte, matte), StepFrame(luma, matte, matte),
                        flow_between(luma, last), FlowQuality::kFinal, 8);
    EXPECT_FALSE(found.by_freed);
    EXPECT_FALSE(found.freed_lead);
}

TEST(StepMotion, LeavesTheOutlineOpenUntilSomebodyAsks) {
    constexpr float kFaint = 0.03f, kGrain = 0.5f;
    const Matte matte = window();
    const Matte before = frame_of(0, kFaint, kGrain), now = frame_of(1, kFaint, kGrain);
    const auto prev = std::make_shared<const StepFrame>(before, matte, matte);
    const auto cur = std::make_shared<const StepFrame>(now, matte, matte);
    const auto flow = std::make_shared<const FlowField>(flow_between(now, before));
    const StepEvidence at_once = gather_evidence(*prev, *cur, *flow, FlowQuality::kFinal, 8);
    const StepEvidence open = picture_evidence(prev, cur, flow, FlowQuality::kFinal, 8);
    ASSERT_TRUE(at_once.by_outline);
    EXPECT_FALSE(open.by_outline);
    ASSERT_TRUE(open.open);
    const StepEvidence& whole = open.open->whole();
    ASSERT_TRUE(whole.by_outline);
    EXPECT_EQ(whole.lead, at_once.lead);
    EXPECT_EQ(whole.freed_lead, at_once.freed_lead);
    const auto same = [](const LatticeField& a, const LatticeField& b) {
        return std::equal(a.nodes().data(),
                          a.nodes().data() + a.nodes().size_bytes() / sizeof(float),
                          b.nodes().data());
    };
    EXPECT_TRUE(same(*whole.by_outline, *at_once.by_outline));
    EXPECT_TRUE(same(open.by_picture, at_once.by_picture));
}

TEST(MotionChoice, TakesThePictureWhereItClearlyLeads) {
    const auto first = [](double lead) {
        MotionChoice choice;
        choice.note(lead);
        return choice.by_outline() ? "outline" : "picture";
    };
    EXPECT_STREQ(first(3.0), "picture");
    EXPECT_STREQ(first(0.1), "outline");
    EXPECT_STREQ(first(-3.0), "outline");
    EXPECT_TRUE(MotionChoice().by_outline());
}

TEST(MotionChoice, ChangesOnlyWhenTheOtherLeadsForAWhile) {
    MotionChoice choice;
    choice.note(4);
    choice.note(4);
    ASSERT_FALSE(choice.by_outline());
    choice.note(-30);
    EXPECT_FALSE(choice.by_outline()) << "one frame is no reason";
    for (int k = 0; k < 4; ++k)
        choice.note(-4);
    EXPECT_TRUE(choice.by_outline());
}

TEST(MotionChoice, StructureThatFadesForAFrameKeepsThePicture) {
    const LatticeField still(kFrame, 8);
    MotionChoice choice;
    EXPECT_FALSE(choose_motion({still, {}, {}, {}, 0}, choice).by_outline);
    EXPECT_FALSE(choose_motion({still, {}, {}, still, 0.5}, choice).by_outline);
}

// A faint wall leads by about one and is not the better for it.
TEST(MotionChoice, TakesMotionFreedOfLightWhereItLeads) {
    const auto after = [](std::initializer_list<double> leads) {
        MotionChoice choice;
        for (const double lead : leads)
            choice.note_freed(lead);
        return choice.freed();
    };
    EXPECT_FALSE(after({}));
    EXPECT_FALSE(after({0.6, 0.4, 0.6, 1.8}));
    EXPECT_TRUE(after({2}));
    EXPECT_TRUE(after({-0.5, 3.5})) << "the first frames are averaged evenly";
    EXPECT_TRUE(after({2, 2, 2, 2, -30})) << "one frame is no reason";
    EXPECT_FALSE(after({2, -2, -2, -2}));
}

TEST(MotionChoice, FramesWithoutMotionFreedOfLightKeepThePlates) {
    LatticeField plate(kFrame, 8), freed(kFrame, 8);
    freed.set_node(0, 0, {1, 0});
    const auto moved = [](const StepMotion& step) { return step.prev_from_cur.node(0, 0).x; };
    MotionChoice choice;
    EXPECT_EQ(moved(choose_motion({plate, freed, 3.0, {}, 0}, choice)), 1);
    for (int k = 0; k < 50; ++k)
        EXPECT_EQ(moved(choose_motion({plate, {}, {}, {}, 0}, choice)), 0) << "not searched";
    EXPECT_EQ(moved(choose_motion({plate, freed, 0.5, {}, 0}, choice)), 1);
    EXPECT_EQ(moved(choose_motion({plate, freed, -4.0, {}, 0}, choice)), 0);
}

TEST(MotionChoice, FramesWithoutEvidenceChangeNothing) {
    for (const double lead : {4.0, -4.0}) {
        MotionChoice choice;
        choice.note(lead);
        const bool before = choice.by_outline();
        for (int k = 0; k < 50; ++k)
            choice.note(0);
        EXPECT_EQ(choice.by_outline(), before);
    }
}

// A wall of upright stripes whose lower edge shows: raw motion does not see that it moves down.
TEST(StepMotion, FollowsTheOutlineAlongStripesOfOneDirection) {
    constexpr float kDown_px = 2;
    const auto wall = [&](int t) {
        return draw(kFrame, [&](Vec2 p) {
            return p.y < 110 + kDown_px * static_cast<float>(t) ? 1.0f : 0.0f;
        });
    };
    const auto striped = [&](int t) {
        Rng rng(60 + static_cast<std::uint64_t>(t));
        return draw(kFrame, [&](Vec2 p) {
            const float x = p.x - kStep_px * static_cast<float>(t);
            return 0.5f + 0.2f * std::sin(x / 4) + 0.1f * std::sin(x / 7) +
                   2.0f / 255 * normal(rng);
        });
    };
    FlowField flow(kFrame);
    for (int y = 0; y < kFrame.height; ++y) {
        for (int x = 0; x < kFrame.width; ++x) {
            flow.d.pixel(x, y)[0] = -kStep_px;
            flow.valid.at(x, y) = 255;
        }
    }
    MotionChoice choice;
    for (int t = 1; t <= 3; ++t) {
        const Matte before = wall(t - 1), now = wall(t), last = striped(t - 1), luma = striped(t);
        const StepEvidence found =
            gather_evidence(StepFrame(last, before, before), StepFrame(luma, now, now), flow,
                            FlowQuality::kFinal, 8);
        ASSERT_TRUE(found.by_lines);
        const Vec2 step = choose_motion(found, choice).prev_from_cur.at({120, 60});
        // One step alone may be chance.
        EXPECT_TRUE(t == 1 || distance(step, {-kStep_px, -kDown_px}) < 0.3f) << t;
    }
    // What the picture shows along its lines goes before.
    MotionChoice seen;
    StepEvidence clear;
    clear.by_picture = moved_along_x(-1);
    clear.by_lines = moved_along_x(-5);
    clear.lines_lead = 3;
    EXPECT_EQ(choose_motion(clear, seen).prev_from_cur.at({120, 60}).x, -1);
}

// A wall of bricks that a pillar divides: the smaller piece finds itself again one brick further.
TEST(StepMotion, TakesOnePlaneWhereBendsFindNoMoreThanChance) {
    constexpr float kBrick_px = 16;
    const Matte matte = draw(kFrame, [](Vec2 p) { return p.x < 175 || p.x > 220 ? 1.0f : 0.0f; });
    const auto bricks = [&](int t) {
        Rng rng(80 + static_cast<std::uint64_t>(t));
        return draw(kFrame, [&](Vec2 p) {
            const float x = p.x - kStep_px * static_cast<float>(t);
            const float joints = std::max(std::cos(x * 2 * std::numbers::pi_v<float> / kBrick_px),
                                          std::cos(p.y * 2 * std::numbers::pi_v<float> / 11));
            return 0.4f + 0.2f * joints + 1.5f / 255 * normal(rng);
        });
    };
    FlowField flow(kFrame);
    for (int y = 0; y < kFrame.height; ++y) {
        for (int x = 0; x < kFrame.width; ++x) {
            flow.d.pixel(x, y)[0] = -kStep_px + (x > 215 ? kBrick_px : 0);
            flow.valid.at(x, y) = 255;
        }
    }
    const Matte last = bricks(0), luma = bricks(1);
    const StepEvidence found = gather_evidence(
        StepFrame(last, matte, matte), StepFrame(luma, matte, matte), flow, FlowQuality::kFinal, 8);
    for (const Vec2 p : {Vec2(40, 40), Vec2(120, 90), Vec2(235, 60), Vec2(240, 120)})
        EXPECT_LT(distance(found.by_picture.at(p), {-kStep_px, 0}), 0.3f) << p.x;
}

// A wall with faint structure in a window whose frame moves over it, as arms before a torso.
TEST(StepMotion, DoesNotFollowTheOutlineOfWhatPassesInFront) {
    constexpr float kContrast = 0.02f, kGrain = 1.5f;
    const WaveTexture frame(21);
    const auto inside = [](int t) {
        return draw(kFrame, [&](Vec2 p) {
            const Vec2 q = glm::abs(p - Vec2(110 + 4 * static_cast<float>(t), 88));
            return q.x < 70 && q.y < 55 ? 1.0f : 0.0f;
        });
    };
    const auto picture = [&](int t, const Matte& matte) {
        const WaveTexture wall(11);
        Rng rng(40 + static_cast<std::uint64_t>(t));
        return draw(kFrame, [&](Vec2 p) {
            const bool seen = matte.at(static_cast<int>(p.x), static_cast<int>(p.y)) >= 128;
            const float moved = 4 * static_cast<float>(t);
            const float value =
                seen ? 0.5f + kContrast * (wall(p) - 0.5f) : frame(p - Vec2(moved, 0));
            return value + kGrain / 255 * normal(rng);
        });
    };
    MotionChoice choice;
    Matte matte = inside(0), last = picture(0, matte);
    for (int t = 1; t <= 4; ++t) {
        const Matte now = inside(t), luma = picture(t, now);
        const StepEvidence found =
            gather_evidence(StepFrame(last, matte, matte), StepFrame(luma, now, now),
                            flow_between(luma, last), FlowQuality::kFinal, 8);
        ASSERT_TRUE(found.by_outline) << t;
        EXPECT_NEAR(found.by_outline->at({120, 88}).x, -4, 0.5);
        EXPECT_FALSE(choose_motion(found, choice).by_outline) << t;
        matte = now, last = luma;
    }
}

// Paints that differ more in colour than in brightness, under shades that move another way.
TEST(StepMotion, FollowsColoursUnderMovingShades) {
    const WaveTexture shades(31);
    const Matte matte = window();
    const auto display = [&](int t) {
        ImageU8x3 out(kFrame);
        Rng rng(70 + static_cast<std::uint64_t>(t));
        for (int y = 0; y < kFrame.height; ++y) {
            for (int x = 0; x < kFrame.width; ++x) {
                const Vec2 p = centre_of(x, y), q = p - Vec2(kStep_px * static_cast<float>(t), 0);
                const Vec2 s = p + Vec2(2 * static_cast<float>(t), 3 * static_cast<float>(t));
                const float paint = std::sin(q.x / 5) * std::sin(q.y / 6 + q.x / 17);
                const float light = 0.4f + 0.5f * shades(0.7f * s);
                for (int c = 0; c < 3; ++c) {
                    const std::array<float, 3> own{1 + 0.35f * paint, 1 + 0.1f * paint,
                                                   1 - 0.35f * paint};
                    out.pixel(x, y)[c] = code_of(light * own[static_cast<std::size_t>(c)] * 0.75f +
                                                 normal(rng) / 255);
                }
            }
        }
        return out;
    };
    const auto luma_of = [](const ImageU8x3& shown) {
        Matte out(shown.size());
        for (int y = 0; y < out.height(); ++y) {
            for (int x = 0; x < out.width(); ++x) {
                const std::uint8_t* p = shown.pixel(x, y);
                out.at(x, y) = static_cast<std::uint8_t>(luma_709_code(p[0], p[1], p[2]));
            }
        }
        return out;
    };
    ImageU8x3 colors = display(0);
    Matte last = luma_of(colors);
    auto start = std::make_shared<const StepFrame>(
        last, matte, matte, std::make_shared<const ImageU8x3>(colors), nullptr);
    ASSERT_TRUE(start->has_color());
    SurfaceWalker walker(start, {});
    std::shared_ptr<const StepFrame> before = start;
    constexpr int kSteps = 6;
    for (int t = 1; t <= kSteps; ++t) {
        colors = display(t);
        const Matte luma = luma_of(colors);
        auto now = std::make_shared<const StepFrame>(
            luma, matte, matte, std::make_shared<const ImageU8x3>(colors), before.get());
        StepEvidence evidence =
            gather_evidence(*before, *now, flow_between(luma, last), FlowQuality::kFinal, 8);
        ASSERT_TRUE(evidence.by_color) << t;
        EXPECT_LT(distance(evidence.by_color->at({128, 88}), {-kStep_px, 0}), 0.6f) << t;
        walker.advance({now, std::move(evidence)});
        before = now, last = luma;
    }
    for (const Vec2 p : {Vec2(80, 60), Vec2(128, 88), Vec2(180, 120)})
        EXPECT_LT(distance(walker.ref_from_cur().at(p), {-kStep_px * kSteps, 0}), 1.0f);
}

}  // namespace
}  // namespace weft
