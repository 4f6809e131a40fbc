#include "texture_db/catalogue/outliers.h"

// Labels of packages that were not inspected are checked against the samples' nearest neighbours.

#include <algorithm>
#include <map>

#include "engine/core/parallel.h"
#include "texture_db/catalogue/index.h"
#include "texture_db/catalogue/rows.h"

namespace weft {
namespace {

constexpr int kVoters = 25;
constexpr int kAsked = 80;               // nearest samples searched for voters from other images
constexpr float kNeeded = 0.20f;         // share of the voters that must agree
constexpr float kNeededGuessed = 0.40f;  // if only the folder named the material

// Easily confused materials count as one.
std::string group_of(const std::string& material) {
    static const std::map<std::string, std::string> kGroups{
        {"cobblestone", "stone"}, {"rust", "metal"},      {"dirt", "sand"},
        {"gravel", "stone"},      {"ice", "snow"},        {"asphalt", "concrete"},
        {"foliage", "grass"},     {"wallpaper", "paper"}, {"plaster", "concrete"},
        {"marble", "stone"}};
    const auto at = kGroups.find(material);
    return at == kGroups.end() ? material : at->second;
}

std::vector<std::size_t> outliers(const SampleIndex& index, const std::vector<bool>& guessed,
                                  const PackageCheck& was_inspected) {
    std::vector<std::string> groups;
    for (int m = 0; m < index.materials.size(); ++m)
        groups.push_back(group_of(index.materials.text(m)));
    std::vector<bool> looked_at;
    for (int p = 0; p < index.packages.size(); ++p)
        looked_at.push_back(was_inspected(index.packages.text(p)));
    std::vector<char> out(index.samples.size(), 0);
    parallel_for(index.samples.size(), [&](std::size_t i) {
        const IndexedSample& s = index.samples[i];
        if (s.origin != TextureOrigin::kPackage || looked_at[static_cast<std::size_t>(s.package)])
            return;
        float same = 0;
        int voters = 0;
        std::map<std::string, int> from_one;  // an image votes at most three times
        for (const Neighbour& n : nearest(index, index.descriptor(i), kAsked)) {
            const IndexedSample& other = index.samples[n.sample];
            if (other.source == s.source && other.package == s.package) continue;
            if (other.origin == TextureOrigin::kPackage && ++from_one[other.source] > 3) continue;
            if (groups[static_cast<std::size_t>(other.material)] ==
                groups[static_cast<std::size_t>(s.material)])
                same += other.material == s.material ? 1.0f : 0.7f;
            if (++voters == kVoters) break;
        }
        if (voters < 8) return;
        const float needed = guessed[i] ? kNeededGuessed : kNeeded;
        out[i] = same / static_cast<float>(voters) < needed ? 1 : 0;
    });
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (out[i]) found.push_back(i);
    }
    return found;
}

}  // namespace

Expected<int> remove_outliers(Database& database, const SampleIndex& index,
                              const PackageCheck& was_inspected) {
    std::vector<bool> guessed(index.samples.size());
    WEFT_TRY(rows, database.query(
                       "SELECT rowid FROM sample_text WHERE sample_text MATCH 'tags:guessed'"));
    for (;;) {
        WEFT_TRY(more, rows.step());
        if (!more) break;
        if (const auto at = index.find_key(rows.integer(0)); at >= 0)
            guessed[static_cast<std::size_t>(at)] = true;
    }
    const std::vector<std::size_t> out = outliers(index, guessed, was_inspected);
    WEFT_TRY(transaction, Transaction::begin(database));
    {
        WEFT_TRY(text, database.query("DELETE FROM sample_text WHERE rowid = ?"));
        WEFT_TRY(sample, database.query("DELETE FROM sample WHERE key = ?"));
        for (const std::size_t i : out) {
            WEFT_CHECK_OK(text.bind(index.samples[i].key).run());
            WEFT_CHECK_OK(sample.bind(index.samples[i].key).run());
        }
        WEFT_CHECK_OK(
            database.execute("DELETE FROM picture WHERE key NOT IN (SELECT picture FROM "
                             "sample WHERE picture IS NOT NULL)"));
    }
    WEFT_CHECK_OK(count_change(database));
    WEFT_CHECK_OK(transaction.commit());
    return static_cast<int>(out.size());
}

}  // namespace weft
