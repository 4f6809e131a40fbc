// Finds parameters by name, and says what was probably meant.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/project/parameters.h"

namespace weft {
namespace {

/// Levenshtein distance (1966); the names are short.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        row[j] = j;
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({row[j] + 1, diagonal + 1, changed});
        }
    }
    return row.back();
}

}  // namespace

template <class Owner>
Expected<const Parameter<Owner>*> find_parameter(std::span<const Parameter<Owner>> table,
                                                 std::string_view key_or_flag) {
    std::string nearest;
    std::size_t best = std::string_view::npos;
    for (const Parameter<Owner>& parameter : table) {
        const std::string key = parameter.full_key();
        if (key == key_or_flag || (!parameter.flag.empty() && parameter.flag == key_or_flag))
            return &parameter;
        for (const std::string_view name : {std::string_view(key), parameter.key, parameter.flag}) {
            // The length is limited, so that a hostile name costs little.
            const std::size_t distance = edit_distance(name, key_or_flag.substr(0, 64));
            if (distance < best) best = distance, nearest = key;
        }
    }
    return fail(ErrorCode::kUsage, fmt::format("Unknown parameter '{}'", key_or_flag.substr(0, 64)),
                fmt::format("check its name, the nearest is '{}'", nearest));
}
template Expected<const Parameter<Region>*> find_parameter(std::span<const Parameter<Region>>,
                                                           std::string_view);
template Expected<const Parameter<MatteSource>*> find_parameter(
    std::span<const Parameter<MatteSource>>, std::string_view);
template Expected<const Parameter<Project>*> find_parameter(std::span<const Parameter<Project>>,
                                                            std::string_view);

}  // namespace weft
