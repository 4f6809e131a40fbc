// A striped wall that a camera pans over, and what passes in front of it.
#include "engine/mask/resting_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "engine/mask/signed_distance.h"
#include "tests/mask/moving_disc.h"
#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kRoom{320, 200};
constexpr float kRoomPan = 0.7f, kLimit_px = 60;
constexpr Recti kWall{60, 0, 250, 130};  // of the first frame; below it is a bed
constexpr int kBegins = 10;              // to move

using Place = std::function<bool(Vec2 p, int t)>;

// A thing that moves by itself.
struct Thing {
    Place is_at;
    Vec3 color;
    Vec2 step;
};

struct Room {
    std::vector<Thing> things;
    Vec2 wall_step{0, 0};  // against the room
    float pan = kRoomPan;
    bool blank = false;  // the wall, so that what passes takes the motion beside it along
    int blind_from = 1000, blind_to = 1000;  // frames without evidence: black, and not followed

    [[nodiscard]] Vec2 in_room(Vec2 p, int t) const {
        return p + Vec2(pan * static_cast<float>(t), 0);
    }
    [[nodiscard]] bool is_blind(int t) const { return t >= blind_from && t < blind_to; }
    [[nodiscard]] bool is_wall(Vec2 p, int t) const {
        const Vec2 q = in_room(p, t) - static_cast<float>(t) * wall_step;
        return q.x >= kWall.x0 && q.x < kWall.x1 && q.y >= kWall.y0 && q.y < kWall.y1;
    }
    [[nodiscard]] const Thing* thing_at(Vec2 p, int t) const {
        for (const Thing& thing : things)
            if (thing.is_at(in_room(p, t), t)) return &thing;
        return nullptr;
    }
    [[nodiscard]] Vec3 color(Vec2 p, int t) const {
        static const WaveTexture paint(1), cloth(2), around(3);
        const Vec2 q = in_room(p, t);
        if (is_blind(t)) return Vec3(0);
        if (const Thing* thing = thing_at(p, t)) return thing->color;
        if (is_wall(p, t)) {
            const Vec2 w = q - static_cast<float>(t) * wall_step;
            if (blank) return Vec3(236, 232, 230);
            const bool white = static_cast<int>(w.x / 12) % 2 == 0;
            return (white ? Vec3(236, 232, 230) : Vec3(214, 180, 190)) + 8.0f * paint(w);
        }
        if (q.y >= kWall.y1) return Vec3(70, 80, 120) + 60.0f * cloth(q);
        return Vec3(60, 90, 60) + 60.0f * around(q);
    }
    [[nodiscard]] ImageU8x3 frame(int t) const {
        ImageU8x3 out(kRoom);
        for (int y = 0; y < kRoom.height; ++y) {
            for (int x = 0; x < kRoom.width; ++x) {
                const Vec3 c = color(centre_of(x, y), t);
                for (int i = 0; i < 3; ++i)
                    out.at(x, y, i) = static_cast<std::uint8_t>(c[i]);
            }
        }
        return out;
    }
    // What of it is seen, and of what `also` says.
    [[nodiscard]] Matte wall(int t, const Place& also, const Place& but) const {
        Matte out(kRoom);
        for (int y = 0; y < kRoom.height; ++y) {
            for (int x = 0; x < kRoom.width; ++x) {
                const Vec2 p = centre_of(x, y), q = in_room(p, t);
                const bool seen = is_wall(p, t) && !thing_at(p, t) && !but(q, t);
                if (seen || also(q, t)) out.at(x, y) = 255;
            }
        }
        return out;
    }
    [[nodiscard]] FlowField prev_from_cur(int t) const {
        FlowField out(kRoom);
        for (int y = 0; y < kRoom.height; ++y) {
            for (int x = 0; x < kRoom.width; ++x) {
                const Vec2 p = centre_of(x, y);
                const Thing* thing = t > kBegins ? thing_at(p, t) : nullptr;
                const bool dragged = blank && t > kBegins && is_wall(p, t);
                const Vec2 own = thing           ? thing->step
                                 : dragged       ? things.front().step
                                 : is_wall(p, t) ? wall_step
                                                 : Vec2(0);
                out.d.pixel(x, y)[0] = pan - own.x;
                if (is_blind(t)) out.valid.at(x, y) = 0;
                out.d.pixel(x, y)[1] = -own.y;
            }
        }
        return out;
    }
};

constexpr auto kNowhere = [](Vec2, int) { return false; };

ImageF1 distance_of(const Matte& matte) {
    return signed_distance(inside_of(matte), kLimit_px);
}

// Follows the room to frame `last`; each frame's matte, as it was `found` where the scene has
// nothing to say.
struct Walk {
    Matte last;
    int corrected = 0;  // frames
};

Walk walk(const Room& room, int last, const Place& also, const Place& but) {
    const ImageU8x3 key = room.frame(0);
    Walk out{room.wall(0, also, kNowhere)};
    const SurfacePalette palette(key, distance_of(out.last));
    RestingScene scene(key, distance_of(out.last));
    for (int t = 1; t <= last; ++t) {
        out.last = room.wall(t, also, but);
        const ImageF1 found = distance_of(out.last);
        const Matte corrected =
            scene.corrected(room.frame(t), found, room.prev_from_cur(t), palette);
        if (!corrected.empty()) {
            ++out.corrected;
            out.last = corrected;
        }
        static_cast<void>(scene.remember(distance_of(out.last), palette));
    }
    return out;
}

// A board, 40 px wide, that crosses the wall from the left.
constexpr float kBoardWidth = 40, kBoardStep = 5;

float board_left(int t) {
    return 10 + kBoardStep * static_cast<float>(std::max(0, t - kBegins));
}

Room with_board() {
    return {{{[](Vec2 q, int t) {
                  return q.x >= board_left(t) && q.x < board_left(t) + kBoardWidth && q.y < 150;
              },
              Vec3(40, 60, 160),
              {kBoardStep, 0}}}};
}

// All that it has passed, and is lost with it.
bool is_behind_board(Vec2 q, int t) {
    return q.x < board_left(t) + kBoardWidth && q.x >= board_left(0);
}

TEST(RestingScene, GivesBackWhatAPassingThingUncovers) {
    const Room room = with_board();
    constexpr int kLast = 36;
    const Walk found = walk(room, kLast, kNowhere, is_behind_board);
    const Matte truth = room.wall(kLast, kNowhere, kNowhere);
    const Matte lost = room.wall(kLast, kNowhere, is_behind_board);
    EXPECT_LT(test::overlap(lost, truth), 0.6);
    EXPECT_GT(test::overlap(found.last, truth), 0.95);
}

TEST(RestingScene, GivesBackABlankWallThoughItSeemsToMoveWithWhatPasses) {
    Room room = with_board();
    room.pan = 0;
    room.blank = true;
    constexpr int kLast = 36;
    const Walk found = walk(room, kLast, kNowhere, is_behind_board);
    EXPECT_GT(test::overlap(found.last, room.wall(kLast, kNowhere, kNowhere)), 0.93);
}

TEST(RestingScene, LeavesABlankThingThatMoves) {
    Room room = with_board();
    room.pan = 0;
    room.blank = true;
    room.wall_step = room.things.front().step;
    EXPECT_EQ(walk(room, 30, kNowhere, kNowhere).corrected, 0);
}

TEST(RestingScene, KeepsWhatItKnowsThroughFramesThatShowNothing) {
    Room room = with_board();
    room.pan = 0;
    room.blind_from = 18;
    room.blind_to = 28;
    constexpr int kLast = 36;
    const Walk found = walk(room, kLast, kNowhere, is_behind_board);
    EXPECT_GT(test::overlap(found.last, room.wall(kLast, kNowhere, kNowhere)), 0.95);
}

// Of two legs on the bed one was painted as wall: it jumps about.
bool is_leg(Vec2 q, int t, float left) {
    const float jump = t > kBegins ? 4 * static_cast<float>((t - kBegins) % 8) : 0;
    return q.x >= left + jump && q.x < left + jump + 14 && q.y >= 120 && q.y < 170;
}

TEST(RestingScene, LetsGoOfWhatWasPaintedWithItAndMoves) {
    constexpr Vec3 kSkin(200, 140, 110);
    constexpr float kPainted = 120, kOther = 180;
    Room room;
    for (const float left : {kPainted, kOther, kOther + 16})
        room.things.push_back({[=](Vec2 q, int t) { return is_leg(q, t, left); }, kSkin, {4, 0}});
    const auto painted = [](Vec2 q, int t) { return is_leg(q, t, kPainted); };
    constexpr int kLast = 30;
    const Walk found = walk(room, kLast, painted, kNowhere);
    int left_px = 0, leg_px = 0;
    for (int y = 0; y < kRoom.height; ++y) {
        for (int x = 0; x < kRoom.width; ++x) {
            const Vec2 q = room.in_room(centre_of(x, y), kLast);
            if (!painted(q, kLast) || q.y < kWall.y1) continue;
            ++leg_px;
            left_px += found.last.at(x, y) != 0 ? 1 : 0;
        }
    }
    EXPECT_GT(leg_px, 400);
    EXPECT_LT(left_px, leg_px / 4);
    EXPECT_GT(test::overlap(found.last, room.wall(kLast, kNowhere, kNowhere)), 0.97);
}

TEST(RestingScene, LeavesWhatMovesAgainstItsSurroundings) {
    Room room = with_board();
    room.wall_step = {2.5f, 0};
    EXPECT_EQ(walk(room, 30, kNowhere, is_behind_board).corrected, 0);
}

}  // namespace
}  // namespace weft
