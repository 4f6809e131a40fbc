#include "texture_db/search/sample_embeddings.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "texture_db/catalogue/rows.h"
#include "texture_db/describe/sample_codec.h"

namespace weft {
namespace {

constexpr std::size_t kBatch = 64;

// Encodes the next samples that have no vector yet; returns how many. `after` becomes the last of
// them.
Expected<std::int64_t> encode_batch(Database& database, ImageTextModel& model,
                                    const std::string& unseen, std::int64_t& after) {
    WEFT_TRY(batch, pixels_behind(database, unseen, after, kBatch));
    // The network is slow, so other processes may write meanwhile.
    std::vector<std::pair<std::int64_t, std::vector<std::int8_t>>> vectors;
    for (const auto& [key, png] : batch) {
        after = key;
        const auto pixels = decode_picture(png);
        if (!pixels) continue;  // damaged: verify reports it
        WEFT_TRY(seen, model.encode_image(*pixels));
        vectors.emplace_back(key, embedding_bytes(seen));
    }
    WEFT_TRY(transaction, Transaction::begin(database));
    {
        WEFT_TRY(store, database.query("INSERT OR REPLACE INTO sight VALUES(?, ?)"));
        for (const auto& [key, bytes] : vectors) {
            store.bind(key).bind(std::as_bytes(std::span(bytes)));
            WEFT_CHECK_OK(store.run());
        }
    }
    WEFT_CHECK_OK(transaction.commit());
    return static_cast<std::int64_t>(batch.size());
}

}  // namespace

std::vector<std::int8_t> embedding_bytes(std::span<const float> unit) {
    std::vector<std::int8_t> out;
    for (const float x : unit)
        out.push_back(static_cast<std::int8_t>(std::lround(127 * std::clamp(x, -1.0f, 1.0f))));
    return out;
}

Expected<SampleEmbeddings> load_embeddings(Database& database, const SampleIndex& index,
                                           int dimensions) {
    SampleEmbeddings out;
    out.dimensions = dimensions;
    const auto width = static_cast<std::size_t>(dimensions);
    out.vectors.resize(index.samples.size() * width);
    WEFT_TRY(rows, database.query("SELECT sample, data FROM sight"));
    for (;;) {
        WEFT_TRY(more, rows.step());
        if (!more) return out;
        const auto at = index.find_key(rows.integer(0));
        const auto blob = rows.blob(1);
        if (at < 0 || blob.size() != width) continue;
        std::memcpy(out.vectors.data() + static_cast<std::size_t>(at) * width, blob.data(), width);
    }
}

std::vector<float> similarity_to_words(const SampleEmbeddings& embeddings,
                                       std::span<const float> words) {
    const auto width = static_cast<std::size_t>(embeddings.dimensions);
    if (words.size() != width || width == 0) return {};
    const std::size_t count = embeddings.vectors.size() / width;
    std::vector<float> out(count);
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::int8_t* v = embeddings.vectors.data() + i * width;
        float dot = 0;
        for (std::size_t k = 0; k < width; ++k)
            dot += static_cast<float>(v[k]) * words[k];
        out[i] = dot / 127;
        sum += out[i];
        squares += static_cast<double>(out[i]) * out[i];
    }
    const auto n = static_cast<double>(std::max<std::size_t>(count, 1));
    const double mean = sum / n;
    const double deviation = std::sqrt(std::max(squares / n - mean * mean, 1e-12));
    for (float& value : out)
        value = static_cast<float>((value - mean) / deviation);
    return out;
}

Status encode_samples(Database& database, const std::string& folder, ImageTextModel* model,
                      const CancelToken& cancel, const ProgressFn& progress) {
    const std::string identity = model ? model->identity() : "";
    WEFT_TRY(before, text_note(database, kModelIdentityNote));
    if (identity != before) {
        WEFT_TRY(transaction, Transaction::begin(database));
        WEFT_CHECK_OK(database.execute("DELETE FROM sight"));
        WEFT_CHECK_OK(set_text_note(database, kModelIdentityNote, identity));
        WEFT_CHECK_OK(transaction.commit());
    }
    WEFT_CHECK_OK(set_text_note(database, kModelFolderNote, folder));
    const std::string unseen =
        "FROM pixels p LEFT JOIN sight s ON s.sample = p.sample WHERE "
        "s.sample IS NULL";
    std::int64_t done = 0, total = 0, after = -1;
    if (model) {
        WEFT_TRY(count, database.number("SELECT count(*) " + unseen));
        total = count;
    }
    while (done < total) {
        if (cancel.cancelled())
            return fail(static_cast<ErrorCode>(cancel.reason()),
                        "Encoding the library was stopped.", "Run the command again to continue.");
        WEFT_TRY(seen, encode_batch(database, *model, unseen, after));
        if (seen == 0) break;
        done += seen;
        if (progress) progress(ProgressEvent::titled("look", done, total));
    }
    return count_change(database);
}

}  // namespace weft
