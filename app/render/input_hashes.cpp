#include "app/render/input_hashes.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "app/shot/color_contents.h"
#include "engine/media/cryptomatte.h"
#include "engine/media/plates.h"
#include "engine/media/sequence_pattern.h"
#include "engine/pipeline/focus_frames.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, kInputKinds> kNames{"plate",  "mattes", "texture",
                                                      "motion", "passes", "color"};
constexpr std::array<const char*, kInputKinds> kWords{
    "the plate",           "the mattes", "the texture",
    "the motion or track", "the passes", "the OpenColorIO config or its tables"};

std::size_t index_of(InputKind kind) {
    return static_cast<std::size_t>(kind);
}

void add(Hasher& hasher, const Hash128& hash) {
    hasher.value(hash.high).value(hash.low);
}

// The region with its inputs of one kind alone. What is none of the other kinds is a pass or a
// picture, so that no path is left out.
Region only(InputKind kind, const Region& region) {
    Region out;
    if (kind == InputKind::kMattes) {
        out.matte = region.matte;
        out.holdouts = region.holdouts;
        out.zones = region.zones;
        return out;
    }
    if (kind == InputKind::kMotion) {
        out.motion = region.motion;
        return out;
    }
    out = region;
    out.matte = MatteSource();
    out.holdouts = std::vector<MatteSource>();
    out.zones = std::vector<Zone>();
    out.motion = {};
    out.texture = {};
    return out;
}

std::vector<MatteSource> mattes_of(const Region& region) {
    std::vector<MatteSource> out{*region.matte};
    out.insert(out.end(), region.holdouts->begin(), region.holdouts->end());
    for (const Zone& zone : *region.zones)
        out.push_back(zone.matte);
    return out;
}

// In the order of the document, without repetition.
std::vector<std::string> paths_of(const Region& region) {
    std::vector<std::string> out;
    // Frozen mattes are among the keyframes; what else is in their folder does not count.
    std::set<std::string> seen;
    for (const MatteSource& matte : mattes_of(region))
        seen.insert(matte.frozen_files);
    Project project;
    project.regions.emplace_back(region);
    static_cast<void>(map_paths(project, [&](const std::string& path) {
        if (seen.insert(path).second) out.push_back(path);
        return path;
    }));
    return out;
}

// The manifests beside the files of a Cryptomatte, which give its objects their ids.
std::vector<std::string> manifests_of(const Region& region, int first) {
    std::vector<std::string> out;
    for (const MatteSource& matte : mattes_of(region)) {
        if (matte.select.crypto.empty()) continue;
        const auto pattern = SequencePattern::parse(matte.files);
        if (!pattern) continue;
        for (std::string& path : cryptomatte_manifest_files(pattern->path_for(first)))
            out.push_back(std::move(path));
    }
    return out;
}

FrameSpan united(const FrameSpan& a, const FrameSpan& b) {
    return {std::min(a.first, b.first), std::max(a.last, b.last)};
}

}  // namespace

InputHashes::InputHashes(std::shared_ptr<const Shot> shot, const std::vector<int>& frames)
    : shot_(std::move(shot)) {
    find_plate();
    const std::size_t count = shot_->region_index.size();
    std::vector<FrameSpan> needed(count + 1, FrameSpan{there_.last, there_.first});
    for (const int frame : frames) {
        const std::vector<FrameSpan> spans = spans_of(frame);
        for (std::size_t k = 0; k < spans.size(); ++k)
            needed[k] = united(needed[k], spans[k]);
    }
    read_plate(needed.back());
    for (std::size_t k = 0; k < count; ++k)
        add_region(*shot_->project.regions[shot_->region_index[k]], needed[k]);
    add_texture_and_color();
    shot_->files->save();
}

Hash128 InputHashes::contents_of(const std::string& path) const {
    const auto contents = shot_->files->contents(path);
    return contents ? *contents : Hash128{};
}

// Frames that repeat another one before the first or after the last frame of the plate are left
// out: which of them there are depends on the part of the shot that is rendered.
void InputHashes::find_plate() {
    given_[index_of(InputKind::kPlate)] = true;
    const CachedReader& plate = *shot_->plate;
    bool any = false;
    for (const int frame : plate.frames()) {
        if (plate.shown_frame(frame) != frame) continue;
        there_ = {any ? there_.first : frame, frame};
        any = true;
    }
}

std::vector<FrameSpan> InputHashes::spans_of(int frame) const {
    const CachedReader& plate = *shot_->plate;
    ShotPlan one;
    // A frame that repeats another one is made from that.
    one.frames = {std::clamp(plate.shown_frame(frame), there_.first, there_.last)};
    FrameSpan all{one.frames.front(), one.frames.front()};
    std::vector<FrameSpan> out;
    for (const RegionPlan& plan : shot_->plan.regions) {
        FrameSpan span = analysed_span(one, plan);
        if (const std::vector<int> focus = needed_focus_frames(one, plan); !focus.empty())
            span = united(span, {focus.front(), focus.back()});
        span.first = std::min(span.first, plate.shown_frame(span.first));
        span = {std::clamp(span.first, there_.first, there_.last),
                std::clamp(span.last, there_.first, there_.last)};
        all = united(all, span);
        out.push_back(span);
    }
    out.push_back(all);
    return out;
}

std::vector<int> InputHashes::frames_in(const FrameSpan& span) const {
    std::vector<int> out;
    for (const int frame : shot_->plate->frames())
        if (frame >= span.first && frame <= span.last) out.push_back(frame);
    return out;
}

// A link that leads nowhere is as good as no file.
void InputHashes::add_entries(const std::vector<int>& frames, const std::vector<std::string>& paths,
                              Sequence& to) const {
    for (std::size_t k = 0; k < frames.size(); ++k)
        if (const auto contents = shot_->files->contents(paths[k]))
            to.entries.push_back({frames[k], *contents});
}

void InputHashes::read_plate(const FrameSpan& span) {
    const std::vector<int> frames = frames_in(span);
    std::vector<std::string> paths;
    paths.reserve(frames.size());
    for (const int frame : frames)
        paths.push_back(shot_->plate->path_of(frame));
    const bool is_movie = paths.size() > 1 && paths.front() == paths.back();
    if (!is_movie) shot_->files->read(paths);
    add_entries(frames, paths, plate_);
}

void InputHashes::add_path(InputKind kind, const std::string& path, const FrameSpan& span,
                           OfRegion& region) {
    given_[index_of(kind)] = true;
    std::error_code ignored;
    const auto pattern = SequencePattern::parse(path);
    if (!pattern || pattern->is_single() || fs::is_regular_file(path, ignored)) {
        Hasher hasher;
        add(hasher, region.fixed[index_of(kind)]);
        // A matte's first frame is that of the plate, wherever that begins.
        if (has_movie_extension(path)) hasher.value(there_.first);
        add(hasher, contents_of(path));
        region.fixed[index_of(kind)] = hasher.finish();
        return;
    }
    const std::vector<int> frames = frames_in(span);
    std::vector<std::string> paths;
    for (const int frame : frames) {
        // Where the plate repeats a frame in place of a missing one, a missing file is repeated
        // too.
        const int shown = shot_->plate->shown_frame(frame);
        const bool repeats = shown != frame && !fs::exists(pattern->path_for(frame), ignored);
        paths.push_back(pattern->path_for(repeats ? shown : frame));
    }
    shot_->files->read(paths);
    Sequence sequence{kind, {}};
    add_entries(frames, paths, sequence);
    region.sequences.push_back(std::move(sequence));
}

void InputHashes::add_region(const Region& region, const FrameSpan& span) {
    OfRegion& out = regions_.emplace_back();
    for (const InputKind kind : {InputKind::kMattes, InputKind::kMotion, InputKind::kPasses}) {
        for (const std::string& path : paths_of(only(kind, region)))
            add_path(kind, path, span, out);
    }
    for (const std::string& path : manifests_of(region, there_.first))
        add_path(InputKind::kMattes, path, span, out);
}

void InputHashes::add_texture_and_color() {
    given_[index_of(InputKind::kTexture)] = !shot_->textures.empty();
    Hasher textures;
    for (const ShotTexture& texture : shot_->textures) {
        textures.text(texture.id);
        for (const ShotTexture& further : texture.also)
            textures.text(further.id);
    }
    whole_[index_of(InputKind::kTexture)] = textures.finish();
    const auto color = color_contents(*shot_);
    if (!color) return;
    given_[index_of(InputKind::kColor)] = true;
    whole_[index_of(InputKind::kColor)] = *color;
}

InputHashes::Hashes InputHashes::hashes(int frame) const {
    std::array<Hasher, kInputKinds> hashers;
    for (std::size_t kind = 0; kind < kInputKinds; ++kind)
        add(hashers[kind], whole_[kind]);
    // Entries have no gaps between their members, so that many of them are hashed at once.
    static_assert(sizeof(Entry) == 24);
    const auto add_span = [&](const Sequence& sequence, const FrameSpan& span) {
        const auto& all = sequence.entries;
        const auto before = [](const Entry& entry, int at) { return entry.frame < at; };
        const auto first = std::lower_bound(all.begin(), all.end(), span.first, before);
        const auto last = std::lower_bound(first, all.end(), span.last + 1, before);
        hashers[index_of(sequence.kind)].bytes(
            all.data() + (first - all.begin()),
            static_cast<std::size_t>(last - first) * sizeof(Entry));
    };
    const std::vector<FrameSpan> spans = spans_of(frame);
    for (std::size_t k = 0; k < regions_.size(); ++k) {
        for (std::size_t kind = 0; kind < kInputKinds; ++kind)
            add(hashers[kind], regions_[k].fixed[kind]);
        for (const Sequence& sequence : regions_[k].sequences)
            add_span(sequence, spans[k]);
    }
    add_span(plate_, spans.back());
    Hashes out;
    for (std::size_t kind = 0; kind < kInputKinds; ++kind)
        out[kind] = hashers[kind].finish();
    return out;
}

std::string InputHashes::text_of(const Hashes& hashes) const {
    constexpr std::size_t kDigits = 16;
    std::string out;
    for (std::size_t kind = 0; kind < kInputKinds; ++kind) {
        if (!given_[kind]) continue;
        out += (out.empty() ? "" : ",") + std::string(kNames[kind]) + ":" +
               hashes[kind].hex().substr(0, kDigits);
    }
    return out;
}

std::string InputHashes::text(int frame) const {
    return text_of(hashes(frame));
}

std::string InputHashes::text(const std::vector<int>& frames) const {
    std::array<Hasher, kInputKinds> hashers;
    for (const int frame : frames) {
        const Hashes one = hashes(frame);
        for (std::size_t kind = 0; kind < kInputKinds; ++kind)
            add(hashers[kind], one[kind]);
    }
    Hashes all;
    for (std::size_t kind = 0; kind < kInputKinds; ++kind)
        all[kind] = hashers[kind].finish();
    return text_of(all);
}

namespace {

std::map<std::string, std::string> parts_of(const std::string& text) {
    std::map<std::string, std::string> out;
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t to = std::min(text.find(',', from), text.size());
        const std::string part = text.substr(from, to - from);
        const std::size_t colon = std::min(part.find(':'), part.size());
        out[part.substr(0, colon)] = part.substr(colon);
        from = to + 1;
    }
    return out;
}

}  // namespace

std::vector<std::string> changed_inputs(const std::string& had, const std::string& wanted) {
    auto before = parts_of(had), now = parts_of(wanted);
    std::vector<std::string> out;
    for (std::size_t kind = 0; kind < kInputKinds; ++kind)
        if (before[kNames[kind]] != now[kNames[kind]]) out.emplace_back(kWords[kind]);
    return out;
}

}  // namespace weft
