#include "texture_db/library/library.h"

#include <cstdlib>
#include <filesystem>

#include "engine/core/setting.h"
#include "texture_db/catalogue/copy.h"
#include "texture_db/catalogue/learn.h"
#include "texture_db/catalogue/outliers.h"
#include "texture_db/catalogue/schema.h"
#include "texture_db/describe/features.h"
#include "texture_db/describe/material_words.h"
#include "texture_db/describe/sample_codec.h"
#include "texture_db/library/library_state.h"
#include "texture_db/library/source_picture.h"
#include "texture_db/recommend/recommend_index.h"
#include "texture_db/search/ranking.h"

namespace weft {

std::string default_library_path() {
    namespace fs = std::filesystem;
    if (const char* data = std::getenv("XDG_DATA_HOME"); data && *data)
        return (fs::path(data) / "weft" / "textures.db").string();
    const char* home = std::getenv("HOME");
    return (fs::path(home ? home : ".") / ".local" / "share" / "weft" / "textures.db").string();
}

const char* name_of(TextureOrigin origin) {
    switch (origin) {
        case TextureOrigin::kProcedural:
            return "procedural";
        case TextureOrigin::kPackage:
            return "package";
        case TextureOrigin::kFile:
            break;
    }
    return "file";
}

TextureLibrary::TextureLibrary(std::unique_ptr<State> state) : state_(std::move(state)) {}
TextureLibrary::~TextureLibrary() = default;

Expected<std::shared_ptr<TextureLibrary>> TextureLibrary::open(const std::string& path,
                                                               const LibraryOptions& options) {
    auto state = std::make_unique<State>();
    state->path = path;
    state->read_only = options.read_only;
    WEFT_TRY(database, Database::open(path, options.create, options.read_only));
    WEFT_CHECK_OK(bring_up_to_date(*database, options.read_only));
    state->database = std::move(database);
    return std::shared_ptr<TextureLibrary>(new TextureLibrary(std::move(state)));
}

const std::string& TextureLibrary::path() const {
    return state_->path;
}

Expected<std::int64_t> TextureLibrary::size() {
    const std::scoped_lock lock(state_->mutex);
    return state_->database->number("SELECT count(*) FROM sample");
}

Expected<std::int64_t> TextureLibrary::change_count() {
    const std::scoped_lock lock(state_->mutex);
    return state_->database->number("SELECT count FROM changes");
}

Expected<ImageU8x3> TextureLibrary::thumbnail(const std::string& given) {
    std::vector<std::byte> png;
    {
        const std::scoped_lock lock(state_->mutex);
        WEFT_TRY(id, full_id(*state_->database, given));
        WEFT_TRY(query, state_->database->query("SELECT p.png FROM pixels p JOIN sample s ON "
                                                "s.key = p.sample WHERE s.id = ?"));
        query.bind(id);
        WEFT_TRY(found, query.step());
        if (found) png.assign(query.blob(0).begin(), query.blob(0).end());
    }
    auto image = decode_picture(png);  // outside of the lock: several threads may decode
    if (!image) {
        return fail(ErrorCode::kUnreadable,
                    "The pixels of texture " + given + " in " + state_->path + " are damaged.",
                    "Check the library" + by({{setting::kVerifyLibrary}}) + ".");
    }
    return image;
}

Expected<ImageU8x3> TextureLibrary::original(const std::string& given) {
    std::vector<std::byte> data;
    WEFT_TRY(about, info(given));
    if (about.original_in_file) {
        const std::scoped_lock lock(state_->mutex);
        WEFT_TRY(query, state_->database->query("SELECT p.data FROM picture p JOIN sample s ON "
                                                "s.picture = p.key WHERE s.id = ?"));
        query.bind(about.id);
        WEFT_TRY(found, query.step());
        if (found) data.assign(query.blob(0).begin(), query.blob(0).end());
    }
    if (!data.empty()) return decode_picture(data);
    if (auto picture = read_source_picture(about); picture) return picture;
    return thumbnail(about.id);
}

Expected<TextureInfo> TextureLibrary::info(const std::string& given) {
    const std::scoped_lock lock(state_->mutex);
    WEFT_TRY(id, full_id(*state_->database, given));
    WEFT_TRY(q, state_->database->query(
                    "SELECT s.id, s.name, s.material, s.category, s.tags, s.origin, s.package, "
                    "s.source, s.author, s.licence, s.original_width, s.original_height, "
                    "s.picture, s.measured, s.synthesis, f.id, r.stars FROM sample s LEFT JOIN "
                    "favourite f ON f.id = s.id LEFT JOIN rating r ON r.id = s.id WHERE s.id = ?"));
    q.bind(id);
    WEFT_TRY(found, q.step());
    TextureInfo info;
    if (!found) return fail(ErrorCode::kUnreadable, "Texture " + id + " not found.");
    info.id = q.text(0);
    info.name = q.text(1);
    info.material = q.text(2);
    info.category = q.text(3);
    info.tags = split_words(q.text(4));
    info.origin = static_cast<TextureOrigin>(q.integer(5));
    info.package = q.text(6);
    info.source = q.text(7);
    info.author = q.text(8);
    info.licence = q.text(9);
    info.original_size = {static_cast<int>(q.integer(10)), static_cast<int>(q.integer(11))};
    info.original_in_file = !q.is_null(12);
    if (!read_measured(q.blob(13), info.measured))
        return fail(ErrorCode::kUnreadable, "The measurements of texture " + id + " are damaged.");
    info.synthesisability = static_cast<float>(q.real(14));
    info.favourite = !q.is_null(15);
    info.rating = static_cast<int>(q.integer(16));
    return info;
}

Expected<std::string> TextureLibrary::note(const std::string& key) {
    const std::scoped_lock lock(state_->mutex);
    return text_note(*state_->database, key);
}

Status TextureLibrary::set_note(const std::string& key, const std::string& value) {
    const std::scoped_lock lock(state_->mutex);
    return set_text_note(*state_->database, key, value);
}

namespace {

Expected<std::vector<FacetCount>> counts_by(Database& database, const std::string& column) {
    std::vector<FacetCount> out;
    WEFT_TRY(query, database.query("SELECT " + column + ", count(*) FROM sample GROUP BY " +
                                   column + " ORDER BY count(*) DESC, " + column));
    for (;;) {
        WEFT_TRY(more, query.step());
        if (!more) return out;
        std::string value = query.text(0);
        if (column == "origin") value = name_of(static_cast<TextureOrigin>(query.integer(0)));
        out.push_back({std::move(value), static_cast<int>(query.integer(1))});
    }
}

}  // namespace

Expected<LibraryStats> TextureLibrary::stats() {
    const std::scoped_lock lock(state_->mutex);
    Database& database = *state_->database;
    LibraryStats stats;
    WEFT_TRY(samples, database.number("SELECT count(*) FROM sample"));
    WEFT_TRY(materials, counts_by(database, "material"));
    WEFT_TRY(origins, counts_by(database, "origin"));
    WEFT_TRY(packages, counts_by(database, "package"));
    WEFT_TRY(licences, counts_by(database, "licence"));
    WEFT_TRY(version, database.number("PRAGMA user_version"));
    WEFT_TRY(trained,
             database.number("SELECT trained_on FROM model WHERE name = 'descriptor'", -1));
    stats.samples = samples;
    stats.materials = std::move(materials);
    stats.origins = std::move(origins);
    stats.packages = std::move(packages);
    stats.licences = std::move(licences);
    stats.schema_version = static_cast<int>(version);
    stats.descriptor_trained = trained >= 0;
    stats.descriptor_samples = std::max<std::int64_t>(trained, 0);
    std::error_code ignored;
    const auto bytes = std::filesystem::file_size(state_->path, ignored);
    stats.file_bytes = ignored ? 0 : static_cast<std::int64_t>(bytes);
    return stats;
}

// ---- searching and recommending ----------------------------------------------------------------

Expected<SearchResult> TextureLibrary::search(const SearchQuery& query) {
    const std::scoped_lock lock(state_->mutex);
    WEFT_CHECK_OK(state_->refresh());
    return search_index(
        *state_->database, *state_->index, *state_->words,
        [this] { return state_->open_embeddings(); }, query);
}

Expected<std::vector<SearchHit>> TextureLibrary::similar(const std::string& given, int count) {
    const std::scoped_lock lock(state_->mutex);
    WEFT_CHECK_OK(state_->refresh());
    WEFT_TRY(id, full_id(*state_->database, given));
    return similar_to_sample(*state_->index, state_->index->by_id.at(id), count);
}

Expected<std::vector<SearchHit>> TextureLibrary::similar(ViewU8x3 picture, int count) {
    if (picture.width() < 32 || picture.height() < 32) {
        return fail(ErrorCode::kUsage, "The picture is smaller than 32x32 pixels.",
                    "Give a larger one.");
    }
    const std::vector<float> features = texture_features(middle_sample(picture));
    const std::scoped_lock lock(state_->mutex);
    WEFT_CHECK_OK(state_->refresh());
    if (!state_->model) return std::vector<SearchHit>();
    return similar_to_picture(*state_->index, *state_->model, features, count);
}

Expected<Recommendation> TextureLibrary::recommend(const RecommendRequest& given) {
    const std::scoped_lock lock(state_->mutex);
    WEFT_CHECK_OK(state_->refresh());
    if (state_->index->samples.empty()) {
        return fail(ErrorCode::kUsage, "The texture library " + state_->path + " is empty.",
                    "Build it or import images" +
                        by({{setting::kBuildLibrary}, {setting::kImportTextures}}) + ".");
    }
    RecommendRequest request = given;
    request.count = std::clamp(request.count, 1, 100);
    if (!request.adjust.like.empty()) {
        WEFT_TRY(id, full_id(*state_->database, request.adjust.like));
        request.adjust.like = id;
    }
    for (RegionRequest& region : request.regions) {
        if (region.keep.empty()) continue;
        WEFT_TRY(id, full_id(*state_->database, region.keep));
        region.keep = id;
    }
    WEFT_TRY(embeddings, state_->open_embeddings());
    return recommend_from(*state_->index, state_->model ? &*state_->model : nullptr, embeddings,
                          request);
}

// ---- writing -----------------------------------------------------------------------------------

Expected<int> TextureLibrary::add(const std::vector<NewTexture>& textures) {
    WEFT_TRY(prepared, prepare_textures(textures));
    const std::scoped_lock lock(state_->mutex);
    return store_textures(*state_->database, textures, prepared);
}

Status TextureLibrary::remove(const std::string& given) {
    const std::scoped_lock lock(state_->mutex);
    WEFT_TRY(id, full_id(*state_->database, given));
    return remove_texture(*state_->database, id);
}

Status TextureLibrary::train_descriptor(const CancelToken& cancel, const ProgressFn& progress) {
    const std::scoped_lock lock(state_->mutex);
    return weft::train_descriptor(*state_->database, cancel, progress);
}

Expected<int> TextureLibrary::remove_outliers(
    const std::function<bool(const std::string& package)>& was_inspected, const CancelToken& cancel,
    const ProgressFn& progress) {
    WEFT_CHECK_OK(train_descriptor(cancel, progress));
    int removed = 0;
    {
        const std::scoped_lock lock(state_->mutex);
        WEFT_CHECK_OK(state_->refresh());
        if (progress) progress(ProgressEvent::titled("vote", 0, 1));
        WEFT_TRY(out, weft::remove_outliers(*state_->database, *state_->index, was_inspected));
        removed = out;
        if (progress) progress(ProgressEvent::titled("vote", 1, 1));
    }
    WEFT_CHECK_OK(train_descriptor(cancel, progress));
    return removed;
}

Expected<std::string> TextureLibrary::image_text_model() {
    return note(kModelFolderNote);
}

Status TextureLibrary::use_image_text_model(const std::string& folder, const CancelToken& cancel,
                                            const ProgressFn& progress) {
    std::optional<ImageTextModel> model;
    if (!folder.empty()) {
        WEFT_TRY(opened, ImageTextModel::open(folder));
        model = std::move(opened);
    }
    const std::scoped_lock lock(state_->mutex);
    WEFT_CHECK_OK(
        encode_samples(*state_->database, folder, model ? &*model : nullptr, cancel, progress));
    state_->embeddings_tried = false;
    state_->embedding_model.reset();
    return {};
}

Expected<bool> TextureLibrary::copy_from(const std::string& path, const std::string& key,
                                         const std::string& value) {
    const std::scoped_lock lock(state_->mutex);
    return copy_library(*state_->database, path, key, value);
}

}  // namespace weft
