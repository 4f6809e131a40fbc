#include "app/project/project.h"

#include <charconv>

#include "engine/core/frame_range.h"

namespace weft {
namespace {

std::size_t heap_bytes(const std::string& text) {
    return text.capacity() > std::string().capacity() ? text.capacity() + 1 : 0;
}

constexpr std::size_t kMapNodeBytes = 48;  // links of a red-black tree node and malloc's overhead

std::size_t heap_bytes(const Extras& extra) {
    std::size_t bytes = 0;
    for (const auto& [key, value] : extra)
        bytes += kMapNodeBytes + 2 * sizeof(std::string) + heap_bytes(key) + heap_bytes(value);
    return bytes;
}

std::size_t heap_bytes(const KeyedNumbers& keyed) {
    std::size_t bytes = keyed.keys.capacity() * sizeof(keyed.keys[0]);
    for (const NumberKey& key : keyed.keys)
        bytes += key.numbers.capacity() * sizeof(double);
    return bytes;
}

/// Sum of the sizes of strings, extras and keys.
template <class... Members>
std::size_t heap_bytes_of(const Members&... members) {
    return (heap_bytes(members) + ... + 0);
}

std::string list_regions(const Project& project) {
    if (project.regions.empty()) return "the project has none yet; add one first";
    std::string out = "choose among ";
    constexpr std::size_t kMostListed = 10;
    for (std::size_t i = 0; i < project.regions.size() && i < kMostListed; ++i) {
        if (i > 0) out += ", ";
        const Region& region = *project.regions[i];
        out += "'" + (region.name.empty() ? std::to_string(region.id) : region.name) + "'";
    }
    if (project.regions.size() > kMostListed) out += " and more";
    return out;
}

Leaf<MatteSource> map_matte(const Leaf<MatteSource>& matte, const auto& map) {
    if (matte->empty()) return matte;
    return matte.with([&](MatteSource& m) {
        map(m.files);
        map(m.frozen_files);
        for (auto& [frame, key] : m.keyframes)
            map(key.path);
        for (auto& [frame, edge] : m.confirmed) {
            map(edge.path);
            map(edge.area);
        }
        map(m.shape.track);
    });
}

}  // namespace

Expected<std::size_t> find_region(const Project& project, std::string_view name_or_id) {
    std::size_t found = project.regions.size();
    for (std::size_t i = 0; i < project.regions.size(); ++i) {
        if (project.regions[i]->name != name_or_id) continue;
        if (found != project.regions.size())
            return fail(ErrorCode::kUsage,
                        "Several regions are called '" + std::string(name_or_id) + "'",
                        "use the id, or rename one");
        found = i;
    }
    if (found != project.regions.size()) return found;
    RegionId id = 0;
    const char* end = name_or_id.data() + name_or_id.size();
    const auto [stop, error] = std::from_chars(name_or_id.data(), end, id);
    if (error == std::errc() && stop == end)
        for (std::size_t i = 0; i < project.regions.size(); ++i)
            if (project.regions[i]->id == id) return i;
    return fail(ErrorCode::kUsage, "Unknown region '" + std::string(name_or_id) + "'",
                list_regions(project));
}

const Region* region_by_id(const Project& project, RegionId id) {
    for (const Leaf<Region>& region : project.regions)
        if (region->id == id) return &*region;
    return nullptr;
}

Status add_matte_text(MatteSource& matte, std::string_view text) {
    const std::string shown(text);
    const std::size_t equals = text.find('=');
    int frame = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), frame);
    const bool keyframe =
        error == std::errc() && equals != std::string_view::npos && stop == text.data() + equals;
    if (!keyframe) {
        if (text.empty())
            return fail(ErrorCode::kUsage, "A matte is an empty text",
                        "give a pattern or FRAME=FILE");
        if (!matte.empty())
            return fail(ErrorCode::kUsage, "'" + shown + "' is a second matte",
                        "give one pattern, or keyframes as FRAME=FILE");
        constexpr std::string_view kCrypto = "crypto:";
        if (text.starts_with(kCrypto)) {
            matte.select.crypto = text.substr(kCrypto.size());
            if (matte.select.crypto.empty())
                return fail(ErrorCode::kUsage, "'" + shown + "' names no object",
                            "write crypto:NAME");
            return {};
        }
        matte.files = shown;
        return {};
    }
    if (!is_frame_number(frame))
        return fail(ErrorCode::kUsage, "'" + shown + "' is a keyframe beyond frame 100000000",
                    "renumber the shot, or correct the number");
    const std::string_view path = text.substr(equals + 1);
    if (path.empty())
        return fail(ErrorCode::kUsage, "'" + shown + "' names no file", "write FRAME=FILE");
    if (!matte.files.empty())
        return fail(ErrorCode::kUsage,
                    "'" + shown + "' is a keyframe, but the matte is '" + matte.files + "' already",
                    "give one or the other");
    if (!matte.keyframes.emplace(frame, MatteKeyframe{std::string(path), {}}).second)
        return fail(ErrorCode::kUsage, "Frame " + std::to_string(frame) + " has two mattes",
                    "give one");
    return {};
}

Status add_confirmed_text(MatteSource& matte, std::string_view text) {
    const std::size_t equals = text.find('='), comma = text.rfind(',');
    const bool three = equals != std::string_view::npos && comma != std::string_view::npos &&
                       comma > equals + 1 && comma + 1 < text.size();
    int frame = 0;
    const char* const end = text.data() + (three ? equals : 0);
    const auto [stop, error] = std::from_chars(text.data(), end, frame);
    if (!three || error != std::errc() || stop != end || !is_frame_number(frame))
        return fail(ErrorCode::kUsage, "'" + std::string(text) + "' is no confirmed part",
                    "write FRAME=MATTE,AREA");
    const std::string_view path = text.substr(equals + 1, comma - equals - 1);
    const ConfirmedEdge edge{std::string(path), std::string(text.substr(comma + 1))};
    if (!matte.confirmed.emplace(frame, edge).second)
        return fail(ErrorCode::kUsage,
                    "Parts of frame " + std::to_string(frame) + " are confirmed twice",
                    "give one area for all of them");
    return {};
}

Project map_paths(const Project& project,
                  const std::function<std::string(const std::string&)>& visit) {
    const auto map = [&](std::string& path) {
        if (!path.empty()) path = visit(path);
    };
    Project out = project;
    map(out.plate.path);
    map(out.output.path);
    map(out.output.movie);
    map(out.output.layers_path);
    for (Leaf<Region>& leaf : out.regions) {
        leaf = leaf.with([&](Region& region) {
            region.matte = map_matte(region.matte, map);
            if (!region.holdouts->empty())
                region.holdouts = region.holdouts.with([&](std::vector<MatteSource>& holdouts) {
                    for (MatteSource& holdout : holdouts)
                        holdout = *map_matte(holdout, map);
                });
            if (!region.zones->empty())
                region.zones = region.zones.with([&](std::vector<Zone>& zones) {
                    for (Zone& zone : zones)
                        zone.matte = *map_matte(zone.matte, map);
                });
            map(region.texture.sample);
            for (std::string& path : region.texture.also)
                map(path);
            map(region.texture.plane);
            map(region.placement.uv);
            map(region.form.position);
            map(region.form.normal);
            map(region.motion.files);
            map(region.motion.track);
            map(region.light.image);
            map(region.light.albedo);
            map(region.light.lighting);
            map(region.finish.depth);
            map(region.lines.files);
        });
    }
    return out;
}

std::size_t own_bytes(const std::vector<PlaneAmendment>& amendments) {
    std::size_t bytes = amendments.capacity() * sizeof(PlaneAmendment);
    for (const PlaneAmendment& amendment : amendments)
        bytes += amendment.runs.capacity() * sizeof(TexelRun);
    return bytes;
}

std::size_t own_bytes(const MatteSource& matte) {
    std::size_t bytes = sizeof matte + heap_bytes_of(matte.edge.choke_keys) +
                        heap_bytes_of(matte.edge.feather_keys) +
                        heap_bytes_of(matte.edge.blur_keys) +
                        heap_bytes_of(matte.files, matte.frozen_files, matte.select.channel,
                                      matte.select.crypto, matte.extra) +
                        matte.frozen.capacity() * sizeof(int);
    for (const auto& [frame, key] : matte.keyframes)
        bytes += kMapNodeBytes + sizeof frame + sizeof key + heap_bytes_of(key.path, key.extra) +
                 (key.shape ? key.shape->points.capacity() * sizeof(RotoPoint) : 0);
    for (const auto& [frame, edge] : matte.confirmed)
        bytes += kMapNodeBytes + sizeof frame + sizeof edge +
                 heap_bytes_of(edge.path, edge.area, edge.extra);
    bytes += heap_bytes(matte.shape.track);
    for (const auto& [frame, shape] : matte.shape.keys)
        bytes += kMapNodeBytes + sizeof frame + sizeof shape +
                 shape.points.capacity() * sizeof(RotoPoint);
    return bytes;
}

std::size_t own_bytes(const std::vector<Zone>& zones) {
    std::size_t bytes = 0;
    for (const Zone& zone : zones)
        bytes += sizeof zone - sizeof zone.matte + own_bytes(zone.matte) +
                 heap_bytes_of(zone.value_keys) + heap_bytes_of(zone.extra);
    return bytes;
}

std::size_t own_bytes(const Region& r) {
    std::size_t pins = 0;
    for (const auto& [frame, list] : r.corrections)
        pins += 64 + list.capacity() * sizeof(CorrectionPin);
    std::size_t samples = r.texture.also.capacity() * sizeof(std::string);
    for (const std::string& path : r.texture.also)
        samples += heap_bytes_of(path);
    std::size_t keys = 0;
    for (const KeyedNumbers* keyed :
         {&r.placement.scale_keys, &r.placement.rotate_keys, &r.placement.offset_keys,
          &r.light.strength_keys, &r.form.amount_keys})
        keys += heap_bytes_of(*keyed);
    for (const Lamp& lamp : r.light.lamps)
        keys += sizeof lamp + heap_bytes_of(lamp.numbers);
    for (const auto* guides : {&r.form.shape, &r.form.strokes})
        for (const FormGuide& guide : *guides)
            keys += sizeof guide + guide.numbers.capacity() * sizeof(double);
    if (r.placement.warp) {
        keys += r.placement.warp->points.capacity() * sizeof(WarpPoint);
        for (const auto& [frame, points] : r.placement.warp->keys)
            keys += sizeof frame + points.capacity() * sizeof(WarpPoint);
    }
    return sizeof r + pins + samples + keys + r.reference_frames.capacity() * sizeof(int) +
           heap_bytes_of(r.name, r.texture.sample, r.texture.plane, r.texture.space,
                         r.texture.extra, r.placement.uv, r.placement.uv_layer, r.placement.extra,
                         r.form.position, r.form.position_layer, r.form.normal, r.form.normal_layer,
                         r.form.extra, r.finish.depth, r.finish.depth_layer, r.grade.extra,
                         r.layer.extra, r.motion.files, r.motion.track, r.motion.layer,
                         r.motion.extra, r.synthesis.extra, r.temporal.extra, r.light.image,
                         r.light.extra, r.light.albedo, r.light.lighting, r.light.pass_layer,
                         r.finish.extra, r.lines.files, r.lines.extra, r.extra);
}

std::size_t own_bytes(const Project& p) {
    return sizeof p + p.regions.capacity() * sizeof(Leaf<Region>) +
           heap_bytes_of(p.name, p.plate.path, p.plate.layer, p.plate.space, p.plate.extra,
                         p.color.working_space, p.color.texture_space, p.color.out_space,
                         p.color.extra, p.settings.frames, p.settings.extra, p.output.path,
                         p.output.movie, p.output.layers_path, p.output.exr_compression,
                         p.output.extra, p.extra);
}

}  // namespace weft
