#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/cli/commands.h"
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

int cryptomatte_command(const std::string& path, const std::string& at, bool json) {
    std::vector<CryptoObject> objects;
    if (at.empty()) {
        auto all = list_cryptomatte(path);
        if (!all) return report_error(all.error());
        objects = std::move(*all);
    } else {
        int x = 0, y = 0, used = 0;
        if (std::sscanf(at.c_str(), "%d,%d%n", &x, &y, &used) != 2 ||
            used != static_cast<int>(at.size())) {
            return report_error(
                {ErrorCode::kUsage, "'" + at + "' is no pixel. Write it like 320,180.", {}});
        }
        auto picked = pick_cryptomatte(path, x, y);
        if (!picked) return report_error(picked.error());
        if (!picked->name.empty()) objects.push_back(std::move(*picked));
    }
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    std::string text;
    for (const CryptoObject& object : objects) {
        list.push_back(entry_of(object));
        char line[64];
        std::snprintf(line, sizeof line, "%12.1f px  ", object.coverage_px);
        text += line + object.layer + "/" + object.name + "\n";
    }
    print(stdout,
          json ? list.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n"
               : text);
    return 0;
}

}  // namespace weft
