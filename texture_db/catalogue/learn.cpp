#include "texture_db/catalogue/learn.h"

#include "engine/core/parallel.h"
#include "texture_db/catalogue/index.h"
#include "texture_db/catalogue/rows.h"
#include "texture_db/describe/features.h"
#include "texture_db/describe/sample_codec.h"

namespace weft {
namespace {

constexpr std::size_t kBatch = 256;

// Recomputes features that an earlier version stored, from the pixels; a batch at a time, so that
// finished work stays.
Status renew_features(Database& database, const CancelToken& cancel, const ProgressFn& progress) {
    const std::string old =
        "FROM pixels p LEFT JOIN features f ON f.sample = p.sample AND "
        "f.version = " +
        std::to_string(kFeatureVersion) + " WHERE f.sample IS NULL";
    WEFT_TRY(total, database.number("SELECT count(*) " + old));
    std::int64_t done = 0, after = -1;
    while (done < total) {
        if (cancel.cancelled())
            return fail(static_cast<ErrorCode>(cancel.reason()), "Training was stopped.");
        WEFT_TRY(batch, pixels_behind(database, old, after, kBatch));
        if (batch.empty()) break;
        std::vector<std::vector<float>> features(batch.size());  // empty: the pixels are damaged
        parallel_for(batch.size(), [&](std::size_t i) {
            if (const auto pixels = decode_picture(batch[i].png))
                features[i] = texture_features(middle_sample(*pixels));
        });
        WEFT_TRY(transaction, Transaction::begin(database));
        {
            WEFT_TRY(store, database.query("INSERT OR REPLACE INTO features VALUES(?, ?, ?)"));
            for (std::size_t i = 0; i < batch.size(); ++i) {
                if (features[i].empty()) continue;
                store.bind(batch[i].key).bind(kFeatureVersion).bind(bytes_of(features[i]));
                WEFT_CHECK_OK(store.run());
            }
        }
        WEFT_CHECK_OK(transaction.commit());
        after = batch.back().key;
        done += static_cast<std::int64_t>(batch.size());
        if (progress) progress({WorkStage::kMeasure, done, total, 0, 0});
    }
    return {};
}

}  // namespace

Status train_descriptor(Database& database, const CancelToken& cancel, const ProgressFn& progress) {
    LabelledFeatures data;
    std::vector<std::int64_t> keys;
    StringTable materials;
    WEFT_CHECK_OK(renew_features(database, cancel, progress));
    {
        WEFT_TRY(rows, database.query("SELECT s.key, s.material, s.origin, f.data FROM sample s "
                                      "JOIN features f ON f.sample = s.key WHERE f.version = ? "
                                      "ORDER BY s.key"));
        rows.bind(kFeatureVersion);
        for (;;) {
            WEFT_TRY(more, rows.step());
            if (!more) break;
            keys.push_back(rows.integer(0));
            data.labels.push_back(materials.number_of(rows.text(1)));
            data.features.push_back(floats_of(rows.blob(3)));
            data.weights.push_back(1.0f);
        }
    }
    for (int m = 0; m < materials.size(); ++m)
        data.materials.push_back(materials.text(m));
    if (progress) progress(ProgressEvent::titled("learn", 0, 2));
    WEFT_TRY(model, learn_descriptor(data));
    if (progress) progress(ProgressEvent::titled("learn", 1, 2));
    if (cancel.cancelled())
        return fail(static_cast<ErrorCode>(cancel.reason()), "Training was stopped.");
    std::vector<std::vector<float>> descriptors(keys.size());
    parallel_for(keys.size(),
                 [&](std::size_t i) { descriptors[i] = model.describe(data.features[i]); });
    const std::vector<std::byte> bytes = model.to_bytes();
    WEFT_TRY(transaction, Transaction::begin(database));
    {
        WEFT_TRY(store, database.query("INSERT OR REPLACE INTO model VALUES('descriptor', ?, ?)"));
        store.bind(static_cast<std::int64_t>(keys.size())).bind(std::span(bytes));
        WEFT_CHECK_OK(store.run());
        WEFT_CHECK_OK(database.execute("DELETE FROM descriptor"));
        for (std::size_t i = 0; i < keys.size(); ++i)
            WEFT_CHECK_OK(store_descriptor(database, keys[i], descriptors[i]));
    }
    WEFT_CHECK_OK(count_change(database));
    WEFT_CHECK_OK(transaction.commit());
    if (progress) progress(ProgressEvent::titled("learn", 2, 2));
    return {};
}

}  // namespace weft
