#include "texture_db/sources/package_pictures.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "engine/core/input_file.h"
#include "engine/core/text.h"
#include "engine/media/atomic_file.h"
#include "engine/media/zip_reader.h"
#include "texture_db/describe/material_words.h"
#include "texture_db/sources/copyright_file.h"
#include "texture_db/sources/import.h"
#include "texture_db/sources/picture_corrections.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

bool is_picture(const std::string& path) {
    static const std::set<std::string> kKinds{".png", ".jpg", ".jpeg", ".tga",
                                              ".dds", ".bmp", ".tif"};
    return kKinds.contains(lower_case(fs::path(path).extension().string()));
}

bool is_archive(const std::string& path) {
    const std::string kind = lower_case(fs::path(path).extension().string());
    return kind == ".pk3" || kind == ".zip" || kind == ".pk4";
}

CopyrightFile read_copyright(const std::string& unpacked, const std::string& package) {
    std::error_code error;
    std::string text;
    const fs::path docs = fs::path(unpacked) / "usr" / "share" / "doc";
    for (const fs::path& file : {docs / package / "copyright"}) {
        text = read_file(file.string(), {}).value_or(std::string());
    }
    for (auto entry = fs::directory_iterator(docs, error);
         text.empty() && !error && entry != fs::directory_iterator(); entry.increment(error)) {
        text = read_file((entry->path() / "copyright").string(), {}).value_or(std::string());
    }
    return CopyrightFile::parse(text);
}

// The last two folders and the name; the folders before them are the same for a whole package.
std::string telling_part(const std::string& path) {
    std::size_t at = path.size();
    for (int parts = 0; parts < 2 && at != std::string::npos && at > 0; ++parts)
        at = path.rfind('/', at - 1);
    return at == std::string::npos ? path : path.substr(at == 0 ? 0 : at + 1);
}

class Collector {
  public:
    Collector(std::string package, CopyrightFile copyright)
        : package_(std::move(package)), copyright_(std::move(copyright)) {}

    /// The material, or empty if the picture is not wanted.
    [[nodiscard]] std::string wanted(const std::string& source) {
        if (!is_picture(source) || names_an_object(source) ||
            is_other_map(fs::path(source).filename().string()))
            return {};
        std::string material = material_of_path(telling_part(source));
        if (material.empty()) ++out.not_named;
        const auto seen = corrected_material(package_, source);
        if (!seen || material.empty()) return material;
        if (*seen != "-") return *seen;
        ++out.looked_wrong;
        return {};
    }
    void take(const std::string& file, const std::string& source, const std::string& material) {
        Photo photo;
        photo.file = file;
        photo.origin = TextureOrigin::kPackage;
        photo.source = source;
        photo.package = package_;
        photo.material = material;
        photo.name = words_of_name(fs::path(source).filename().string());
        photo.category = package_ + "/" + fs::path(source).parent_path().filename().string();
        const FileLicence licence = copyright_.of(source);
        photo.author = licence.author;
        photo.licence = licence.licence;
        photo.keep_original = true;
        // A material that only the folder names is a guess unless the package was inspected.
        if (!was_inspected(package_) &&
            material_of_path(fs::path(source).filename().string()).empty())
            photo.tags.push_back("guessed");
        out.photos.push_back(std::move(photo));
    }
    PackagePictures out;

  private:
    std::string package_;
    CopyrightFile copyright_;
};

Status take_archive(const std::string& archive, const std::string& extracted,
                    const CancelToken& cancel, Collector& collector) {
    WEFT_TRY(zip, ZipReader::open(archive));
    collector.out.refused_paths += static_cast<int>(zip.refused().size());
    for (const ZipEntry& entry : zip.entries()) {
        if (cancel.cancelled())
            return fail(static_cast<ErrorCode>(cancel.reason()), "Unpacking was stopped",
                        "run it again to continue.");
        const std::string material = collector.wanted(entry.path);
        if (material.empty()) continue;
        const fs::path file = fs::path(extracted) / fs::path(archive).stem() / entry.path;
        std::error_code error;
        if (fs::file_size(file, error) != entry.bytes || error) {
            auto data = zip.read(entry);
            if (!data) continue;  // one damaged picture does not stop the others
            fs::create_directories(file.parent_path(), error);
            WEFT_CHECK_OK(
                write_file_atomically(file.string(), std::string_view(*data), WriteRule::own()));
        }
        collector.take(file.string(), entry.path, material);
    }
    return {};
}

}  // namespace

bool names_an_object(const std::string& path) {
    static const std::set<std::string> kObjects{
        "sign",    "signs",    "logo",     "text",    "poster",   "banner",     "flag",
        "menu",    "icon",     "icons",    "gui",     "font",     "fonts",      "door",
        "doors",   "window",   "windows",  "screen",  "monitor",  "skybox",     "skies",
        "sky",     "env",      "lightmap", "sprite",  "particle", "particles",  "explosion",
        "hud",     "face",     "head",     "body",    "player",   "players",    "weapon",
        "vehicle", "vehicles", "kart",     "karts",   "car",      "wheel",      "books",
        "book",    "shelf",    "fence",    "grate",   "ladder",   "pipe",       "pipes",
        "light",   "lights",   "lamp",     "switch",  "button",   "computer",   "console",
        "picture", "pics",     "painting", "map",     "minimap",  "screenshot", "loading",
        "editor",  "trim",     "trims",    "border",  "edge",     "corner",     "stripe",
        "arrow",   "number",   "letter",   "symbol",  "eye",      "hand",       "clock",
        "tv",      "radio",    "keyboard", "crate",   "box",      "barrel",     "container",
        "tree",    "flower",   "flowers",  "plant",   "bush",     "palm",       "sfx",
        "fx",      "models",   "skins",    "common",  "effects",  "portal",     "teleporter",
        "jumppad", "decal",    "decals",   "curtain", "bed",      "chair",      "table",
        "sofa",    "shadow",   "cube",     "side",    "top",      "ceil",       "rail",
        "railing", "gfx",      "card",     "cards",   "credits",  "billboard",  "preview",
        "help",    "banners",  "rope",     "chain",   "cage",     "vent",       "fan",
        "grill",   "grid",     "shop",     "labels",  "label",    "anim",       "tex_anim",
        "nodraw",  "caulk",    "clip",     "hint",    "waving",   "gift",       "garage",
        "truck",   "boat",     "bus"};
    const std::string words = words_of_name(telling_part(path));
    for (const std::string& word : split_words(words)) {
        if (kObjects.contains(word)) return true;
    }
    return false;
}

Expected<PackagePictures> find_package_pictures(const std::string& package,
                                                const std::string& unpacked,
                                                const std::string& extracted,
                                                const CancelToken& cancel) {
    Collector collector(package, read_copyright(unpacked, package));
    std::vector<std::string> files;
    std::error_code error;
    for (fs::recursive_directory_iterator entry(unpacked, error), end; !error && entry != end;
         entry.increment(error)) {
        if (entry->is_regular_file(error) && !entry->is_symlink(error))
            files.push_back(entry->path().string());
    }
    if (error || files.empty()) {
        return fail(ErrorCode::kUnreadable,
                    "The unpacked package in " + unpacked + " cannot be read.",
                    "Remove that folder and build again.");
    }
    std::sort(files.begin(), files.end());
    for (const std::string& file : files) {
        if (is_archive(file)) {
            WEFT_CHECK_OK(take_archive(file, extracted, cancel, collector));
            continue;
        }
        const std::string source = fs::path(file).lexically_relative(unpacked).generic_string();
        if (const std::string material = collector.wanted(source); !material.empty())
            collector.take(file, source, material);
    }
    std::stable_sort(collector.out.photos.begin(), collector.out.photos.end(),
                     [](const Photo& a, const Photo& b) { return a.source < b.source; });
    return std::move(collector.out);
}

}  // namespace weft
