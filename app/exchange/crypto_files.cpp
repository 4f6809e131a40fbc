#include "app/exchange/crypto_files.h"

#include <filesystem>
#include <vector>

#include "engine/core/setting.h"
#include "engine/media/sequence_pattern.h"

namespace weft {

Status name_crypto_files(Region& region, const std::string& plate) {
    const auto name = [&](MatteSource& matte) -> Status {
        if (matte.select.crypto.empty() || !matte.files.empty()) return {};
        const auto pattern = SequencePattern::parse(plate);
        std::error_code ignored;
        if (!pattern || std::filesystem::is_directory(plate, ignored)) {
            return fail(ErrorCode::kUsage, "The Cryptomatte's files are not set. Set them" +
                                               by({{setting::kCryptoFiles}}) + ".");
        }
        matte.files = plate;
        return {};
    };
    MatteSource extent = *region.matte;
    WEFT_CHECK_OK(name(extent));
    region.matte = std::move(extent);
    std::vector<MatteSource> holdouts = *region.holdouts;
    for (MatteSource& holdout : holdouts)
        WEFT_CHECK_OK(name(holdout));
    if (!holdouts.empty()) region.holdouts = std::move(holdouts);
    std::vector<Zone> zones = *region.zones;
    for (Zone& zone : zones)
        WEFT_CHECK_OK(name(zone.matte));
    if (!zones.empty()) region.zones = std::move(zones);
    return {};
}

}  // namespace weft
