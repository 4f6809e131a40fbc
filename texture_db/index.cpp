#include "texture_db/index.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace weft {

int StringTable::number_of(std::string_view text) {
    const auto [at, fresh] = numbers_.try_emplace(std::string(text), size());
    if (fresh) texts_.emplace_back(text);
    return at->second;
}

int StringTable::find(std::string_view text) const {
    const auto at = numbers_.find(std::string(text));
    return at == numbers_.end() ? -1 : at->second;
}

std::ptrdiff_t SampleIndex::find_key(std::int64_t key) const {
    const auto at = std::lower_bound(
        samples.begin(), samples.end(), key,
        [](const IndexedSample& sample, std::int64_t k) { return sample.key < k; });
    return at != samples.end() && at->key == key ? at - samples.begin() : -1;
}

Expected<SampleIndex> load_index(Database& database) {
    SampleIndex index;
    WEFT_TRY(count, database.number("SELECT count(*) FROM sample"));
    index.samples.reserve(static_cast<std::size_t>(count));
    // One row after the other by key: the tables are clustered by it, so this is three scans side
    // by side.
    WEFT_TRY(rows, database.query("SELECT s.key, s.id, s.name, s.source, s.material, s.package, "
                                  "s.licence, s.category, s.origin, s.synthesis, s.added, "
                                  "s.measured, d.data FROM sample s LEFT JOIN descriptor d ON "
                                  "d.sample = s.key ORDER BY s.key"));
    for (;;) {
        WEFT_TRY(more, rows.step());
        if (!more) break;
        IndexedSample s;
        s.key = rows.integer(0);
        s.id = rows.text(1);
        s.name = rows.text(2);
        s.source = rows.text(3);
        s.material = index.materials.number_of(rows.text(4));
        s.package = index.packages.number_of(rows.text(5));
        s.licence = index.licences.number_of(rows.text(6));
        s.category = index.categories.number_of(rows.text(7));
        s.origin = static_cast<TextureOrigin>(std::clamp<std::int64_t>(rows.integer(8), 0, 2));
        s.synthesis = static_cast<float>(rows.real(9));
        s.added = rows.integer(10);
        if (!read_measured(rows.blob(11), s.measured)) {
            return fail(ErrorCode::kUnreadable, "The texture library " + database.path() +
                                                    " is damaged at sample " + s.id +
                                                    ". Run 'weft texture verify'.");
        }
        s.colour = index.colours.number_of(colour_name(s.measured.mean));
        const auto descriptor = rows.blob(12);
        const auto length = static_cast<int>(descriptor.size() / sizeof(float));
        if (index.descriptor_size == 0 && length > 0) {
            index.descriptor_size = length;
            index.descriptors.reserve(static_cast<std::size_t>(count * length));
            index.descriptors.resize(index.samples.size() * static_cast<std::size_t>(length));
        }
        const std::size_t old = index.descriptors.size();
        index.descriptors.resize(old + static_cast<std::size_t>(index.descriptor_size));
        if (length == index.descriptor_size && length > 0) {
            std::memcpy(index.descriptors.data() + old, descriptor.data(),
                        static_cast<std::size_t>(length) * sizeof(float));
        }
        index.by_id.emplace(s.id, index.samples.size());
        index.samples.push_back(std::move(s));
    }
    WEFT_TRY(favourites, database.query("SELECT id FROM favourite"));
    for (;;) {
        WEFT_TRY(more, favourites.step());
        if (!more) break;
        if (const auto at = index.by_id.find(favourites.text(0)); at != index.by_id.end())
            index.samples[at->second].favourite = true;
    }
    WEFT_TRY(ratings, database.query("SELECT id, stars FROM rating"));
    for (;;) {
        WEFT_TRY(more, ratings.step());
        if (!more) break;
        if (const auto at = index.by_id.find(ratings.text(0)); at != index.by_id.end())
            index.samples[at->second].rating = static_cast<std::uint8_t>(ratings.integer(1));
    }
    return index;
}

std::vector<Neighbour> nearest(const SampleIndex& index, std::span<const float> descriptor,
                               int count) {
    const auto size = static_cast<std::size_t>(index.descriptor_size);
    if (size == 0 || descriptor.size() != size || count <= 0) return {};
    std::vector<Neighbour> all;
    all.reserve(index.samples.size());
    for (std::size_t i = 0; i < index.samples.size(); ++i) {
        const float* d = index.descriptors.data() + i * size;
        // Four sums side by side let the compiler use vector instructions without reordering.
        std::array<float, 4> sum{};
        float magnitude = 0;
        std::size_t k = 0;
        for (; k + 4 <= size; k += 4) {
            for (std::size_t j = 0; j < 4; ++j) {
                const float difference = d[k + j] - descriptor[k + j];
                sum[j] += difference * difference;
            }
            magnitude += std::abs(d[k]);
        }
        for (; k < size; ++k) {
            const float difference = d[k] - descriptor[k];
            sum[0] += difference * difference;
        }
        if (magnitude == 0) continue;
        all.push_back({i, (sum[0] + sum[1]) + (sum[2] + sum[3])});
    }
    const auto wanted = std::min(all.size(), static_cast<std::size_t>(count));
    const auto nearer = [](const Neighbour& a, const Neighbour& b) {
        return a.distance != b.distance ? a.distance < b.distance : a.sample < b.sample;
    };
    std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(wanted), all.end(),
                      nearer);
    all.resize(wanted);
    for (Neighbour& n : all)
        n.distance = std::sqrt(n.distance);
    return all;
}

std::vector<std::byte> bytes_of(const MeasuredTexture& measured) {
    std::array<float, kTextureAttributes + 6> values{};
    std::copy(measured.attributes.values.begin(), measured.attributes.values.end(), values.begin());
    const std::array<float, 6> colours{measured.mean.l,   measured.mean.a,   measured.mean.b,
                                       measured.accent.l, measured.accent.a, measured.accent.b};
    std::copy(colours.begin(), colours.end(), values.begin() + kTextureAttributes);
    std::vector<std::byte> out(sizeof values);
    std::memcpy(out.data(), values.data(), sizeof values);
    return out;
}

bool read_measured(std::span<const std::byte> bytes, MeasuredTexture& measured) {
    const std::vector<float> v = floats_of(bytes);
    if (v.size() != kTextureAttributes + 6) return false;
    std::copy_n(v.begin(), kTextureAttributes, measured.attributes.values.begin());
    const float* c = v.data() + kTextureAttributes;
    measured.mean = {c[0], c[1], c[2]};
    measured.accent = {c[3], c[4], c[5]};
    return true;
}

std::vector<float> floats_of(std::span<const std::byte> bytes) {
    std::vector<float> out(bytes.size() / sizeof(float));
    std::memcpy(out.data(), bytes.data(), out.size() * sizeof(float));
    return out;
}

std::span<const std::byte> bytes_of(std::span<const float> values) {
    return std::as_bytes(values);
}

}  // namespace weft
