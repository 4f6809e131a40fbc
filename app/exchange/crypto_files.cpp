#include "app/exchange/crypto_files.h"

#include <filesystem>

#include "app/exchange/region_matte_sources.h"
#include "engine/core/setting.h"
#include "engine/media/cryptomatte.h"
#include "engine/media/sequence_files.h"

namespace weft {

Status name_crypto_files(Region& region, const std::string& plate) {
    const auto name = [&](MatteSource& matte) -> Status {
        if (matte.select.crypto.empty() || !matte.files.empty()) return {};
        const auto pattern = SequencePattern::parse(plate);
        std::error_code ignored;
        if (!pattern || std::filesystem::is_directory(plate, ignored)) {
            return fail(ErrorCode::kUsage, "The Cryptomatte's files are not set.",
                        "Set them" + by({{setting::kCryptoFiles}}) + ".");
        }
        matte.files = plate;
        return {};
    };
    Status named;
    change_matte_sources(region, [&](MatteSource& matte) {
        if (named) named = name(matte);
    });
    return named;
}

Status check_crypto_names(const Region& region, const std::vector<int>& frames) {
    for (const MatteSource* matte : matte_sources(region)) {
        if (matte->select.crypto.empty()) continue;
        WEFT_TRY(pattern, SequencePattern::parse(matte->files));
        WEFT_CHECK_OK(
            check_cryptomatte_names(existing_files(pattern, frames), matte->select.crypto));
    }
    return {};
}

}  // namespace weft
