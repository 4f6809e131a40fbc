#include "engine/media/matte_look.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <mutex>
#include <optional>

#include "engine/core/hash.h"
#include "engine/core/luma.h"
#include "engine/core/setting.h"
#include "engine/media/image_files.h"
#include "engine/media/plates.h"

namespace weft {
namespace {

// Grey that a lossy codec has tinted differs by less.
constexpr float kColoured = 0.2f;
constexpr double kColouredShare = 0.001;
// Ids are small codes; whoever wants so little of a texture sets its opacity.
constexpr float kHardlyAnything = 0.125f;
constexpr float kFull = 0.5f, kEmpty = 0.02f;
constexpr double kCodes = 255;

std::string percent(float share) {
    return std::to_string(std::lround(100 * share)) + " %";
}

bool is_opaque(const ImageF1& alpha) {
    const float* const begin = alpha.data();
    return std::all_of(begin, begin + alpha.size_bytes() / sizeof(float),
                       [](float a) { return a == 1.0f; });
}

// A project that is being edited is opened again and again, with the same files.
class LooksTaken {
  public:
    std::optional<MatteLook> find(const Hash128& stamp) {
        const std::lock_guard lock(mutex_);
        const auto found = looks_.find(stamp);
        return found == looks_.end() ? std::nullopt : std::optional(found->second);
    }
    void keep(const Hash128& stamp, const MatteLook& look) {
        constexpr std::size_t kMost = 4096;
        const std::lock_guard lock(mutex_);
        if (looks_.size() >= kMost) looks_.clear();
        looks_.emplace(stamp, look);
    }

  private:
    std::mutex mutex_;
    std::map<Hash128, MatteLook> looks_;
};

// Nothing if the file cannot be read.
std::optional<MatteLook> look_at_file(const std::string& path, const std::string& channel) {
    static LooksTaken taken;
    const auto file = stamp_file(path, 0);
    if (!file) return std::nullopt;
    const Hash128 stamp = Hasher().value(file->high).value(file->low).text(channel).finish();
    if (const auto known = taken.find(stamp)) return known;
    auto picture = read_image(path);
    if (!picture) return std::nullopt;
    // Without a channel, each file is read by its alpha if that is not opaque.
    if (channel != "A" && (channel == "Y" || is_opaque(picture->alpha))) picture->alpha = {};
    const MatteLook look = look_at_matte(picture->rgb, picture->alpha);
    taken.keep(stamp, look);
    return look;
}

}  // namespace

MatteLook look_at_matte(ViewF3 rgb, const ImageF1& alpha) {
    MatteLook look;
    std::size_t coloured = 0;
    for (int y = 0; y < rgb.height(); ++y) {
        const float* p = rgb.row(y);
        for (int x = 0; x < rgb.width(); ++x, p += 3) {
            const float coverage = alpha.empty() ? luma_709(p) : alpha.at(x, y);
            if (!std::isfinite(coverage)) continue;
            look.least = std::min(look.least, coverage);
            look.most = std::max(look.most, coverage);
            const auto [low, high] = std::minmax({p[0], p[1], p[2]});
            coloured += alpha.empty() && high - low > kColoured;
        }
    }
    const double pixels = std::max(1.0, static_cast<double>(rgb.width()) * rgb.height());
    look.coloured = static_cast<double>(coloured) / pixels;
    return look;
}

void MatteJudge::add(const MatteLook& look) {
    all_.least = std::min(all_.least, look.least);
    all_.most = std::max(all_.most, look.most);
    all_.coloured = std::max(all_.coloured, look.coloured);
    satisfied_ = all_.coloured <= kColouredShare && all_.most >= kFull && all_.least <= kEmpty;
}

Status MatteJudge::check(const std::string& name) const {
    const std::string pick = by({{setting::kMatteValue}});
    if (all_.coloured > kColouredShare) {
        return fail(ErrorCode::kUnreadable,
                    "The matte " + name + " has colours, and which of them covers is not known.",
                    "Name the channel" + by({{setting::kMatteChannel}}) +
                        ": R, G, B, or Y for its brightness; or the id that is meant" + pick + ".");
    }
    if (all_.most <= 0 || all_.most >= kHardlyAnything) return {};
    const long code = std::max(1L, std::lround(kCodes * static_cast<double>(all_.most)));
    return fail(ErrorCode::kUnreadable,
                "The matte " + name + " covers hardly anything: its values go up to " +
                    std::to_string(code) + " of 255, as ids do.",
                "Name the id that is meant" + pick + ", or give a matte that is white inside.");
}

std::string MatteJudge::warning(const std::string& name) const {
    if (all_.most > 0 && all_.most < kFull) {
        return "The matte " + name + " covers nothing by more than " + percent(all_.most) +
               ": the old surface shows through everywhere.";
    }
    if (all_.least <= kEmpty || all_.least >= kFull) return {};
    return "The matte " + name + " is nowhere below " + percent(all_.least) +
           ": the new surface shows a little everywhere. Stretch its levels if black is not 0, as "
           "in pictures of video levels.";
}

Expected<std::string> judge_mattes(const std::string& name, const std::vector<std::string>& paths,
                                   const std::string& channel) {
    constexpr std::size_t kMostLooks = 24;
    const std::size_t looks = std::min(paths.size(), kMostLooks);
    MatteJudge judge;
    for (std::size_t k = 0; k < looks && !judge.is_satisfied(); ++k)
        if (const auto look = look_at_file(paths[k * paths.size() / looks], channel))
            judge.add(*look);
    WEFT_CHECK_OK(judge.check(name));
    return judge.warning(name);
}

}  // namespace weft
