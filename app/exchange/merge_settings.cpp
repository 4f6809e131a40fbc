#include "app/exchange/merge_settings.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>

namespace weft {
namespace {

using Json = nlohmann::json;
using Pointer = Json::json_pointer;
using Value = const Json*;  // null: not set

bool same(Value a, Value b) {
    return a && b ? *a == *b : a == b;
}

Value at(Value object, const std::string& name) {
    if (!object || !object->is_object()) return nullptr;
    const auto found = object->find(name);
    return found == object->end() ? nullptr : &*found;
}

Value at(const Json& object, const Pointer& place) {
    return object.contains(place) ? &object.at(place) : nullptr;
}

std::string text_of(Value value) {
    constexpr std::size_t kLongest = 80;
    if (!value) return "not set";
    if (value->is_string()) return value->get<std::string>();
    std::string text = value->dump();
    if (text.size() <= kLongest) return text;
    if (value->is_array()) return std::to_string(value->size()) + " entries";
    return "changed";
}

/// Settings of which one says nothing without the other.
struct Couple {
    const char* key;  ///< Names the conflict.
    std::vector<Pointer> one, other;
};

const std::vector<Couple>& couples() {
    static const std::vector<Couple> list{
        {"amendments",
         {Pointer("/amendments")},
         {Pointer("/texture/sample"), Pointer("/texture/also")}},
        {"reference_frames", {Pointer("/reference_frames/0")}, {Pointer("/placement")}},
    };
    return list;
}

class SettingsMerge {
  public:
    SettingsMerge(MergeSide wins, const std::string& region, std::vector<MergeConflict>& conflicts)
        : wins_(wins), region_(region), conflicts_(conflicts) {}

    // Makes couples that were changed on both sides those of the side that wins.
    void settle(const Json& base, Json& mine, Json& theirs) {
        for (const Couple& couple : couples()) {
            const auto changed = [&](const std::vector<Pointer>& places, const Json& side) {
                return std::any_of(places.begin(), places.end(), [&](const Pointer& place) {
                    return !same(at(base, place), at(side, place));
                });
            };
            if (!(changed(couple.one, mine) && changed(couple.other, theirs)) &&
                !(changed(couple.one, theirs) && changed(couple.other, mine)))
                continue;
            std::vector<Pointer> places = couple.one;
            places.insert(places.end(), couple.other.begin(), couple.other.end());
            const bool agree = std::all_of(places.begin(), places.end(), [&](const Pointer& place) {
                return same(at(mine, place), at(theirs, place));
            });
            if (agree) continue;
            const Pointer named = couple.one.front(), with = couple.other.front();
            conflicts_.push_back({region_,
                                  couple.key,
                                  {},
                                  both_text(mine, named, with),
                                  both_text(theirs, named, with)});
            const Json from = wins_ == MergeSide::kMine ? mine : theirs;
            Json& to = wins_ == MergeSide::kMine ? theirs : mine;
            for (const Pointer& place : places)
                take(from, to, place);
        }
    }

    [[nodiscard]] Json object(const std::string& key, Value base, Value mine, Value theirs) {
        std::set<std::string> names;
        for (const Value side : {mine, theirs})
            for (const auto& [name, value] : side->items())
                names.insert(name);
        const std::string prefix = key.empty() ? key : key + ".";
        Json out = Json::object();
        for (const std::string& name : names) {
            const auto value =
                this->value(prefix + name, at(base, name), at(mine, name), at(theirs, name));
            if (value) out[name] = *value;
        }
        return out;
    }

  private:
    using Result = std::optional<Json>;

    static Result copy(Value value) { return value ? Result(*value) : std::nullopt; }

    static std::string both_text(const Json& side, const Pointer& one, const Pointer& other) {
        return text_of(at(side, one)) + ", " + text_of(at(side, other));
    }

    // A list whose first entry counts is taken whole.
    static void take(const Json& from, Json& to, const Pointer& place) {
        const Pointer whole = place.back() == "0" ? place.parent_pointer() : place;
        if (const Value value = at(from, whole)) {
            to[whole] = *value;
        } else if (const Value holder = at(to, whole.parent_pointer());
                   holder && holder->is_object()) {
            to[whole.parent_pointer()].erase(whole.back());
        }
    }

    Result value(const std::string& key, Value base, Value mine, Value theirs) {
        if (same(mine, theirs) || same(theirs, base)) return copy(mine);
        if (same(mine, base)) return copy(theirs);
        if (!mine || !theirs) return conflict(key, {}, mine, theirs);
        if (mine->is_object() && theirs->is_object() && !is_whole(key, base, *mine, *theirs))
            return object(key, base, mine, theirs);
        if (mine->is_array() && theirs->is_array() && (!base || base->is_array())) {
            static const Json kNone = Json::array();
            const Json& before = base ? *base : kNone;
            if (has_frames(before) && has_frames(*mine) && has_frames(*theirs))
                return keys(key, before, *mine, *theirs);
            if (key == "reference_frames") return frames(key, before, *mine, *theirs);
            if (is_list_of_parts(key)) return parts(key, before, *mine, *theirs);
        }
        return conflict(key, {}, mine, theirs);
    }

    Result conflict(const std::string& key, std::optional<int> frame, Value mine, Value theirs) {
        conflicts_.push_back({region_, key, frame, text_of(mine), text_of(theirs)});
        return copy(wins_ == MergeSide::kMine ? mine : theirs);
    }

    // ---- mattes and what else belongs together ----
    static bool is_whole(const std::string& key, Value base, const Json& mine, const Json& theirs) {
        if (key == "placement.warp") return true;
        const bool matte =
            key == "matte" || key.ends_with(".matte") || key.starts_with("holdouts[");
        if (!matte) return false;
        const auto kind = [](const Json& json) {
            return std::array{json.contains("files"), json.contains("crypto"),
                              json.contains("keyframes"), json.contains("shape")};
        };
        if (kind(mine) != kind(theirs)) return true;
        // Frozen frames hide what was corrected on them.
        return std::any_of(kFrozen.begin(), kFrozen.end(), [&](const char* name) {
            return !same(at(base, name), at(&mine, name)) ||
                   !same(at(base, name), at(&theirs, name));
        });
    }
    static constexpr std::array kFrozen{"frozen", "frozen_files"};

    // ---- keys over time ----
    static bool has_frames(const Json& list) {
        return std::all_of(list.begin(), list.end(), [](const Json& entry) {
            const Value frame = at(&entry, "frame");
            return frame && frame->is_number_integer();
        });
    }
    static std::map<int, Value> by_frame(const Json& list) {
        std::map<int, Value> out;
        for (const Json& entry : list)
            out.emplace(entry.at("frame").get<int>(), &entry);
        return out;
    }
    Result keys(const std::string& key, const Json& base, const Json& mine, const Json& theirs) {
        const auto before = by_frame(base), ours = by_frame(mine), others = by_frame(theirs);
        std::set<int> numbers;
        for (const auto* side : {&ours, &others})
            for (const auto& [frame, entry] : *side)
                numbers.insert(frame);
        const auto of = [](const std::map<int, Value>& side, int frame) -> Value {
            const auto found = side.find(frame);
            return found == side.end() ? nullptr : found->second;
        };
        Json out = Json::array();
        for (const int frame : numbers) {
            const Value b = of(before, frame), m = of(ours, frame), t = of(others, frame);
            const Result kept = same(m, t) || same(t, b) ? copy(m)
                                : same(m, b)             ? copy(t)
                                                         : conflict(key, frame, m, t);
            if (kept) out.push_back(*kept);
        }
        return out.empty() ? std::nullopt : Result(std::move(out));
    }

    // Of reference frames the first one holds the placement; the others are a set.
    Result frames(const std::string& key, const Json& base, const Json& mine, const Json& theirs) {
        if (mine.empty() || theirs.empty() || mine.front() != theirs.front())
            return conflict(key, {}, &mine, &theirs);
        const auto has = [](const Json& list, const Json& frame) {
            return std::find(list.begin(), list.end(), frame) != list.end();
        };
        Json out = Json::array();
        for (const Json& frame : theirs)
            if (has(mine, frame) || !has(base, frame)) out.push_back(frame);
        for (const Json& frame : mine)
            if (!has(theirs, frame) && !has(base, frame)) out.push_back(frame);
        return out;
    }

    // ---- holdouts, zones, lamps: told apart by their places ----
    static bool is_list_of_parts(const std::string& key) {
        return key == "holdouts" || key == "zones" || key == "light.lamps";
    }
    // Entries that only moved would be taken for changed ones.
    static bool has_moved(const Json& base, const Json& side) {
        for (std::size_t k = 0; k < side.size(); ++k)
            for (std::size_t j = 0; j < base.size(); ++j)
                if (j != k && side[k] == base[j] && (k >= base.size() || base[k] != base[j]))
                    return true;
        return false;
    }
    static bool only_adds(const Json& base, const Json& side) {
        return side.size() >= base.size() && std::equal(base.begin(), base.end(), side.begin());
    }
    Result parts(const std::string& key, const Json& base, const Json& mine, const Json& theirs) {
        const bool fits = mine.size() == base.size() || only_adds(base, mine);
        const bool others_fit = theirs.size() == base.size() || only_adds(base, theirs);
        if (!fits || !others_fit || has_moved(base, mine) || has_moved(base, theirs))
            return conflict(key, {}, &mine, &theirs);
        Json out = Json::array();
        for (std::size_t k = 0; k < base.size(); ++k) {
            const auto part =
                value(key + "[" + std::to_string(k) + "]", &base[k], &mine[k], &theirs[k]);
            if (part) out.push_back(*part);
        }
        for (const Json* side : {&theirs, &mine})
            for (std::size_t k = base.size(); k < side->size(); ++k)
                out.push_back((*side)[k]);
        return out;
    }

    const MergeSide wins_;
    const std::string& region_;
    std::vector<MergeConflict>& conflicts_;
};

}  // namespace

Json merged_settings(const Json& base, const Json& mine, const Json& theirs, MergeSide wins,
                     const std::string& region, std::vector<MergeConflict>& conflicts) {
    SettingsMerge merge(wins, region, conflicts);
    Json ours = mine, others = theirs;
    merge.settle(base, ours, others);
    return merge.object("", &base, &ours, &others);
}

}  // namespace weft
