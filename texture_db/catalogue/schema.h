#pragma once
// Internal: the tables of a library, and the upgrade of older files.

#include "texture_db/catalogue/database.h"

namespace weft {

inline constexpr int kLibrarySchema = 4;
/// "weft" in ASCII: SQLite's application_id distinguishes a texture library from other databases.
inline constexpr int kLibraryApplicationId = 0x77656674;

/// Upgrades a new or older file to kLibrarySchema, each step in a transaction of its own. Errors:
/// Unreadable for a foreign database, or one that a newer version wrote.
[[nodiscard]] Status bring_up_to_date(Database& database, bool read_only);

}  // namespace weft
