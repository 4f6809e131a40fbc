#include "texture_db/describe/features.h"
#include "texture_db/describe/sample_codec.h"
#include "texture_db/library/library_state.h"

namespace weft {
namespace {

Status check_file(Database& database, std::vector<LibraryFault>& faults) {
    WEFT_TRY(check, database.query("PRAGMA quick_check(20)"));
    for (;;) {
        WEFT_TRY(more, check.step());
        if (!more) break;
        if (check.text(0) != "ok") faults.push_back({"", check.text(0)});
    }
    const auto missing = [&](const char* table, const std::string& what) -> Status {
        WEFT_TRY(rows,
                 database.query(std::string("SELECT id FROM sample WHERE key NOT IN (SELECT ") +
                                table + ")"));
        for (;;) {
            WEFT_TRY(more, rows.step());
            if (!more) return {};
            faults.push_back({rows.text(0), what});
        }
    };
    WEFT_CHECK_OK(missing("sample FROM pixels", "It has no pixels."));
    WEFT_CHECK_OK(missing("sample FROM features", "It has no features."));
    return missing("rowid FROM sample_text", "Its words are missing from the text index.");
}

}  // namespace

Expected<std::vector<LibraryFault>> TextureLibrary::verify(const CancelToken& cancel,
                                                           const ProgressFn& progress) {
    std::vector<LibraryFault> faults;
    std::vector<std::pair<std::int64_t, std::string>> rows;
    {
        const std::scoped_lock lock(state_->mutex);
        WEFT_CHECK_OK(check_file(*state_->database, faults));
        WEFT_TRY(all, state_->database->query("SELECT key, id FROM sample ORDER BY key"));
        for (;;) {
            WEFT_TRY(more, all.step());
            if (!more) break;
            rows.emplace_back(all.integer(0), all.text(1));
        }
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (cancel.cancelled())
            return fail(static_cast<ErrorCode>(cancel.reason()), "The check was stopped.");
        std::vector<std::byte> png;
        {
            const std::scoped_lock lock(state_->mutex);
            WEFT_TRY(query, state_->database->query("SELECT png FROM pixels WHERE sample = ?"));
            query.bind(rows[i].first);
            WEFT_TRY(found, query.step());
            if (found) png.assign(query.blob(0).begin(), query.blob(0).end());
        }
        if (!png.empty()) {
            const auto image = decode_picture(png);
            if (!image) {
                faults.push_back({rows[i].second, "Its pixels are damaged."});
            } else if (texture_id(*image) != rows[i].second) {
                faults.push_back({rows[i].second, "Its pixels have changed since it was stored."});
            }
        }
        if (progress && (i % 256 == 255 || i + 1 == rows.size())) {
            progress(ProgressEvent::titled("verify", static_cast<std::int64_t>(i + 1),
                                           static_cast<std::int64_t>(rows.size())));
        }
    }
    return faults;
}

}  // namespace weft
