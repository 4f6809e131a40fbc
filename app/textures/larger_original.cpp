#include "app/textures/larger_original.h"

#include <algorithm>
#include <filesystem>

#include "app/textures/texture_shelf.h"
#include "engine/core/geometry.h"
#include "texture_db/catalogue/database.h"
#include "texture_db/library/library.h"

namespace weft {
namespace {

constexpr int kSample_px = 96;
constexpr float kWorthIt = 1.2f;  // a smaller gain is hardly visible
constexpr int kLargest_px = 1024;

// The rectangle of a sample in its original.
Expected<Recti> crop_of(const std::string& library_path, const std::string& id) {
    WEFT_TRY(database, Database::open(library_path, false, true));
    WEFT_TRY(query,
             database->query("SELECT crop_x0, crop_y0, crop_x1, crop_y1 FROM sample WHERE id = ?"));
    query.bind(id);
    WEFT_TRY(found, query.step());
    if (!found) return fail(ErrorCode::kUnreadable, "Texture " + id + " not found.");
    return Recti{static_cast<int>(query.integer(0)), static_cast<int>(query.integer(1)),
                 static_cast<int>(query.integer(2)), static_cast<int>(query.integer(3))};
}

ImageU8x3 piece(const ImageU8x3& picture, const Recti& box) {
    ImageU8x3 out(box.size());
    for (int y = 0; y < box.height(); ++y)
        std::copy_n(picture.pixel(box.x0, box.y0 + y), 3 * box.width(), out.row(y));
    return out;
}

}  // namespace

Expected<float> original_scale(const std::string& library_path, const std::string& id) {
    WEFT_TRY(crop, crop_of(library_path, id));
    const float scale = static_cast<float>(crop.width()) / kSample_px;
    return scale >= kWorthIt ? scale : 1.0f;
}

Expected<LargerOriginal> keep_larger_original(const std::string& library_path,
                                              const std::string& sample_path,
                                              const std::string& folder) {
    const std::string name = library_name_of(sample_path);
    const std::string path = library_path.empty() ? default_library_path() : library_path;
    if (name.empty())
        return fail(ErrorCode::kUsage,
                    "This texture is not from the library, so it has no larger original.",
                    "Take a larger picture of the surface.");
    WEFT_TRY(texture, resolve_texture(path, name));
    WEFT_TRY(crop, crop_of(path, texture.credit.id));
    const float scale = static_cast<float>(crop.width()) / kSample_px;
    Recti box = crop.intersected(rect_of(texture.original.size()));
    if (scale < kWorthIt || texture.original.empty() || box.size() != crop.size())
        return fail(ErrorCode::kUsage, "This texture has no larger original, or its image is gone.",
                    "Take a larger picture of the surface.");
    // A larger area than the sample's gives the synthesis more material.
    const auto widen = [](int& low, int& high, int limit) {
        const int wanted = std::min(limit, std::max(high - low, kLargest_px));
        low = std::clamp((low + high - wanted) / 2, 0, limit - wanted);
        high = low + wanted;
    };
    widen(box.x0, box.x1, texture.original.width());
    widen(box.y0, box.y1, texture.original.height());
    texture.pixels = piece(texture.original, box);
    texture.credit.id += "_larger";
    WEFT_TRY(file, keep_texture(texture, folder));
    return LargerOriginal{std::move(file), scale};
}

}  // namespace weft
