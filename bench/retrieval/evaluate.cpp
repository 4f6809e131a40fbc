#include "bench/retrieval/evaluate.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "engine/core/hash.h"
#include "engine/core/input_file.h"
#include "engine/core/parallel.h"
#include "texture_db/describe/features.h"
#include "texture_db/describe/material_words.h"
#include "texture_db/describe/near_duplicates.h"
#include "texture_db/describe/picture_file.h"
#include "texture_db/describe/sample_codec.h"
#include "texture_db/library/library.h"
#include "texture_db/search/ranking.h"
#include "texture_db/sources/photo_samples.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr int kFolds = 5;
constexpr int kAskedOfOnePicture = 2;
constexpr int kEnough = 10;  // photographs of a material that enters the average

struct Stored {
    std::int64_t key = 0, picture = 0;
    std::string material, package, source;
    TextureOrigin origin = TextureOrigin::kProcedural;
    std::vector<float> features;
};
struct Asked {
    std::string material, package, source, file;
    std::vector<float> features;
    ImageU8x3 picture;
};

std::string file_of(const std::string& package, const std::string& source) {
    return package + ":" + source;
}

// The words of a file's name, without numbers and single letters.
std::vector<std::string> stem_of(const std::string& source) {
    std::vector<std::string> out;
    for (const std::string& word : split_words(words_of_name(fs::path(source).filename().string())))
        if (word.size() > 1 && word.find_first_not_of("0123456789") != std::string::npos)
            out.push_back(word);
    return out;
}

std::string series_of(const std::string& package, const std::string& source) {
    return package + ":" + joined_words(stem_of(source));
}

std::string merged(const std::string& material) {
    if (material == "dirt") return "sand";
    if (material == "cobblestone" || material == "tiles") return "stone";
    return material == "rust" ? "metal" : material;
}

Expected<std::vector<Stored>> stored_samples(Database& database) {
    std::vector<Stored> out;
    WEFT_TRY(rows, database.query("SELECT s.key, s.picture, s.material, s.package, s.source, "
                                  "s.origin, f.data FROM sample s JOIN features f ON f.sample = "
                                  "s.key WHERE f.version = ? ORDER BY s.key"));
    rows.bind(kFeatureVersion);
    for (;;) {
        WEFT_TRY(more, rows.step());
        if (!more) return out;
        out.push_back({rows.integer(0), rows.integer(1), rows.text(2), rows.text(3), rows.text(4),
                       static_cast<TextureOrigin>(rows.integer(5)), floats_of(rows.blob(6))});
    }
}

// manifest.csv: maps a file to its package and the path in it. The package is the last word of its
// column with a hyphen ("Debian ufoai-textures 2.5-2").
std::map<std::string, std::pair<std::string, std::string>> manifest_of(const fs::path& folder) {
    std::map<std::string, std::pair<std::string, std::string>> out;
    std::istringstream in(
        read_file((folder / "manifest.csv").string(), {}).value_or(std::string()));
    for (std::string line; std::getline(in, line);) {
        std::vector<std::string> columns;
        for (std::size_t at = 0; columns.size() < 4 && at != std::string::npos;) {
            const std::size_t end = line.find(',', at);
            columns.push_back(line.substr(at, end - at));
            at = end == std::string::npos ? end : end + 1;
        }
        if (columns.size() < 4) continue;
        std::string package;
        for (const std::string& word : split_words(columns[2]))
            if (package.empty() && std::isalpha(static_cast<unsigned char>(word[0])) &&
                word.find('-') != std::string::npos)
                package = word;
        out[columns[0]] = {package, columns[3]};
    }
    return out;
}

Expected<std::vector<Asked>> asked_photographs(const EvaluationOptions& options) {
    WEFT_TRY(files, pictures_below(options.folder));
    const auto manifest = manifest_of(options.folder);
    std::vector<Asked> out(files.size());
    parallel_for(files.size(), [&](std::size_t i) {
        Asked& a = out[i];
        a.file = files[i];
        const fs::path path(files[i]);
        const std::string category = path.parent_path().filename().string();
        const auto renamed = options.renamed.find(category);
        a.material =
            renamed != options.renamed.end() ? renamed->second : material_of_path(category);
        const std::string name = path.lexically_relative(options.folder).generic_string();
        if (const auto at = manifest.find(name); at != manifest.end()) {
            a.package = at->second.first;
            a.source = at->second.second;
        }
        if (a.material.empty()) return;
        auto picture = read_picture_file(files[i]);
        if (!picture) return;
        a.features = texture_features(middle_sample(at_sample_scale(*picture)));
        a.picture = std::move(*picture);
    });
    std::erase_if(out, [](const Asked& a) { return a.features.empty(); });
    if (out.empty()) {
        return fail(ErrorCode::kUsage, "No photograph was found in " + options.folder +
                                           " in a folder that is named after a material.");
    }
    return out;
}

// The library's pictures that nearly equal one of the query photographs, which were cut from the
// middle, at most 512 px a side.
Expected<std::set<std::int64_t>> nearly_the_same(Database& database,
                                                 const std::vector<Asked>& asked) {
    std::set<std::int64_t> out;
    std::map<std::pair<int, int>, NearDuplicates> by_size;
    for (const Asked& a : asked)
        by_size[{a.picture.width(), a.picture.height()}].add_if_new(a.picture);
    WEFT_TRY(rows, database.query("SELECT p.key, p.data, s.original_width, s.original_height FROM "
                                  "picture p JOIN sample s ON s.picture = p.key GROUP BY p.key "
                                  "ORDER BY p.key"));
    for (;;) {
        WEFT_TRY(more, rows.step());
        if (!more) return out;
        const auto picture = decode_picture(rows.blob(1));
        if (!picture) continue;
        const double scale = static_cast<double>(picture->width()) /
                             static_cast<double>(std::max<std::int64_t>(rows.integer(2), 1));
        for (const auto& [size, seen] : by_size) {
            const int width = static_cast<int>(size.first * scale),
                      height = static_cast<int>(size.second * scale);
            if (width > picture->width() || height > picture->height() || width < 16 || height < 16)
                continue;
            const int x = (picture->width() - width) / 2, y = (picture->height() - height) / 2;
            if (seen.is_known(picture->view().crop({x, y, x + width, y + height})))
                out.insert(rows.integer(0));
        }
    }
}

// The samples that must be left out for a set of queries.
class Excluded {
  public:
    Excluded(const std::vector<Asked>& asked, LeaveOut leave_out, std::set<std::int64_t> pictures)
        : pictures_(std::move(pictures)) {
        for (const Asked& a : asked) {
            if (a.source.empty()) continue;
            files_.insert(file_of(a.package, a.source));
            const std::size_t words = stem_of(a.source).size();
            if (leave_out == LeaveOut::kStem || (leave_out == LeaveOut::kSeries && words >= 2))
                series_.insert(series_of(a.package, a.source));
        }
    }
    [[nodiscard]] bool operator()(const Stored& s) const {
        return s.origin != TextureOrigin::kProcedural &&
               (pictures_.contains(s.picture) || files_.contains(file_of(s.package, s.source)) ||
                series_.contains(series_of(s.package, s.source)));
    }

  private:
    std::set<std::int64_t> pictures_;
    std::set<std::string> files_, series_;
};

struct Learned {
    SampleIndex index;
    DescriptorModel model;
};

Expected<Learned> learn_on(const std::vector<const Stored*>& samples) {
    LabelledFeatures data;
    StringTable materials;
    for (const Stored* s : samples) {
        data.features.push_back(s->features);
        data.labels.push_back(materials.number_of(s->material));
        data.weights.push_back(1);
    }
    for (int m = 0; m < materials.size(); ++m)
        data.materials.push_back(materials.text(m));
    WEFT_TRY(model, learn_descriptor(data));
    std::vector<std::vector<float>> descriptors(samples.size());
    parallel_for(samples.size(),
                 [&](std::size_t i) { descriptors[i] = model.describe(samples[i]->features); });
    Learned out;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        IndexedSample s;
        s.origin = samples[i]->origin;
        s.material = out.index.materials.number_of(samples[i]->material);
        out.index.add(std::move(s), descriptors[i]);
    }
    out.model = std::move(model);
    return out;
}

class Tally {
  public:
    void ask(const Learned& library, const std::string& material,
             const std::vector<float>& features) {
        const auto found =
            rank_for_picture(library.index, library.model, library.model.describe(features), 5);
        RetrievalScore& s = scores_[material];
        ++s.asked;
        bool here = false, near = false;
        for (std::size_t k = 0; k < found.size(); ++k) {
            const std::string& shown =
                library.index.materials.text(library.index.looks[found[k].sample].material);
            here = here || shown == material;
            near = near || merged(shown) == merged(material);
            if (k == 0) {
                s.first += here ? 1 : 0;
                s.merged_first += near ? 1 : 0;
            }
        }
        s.among_five += here ? 1 : 0;
        s.merged_among_five += near ? 1 : 0;
    }
    void report(EvaluationReport& out) const {
        int counted = 0;
        for (const auto& [material, sum] : scores_) {
            RetrievalScore s = sum;
            s.material = material;
            for (double* v : {&s.first, &s.among_five, &s.merged_first, &s.merged_among_five})
                *v /= s.asked;
            out.asked += s.asked;
            out.materials.push_back(s);
            if (s.asked < kEnough) continue;
            ++counted;
            out.average.asked += s.asked;
            out.average.first += s.first;
            out.average.among_five += s.among_five;
            out.average.merged_first += s.merged_first;
            out.average.merged_among_five += s.merged_among_five;
        }
        RetrievalScore& a = out.average;
        for (double* v : {&a.first, &a.among_five, &a.merged_first, &a.merged_among_five})
            *v /= std::max(counted, 1);
    }

  private:
    std::map<std::string, RetrievalScore> scores_;
};

Expected<EvaluationReport> ask_photographs(Database& database, const std::vector<Stored>& samples,
                                           const EvaluationOptions& options) {
    WEFT_TRY(asked, asked_photographs(options));
    WEFT_TRY(same, nearly_the_same(database, asked));
    const Excluded excluded(asked, options.leave_out, std::move(same));
    std::vector<const Stored*> kept;
    for (const Stored& s : samples)
        if (!excluded(s)) kept.push_back(&s);
    WEFT_TRY(library, learn_on(kept));
    Tally tally;
    for (const Asked& a : asked)
        tally.ask(library, a.material, a.features);
    EvaluationReport out;
    out.samples = static_cast<int>(kept.size());
    out.left_out = static_cast<int>(samples.size() - kept.size());
    tally.report(out);
    return out;
}

// The fold in which a sample is a query; all samples of one name share a fold.
int fold_of(const Stored& s) {
    Hasher hasher;
    hasher.text(series_of(s.package, s.source));
    return static_cast<int>(hasher.finish().low % kFolds);
}

Expected<EvaluationReport> ask_itself(const std::vector<Stored>& samples, const CancelToken& cancel,
                                      const ProgressFn& progress) {
    EvaluationReport out;
    Tally tally;
    for (int fold = 0; fold < kFolds; ++fold) {
        if (cancel.cancelled())
            return fail(static_cast<ErrorCode>(cancel.reason()), "The evaluation was stopped.");
        std::vector<const Stored*> kept, asked;
        std::map<std::string, int> of_one;
        for (const Stored& s : samples) {
            const bool mine = s.origin == TextureOrigin::kPackage && fold_of(s) == fold;
            if (!mine)
                kept.push_back(&s);
            else if (++of_one[file_of(s.package, s.source)] <= kAskedOfOnePicture)
                asked.push_back(&s);
        }
        WEFT_TRY(library, learn_on(kept));
        for (const Stored* s : asked)
            tally.ask(library, s->material, s->features);
        out.samples = static_cast<int>(kept.size());
        out.left_out = static_cast<int>(samples.size() - kept.size());
        if (progress) progress(ProgressEvent::titled("evaluate", fold + 1, kFolds));
    }
    tally.report(out);
    return out;
}

}  // namespace

Expected<EvaluationReport> evaluate_library(const std::string& library_path,
                                            const EvaluationOptions& options,
                                            const CancelToken& cancel, const ProgressFn& progress) {
    WEFT_TRY(database, Database::open(library_path, false, true));
    WEFT_TRY(samples, stored_samples(*database));
    if (samples.empty()) {
        return fail(
            ErrorCode::kUsage,
            "The texture library " + library_path + " has no samples that this version measured.",
            "Run 'weft texture train' first.");
    }
    return options.folder.empty() ? ask_itself(samples, cancel, progress)
                                  : ask_photographs(*database, samples, options);
}

}  // namespace weft
