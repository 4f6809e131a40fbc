#include "app/shot/settled_region.h"

#include <iterator>

#include "app/exchange/crypto_files.h"
#include "app/exchange/region_matte_sources.h"
#include "app/shot/matte_channel.h"
#include "app/shot/matte_movies.h"
#include "app/shot/pass_choice.h"
#include "app/shot/region_projection.h"
#include "app/shot/trimmed_frames.h"
#include "engine/media/cryptomatte.h"
#include "engine/media/sequence_files.h"

namespace weft {
namespace {

// Several renders of one file may list an object: that of the plate is meant.
void choose_crypto_layers(Region& region, const Shot& shot) {
    const std::string& beside = shot.project.plate.layer;
    if (beside.empty()) return;
    change_matte_sources(region, [&](MatteSource& matte) {
        if (matte.select.crypto.empty()) return;
        const auto pattern = SequencePattern::parse(matte.files);
        if (!pattern) return;
        const auto files = existing_files(*pattern, shot.plate->frames());
        if (files.empty()) return;
        matte.select.crypto = cryptomatte_names_beside(files.front(), matte.select.crypto, beside);
    });
}

}  // namespace

Status settle_region(Region& region, Shot& shot) {
    const Plate& plate = shot.project.plate;
    WEFT_CHECK_OK(name_crypto_files(region, plate.path));
    WEFT_TRY(movies, check_matte_movies(region, *shot.plate));
    std::move(movies.begin(), movies.end(), std::back_inserter(shot.warnings));
    choose_crypto_layers(region, shot);
    WEFT_CHECK_OK(add_frozen_mattes(region));
    WEFT_TRY(channels, choose_matte_channels(region, shot.plate->frames()));
    std::move(channels.begin(), channels.end(), std::back_inserter(shot.warnings));
    if (std::string trimmed = leave_out_trimmed(region, *shot.plate); !trimmed.empty())
        shot.warnings.push_back(std::move(trimmed));
    WEFT_TRY(passes, choose_pass_layers(region, plate, shot.plate->frames()));
    std::move(passes.notes.begin(), passes.notes.end(), std::back_inserter(shot.notes));
    std::move(passes.warnings.begin(), passes.warnings.end(), std::back_inserter(shot.warnings));
    return {};
}

}  // namespace weft
