#include <cstdio>

#include "app/cli/commands.h"
#include "engine/core/printable.h"
#include "engine/media/cryptomatte.h"

namespace weft {
namespace {

nlohmann::ordered_json entry_of(const CryptoObject& object) {
    char id[16];
    std::snprintf(id, sizeof id, "%08x", object.id);
    return {{"layer", object.layer},
            {"name", object.name},
            {"id", id},
            {"coverage_px", object.coverage_px}};
}

}  // namespace

CommandResult cryptomatte_command(const std::string& path, const std::string& at) {
    std::vector<CryptoObject> objects;
    if (at.empty()) {
        WEFT_TRY(all, list_cryptomatte(path));
        objects = std::move(all);
    } else {
        int x = 0, y = 0, used = 0;
        if (std::sscanf(at.c_str(), "%d,%d%n", &x, &y, &used) != 2 ||
            used != static_cast<int>(at.size())) {
            return fail(ErrorCode::kUsage, "--at must be a pixel, not '" + at + "'.",
                        "Write it like 320,180.");
        }
        WEFT_TRY(picked, pick_cryptomatte(path, x, y));
        if (!picked.name.empty()) objects.push_back(std::move(picked));
    }
    Answer answer;
    answer.json = {{"schema", "weft.cryptomatte/1"},
                   {"file", absolute_path(path)},
                   {"objects", nlohmann::ordered_json::array()}};
    for (const CryptoObject& object : objects) {
        answer.json["objects"].push_back(entry_of(object));
        char line[64];
        std::snprintf(line, sizeof line, "%12.1f px  ", object.coverage_px);
        answer.text += line + printable(object.layer + "/" + object.name) + "\n";
    }
    return answer;
}

}  // namespace weft
