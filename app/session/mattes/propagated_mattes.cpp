#include "app/session/mattes/propagated_mattes.h"

#include "app/mattes/matte_layer.h"
#include "app/preview/propagation_key.h"
#include "app/project/codec/project_file.h"
#include "engine/media/image_files.h"

namespace weft {
namespace {

constexpr int kAnyFrame = -1;  // of a layer as a whole

}  // namespace

// Hashing all files of a layer takes too long for every frame that is drawn.
const PropagatedMattes::Keys& PropagatedMattes::keys_of(const Region& region, int layer,
                                                        int frame) {
    if (!absolute_ || version_ != use_.document.version()) {
        version_ = use_.document.version();
        absolute_ = use_.document.resolved();
        keys_.clear();
    }
    Keys& keys = keys_[{region.id, layer, frame}];
    if (!keys.all.empty()) return keys;
    const Region& absolute = *region_by_id(*absolute_, region.id);
    keys.all = propagation_key(*absolute_, absolute, layer);
    keys.others = layer_source(region, layer).confirmed.contains(frame)
                      ? propagation_key(*absolute_, absolute, layer, frame)
                      : keys.all;
    return keys;
}

MattePtr PropagatedMattes::propagated(const std::string& name, const WantedMatte& wanted) {
    // It may exist now; retry.
    if (!use_.shelf.error(name).empty()) {
        const std::uint64_t now = use_.preview.matte_version();
        const auto [tried, first] = missed_.try_emplace(name, now);
        if (first || tried->second != now) use_.shelf.forget(name);
        tried->second = now;
    }
    MattePtr found = use_.shelf.get(
        name, [&preview = use_.preview, wanted] { return preview.propagated_matte(wanted); });
    if (found) missed_.erase(name);
    return found;
}

MattePtr PropagatedMattes::file(const std::string& path, const MatteSelect& select, Size size) {
    return use_.shelf.get(path, [path, select, size] { return read_matte(path, select, size); });
}

PropagatedMatte PropagatedMattes::find(const Region& region, int layer, int frame, Size size) {
    const Keys keys = keys_of(region, layer, frame);
    const MatteSource& source = layer_source(region, layer);
    const Where where{region.id, layer, frame};
    PropagatedMatte out;
    // What was painted on the frame is what is seen there, not what the walks make of it near the
    // border of its area: otherwise the next stroke would depend on how far they have come.
    const auto edge = source.confirmed.find(frame);
    const std::string painted = edge == source.confirmed.end()
                                    ? std::string()
                                    : resolve_path(use_.document.folder(), edge->second.path);
    if (const auto on = painted_on_.find(painted);
        on != painted_on_.end() && on->second == keys.others && use_.shelf.error(painted).empty()) {
        out = {file(painted, source.select, size), true, true, painted, keys.others};
        return out;
    }
    WantedMatte wanted{region.id, layer, frame, keys.all};
    out.name = "propagated " + std::to_string(use_.document.id()) + " " +
               std::to_string(region.id) + " " + std::to_string(layer) + " " +
               std::to_string(frame) + " " + keys.all;
    Held& held = held_[{region.id, layer}];
    out.matte = held.name == out.name ? held.matte : propagated(out.name, wanted);
    if (out.matte) {
        held = {out.name, out.matte};
        seen_[where] = {out.name, keys.others};
        out.current = true;
        out.depends_on = keys.others;
        return out;
    }
    out.reached = use_.shelf.error(out.name).empty() && !missed_.contains(out.name);
    const auto instead = [&](MattePtr matte, std::string name, std::string depends_on) {
        if (matte) out = {std::move(matte), false, true, std::move(name), std::move(depends_on)};
        return out.matte != nullptr;
    };
    wanted.walk = WantedMatte::Walk::kForward;
    const std::string forward = out.name + " forward";
    if (!out.reached && instead(propagated(forward, wanted), forward, {})) return out;
    if (const auto on = painted_on_.find(painted);
        !painted.empty() && instead(file(painted, source.select, size), painted,
                                    on != painted_on_.end() ? on->second : std::string()))
        return out;
    if (const auto seen = seen_.find(where); seen != seen_.end())
        (void)instead(use_.shelf.get(seen->second.name, {}), seen->second.name,
                      seen->second.depends_on);
    return out;
}

std::vector<int> PropagatedMattes::reached(const Region& region, int layer) {
    const std::string key = keys_of(region, layer, kAnyFrame).all;
    const WantedMatte wanted{region.id, layer, kAnyFrame, key};
    // One request after another: a new one would cancel the one before.
    if (!reader_.busy())
        (void)reader_.ask({key, use_.preview.matte_version()},
                          [&preview = use_.preview, wanted](const CancelToken&) {
                              return std::optional(Reached{wanted.key, preview.reached(wanted)});
                          });
    const auto newest = reader_.newest();
    return newest && newest->key == key ? newest->frames : std::vector<int>();
}

void PropagatedMattes::forget() {
    absolute_.reset();
    keys_.clear();
    painted_on_.clear();
    seen_.clear();
    held_.clear();
    missed_.clear();
}

}  // namespace weft
