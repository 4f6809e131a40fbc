// Samples of packages are believed to be what their names say only as far as they look like it.

#include <algorithm>
#include <map>

#include "engine/core/parallel.h"
#include "texture_db/library_state.h"

namespace weft {
namespace {

constexpr int kVoters = 25;
constexpr int kAsked = 80;  // nearest ones looked through for voters from other pictures
// Share of the voters that must agree, on the mean over a picture's samples. Of 20 pictures looked
// at in each step about 11 were wrong at 0.2 to 0.3, 10 up to 0.35, 7 up to 0.4, 4 up to 0.45. What
// is odd but right is needed to recognise materials by: at 0.38 retrieval fell from 0.81 to 0.77.
constexpr float kNeeded = 0.30f;
constexpr float kNeededGuessed = 0.42f;  // where only the folder named the material
constexpr float kNeededOfOne = 0.08f;    // of a sample by itself

// Materials that even people mix up count as one.
std::string group_of(const std::string& material) {
    static const std::map<std::string, std::string> kGroups{
        {"cobblestone", "stone"}, {"rust", "metal"},      {"dirt", "sand"},
        {"gravel", "stone"},      {"ice", "snow"},        {"asphalt", "concrete"},
        {"foliage", "grass"},     {"wallpaper", "paper"}, {"plaster", "concrete"},
        {"marble", "stone"}};
    const auto at = kGroups.find(material);
    return at == kGroups.end() ? material : at->second;
}

// The share of a sample's neighbours from other pictures that have its material; 1 where there are
// too few of them to say.
float agreement(const SampleIndex& index, const std::vector<std::string>& groups, std::size_t i) {
    const IndexedSample& s = index.samples[i];
    float same = 0;
    int voters = 0;
    std::map<std::string, int> from_one;  // no picture votes more than three times
    for (const Neighbour& n : nearest(index, index.descriptor(i), kAsked)) {
        const IndexedSample& other = index.samples[n.sample];
        if (other.source == s.source && other.package == s.package) continue;
        if (other.origin == TextureOrigin::kPackage && ++from_one[other.source] > 3) continue;
        if (groups[static_cast<std::size_t>(other.material)] ==
            groups[static_cast<std::size_t>(s.material)])
            same += other.material == s.material ? 1.0f : 0.7f;
        if (++voters == kVoters) break;
    }
    return voters < 8 ? 1.0f : same / static_cast<float>(voters);
}

std::vector<std::size_t> strangers(const SampleIndex& index, const std::vector<bool>& guessed) {
    std::vector<std::string> groups;
    for (int m = 0; m < index.materials.size(); ++m)
        groups.push_back(group_of(index.materials.text(m)));
    std::vector<float> agreed(index.samples.size(), 1.0f);
    parallel_for(index.samples.size(), [&](std::size_t i) {
        if (index.samples[i].origin == TextureOrigin::kPackage)
            agreed[i] = agreement(index, groups, i);
    });
    // A picture is of one material, and many samples of it say better of which than one does.
    struct Picture {
        float sum = 0;
        int samples = 0;
    };
    std::map<std::pair<std::string, std::string>, Picture> pictures;
    const auto picture_of = [&](std::size_t i) -> Picture& {
        return pictures[{index.packages.text(index.samples[i].package), index.samples[i].source}];
    };
    for (std::size_t i = 0; i < agreed.size(); ++i) {
        Picture& picture = picture_of(i);
        picture.sum += agreed[i];
        ++picture.samples;
    }
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < agreed.size(); ++i) {
        if (index.samples[i].origin != TextureOrigin::kPackage) continue;
        const Picture& picture = picture_of(i);
        const float mean = picture.sum / static_cast<float>(picture.samples);
        if (mean < (guessed[i] ? kNeededGuessed : kNeeded) || agreed[i] < kNeededOfOne)
            found.push_back(i);
    }
    return found;
}

}  // namespace

Expected<int> TextureLibrary::vote_out_strangers(const CancelToken& cancel,
                                                 const ProgressFn& progress) {
    WEFT_CHECK_OK(train_descriptor(cancel, progress));
    int removed = 0;
    {
        const std::scoped_lock lock(state_->mutex);
        WEFT_CHECK_OK(state_->refresh());
        const SampleIndex& index = *state_->index;
        Database& database = *state_->database;
        std::vector<bool> guessed(index.samples.size());
        WEFT_TRY(rows, database.query(
                           "SELECT rowid FROM sample_text WHERE sample_text MATCH 'tags:guessed'"));
        for (;;) {
            WEFT_TRY(more, rows.step());
            if (!more) break;
            if (const auto at = index.find_key(rows.integer(0)); at >= 0)
                guessed[static_cast<std::size_t>(at)] = true;
        }
        if (progress) progress({"vote", 0, 1, 0, 0});
        const std::vector<std::size_t> out = strangers(index, guessed);
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
        WEFT_CHECK_OK(state_->count_change());
        WEFT_CHECK_OK(transaction.commit());
        removed = static_cast<int>(out.size());
        if (progress) progress({"vote", 1, 1, 0, 0});
    }
    WEFT_CHECK_OK(train_descriptor(cancel, progress));
    return removed;
}

}  // namespace weft
