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

std::string software_text(const NamedTexts& metadata, bool with_inputs) {
    if (metadata.empty()) return {};
    const std::string plane = value_of(metadata, "weft:plane");
    const std::string inputs = with_inputs ? value_of(metadata, "weft:inputs") : "";
    return "weft " + value_of(metadata, "weft:version") +
           " settings=" + value_of(metadata, "weft:settings") +
           " seed=" + value_of(metadata, "weft:seed") +
           " backend=" + value_of(metadata, "weft:backend") +
           (plane.empty() ? "" : " plane=" + plane) + (inputs.empty() ? "" : " inputs=" + inputs);
}

std::string inputs_text(const NamedTexts& metadata) {
    const std::string inputs = value_of(metadata, "weft:inputs");
    return inputs.empty() ? inputs : "weft inputs=" + inputs;
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
    if (!out.empty()) return out;
    // DPX has no room for all of it in one field.
    for (const char* field : {"Software", "DocumentName"}) {
        std::istringstream text(std::string(input->spec().get_string_attribute(field, "")));
        std::string word;
        if (!(text >> word) || word != "weft") continue;
        while (text >> word) {
            const std::size_t equals = word.find('=');
            if (equals == std::string::npos)
                out["weft:version"] = word;
            else
                out[kPrefix + word.substr(0, equals)] = word.substr(equals + 1);
        }
    }
    return out;
}

}  // namespace weft
