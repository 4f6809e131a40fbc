#include "app/shot/matte_channel.h"

#include "app/exchange/region_matte_sources.h"
#include "engine/media/image_files.h"
#include "engine/media/matte_look.h"
#include "engine/media/plates.h"
#include "engine/media/sequence_files.h"

namespace weft {
namespace {

bool is_chosen(const MatteSelect& select) {
    return !select.channel.empty() || !select.crypto.empty() || select.value;
}

std::vector<std::string> painted_files(const MatteSource& matte) {
    std::vector<std::string> files;
    for (const auto& [frame, key] : matte.keyframes)
        files.push_back(key.path);
    return files;
}

}  // namespace

Expected<std::vector<std::string>> choose_matte_channels(Region& region,
                                                         const std::vector<int>& frames) {
    std::vector<std::string> warnings;
    Status judged;
    const auto judge = [&](const std::string& name, const std::vector<std::string>& files,
                           const std::string& channel) {
        if (!judged) return;
        auto warning = judge_mattes(name, files, channel);
        if (!warning)
            judged = tl::unexpected(warning.error());
        else if (!warning->empty())
            warnings.push_back("Region '" + region.name + "': " + *warning);
    };
    change_matte_sources(region, [&](MatteSource& matte) {
        if (is_chosen(matte.select)) return;
        if (matte.files.empty()) {
            const auto files = painted_files(matte);
            if (!files.empty()) judge(files.front(), files, {});
            return;
        }
        const auto pattern = SequencePattern::parse(matte.files);
        if (!pattern || (pattern->is_single() && has_movie_extension(matte.files))) return;
        if (pattern->is_single()) return judge(matte.files, {matte.files}, {});
        const auto files = existing_files(*pattern, frames);
        matte.select.channel = channel_of_mattes(files);
        judge(matte.files, files, matte.select.channel);
    });
    if (!judged) return tl::unexpected(judged.error());
    return warnings;
}

}  // namespace weft
