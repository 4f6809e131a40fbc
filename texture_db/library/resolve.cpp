#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/core/input_file.h"
#include "engine/media/atomic_file.h"
#include "texture_db/describe/sample_codec.h"
#include "texture_db/library/library.h"

namespace weft {

std::string texture_credit_path(const std::string& picture_path) {
    return picture_path + ".credit.json";
}

Expected<ResolvedTexture> resolve_texture(const std::string& library_path, const std::string& id) {
    const std::string path = library_path.empty() ? default_library_path() : library_path;
    LibraryOptions options;
    options.create = false;
    WEFT_TRY(library, TextureLibrary::open(path, options));
    WEFT_TRY(info, library->info(id));
    ResolvedTexture out;
    WEFT_TRY(pixels, library->thumbnail(info.id));
    out.pixels = std::move(pixels);
    if (!info.original_size.empty()) {
        WEFT_TRY(original, library->original(info.id));
        if (original.size() != out.pixels.size()) out.original = std::move(original);
    }
    out.credit = {{}, info.id, info.name, info.material, info.author, info.licence, info.source};
    if (!info.package.empty()) out.credit.source = info.package + ": " + info.source;
    return out;
}

Expected<std::string> keep_texture(const std::string& library_path, const std::string& id,
                                   const std::string& folder, const WriteRule& rule) {
    WEFT_TRY(texture, resolve_texture(library_path, id));
    return keep_texture(texture, folder, rule);
}

Expected<std::string> keep_texture(const ResolvedTexture& texture, const std::string& folder,
                                   const WriteRule& rule) {
    WEFT_CHECK_OK(make_folder(folder, rule));
    const TextureCredit& credit = texture.credit;
    const std::string path =
        (std::filesystem::path(folder) / ("db_" + credit.id + ".png")).string();
    WEFT_CHECK_OK(write_file_atomically(path, encode_png(texture.pixels), rule));
    const nlohmann::ordered_json json{
        {"id", credit.id},         {"name", credit.name},       {"material", credit.material},
        {"author", credit.author}, {"licence", credit.licence}, {"source", credit.source}};
    const std::string text =
        json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    WEFT_CHECK_OK(write_file_atomically(texture_credit_path(path), std::string_view(text), rule));
    return path;
}

std::optional<TextureCredit> read_texture_credit(const std::string& picture_path) {
    const auto written = read_file(texture_credit_path(picture_path), {});
    if (!written) return std::nullopt;
    const auto json = nlohmann::json::parse(*written, nullptr, false);
    if (!json.is_object()) return std::nullopt;
    const auto text = [&](const char* key) {
        const auto at = json.find(key);
        return at != json.end() && at->is_string() ? at->get<std::string>() : std::string();
    };
    TextureCredit credit;
    credit.id = text("id");
    credit.name = text("name");
    credit.material = text("material");
    credit.author = text("author");
    credit.licence = text("licence");
    credit.source = text("source");
    return credit;
}

}  // namespace weft
