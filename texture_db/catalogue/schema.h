#pragma once
// Internal: the tables of a library and how older files become current ones.

#include "texture_db/catalogue/database.h"

namespace weft {

inline constexpr int kLibrarySchema = 4;
/// "weft" in ASCII: SQLite's application_id tells a texture library from any other database.
inline constexpr int kLibraryApplicationId = 0x77656674;

/// Brings a new, older or current file to kLibrarySchema, each step in a transaction of its own.
/// Errors: Unreadable for a foreign database, or one that a newer version wrote.
[[nodiscard]] Status bring_up_to_date(Database& database, bool read_only);

}  // namespace weft
