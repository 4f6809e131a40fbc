#include "texture_db/catalogue/index.h"

#include "engine/core/setting.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

namespace weft {
namespace {

constexpr std::size_t kLanes = 8;

SampleLook look_of(const IndexedSample& s) {
    const TextureAttributes& a = s.measured.attributes;
    SampleLook look;
    look.mean = s.measured.mean;
    look.chroma = std::hypot(look.mean.a, look.mean.b);
    look.hue_deg = std::atan2(look.mean.b, look.mean.a) * 180 / std::numbers::pi_v<float>;
    look.structure_px = 2 * std::pow(24.0f, a[TextureAttribute::kScale]);
    look.contrast = a[TextureAttribute::kContrast];
    look.saturation = a[TextureAttribute::kSaturation];
    look.roughness = a[TextureAttribute::kRoughness];
    look.synthesis = s.synthesis;
    look.material = s.material;
    look.licence = s.licence;
    return look;
}

}  // namespace

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

void SampleIndex::add(IndexedSample sample, std::span<const float> descriptor) {
    sample.colour = colours.number_of(colour_name(sample.measured.mean));
    if (descriptor_size == 0 && !descriptor.empty()) {
        descriptor_size = static_cast<int>(descriptor.size());
        stride_ = (descriptor.size() + kLanes - 1) / kLanes * kLanes;
        descriptors_.resize(samples.size() * stride_);
    }
    const bool fits =
        descriptor_size > 0 && descriptor.size() == static_cast<std::size_t>(descriptor_size) &&
        std::any_of(descriptor.begin(), descriptor.end(), [](float v) { return v != 0; });
    const std::size_t at = descriptors_.size();
    descriptors_.resize(at + stride_);
    if (fits)
        std::copy(descriptor.begin(), descriptor.end(),
                  descriptors_.begin() + static_cast<std::ptrdiff_t>(at));
    described_.push_back(fits);
    looks.push_back(look_of(sample));
    by_id.emplace(sample.id, samples.size());
    samples.push_back(std::move(sample));
}

Expected<SampleIndex> load_index(Database& database) {
    SampleIndex index;
    WEFT_TRY(count, database.number("SELECT count(*) FROM sample"));
    index.samples.reserve(static_cast<std::size_t>(count));
    // Rows in the order of their key: the tables are clustered by it, so this is three parallel
    // scans.
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
            return fail(
                ErrorCode::kUnreadable,
                "The texture library " + database.path() + " is damaged at sample " + s.id + ".",
                "Check the library" + by({{setting::kVerifyLibrary}}) + ".");
        }
        index.add(std::move(s), floats_of(rows.blob(12)));
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

std::vector<float> SampleIndex::squared_distances(std::span<const float> descriptor) const {
    if (descriptor_size == 0 || descriptor.size() != static_cast<std::size_t>(descriptor_size))
        return {};
    std::vector<float> asked(stride_), out(samples.size());
    std::copy(descriptor.begin(), descriptor.end(), asked.begin());
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (!described_[i]) {
            out[i] = kFar;
            continue;
        }
        const float *d = descriptors_.data() + i * stride_, *q = asked.data();
        // Separate sums let the compiler use vector instructions without reordering.
        std::array<float, kLanes> sum{};
        for (std::size_t k = 0; k < stride_; k += kLanes) {
            for (std::size_t j = 0; j < kLanes; ++j) {
                const float difference = d[k + j] - q[k + j];
                sum[j] += difference * difference;
            }
        }
        out[i] = ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
    }
    return out;
}

std::vector<Neighbour> lowest(std::span<const float> squared, int count) {
    std::vector<Neighbour> all;
    if (count <= 0) return all;
    const auto wanted = static_cast<std::size_t>(count);
    const auto nearer = [](const Neighbour& a, const Neighbour& b) {
        return a.distance != b.distance ? a.distance < b.distance : a.sample < b.sample;
    };
    // Keeps few of many: whenever twice as many as wanted have been collected, the farther half is
    // dropped.
    float limit = SampleIndex::kFar;
    for (std::size_t i = 0; i < squared.size(); ++i) {
        if (squared[i] >= limit) continue;
        all.push_back({i, squared[i]});
        if (all.size() < 2 * wanted + 64) continue;
        std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(wanted - 1),
                         all.end(), nearer);
        all.resize(wanted);
        limit = all.back().distance;
    }
    std::sort(all.begin(), all.end(), nearer);
    if (all.size() > wanted) all.resize(wanted);
    for (Neighbour& n : all)
        n.distance = std::sqrt(n.distance);
    return all;
}

std::vector<Neighbour> nearest(const SampleIndex& index, std::span<const float> descriptor,
                               int count) {
    return lowest(index.squared_distances(descriptor), count);
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
    if (!out.empty()) std::memcpy(out.data(), bytes.data(), out.size() * sizeof(float));
    return out;
}

std::span<const std::byte> bytes_of(std::span<const float> values) {
    return std::as_bytes(values);
}

}  // namespace weft
