#include "engine/media/matte_movie.h"

#include <algorithm>
#include <utility>

#include "engine/core/hash.h"
#include "engine/core/luma.h"
#include "engine/core/setting.h"
#include "engine/media/image_files.h"
#include "engine/media/matte_code.h"
#include "engine/media/matte_look.h"
#include "engine/media/plates.h"
#include "engine/media/raster_errors.h"

namespace weft {
namespace {

constexpr std::size_t kMostOpen = 32;
constexpr std::size_t kKept_bytes = std::size_t{64} << 20;
constexpr std::size_t kMostKept = 512;
constexpr int kMovieLooks = 24;  // of a movie, spread over all of it

// A surface is followed both ways from its reference frame, region by region, and every frame is
// rendered after that: a movie is read many times.
class OpenMovies {
  public:
    Expected<std::shared_ptr<const MatteMovie>> open(const std::string& path) {
        WEFT_CHECK_OK(check_picture_exists(path));
        WEFT_TRY(stamp, stamp_file(path, 0));
        const std::lock_guard lock(mutex_);
        for (const auto& [known, movie] : open_)
            if (known == stamp) return movie;
        WEFT_TRY(reader, open_plate(path, {{}, 0}));
        if (open_.size() >= kMostOpen) open_.pop_front();
        auto movie = std::make_shared<const MatteMovie>(path, std::move(reader));
        open_.emplace_back(stamp, movie);
        return movie;
    }

  private:
    std::mutex mutex_;
    std::deque<std::pair<Hash128, std::shared_ptr<const MatteMovie>>> open_;
};

Matte coverage_in(const PlateFrame& frame, const std::string& channel) {
    Matte matte(frame.rgb.size());
    std::uint8_t* const out = matte.data();
    const auto pixels = matte.size_bytes();
    if (channel == "A") {
        const float* alpha = frame.alpha.data();
        std::transform(alpha, alpha + pixels, out, matte_code);
        return matte;
    }
    const float* rgb = frame.rgb.data();
    const std::size_t c = channel == "R" ? 0 : channel == "G" ? 1 : 2;
    for (std::size_t i = 0; i < pixels; ++i, rgb += 3)
        out[i] = matte_code(channel == "Y" ? luma_709(rgb) : rgb[c]);
    return matte;
}

bool is_transparent(const ImageF1& alpha) {
    const float* const begin = alpha.data();
    return std::any_of(begin, begin + alpha.size_bytes() / sizeof(float),
                       [](float a) { return a != 1.0f; });
}

bool is_channel(const std::string& name) {
    return name == "R" || name == "G" || name == "B" || name == "A" || name == "Y";
}

}  // namespace

Expected<std::shared_ptr<const MatteMovie>> MatteMovie::open(const std::string& path) {
    static OpenMovies movies;
    return movies.open(path);
}

MatteMovie::MatteMovie(std::string path, std::shared_ptr<const FrameReader> movie)
    : path_(std::move(path)), movie_(std::move(movie)) {}

Expected<std::string> MatteMovie::default_channel() const {
    {
        const std::lock_guard lock(mutex_);
        if (!default_channel_.empty()) return default_channel_;
    }
    const int looks = std::min(frame_count(), kMovieLooks);
    std::string channel = "Y";
    for (int k = 0; k < looks && channel == "Y"; ++k) {
        WEFT_TRY(frame, movie_->read(k * frame_count() / looks));
        if (frame.alpha.empty()) break;
        if (is_transparent(frame.alpha)) channel = "A";
    }
    const std::lock_guard lock(mutex_);
    return default_channel_ = channel;
}

const MatteMovie::Kept* MatteMovie::find(int index, const std::string& channel) const {
    const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) {
        return kept.index == index && kept.channel == channel;
    });
    return found == kept_.end() ? nullptr : &*found;
}

void MatteMovie::keep(Kept matte) const {
    const std::size_t bytes = std::max<std::size_t>(1, matte.matte.size_bytes());
    const std::size_t most = std::clamp<std::size_t>(kKept_bytes / bytes, 1, kMostKept);
    const std::lock_guard lock(mutex_);
    if (find(matte.index, matte.channel)) return;
    kept_.push_back(std::move(matte));
    while (kept_.size() > most)
        kept_.pop_front();
}

Expected<Matte> MatteMovie::read(int index, const std::string& channel) const {
    if (index < 0 || index >= frame_count()) {
        return fail(ErrorCode::kMissingFrames,
                    "The matte " + path_ + " has " + std::to_string(frame_count()) +
                        " frames, and none for this one.",
                    "Give a movie that is as long as the plate.");
    }
    std::string from = channel;
    if (from.empty()) {
        WEFT_TRY(by_itself, default_channel());
        from = std::move(by_itself);
    }
    {
        const std::lock_guard lock(mutex_);
        if (const Kept* kept = find(index, from)) return kept->matte;
    }
    WEFT_TRY(frame, movie_->read(index));
    if (!is_channel(from) || (from == "A" && frame.alpha.empty())) {
        const std::string have = frame.alpha.empty() ? "R, G, B and Y" : "R, G, B, A and Y";
        return tl::unexpected(unreadable(path_, "it has no channel '" + from + "'",
                                         "It has " + have + by({{setting::kMatteChannel}}) + "."));
    }
    Matte matte = coverage_in(frame, from);
    keep({index, from, matte});
    return matte;
}

Expected<std::string> MatteMovie::judge() const {
    WEFT_TRY(channel, default_channel());
    const int looks = std::min(frame_count(), kMovieLooks);
    MatteJudge judge;
    for (int k = 0; k < looks && !judge.is_satisfied(); ++k) {
        WEFT_TRY(frame, movie_->read(k * frame_count() / looks));
        if (channel != "A") frame.alpha = {};
        judge.add(look_at_matte(frame.rgb, frame.alpha));
    }
    WEFT_CHECK_OK(judge.check(path_));
    return judge.warning(path_);
}

}  // namespace weft
