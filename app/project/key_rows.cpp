#include "app/project/key_rows.h"

#include <algorithm>
#include <limits>
#include <map>

#include "app/project/parameters.h"

namespace weft {
namespace {

using Contents = std::map<int, KeyContent>;

// ---- mattes by number ------------------------------------------------------------------------

const MatteSource* matte_of(const Region& region, int layer) {
    if (layer == 0) return &*region.matte;
    const auto at = static_cast<std::size_t>(layer > 0 ? layer - 1 : -1 - layer);
    if (layer > 0) return at < region.holdouts->size() ? &(*region.holdouts)[at] : nullptr;
    return at < region.zones->size() ? &(*region.zones)[at].matte : nullptr;
}

void change_matte(Region& region, int layer, const auto& change) {
    if (layer == 0) {
        region.matte = region.matte.with(change);
    } else if (layer > 0) {
        region.holdouts = region.holdouts.with([&](std::vector<MatteSource>& holdouts) {
            change(holdouts[static_cast<std::size_t>(layer - 1)]);
        });
    } else {
        region.zones = region.zones.with([&](std::vector<Zone>& zones) {
            change(zones[static_cast<std::size_t>(-1 - layer)].matte);
        });
    }
}

// The layers of a region in the order of their rows.
std::vector<int> layers_of(const Region& region) {
    std::vector<int> out{0};
    for (std::size_t k = 0; k < region.holdouts->size(); ++k)
        out.push_back(static_cast<int>(k) + 1);
    for (std::size_t k = 0; k < region.zones->size(); ++k)
        out.push_back(-1 - static_cast<int>(k));
    return out;
}

// ---- numbers ---------------------------------------------------------------------------------

const Parameter<Region>* entry_of(const std::string& key) {
    const auto found = find_parameter(region_parameters(), key);
    return found && (*found)->kind == ParameterKind::kKeys ? *found : nullptr;
}

// The members behind the entries of kind kKeys; the table reads copies.
const KeyedNumbers* edge_member_of(const Region& region, const KeyRowId& row) {
    const MatteSource* matte = matte_of(region, row.layer);
    if (!matte) return nullptr;
    if (row.key == "matte.choke_keys") return &matte->edge.choke_keys;
    if (row.key == "matte.feather_keys") return &matte->edge.feather_keys;
    if (row.key == "matte.blur_keys") return &matte->edge.blur_keys;
    return nullptr;
}

const KeyedNumbers* member_of(const Region& region, const std::string& key) {
    if (key == "placement.scale_keys") return &region.placement.scale_keys;
    if (key == "placement.rotate_keys") return &region.placement.rotate_keys;
    if (key == "placement.offset_keys") return &region.placement.offset_keys;
    if (key == "form.amount_keys") return &region.form.amount_keys;
    if (key == "light.strength_keys") return &region.light.strength_keys;
    return nullptr;
}

void set_numbers(Region& region, const KeyRowId& row, KeyedNumbers numbers) {
    const auto at = static_cast<std::size_t>(row.layer);
    if (row.kind == KeyRowKind::kMatteEdge)
        change_matte(region, row.layer, [&](MatteSource& matte) {
            (row.key == "matte.choke_keys"     ? matte.edge.choke_keys
             : row.key == "matte.feather_keys" ? matte.edge.feather_keys
                                               : matte.edge.blur_keys) = std::move(numbers);
        });
    else if (row.kind == KeyRowKind::kLamp)
        region.light.lamps[at].numbers = std::move(numbers);
    else if (row.kind == KeyRowKind::kZoneValue)
        region.zones = region.zones.with(
            [&](std::vector<Zone>& zones) { zones[at].value_keys = std::move(numbers); });
    else if (const auto* entry = entry_of(row.key))
        entry->write(region, ParameterValue(std::move(numbers)));
}

// ---- rows as maps ----------------------------------------------------------------------------

bool has_row(const Region& region, const KeyRowId& row) {
    if (row.kind == KeyRowKind::kMatte || row.kind == KeyRowKind::kShape)
        return matte_of(region, row.layer) != nullptr;
    if (row.kind == KeyRowKind::kReference || row.kind == KeyRowKind::kCorrection) return true;
    if (row.kind == KeyRowKind::kWarp) return region.placement.warp.has_value();
    return numbers_of(region, row) != nullptr;
}

Contents contents_of(const Region& region, const KeyRowId& row) {
    Contents out;
    const auto add = [&](const auto& map) {
        for (const auto& [frame, content] : map)
            out.emplace(frame, content);
    };
    if (const MatteSource* matte = matte_of(region, row.layer)) {
        if (row.kind == KeyRowKind::kMatte) add(matte->keyframes);
        if (row.kind == KeyRowKind::kShape) add(matte->shape.keys);
    }
    if (row.kind == KeyRowKind::kCorrection) add(region.corrections);
    if (row.kind == KeyRowKind::kWarp && region.placement.warp) add(region.placement.warp->keys);
    if (row.kind == KeyRowKind::kReference)
        for (std::size_t k = 0; k < region.reference_frames.size(); ++k)
            out.emplace(region.reference_frames[k], k);
    if (const KeyedNumbers* numbers = numbers_of(region, row))
        for (const NumberKey& key : numbers->keys)
            out.emplace(key.frame, key);
    return out;
}

template <class T>
std::map<int, T> only(const Contents& contents) {
    std::map<int, T> out;
    for (const auto& [frame, content] : contents)
        if (const T* is = std::get_if<T>(&content)) out.emplace(frame, *is);
    return out;
}

void set_contents(Region& region, const KeyRowId& row, const Contents& contents) {
    switch (row.kind) {
        case KeyRowKind::kMatte:
            change_matte(region, row.layer,
                         [&](MatteSource& m) { m.keyframes = only<MatteKeyframe>(contents); });
            break;
        case KeyRowKind::kShape:
            change_matte(region, row.layer,
                         [&](MatteSource& m) { m.shape.keys = only<RotoShape>(contents); });
            break;
        case KeyRowKind::kCorrection:
            region.corrections = only<std::vector<CorrectionPin>>(contents);
            break;
        case KeyRowKind::kReference: {
            std::vector<std::pair<std::size_t, int>> order;
            for (const auto& [frame, place] : only<std::size_t>(contents))
                order.emplace_back(place, frame);
            std::sort(order.begin(), order.end());
            region.reference_frames.clear();
            for (const auto& [place, frame] : order)
                region.reference_frames.push_back(frame);
            break;
        }
        case KeyRowKind::kWarp: {
            // Without keys the grid stays as the first one had it.
            GridWarp& warp = *region.placement.warp;
            const auto keys = only<std::vector<WarpPoint>>(contents);
            if (keys.empty() && warp.moves()) warp.points = warp.keys.front().second;
            warp.keys.assign(keys.begin(), keys.end());
            break;
        }
        case KeyRowKind::kNumbers:
        case KeyRowKind::kLamp:
        case KeyRowKind::kMatteEdge:
        case KeyRowKind::kZoneValue: {
            KeyedNumbers numbers;
            for (auto& [frame, key] : only<NumberKey>(contents)) {
                numbers.keys.push_back(key);
                numbers.keys.back().frame = frame;
            }
            set_numbers(region, row, std::move(numbers));
        }
    }
}

// The frames of each row's keys.
std::map<KeyRowId, std::set<int>> by_row(const KeySet& keys) {
    std::map<KeyRowId, std::set<int>> out;
    for (const KeyRef& key : keys)
        out[key.row].insert(key.frame);
    return out;
}

void drop_empty_layers(Region& region) {
    const auto none = [](const MatteSource& matte) { return matte.empty(); };
    if (std::any_of(region.holdouts->begin(), region.holdouts->end(), none))
        region.holdouts = region.holdouts.with(
            [&](std::vector<MatteSource>& holdouts) { std::erase_if(holdouts, none); });
    const auto bare = [&](const Zone& zone) { return zone.matte.empty(); };
    if (std::any_of(region.zones->begin(), region.zones->end(), bare))
        region.zones =
            region.zones.with([&](std::vector<Zone>& zones) { std::erase_if(zones, bare); });
}

}  // namespace

const KeyedNumbers* numbers_of(const Region& region, const KeyRowId& row) {
    const auto at = static_cast<std::size_t>(row.layer);
    if (row.kind == KeyRowKind::kNumbers) return member_of(region, row.key);
    if (row.kind == KeyRowKind::kMatteEdge) return edge_member_of(region, row);
    if (row.kind == KeyRowKind::kLamp && at < region.light.lamps.size())
        return &region.light.lamps[at].numbers;
    if (row.kind == KeyRowKind::kZoneValue && at < region.zones->size())
        return &(*region.zones)[at].value_keys;
    return nullptr;
}

NumberRange range_of(const KeyRowId& row) {
    constexpr double kAny = std::numeric_limits<float>::max();
    if (row.kind == KeyRowKind::kNumbers || row.kind == KeyRowKind::kMatteEdge)
        if (const auto* entry = entry_of(row.key)) return {entry->min, entry->max};
    if (row.kind == KeyRowKind::kZoneValue)
        for (const Parameter<Zone>& entry : zone_parameters())
            if (entry.kind == ParameterKind::kKeys) return {entry.min, entry.max};
    return {-kAny, kAny};
}

std::vector<KeyRow> key_rows(const Region& region) {
    std::vector<KeyRowId> ids;
    for (const int layer : layers_of(region)) {
        ids.push_back({KeyRowKind::kMatte, layer});
        ids.push_back({KeyRowKind::kShape, layer});
        for (const char* key : {"matte.choke_keys", "matte.feather_keys", "matte.blur_keys"})
            ids.push_back({KeyRowKind::kMatteEdge, layer, key});
    }
    ids.push_back({KeyRowKind::kReference});
    ids.push_back({KeyRowKind::kCorrection});
    for (const Parameter<Region>& entry : region_parameters())
        if (entry.kind == ParameterKind::kKeys)
            ids.push_back({KeyRowKind::kNumbers, 0, entry.full_key()});
    ids.push_back({KeyRowKind::kWarp});
    for (std::size_t k = 0; k < region.light.lamps.size(); ++k)
        // A lamp with one key stands still.
        if (region.light.lamps[k].numbers.keys.size() > 1)
            ids.push_back({KeyRowKind::kLamp, static_cast<int>(k)});
    for (std::size_t k = 0; k < region.zones->size(); ++k)
        ids.push_back({KeyRowKind::kZoneValue, static_cast<int>(k)});
    std::vector<KeyRow> out;
    for (KeyRowId& id : ids) {
        KeyRow row{std::move(id), {}};
        for (const auto& [frame, content] : contents_of(region, row.id)) {
            KeyMark mark{frame};
            if (const auto* number = std::get_if<NumberKey>(&content)) mark.after = number->after;
            if (const auto* matte = std::get_if<MatteKeyframe>(&content))
                mark.between = matte->shape_between;
            row.keys.push_back(mark);
        }
        if (!row.keys.empty()) out.push_back(std::move(row));
    }
    return out;
}

Region with_keys_moved(const Region& region, const KeySet& keys, int by) {
    Region out = region;
    if (by == 0) return out;
    for (const auto& [row, frames] : by_row(keys)) {
        const Contents before = contents_of(region, row);
        Contents after;
        for (const auto& [frame, content] : before)
            if (frames.contains(frame)) after.emplace(frame + by, content);
        // The moved ones are there first, and stay.
        for (const auto& [frame, content] : before)
            if (!frames.contains(frame)) after.emplace(frame, content);
        set_contents(out, row, after);
    }
    return out;
}

Region without_keys(const Region& region, const KeySet& keys) {
    Region out = region;
    for (const auto& [row, frames] : by_row(keys)) {
        Contents contents = contents_of(out, row);
        for (const int frame : frames)
            contents.erase(frame);
        set_contents(out, row, contents);
    }
    drop_empty_layers(out);
    std::erase_if(out.light.lamps, [](const Lamp& lamp) { return lamp.numbers.empty(); });
    return out;
}

Region with_interpolation(const Region& region, const KeySet& keys, KeyInterpolation after) {
    Region out = region;
    for (const auto& [row, frames] : by_row(keys)) {
        const KeyedNumbers* numbers = numbers_of(region, row);
        if (!numbers) continue;
        KeyedNumbers changed = *numbers;
        for (NumberKey& key : changed.keys)
            if (frames.contains(key.frame)) key.after = after;
        set_numbers(out, row, std::move(changed));
    }
    return out;
}

Region with_key_value(const Region& region, const KeyRef& key, std::size_t which, double value) {
    Region out = region;
    const KeyedNumbers* numbers = numbers_of(region, key.row);
    const NumberKey* there = numbers ? numbers->key(key.frame) : nullptr;
    if (!there || which >= there->numbers.size()) return out;
    std::vector<double> changed = there->numbers;
    const NumberRange range = range_of(key.row);
    changed[which] = std::clamp(value, range.min, range.max);
    KeyedNumbers all = *numbers;
    all.set(key.frame, std::move(changed));
    set_numbers(out, key.row, std::move(all));
    return out;
}

std::vector<CopiedKey> copied_keys(const Region& region, const KeySet& keys) {
    std::vector<CopiedKey> out;
    for (const auto& [row, frames] : by_row(keys)) {
        const Contents contents = contents_of(region, row);
        for (const int frame : frames)
            if (const auto found = contents.find(frame); found != contents.end())
                out.push_back({{row, frame}, found->second});
    }
    return out;
}

PastedKeys with_keys_pasted(const Region& region, const std::vector<CopiedKey>& keys, int frame) {
    PastedKeys out{region, {}};
    if (keys.empty()) return out;
    const int earliest =
        std::min_element(keys.begin(), keys.end(), [](const auto& a, const auto& b) {
            return a.key.frame < b.key.frame;
        })->key.frame;
    for (const CopiedKey& copied : keys) {
        const KeyRowId& row = copied.key.row;
        if (!has_row(out.region, row)) continue;
        Contents contents = contents_of(out.region, row);
        if (const auto* shape = std::get_if<RotoShape>(&copied.content)) {
            const MatteSource* matte = matte_of(out.region, row.layer);
            const auto& there = matte->shape.keys;
            if (there.empty() || there.begin()->second.points.size() != shape->points.size())
                continue;
        }
        if (const auto* points = std::get_if<std::vector<WarpPoint>>(&copied.content);
            points && points->size() != out.region.placement.warp->points.size())
            continue;
        if (row.kind == KeyRowKind::kMatte && matte_of(out.region, row.layer)->by_frame()) continue;
        const int to = frame + copied.key.frame - earliest;
        KeyContent content = copied.content;
        // A further reference frame comes last; the first one holds the placement.
        if (auto* order = std::get_if<std::size_t>(&content)) {
            if (contents.contains(to)) continue;
            *order = contents.size();
        }
        contents.insert_or_assign(to, std::move(content));
        set_contents(out.region, row, contents);
        out.keys.insert({row, to});
    }
    return out;
}

}  // namespace weft
