#include "engine/media/metadata.h"
#include "engine/media/picture_file.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <sstream>

namespace weft {
namespace {

constexpr const char* kPrefix = "weft:";

std::string value_of(const NamedTexts& metadata, const std::string& name) {
    const auto at = std::find_if(metadata.begin(), metadata.end(),
                                 [&](const auto& entry) { return entry.first == name; });
    return at == metadata.end() ? std::string() : at->second;
}

}  // namespace

std::string software_text(const NamedTexts& metadata) {
    if (metadata.empty()) return {};
    const std::string plane = value_of(metadata, "weft:plane");
    return "weft " + value_of(metadata, "weft:version") +
           " settings=" + value_of(metadata, "weft:settings") +
           " seed=" + value_of(metadata, "weft:seed") +
           " backend=" + value_of(metadata, "weft:backend") +
           (plane.empty() ? "" : " plane=" + plane);
}

std::string copyright_text(const NamedTexts& metadata) {
    const std::string textures = value_of(metadata, "weft:textures");
    if (textures.empty()) return {};
    return "textures " + textures + "; licences " + value_of(metadata, "weft:licences");
}

std::map<std::string, std::string> read_recipe_metadata(const std::string& path) {
    std::map<std::string, std::string> out;
    const auto opened = open_picture(path);
    if (!opened) return out;
    const auto& input = *opened;
    for (const OIIO::ParamValue& entry : input->spec().extra_attribs) {
        const std::string name(entry.name().string());
        if (name.rfind(kPrefix, 0) == 0) out[name] = entry.get_string();
    }
    std::istringstream software(std::string(input->spec().get_string_attribute("Software", "")));
    std::string word, version;
    if (out.empty() && software >> word && word == "weft" && software >> version) {
        out["weft:version"] = version;
        while (software >> word) {
            const std::size_t equals = word.find('=');
            if (equals != std::string::npos)
                out[kPrefix + word.substr(0, equals)] = word.substr(equals + 1);
        }
    }
    return out;
}

}  // namespace weft
