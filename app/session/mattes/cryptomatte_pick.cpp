#include "app/session/mattes/cryptomatte_pick.h"

#include <string>
#include <string_view>

#include "app/mattes/matte_layer.h"
#include "app/project/codec/project_file.h"
#include "engine/media/cryptomatte.h"
#include "engine/media/cryptomatte_selection.h"
#include "engine/media/sequence_pattern.h"

namespace weft {
namespace {

// Adds a name to a comma-separated list, or removes it.
std::string changed_names(const std::string& names, const std::string& name, bool subtract) {
    std::string out;
    const auto add = [&](std::string_view one) {
        out += (out.empty() ? "" : ",") + std::string(one);
    };
    for (const std::string& one : split_crypto_names(names))
        if (one != name) add(escaped_crypto_name(one));
    if (!subtract) add(escaped_crypto_name(name));
    return out;
}

Expected<CryptoObject> object_at(const std::string& files, int frame, Vec2i at) {
    WEFT_TRY(pattern, SequencePattern::parse(files));
    return pick_cryptomatte(pattern.path_for(frame), at.x, at.y);
}

}  // namespace

void CryptomattePick::pick(const PickCryptomatte& action) {
    const Region* region = use_.selection.of(use_.document.project());
    if (!region || !use_.plate.reader()) {
        use_.notices.add(NoticeKind::kWarning, "Add a region first, then pick its objects.");
        return;
    }
    const int frame = use_.playback.frame(), layer = use_.selection.layer;
    const MatteSource& source = layer_source(*region, layer);
    const bool own = !source.select.crypto.empty() && !source.files.empty();
    const std::string files = own ? resolve_path(use_.document.folder(), source.files)
                                  : use_.plate.reader()->path_of(frame);
    use_.tasks.start_for_document(
        [this, action, files, frame, id = region->id, layer]() -> DocumentTasks::Finish {
            const auto picked = object_at(files, frame, action.at);
            return [this, action, picked, id, layer] {
                if (!region_by_id(use_.document.project(), id)) return;
                if (!picked) return use_.notices.add(NoticeKind::kWarning, picked.error().text());
                if (picked->name.empty())
                    return use_.notices.add(NoticeKind::kWarning,
                                            "The Cryptomatte has no object at this pixel.");
                take(picked->name, action.subtract, id, layer);
            };
        });
}

void CryptomattePick::take(const std::string& object, bool subtract, RegionId region, int layer) {
    const Region& now = *region_by_id(use_.document.project(), region);
    const MatteSource& before = layer_source(now, layer);
    MatteSource matte;
    matte.select.crypto = changed_names(before.select.crypto, object, subtract);
    if (!before.select.crypto.empty()) matte.files = before.files;
    if (matte.select.crypto.empty()) matte.files.clear();
    use_.document.commit(set_layer(now, layer, matte, use_.selection.begun_zone),
                         (subtract ? "Subtract " : "Add ") + object);
}

}  // namespace weft
