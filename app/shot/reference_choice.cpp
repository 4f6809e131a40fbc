#include "app/shot/reference_choice.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <vector>

#include "app/shot/frame_plan.h"
#include "app/shot/matte_movies.h"
#include "engine/core/parallel.h"
#include "engine/mask/matte_box.h"
#include "engine/mask/surface_visibility.h"
#include "engine/media/matte_files.h"

namespace weft {
namespace {

// Numbers of frames examined: first to judge the first frame, then to find a better one, then to
// find a surface that is visible only briefly.
constexpr std::array<std::size_t, 4> kLooks{9, 33, 129, 257};
// Mattes read at the same time: a 4K matte takes up to 130 MB while it is decoded.
constexpr std::size_t kAtOnce = 2;
constexpr std::size_t kMostKept = 100'000;

// What a source has on a frame.
struct Layer {
    MatteFiles files;
    int frame;
    MatteSelect select;
};

// Nothing if it is painted on other frames only.
std::optional<Layer> layer_on(const MatteSource& source, int frame, const FrameReader& plate) {
    if (source.files.empty()) {
        const auto key = source.keyframes.find(frame);
        if (key == source.keyframes.end()) return std::nullopt;
        return Layer{MatteFiles::single(key->second.path), frame, source.select};
    }
    auto files = matte_files(source.files, plate);
    if (!files) return std::nullopt;
    return Layer{std::move(*files), frame, source.select};
}

Expected<Matte> read_layer(const Layer& layer, Size size, const PaintedMattes& painted) {
    const std::string path = layer.files.path_for(layer.frame);
    if (painted.contains(path)) return read_matte(path, layer.select, size, painted);
    return layer.files.read(layer.frame, layer.select, size);
}

void hash_layer(Hasher& hasher, const Layer& layer) {
    const MatteSelect& select = layer.select;
    if (const auto stamp = layer.files.stamp(layer.frame))
        hasher.value(stamp->high).value(stamp->low);
    hasher.value(select.value.value_or(-1)).value(select.value.has_value()).value(select.invert);
    hasher.text(select.channel).text(select.crypto).text(layer.files.path_for(layer.frame));
}

// The region's matte on a frame and its holdouts. Painted holdouts are ignored, because frames
// without a keyframe would seem to show more.
std::vector<Layer> layers_on(const Region& region, int frame, const FrameReader& plate) {
    std::vector<Layer> layers;
    const auto add = [&](const MatteSource& source) {
        if (auto layer = layer_on(source, frame, plate)) layers.push_back(std::move(*layer));
    };
    add(*region.matte);
    if (layers.empty()) return layers;
    for (const MatteSource& holdout : *region.holdouts)
        if (!holdout.files.empty()) add(holdout);
    return layers;
}

// Returns nothing if a file cannot be read.
std::optional<double> score_of(const std::vector<Layer>& layers, Size size,
                               const PaintedMattes& painted) {
    if (layers.empty()) return std::nullopt;
    const auto matte = read_layer(layers[0], size, painted);
    if (!matte) return std::nullopt;
    Matte holdout;
    for (std::size_t k = 1; k < layers.size(); ++k) {
        auto one = read_layer(layers[k], size, painted);
        if (!one) return std::nullopt;
        if (holdout.empty()) {
            holdout = std::move(*one);
            continue;
        }
        std::transform(one->data(), one->data() + one->size_bytes(), holdout.data(), holdout.data(),
                       [](std::uint8_t a, std::uint8_t b) { return std::max(a, b); });
    }
    return surface_visibility(*matte, holdout).score();
}

std::optional<double> score_on(const Region& region, const FrameReader& plate, int frame,
                               const MatteLooks& looks) {
    const std::vector<Layer> layers = layers_on(region, frame, plate);
    Hasher hasher;
    for (const Layer& layer : layers)
        hash_layer(hasher, layer);
    const Hash128 files = hasher.finish();
    if (looks.memory) {
        if (const auto known = looks.memory->find(files)) return known;
    }
    static const PaintedMattes kNone;
    const auto score = score_of(layers, plate.size(), looks.painted ? *looks.painted : kNone);
    if (looks.memory && score) looks.memory->keep(files, *score);
    return score;
}

// The possible reference frames.
Expected<std::vector<int>> candidates(const Region& region, const FrameReader& plate) {
    std::vector<int> frames;
    if (!region.matte->keyframes.empty()) {
        for (const auto& [frame, key] : region.matte->keyframes)
            frames.push_back(frame);
        return frames;
    }
    frames = plate.frames();
    if (!region.matte->shape.empty()) {
        // A shape is drawn where its surface is seen.
        std::vector<int> drawn;
        for (const int frame : frames)
            if (region.matte->shape.keys.contains(frame)) drawn.push_back(frame);
        return drawn.empty() ? frames : drawn;
    }
    WEFT_TRY(files, matte_files(region.matte->files, plate));
    if (files.is_single()) return frames;
    WEFT_TRY(mattes, files.list_frames());
    std::erase_if(frames, [&](int frame) {
        return !std::binary_search(mattes.begin(), mattes.end(), frame);
    });
    if (!frames.empty()) return frames;
    return fail(ErrorCode::kMissingFrames,
                "The matte " + region.matte->files +
                    " has no file for any frame of the plate, which has " +
                    frames_text(plate.frames()) + ".",
                "Check the pattern and its numbers.");
}

// Returns true for one matte for all frames and no animated holdouts.
bool same_everywhere(const Region& region, const FrameReader& plate) {
    const auto single = [&](const MatteSource& source) {
        const auto files = matte_files(source.files, plate);
        return source.files.empty() || (files && files->is_single());
    };
    return region.matte->keyframes.empty() && single(*region.matte) &&
           std::all_of(region.holdouts->begin(), region.holdouts->end(), single);
}

}  // namespace

std::optional<double> VisibilityCache::find(const Hash128& files) const {
    const std::lock_guard lock(mutex_);
    const auto found = scores_.find(files);
    if (found == scores_.end()) return std::nullopt;
    return found->second;
}

void VisibilityCache::keep(const Hash128& files, double score) {
    const std::lock_guard lock(mutex_);
    if (scores_.size() >= kMostKept) scores_.clear();
    scores_[files] = score;
}

std::size_t VisibilityCache::size() const {
    const std::lock_guard lock(mutex_);
    return scores_.size();
}

Expected<ReferenceChoice> choose_reference(const Region& region, const FrameReader& plate,
                                           const MatteLooks& looks, ReferenceRange range) {
    WEFT_TRY(frames, candidates(region, plate));
    const int first = frames.front();
    std::erase_if(frames, [&](int f) { return f < range.first || f > range.last; });
    if (frames.empty()) return ReferenceChoice{first, first, false};
    if (frames.size() == 1 || !region.matte->shape.empty() || same_everywhere(region, plate))
        return ReferenceChoice{frames.front(), frames.front(), true};
    std::map<std::size_t, double> seen;  // score by index, in frame order
    for (const std::size_t count_looked : kLooks) {
        std::vector<std::size_t> fresh;
        const std::size_t count = std::min(count_looked, frames.size());
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t at = k * (frames.size() - 1) / (count - 1);
            if (seen.try_emplace(at, 0.0).second) fresh.push_back(at);
        }
        for (std::size_t k = 0; k < fresh.size(); k += kAtOnce) {
            parallel_for(std::min(kAtOnce, fresh.size() - k), [&](std::size_t i) {
                const std::size_t at = fresh[k + i];
                seen.at(at) = score_on(region, plate, frames[at], looks).value_or(0.0);
            });
        }
        std::vector<double> scores;
        for (const auto& [at, score] : seen)
            scores.push_back(score);
        const auto best = first_well_shown(scores);
        const bool all_seen = count == frames.size();
        if (best && (*best == 0 || all_seen || count_looked >= kLooks[1])) {
            const auto chosen = std::next(seen.begin(), static_cast<std::ptrdiff_t>(*best));
            return ReferenceChoice{frames[chosen->first], frames.front(), true};
        }
        if (all_seen) break;
    }
    return ReferenceChoice{frames.front(), frames.front(), false};
}

Recti surface_box(const Region& region, const FrameReader& plate, int frame,
                  const MatteLooks& looks) {
    static const PaintedMattes kNone;
    if (const auto layer = layer_on(*region.matte, frame, plate)) {
        const auto matte = read_layer(*layer, plate.size(), looks.painted ? *looks.painted : kNone);
        if (matte)
            if (const Recti box = matte_box(*matte); !box.empty()) return box;
    }
    return rect_of(plate.size());
}

bool shows_nothing(const Region& region, const FrameReader& plate, int frame,
                   const MatteLooks& looks) {
    if (region.matte->files.empty()) return false;
    const auto score = score_on(region, plate, frame, looks);
    return score && !(*score > 0);
}

}  // namespace weft
