#pragma once
// Internal: rows of the library's file that several parts of the catalogue use. The caller holds
// the library's lock.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "texture_db/catalogue/database.h"
#include "texture_db/describe/descriptor_model.h"

namespace weft {

/// A sample's pixels as stored.
struct StoredPixels {
    std::int64_t key = 0;
    std::vector<std::byte> png;
};
/// The next `count` samples after key `after`, by key; `from_where`: "FROM pixels p … WHERE …".
[[nodiscard]] Expected<std::vector<StoredPixels>> pixels_behind(Database& database,
                                                                const std::string& from_where,
                                                                std::int64_t after,
                                                                std::size_t count);
/// The full id for an id or a prefix of it. Errors: Usage for text that is not an id or matches
/// several; Unreadable if there is none.
[[nodiscard]] Expected<std::string> full_id(Database& database, const std::string& given);
/// Notifies every reader of the file that the samples have changed.
[[nodiscard]] Status count_change(Database& database);
/// A note's text; empty if there is none.
[[nodiscard]] Expected<std::string> text_note(Database& database, const std::string& key);
[[nodiscard]] Status set_text_note(Database& database, const std::string& key,
                                   const std::string& value);
/// The trained descriptor, if there is one.
[[nodiscard]] Expected<std::optional<DescriptorModel>> stored_model(Database& database);
[[nodiscard]] Status store_descriptor(Database& database, std::int64_t key,
                                      std::span<const float> descriptor);

}  // namespace weft
