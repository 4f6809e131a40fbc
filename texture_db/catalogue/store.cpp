#include "texture_db/catalogue/store.h"

#include <chrono>
#include <map>

#include "engine/core/hash.h"
#include "engine/core/parallel.h"
#include "texture_db/catalogue/index.h"
#include "texture_db/catalogue/rows.h"
#include "texture_db/describe/features.h"
#include "texture_db/describe/material_words.h"
#include "texture_db/describe/sample_codec.h"

namespace weft {
namespace {

std::int64_t now_s() {
    return std::chrono::duration_cast<std::chrono::seconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
}

Expected<std::int64_t> store_picture(Database& database, const PreparedPicture& picture) {
    WEFT_TRY(insert, database.query("INSERT OR IGNORE INTO picture(hash, width, height, data) "
                                    "VALUES(?, ?, ?, ?)"));
    insert.bind(picture.hash)
        .bind(picture.size.width)
        .bind(picture.size.height)
        .bind(std::span<const std::byte>(picture.bytes));
    WEFT_CHECK_OK(insert.run());
    WEFT_TRY(find, database.query("SELECT key FROM picture WHERE hash = ?"));
    find.bind(picture.hash);
    WEFT_TRY(found, find.step());
    return found ? find.integer(0) : 0;
}

// False if it is already there.
Expected<bool> store_sample(Database& database, const NewTexture& t, const PreparedTexture& p,
                            const PreparedPicture* picture_of_it) {
    const Size original = t.original ? t.original->size() : t.original_size;
    const std::string tags = joined_words(t.tags);
    const std::vector<std::byte> measured = bytes_of(p.measured);
    WEFT_TRY(there, database.query("SELECT 1 FROM sample WHERE id = ?"));
    there.bind(p.id);
    WEFT_TRY(already, there.step());
    if (already) return false;
    std::int64_t picture = 0;
    if (picture_of_it) {
        WEFT_TRY(key, store_picture(database, *picture_of_it));
        picture = key;
    }
    WEFT_TRY(insert, database.query(
                         "INSERT INTO sample(id, name, material, category, tags, origin, package, "
                         "source, author, licence, original_width, original_height, crop_x0, "
                         "crop_y0, crop_x1, crop_y1, picture, measured, synthesis, added) "
                         "VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)"));
    insert.bind(p.id).bind(t.name).bind(t.material).bind(t.category).bind(tags);
    insert.bind(static_cast<int>(t.origin)).bind(t.package).bind(t.source).bind(t.author);
    insert.bind(t.licence).bind(original.width).bind(original.height);
    insert.bind(t.original_crop.x0).bind(t.original_crop.y0);
    insert.bind(t.original_crop.x1).bind(t.original_crop.y1);
    picture > 0 ? insert.bind(picture) : insert.bind_null();
    insert.bind(std::span<const std::byte>(measured)).bind(static_cast<double>(p.synthesis));
    insert.bind(now_s());
    WEFT_CHECK_OK(insert.run());
    const std::int64_t key = database.last_row();
    WEFT_TRY(pixels, database.query("INSERT INTO pixels VALUES(?, ?)"));
    WEFT_CHECK_OK(pixels.bind(key).bind(std::span<const std::byte>(p.png)).run());
    WEFT_TRY(features, database.query("INSERT INTO features VALUES(?, ?, ?)"));
    WEFT_CHECK_OK(features.bind(key).bind(kFeatureVersion).bind(bytes_of(p.features)).run());
    WEFT_TRY(text, database.query("INSERT INTO sample_text(rowid, name, material, tags, category) "
                                  "VALUES(?, ?, ?, ?, ?)"));
    const std::string name = words_of_name(t.name), category = words_of_name(t.category);
    WEFT_CHECK_OK(text.bind(key).bind(name).bind(t.material).bind(tags).bind(category).run());
    return true;
}

PreparedTexture prepare_texture(const NewTexture& texture) {
    PreparedTexture p;
    p.id = texture_id(texture.pixels);
    p.png = encode_png(texture.pixels);
    p.measured = measure_texture(texture.pixels);
    p.features = texture_features(texture.pixels);
    p.synthesis = synthesisability(texture.pixels);
    return p;
}

}  // namespace

Expected<PreparedTextures> prepare_textures(const std::vector<NewTexture>& textures) {
    for (const NewTexture& texture : textures) {
        if (texture.pixels.size() != Size{kSampleSide_px, kSampleSide_px}) {
            return fail(ErrorCode::kUsage,
                        "A sample must be 96x96 pixels: " + texture.name + " is not.");
        }
    }
    PreparedTextures out;
    out.samples.resize(textures.size());
    parallel_for(textures.size(),
                 [&](std::size_t i) { out.samples[i] = prepare_texture(textures[i]); });
    for (const NewTexture& texture : textures) {
        if (!texture.original || out.pictures.contains(texture.original.get())) continue;
        out.pictures[texture.original.get()] = {texture.original->size(),
                                                texture_id(*texture.original),
                                                encode_jpeg(*texture.original)};
    }
    return out;
}

Expected<int> store_textures(Database& database, const std::vector<NewTexture>& textures,
                             const PreparedTextures& prepared) {
    const std::map<const ImageU8x3*, PreparedPicture>& pictures = prepared.pictures;
    WEFT_TRY(transaction, Transaction::begin(database));
    WEFT_TRY(model, stored_model(database));
    int added = 0;
    for (std::size_t i = 0; i < textures.size(); ++i) {
        const auto picture = pictures.find(textures[i].original.get());
        WEFT_TRY(fresh, store_sample(database, textures[i], prepared.samples[i],
                                     picture == pictures.end() ? nullptr : &picture->second));
        if (!fresh) continue;
        ++added;
        if (model) {
            WEFT_TRY(key, database.number("SELECT max(key) FROM sample"));
            WEFT_CHECK_OK(
                store_descriptor(database, key, model->describe(prepared.samples[i].features)));
        }
    }
    if (added > 0) WEFT_CHECK_OK(count_change(database));
    WEFT_CHECK_OK(transaction.commit());
    return added;
}

Status remove_texture(Database& database, const std::string& id) {
    WEFT_TRY(transaction, Transaction::begin(database));
    {
        WEFT_TRY(text, database.query("DELETE FROM sample_text WHERE rowid = (SELECT key FROM "
                                      "sample WHERE id = ?)"));
        WEFT_CHECK_OK(text.bind(id).run());
        WEFT_TRY(sample, database.query("DELETE FROM sample WHERE id = ?"));
        WEFT_CHECK_OK(sample.bind(id).run());
        WEFT_CHECK_OK(
            database.execute("DELETE FROM picture WHERE key NOT IN (SELECT picture FROM "
                             "sample WHERE picture IS NOT NULL)"));
    }
    WEFT_CHECK_OK(count_change(database));
    return transaction.commit();
}

}  // namespace weft
