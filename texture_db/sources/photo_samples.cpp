#include "texture_db/sources/photo_samples.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <new>

#include "engine/core/text.h"
#include "texture_db/describe/material_words.h"
#include "texture_db/describe/picture_file.h"
#include "texture_db/describe/sample_codec.h"

namespace weft {

namespace fs = std::filesystem;

PhotoSamples samples_of(const Photo& photo, const ChoiceRules& rules) {
    PhotoSamples out;
    try {
        auto read = read_picture_file(photo.file);
        if (!read) {
            out.fault = read.error().text();
            return out;
        }
        out.fault = picture_fault(*read, rules);
        if (!out.fault.empty()) return out;
        const Size full = read->size();
        out.picture = at_sample_scale(*read);
        const double scale = static_cast<double>(full.width) / out.picture.width();
        const auto tiles = choose_samples(out.picture, rules);
        if (tiles.empty()) {
            out.fault = "no part is sharp and even enough";
            return out;
        }
        std::shared_ptr<const ImageU8x3> original;
        if (photo.keep_original) original = std::make_shared<const ImageU8x3>(out.picture);
        int number = 0;
        for (const Recti& tile : tiles) {
            NewTexture t;
            t.pixels = cropped(out.picture, tile);
            t.name = photo.name + (tiles.size() > 1 ? ", part " + std::to_string(++number) : "");
            t.material = photo.material;
            t.category = photo.category;
            t.tags = photo.tags;
            t.origin = photo.origin;
            t.package = photo.package;
            t.source = photo.source;
            t.author = photo.author;
            t.licence = photo.licence;
            t.original = original;
            t.original_size = full;
            const auto to_full = [&](int v) { return static_cast<int>(std::lround(v * scale)); };
            t.original_crop = original ? tile
                                       : Recti{to_full(tile.x0), to_full(tile.y0), to_full(tile.x1),
                                               to_full(tile.y1)};
            out.samples.push_back(std::move(t));
        }
    } catch (const std::bad_alloc&) {
        out = {};
        out.fault = "it does not fit into memory";
    }
    return out;
}

Expected<std::vector<std::string>> pictures_below(const std::string& path) {
    static const std::vector<std::string> kKinds{".png",  ".jpg", ".jpeg", ".tga", ".dds",  ".tif",
                                                 ".tiff", ".bmp", ".exr",  ".hdr", ".webp", ".psd",
                                                 ".ppm",  ".gif", ".jp2",  ".tx"};
    std::error_code error;
    if (fs::is_regular_file(path, error)) return std::vector<std::string>{path};
    if (!fs::is_directory(path, error)) {
        return fail(ErrorCode::kUnreadable, path + " not found.", "Check the path.");
    }
    std::vector<std::string> out;
    fs::recursive_directory_iterator entries(path, fs::directory_options::skip_permission_denied,
                                             error);
    if (error) {
        return fail(ErrorCode::kUnreadable,
                    "The folder " + path + " cannot be read: " + error.message() + ".");
    }
    for (; entries != fs::recursive_directory_iterator(); entries.increment(error)) {
        if (error) break;
        const std::string kind = lower_case(entries->path().extension().string());
        if (std::find(kKinds.begin(), kKinds.end(), kind) != kKinds.end() &&
            entries->is_regular_file(error))
            out.push_back(entries->path().string());
    }
    std::sort(out.begin(), out.end());
    return out;
}

}  // namespace weft
