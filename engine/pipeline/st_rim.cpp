#include "engine/pipeline/st_rim.h"

#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace weft {
namespace {

constexpr int kRimPx = 2;
constexpr float kRimJump = 0.25f;  // of a texture that repeats, from its end to its beginning
constexpr std::array<Vec2i, 8> kRimAround{
    {{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};

class MapRim {
  public:
    MapRim(const ImageF2& st, ViewF1 known) : st_(st), known_(known.width(), known.height()) {
        for (int y = 0; y < known.height(); ++y)
            for (int x = 0; x < known.width(); ++x)
                known_.at(x, y) = known.at(x, y) > 0 ? 1 : 0;
    }

    /// One pixel further.
    void grow() {
        ImageF2 st = st_;
        Image<std::uint8_t, 1> known = known_;
        for (int y = 0; y < known_.height(); ++y) {
            for (int x = 0; x < known_.width(); ++x) {
                if (known_.at(x, y)) continue;
                const auto place = continued({x, y});
                if (!place) continue;
                st.at(x, y, 0) = place->x;
                st.at(x, y, 1) = place->y;
                known.at(x, y) = 1;
            }
        }
        st_ = std::move(st);
        known_ = std::move(known);
    }

    [[nodiscard]] ImageF2 take() { return std::move(st_); }

  private:
    [[nodiscard]] bool shows(Vec2i p) const {
        return p.x >= 0 && p.y >= 0 && p.x < known_.width() && p.y < known_.height() &&
               known_.at(p.x, p.y);
    }
    [[nodiscard]] Vec2 at(Vec2i p) const { return {st_.at(p.x, p.y, 0), st_.at(p.x, p.y, 1)}; }

    // By the first direction in which two pixels lead here, else as the first pixel beside.
    [[nodiscard]] std::optional<Vec2> continued(Vec2i p) const {
        std::optional<Vec2> beside;
        for (const Vec2i d : kRimAround) {
            if (!shows(p + d)) continue;
            const Vec2 near = at(p + d);
            if (!beside) beside = near;
            if (!shows(p + 2 * d)) continue;
            const Vec2 step = near - at(p + 2 * d);
            if (std::fabs(step.x) < kRimJump && std::fabs(step.y) < kRimJump) return near + step;
        }
        return beside;
    }

    ImageF2 st_;
    Image<std::uint8_t, 1> known_;
};

}  // namespace

void continue_map(ImageF2& st, ViewF1 known) {
    MapRim rim(st, known);
    for (int k = 0; k < kRimPx; ++k)
        rim.grow();
    st = rim.take();
}

}  // namespace weft
