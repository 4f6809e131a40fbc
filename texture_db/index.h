#pragma once
// Internal: the catalogue in memory, as columns that a search walks through. No pixels.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "texture_db/database.h"
#include "texture_db/query.h"

namespace weft {

/// Strings by number, each once.
class StringTable {
  public:
    int number_of(std::string_view text);
    [[nodiscard]] int find(std::string_view text) const;  ///< -1: not there.
    [[nodiscard]] const std::string& text(int number) const {
        return texts_[static_cast<std::size_t>(number)];
    }
    [[nodiscard]] int size() const { return static_cast<int>(texts_.size()); }

  private:
    std::vector<std::string> texts_;
    std::unordered_map<std::string, int> numbers_;
};

struct IndexedSample {
    std::int64_t key = 0;  ///< Row in the file.
    std::string id, name, source;
    int material = 0, package = 0, licence = 0, category = 0;
    TextureOrigin origin = TextureOrigin::kProcedural;
    bool favourite = false;
    std::uint8_t rating = 0;
    float synthesis = 0;
    std::int64_t added = 0;
    MeasuredTexture measured;
    int colour = 0;  ///< Word of the mean colour, in `colours`.
};

struct SampleIndex {
    std::vector<IndexedSample> samples;  ///< In the order of `key`.
    StringTable materials, packages, licences, categories, colours;
    std::unordered_map<std::string, std::size_t> by_id;
    int descriptor_size = 0;
    std::vector<float> descriptors;  ///< samples × descriptor_size; all 0 where there is none yet.

    [[nodiscard]] std::span<const float> descriptor(std::size_t i) const {
        const auto n = static_cast<std::size_t>(descriptor_size);
        return {descriptors.data() + i * n, n};
    }
    /// Position of a row's key, or -1.
    [[nodiscard]] std::ptrdiff_t find_key(std::int64_t key) const;
};

/// Reads the whole catalogue.
[[nodiscard]] Expected<SampleIndex> load_index(Database& database);

struct Neighbour {
    std::size_t sample = 0;
    float distance = 0;
};
/// The `count` nearest by Euclidean distance, nearest first, ties to the lower position. Samples
/// without a descriptor are left out.
[[nodiscard]] std::vector<Neighbour> nearest(const SampleIndex& index,
                                             std::span<const float> descriptor, int count);

[[nodiscard]] std::vector<std::byte> bytes_of(const MeasuredTexture& measured);
[[nodiscard]] bool read_measured(std::span<const std::byte> bytes, MeasuredTexture& measured);
[[nodiscard]] std::vector<float> floats_of(std::span<const std::byte> bytes);
[[nodiscard]] std::span<const std::byte> bytes_of(std::span<const float> values);

}  // namespace weft
