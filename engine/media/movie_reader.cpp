#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdio>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "engine/core/input_file.h"
#include "engine/core/setting.h"
#include "engine/core/text.h"
#include "engine/media/frame_pacing.h"
#include "engine/media/movie_decoder.h"
#include "engine/media/movie_fields.h"
#include "engine/media/movie_pixels.h"
#include "engine/media/plate_decode.h"
#include "engine/media/plates.h"
#include "engine/media/raster_errors.h"
#include "engine/media/video_library.h"

namespace weft {
namespace {

constexpr std::size_t kRecentBudget_bytes = std::size_t{48} << 20;

std::size_t sample_bytes(const Raster& raster) {
    return std::visit([](const auto& samples) { return samples.size() * sizeof(samples[0]); },
                      raster.samples);
}

// The frames of one movie by number. Going back means decoding again from the start; the frames
// before the requested one are kept on the way, because stepping back usually continues, and those
// skipped by a short step forward, because several threads ask for them in any order.
class MovieFrames {
  public:
    explicit MovieFrames(const std::string& path) : decoder_(path) {}

    /// Frame `index`, counted from 0; null when it cannot be decoded.
    std::shared_ptr<const Raster> frame(int index) {
        for (const auto& [i, raster] : recent_) {
            if (i == index) return raster;
        }
        const bool backwards = index < next_;
        if ((backwards || !open_) && !rewind()) return nullptr;
        const bool near = index - next_ < kept_frames_;
        const int keep_from = backwards || near ? index - kept_frames_ + 1 : index;
        while (true) {
            const AVFrame* decoded = decoder_.next();
            if (!decoded) return nullptr;
            const int number = next_++;
            if (number < keep_from) continue;
            auto raster = converter_.convert(*decoded, decoder_.rotation_deg());
            if (raster) keep(number, raster);
            if (number == index) return raster;
        }
    }

  private:
    bool rewind() {
        recent_.clear();
        next_ = 0;
        open_ = decoder_.rewind();
        return open_;
    }

    void keep(int index, const std::shared_ptr<const Raster>& raster) {
        const std::size_t bytes = std::max<std::size_t>(1, sample_bytes(*raster));
        kept_frames_ =
            static_cast<int>(std::clamp<std::size_t>(kRecentBudget_bytes / bytes, 1, 64));
        recent_.emplace_back(index, raster);
        while (static_cast<int>(recent_.size()) > kept_frames_)
            recent_.pop_front();
    }

    MovieDecoder decoder_;
    MovieConverter converter_;
    bool open_ = false;
    int next_ = 0;  // the frame that the decoder gives next
    int kept_frames_ = 1;
    std::deque<std::pair<int, std::shared_ptr<const Raster>>> recent_;
};

struct MovieFacts {
    Size size;
    PixelDepth depth = PixelDepth::kU8;
    double fps = 0;
    double pixel_aspect = 1;
    int frames = 0;         ///< frames that can be decoded
    int claimed = 0;        ///< number by the container; 0 if it does not say
    int damaged = 0;        ///< Frames that were decoded with errors.
    int first_damaged = 0;  ///< Counted from 0.
    bool high_dynamic_range = false;
    bool variable_rate = false;
    bool only_flagged_interlaced = false;  ///< The pictures are progressive.
    double shortest_s = 0, longest_s = 0;  ///< For how long single frames are shown.
};

Error another_size(const std::string& path, int frame, Size size, Size first) {
    return unreadable(path,
                      "its frame " + std::to_string(frame) + " is " + size_text(size) +
                          " but the first one is " + size_text(first),
                      "All frames of a plate must have one size: export it with a constant size.");
}

bool is_damaged(const AVFrame& frame) {
    return (frame.flags & AV_FRAME_FLAG_CORRUPT) != 0 || frame.decode_error_flags != 0;
}

class MoviePlate final : public FrameReader {
  public:
    MoviePlate(std::string path, int start, MovieFacts facts)
        : path_(std::move(path)), facts_(facts), decoded_(path_) {
        for (int i = 0; i < facts.frames; ++i)
            frames_.push_back(start + i);
    }

    const std::vector<int>& frames() const override { return frames_; }
    Size size() const override { return facts_.size; }
    double fps() const override { return facts_.fps; }
    double pixel_aspect() const override { return facts_.pixel_aspect; }
    PixelDepth depth() const override { return facts_.depth; }
    bool display_encoded() const override { return true; }
    std::string path_of(int /*frame*/) const override { return path_; }

    Expected<PlateFrame> read(int frame) const override {
        WEFT_CHECK_OK(check_range(frame));
        std::shared_ptr<const Raster> raster;
        {
            const std::lock_guard lock(mutex_);
            raster = decoded_.frame(frame - frames_.front());
        }
        if (!raster) {
            return tl::unexpected(
                damaged(path_, "frame " + std::to_string(frame) + " can no longer be decoded"));
        }
        if (raster->info.size != facts_.size) {
            return tl::unexpected(another_size(path_, frame, raster->info.size, facts_.size));
        }
        return to_plate(*raster);
    }

    Expected<Hash128> stamp(int frame) const override {
        WEFT_CHECK_OK(check_range(frame));
        return stamp_file(path_, frame);
    }

    std::vector<std::string> warnings() const override {
        std::vector<std::string> found;
        if (facts_.claimed > facts_.frames) {
            found.push_back(path_ + " claims " + std::to_string(facts_.claimed) +
                            " frames, but only " + std::to_string(facts_.frames) +
                            " can be decoded. It may be cut off: compare it with its source.");
        }
        if (facts_.damaged > 0) {
            found.push_back(path_ + " is damaged in " + std::to_string(facts_.damaged) +
                            " frames, first in " +
                            std::to_string(frames_.front() + facts_.first_damaged) +
                            ". Check these frames, or copy the movie again.");
        }
        if (facts_.high_dynamic_range) {
            found.push_back(path_ +
                            " is an HDR movie (PQ or HLG), whose values are taken as they stand. "
                            "Convert it to numbered EXR frames to keep its colours.");
        }
        if (facts_.only_flagged_interlaced) {
            found.push_back(path_ +
                            " is flagged as interlaced, but its pictures are progressive: each "
                            "shows one moment. They are used as they are.");
        }
        if (facts_.variable_rate) {
            char text[64];
            std::snprintf(text, sizeof text, "%.1f to %.1f ms each", 1000 * facts_.shortest_s,
                          1000 * facts_.longest_s);
            char rate[32];
            std::snprintf(rate, sizeof rate, "%.5g", facts_.fps);
            found.push_back(
                path_ + " has a variable frame rate (" + text +
                "). Its frames are taken by number and the result runs at a constant " + rate +
                " fps. To keep its timing, convert it first: ffmpeg -i IN -vf fps=" + rate +
                " OUT.");
        }
        return found;
    }

  private:
    Status check_range(int frame) const {
        if (frame >= frames_.front() && frame <= frames_.back()) return {};
        return fail(ErrorCode::kMissingFrames,
                    "Frame " + std::to_string(frame) + " is missing in " + path_ + ", which has " +
                        std::to_string(frames_.front()) + " to " + std::to_string(frames_.back()) +
                        ".",
                    "Render other frames, or change the number of the first frame" +
                        by({{setting::kFrames}, {setting::kMovieStart}}) + ".");
    }

    std::string path_;
    MovieFacts facts_;
    std::vector<int> frames_;
    mutable std::mutex mutex_;
    mutable MovieFrames decoded_;
};

// Containers are unreliable about their number of frames, so frames are counted. `frame`: the
// first. `counted`: see ReadOptions.
Status count_frames(MovieDecoder& decoder, const AVFrame* frame, const std::string& path,
                    std::atomic<int>* counted, MovieFacts& facts) {
    FramePacing pacing;
    MovieFields fields;
    for (; frame; frame = decoder.next(), ++facts.frames) {
        if (counted) *counted = facts.frames + 1;
        fields.add(*frame);
        if (frame->best_effort_timestamp == AV_NOPTS_VALUE)
            pacing.add_unknown();
        else
            pacing.add(frame->best_effort_timestamp);
        if (!is_damaged(*frame)) continue;
        if (facts.damaged++ == 0) facts.first_damaged = facts.frames;
    }
    if (fields.are_interlaced()) {
        const char* flags = fields.are_flagged() ? "" : ", though it is not flagged so";
        return tl::unexpected(unreadable(
            path, std::string("it is interlaced: its frames hold two moments in time") + flags,
            "Deinterlace it first, for instance: ffmpeg -i IN -vf bwdif OUT, or bring telecined "
            "film back with: ffmpeg -i IN -vf fieldmatch,decimate OUT."));
    }
    facts.only_flagged_interlaced = fields.are_flagged();
    facts.claimed = decoder.claimed_frames();
    // Frames that could not be decoded leave gaps, which have their own warning.
    const bool complete = facts.claimed <= facts.frames || decoder.claims_by_duration();
    facts.variable_rate = facts.damaged == 0 && complete && pacing.varies();
    if (facts.variable_rate) facts.claimed = facts.frames;
    const auto [shortest, longest] = pacing.durations();
    facts.shortest_s = static_cast<double>(shortest) * decoder.tick_s();
    facts.longest_s = static_cast<double>(longest) * decoder.tick_s();
    return {};
}

}  // namespace

Expected<std::shared_ptr<const FrameReader>> open_movie_plate(const std::string& path,
                                                              const ReadOptions& options) {
    silence_video_library();
    WEFT_CHECK_OK(stamp_file(path, 0));
    WEFT_CHECK_OK(check_input_file(path));
    MovieDecoder decoder(path);
    if (!decoder.rewind()) {
        if (decoder.has_sound_only()) {
            return tl::unexpected(unreadable(path, "it has sound but no pictures",
                                             "Give the movie with the pictures."));
        }
        return tl::unexpected(unreadable(path, "it is not a movie, or is cut off before its index",
                                         "Copy or export it again."));
    }
    const AVFrame* frame = decoder.next();
    const auto first = frame ? MovieConverter().convert(*frame, decoder.rotation_deg()) : nullptr;
    if (!first) {
        return tl::unexpected(unreadable(path, "it is a movie without frames that can be decoded",
                                         "Copy or export it again."));
    }
    MovieFacts facts;
    facts.size = first->info.size;
    facts.depth = depth_of(first->info.kind);
    facts.fps = decoder.fps();
    facts.pixel_aspect = decoder.pixel_aspect();
    facts.high_dynamic_range =
        frame->color_trc == AVCOL_TRC_SMPTE2084 || frame->color_trc == AVCOL_TRC_ARIB_STD_B67;
    WEFT_CHECK_OK(count_frames(decoder, frame, path, options.counted.get(), facts));
    return std::make_shared<MoviePlate>(path, options.movie_start, facts);
}

}  // namespace weft
