#pragma once
// Internal: the catalogue in memory, as columns for searching. No pixels.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "texture_db/catalogue/database.h"
#include "texture_db/catalogue/query.h"

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

/// What the recommender needs of every sample, contiguous in memory.
struct SampleLook {
    LabColor mean;
    float chroma = 0, hue_deg = 0;  ///< Of `mean`.
    float structure_px = 2;         ///< Size of the largest common structure.
    float contrast = 0, saturation = 0, roughness = 0, synthesis = 0;
    int material = 0, licence = 0;
};

struct SampleIndex {
    std::vector<IndexedSample> samples;  ///< In the order of `key`.
    StringTable materials, packages, licences, categories, colours;
    std::unordered_map<std::string, std::size_t> by_id;
    std::vector<SampleLook> looks;  ///< One a sample.
    int descriptor_size = 0;

    /// Appends a sample. A descriptor of another size than the others' is ignored. Computes
    /// `colour` and the look.
    void add(IndexedSample sample, std::span<const float> descriptor);
    /// Empty for a sample that has none.
    [[nodiscard]] std::span<const float> descriptor(std::size_t i) const {
        if (!described_[i]) return {};
        return {descriptors_.data() + i * stride_, static_cast<std::size_t>(descriptor_size)};
    }
    /// The squared Euclidean distance of every sample, kFar for one without a descriptor; empty if
    /// `descriptor` has another size.
    [[nodiscard]] std::vector<float> squared_distances(std::span<const float> descriptor) const;
    /// Position of a row's key, or -1.
    [[nodiscard]] std::ptrdiff_t find_key(std::int64_t key) const;

    static constexpr float kFar = 1e30f;

  private:
    std::size_t stride_ = 0;          // descriptor_size rounded up, the rest 0
    std::vector<float> descriptors_;  // samples × stride_
    std::vector<bool> described_;
};

/// Reads the whole catalogue.
[[nodiscard]] Expected<SampleIndex> load_index(Database& database);

struct Neighbour {
    std::size_t sample = 0;
    float distance = 0;
};
/// The `count` lowest of squared distances that are not kFar, as distances, nearest first, ties to
/// the lower position.
[[nodiscard]] std::vector<Neighbour> lowest(std::span<const float> squared, int count);
/// The `count` nearest by Euclidean distance, nearest first, ties to the lower position. Ignores
/// samples without a descriptor.
[[nodiscard]] std::vector<Neighbour> nearest(const SampleIndex& index,
                                             std::span<const float> descriptor, int count);

[[nodiscard]] std::vector<std::byte> bytes_of(const MeasuredTexture& measured);
[[nodiscard]] bool read_measured(std::span<const std::byte> bytes, MeasuredTexture& measured);
[[nodiscard]] std::vector<float> floats_of(std::span<const std::byte> bytes);
[[nodiscard]] std::span<const std::byte> bytes_of(std::span<const float> values);

}  // namespace weft
