#include "app/cli/texture/texture_commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "app/cli/console.h"
#include "app/cli/texture/texture_console.h"
#include "app/cli/texture/texture_json.h"
#include "app/cli/texture/texture_sheet.h"
#include "engine/core/parallel.h"
#include "engine/core/rng.h"
#include "engine/core/text.h"
#include "engine/media/atomic_file.h"
#include "engine/media/frame_reader.h"
#include "engine/media/image_files.h"
#include "engine/synthesis/sample_kind.h"
#include "texture_db/describe/picture_file.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// No progress with --json, to keep the log short.
ProgressFn plain_progress() {
    if (json_output()) return {};
    return [](const ProgressEvent& e) {
        print(stderr, "weft: " + e.name() + " " + std::to_string(e.done) + "/" +
                          std::to_string(e.total) + "\n");
    };
}

std::string bytes_text(std::int64_t bytes) {
    char line[32];
    std::snprintf(line, sizeof line, "%.1f MB", static_cast<double>(bytes) / 1e6);
    return line;
}

std::vector<TextureOrigin> origins_of(const std::vector<std::string>& names) {
    std::vector<TextureOrigin> out;
    for (const TextureOrigin o :
         {TextureOrigin::kProcedural, TextureOrigin::kPackage, TextureOrigin::kFile}) {
        if (std::find(names.begin(), names.end(), name_of(o)) != names.end()) out.push_back(o);
    }
    return out;
}

std::string hits_text(const std::vector<SearchHit>& hits) {
    std::string out;
    for (const SearchHit& hit : hits)
        out += texture_hit_line(hit.id, hit.score, hit.material, hit.name, hit.reasons);
    return out;
}

std::string stats_text(const LibraryStats& s, const std::string& path) {
    std::string out = path + ": " + std::to_string(s.samples) + " samples of " +
                      std::to_string(s.materials.size()) + " materials, " +
                      bytes_text(s.file_bytes) + "\n";
    for (const FacetCount& m : s.materials) {
        char line[64];
        std::snprintf(line, sizeof line, "  %-14s %6d\n", m.value.c_str(), m.count);
        out += line;
    }
    return out;
}

std::string evaluation_text(const EvaluationReport& report) {
    std::string out = std::to_string(report.asked) + " photographs asked of " +
                      std::to_string(report.samples) + " samples, " +
                      std::to_string(report.left_out) +
                      " left out\n                 asked  first  five   merged: first  five\n";
    const auto line = [&](const RetrievalScore& s, const std::string& name) {
        char text[96];
        std::snprintf(text, sizeof text, "%-16s %5d  %5.3f  %5.3f  %13.3f  %5.3f\n", name.c_str(),
                      s.asked, s.first, s.among_five, s.merged_first, s.merged_among_five);
        out += text;
    };
    for (const RetrievalScore& s : report.materials)
        line(s, s.material);
    line(report.average, "average of >= 10");
    return out;
}

std::string estimate_text(const BuildEstimate& estimate) {
    std::string text;
    for (const auto& p : estimate.packages)
        text += "  " + p.name + " " +
                (p.known ? p.version + ", " + bytes_text(p.download_bytes) : p.fault) + "\n";
    char line[160];
    std::snprintf(line, sizeof line,
                  "%s to download, %s of disk (%s free), about %.0f minutes plus the download\n",
                  bytes_text(estimate.download_bytes).c_str(),
                  bytes_text(estimate.disk_bytes).c_str(), bytes_text(estimate.free_bytes).c_str(),
                  estimate.minutes);
    return text + line;
}

std::string import_text(const ImportReport& r) {
    return std::to_string(r.samples) + " samples added from " + std::to_string(r.pictures) +
           " pictures, " + std::to_string(r.skipped) + " skipped, " +
           std::to_string(r.refused.size()) + " left out\n";
}

void add(const ImportReport& part, ImportReport& all) {
    all.pictures += part.pictures;
    all.samples += part.samples;
    all.skipped += part.skipped;
    all.seconds += part.seconds;
    all.refused.insert(all.refused.end(), part.refused.begin(), part.refused.end());
}

}  // namespace

CommandResult texture_build_command(const TextureCommandOptions& common,
                                    const BuildOptions& options, bool only_estimate) {
    WEFT_TRY(estimate, estimate_build(options));
    if (only_estimate) return Answer{to_json(estimate), estimate_text(estimate)};
    print(stderr, estimate_text(estimate));
    WEFT_TRY(library, open_texture_library(common, true));
    WEFT_TRY(report, build_library(*library, options, cancel_on_signals(), plain_progress()));
    WEFT_TRY(stats, library->stats());
    Answer answer{to_json(report, stats), std::to_string(report.samples) + " samples added from " +
                                              std::to_string(report.pictures) + " pictures, " +
                                              std::to_string(report.outliers) +
                                              " outliers removed, " +
                                              std::to_string(report.duplicates) + " seen before\n"};
    for (const auto& [why, count] : report.refused)
        answer.text += "  " + std::to_string(count) + " pictures left out: " + why + "\n";
    answer.text += stats_text(stats, library->path());
    if (!report.unreachable.empty()) {
        std::string what;
        for (const std::string& fault : report.unreachable)
            what += (what.empty() ? "" : " ") + fault;
        answer.error = Error{ErrorCode::kUnreadable, what, {}, {}};
    }
    return answer;
}

CommandResult texture_import_command(const TextureCommandOptions& common,
                                     const std::vector<std::string>& paths,
                                     const ImportOptions& options, bool watch) {
    if (watch && paths.size() != 1) return fail(ErrorCode::kUsage, "Give one folder to watch.");
    WEFT_TRY(library, open_texture_library(common, true));
    const CancelToken cancel = cancel_on_signals();
    ImportReport all;
    const auto note = [&](const ImportReport& part) {
        for (const auto& [path, why] : part.refused)
            print_warning(path + " was left out: " + why);
        add(part, all);
    };
    if (watch) {
        // While watching, print each import at once; the total comes at the end.
        WEFT_CHECK_OK(
            watch_folder(*library, paths[0], options, cancel, [&](const ImportReport& part) {
                note(part);
                print(json_output() ? stderr : stdout, import_text(part));
            }));
        return Answer{to_json(all)};
    }
    WEFT_TRY(report, import_pictures(*library, paths, options, cancel, plain_progress()));
    note(report);
    WEFT_TRY(stats, library->stats());
    if (!stats.descriptor_trained && stats.samples > 50) {
        const Status learned = library->train_descriptor(cancel);
        if (!learned && learned.error().code != ErrorCode::kUsage)
            return tl::unexpected(learned.error());  // too few samples yet
    }
    return Answer{to_json(all), import_text(all)};
}

CommandResult texture_search_command(const TextureCommandOptions& common,
                                     const TextureSearchOptions& given) {
    static const std::map<std::string, TextureSort> kSorts{{"relevance", TextureSort::kRelevance},
                                                           {"name", TextureSort::kName},
                                                           {"material", TextureSort::kMaterial},
                                                           {"newest", TextureSort::kNewest},
                                                           {"rating", TextureSort::kRating},
                                                           {"brightness", TextureSort::kBrightness},
                                                           {"hue", TextureSort::kHue},
                                                           {"scale", TextureSort::kScale}};
    SearchQuery query = given.query;
    query.sort = kSorts.at(given.sort);
    query.origins = origins_of(given.origins);
    WEFT_TRY(library, open_texture_library(common, false));
    WEFT_CHECK_OK(check_exclusions(*library, query.excluded_licences));
    WEFT_TRY(result, library->search(query));
    if (!json_output()) {
        for (const std::string& line : result.understood)
            print(stderr, "weft: " + line + "\n");
        if (!result.missing.empty())
            print(stderr,
                  fmt::format("weft: no texture matches every word: the nearest lack '{}'\n",
                              fmt::join(result.missing, "', '")));
        for (const std::string& word : result.ignored)
            print(stderr, "weft: unknown word '" + word + "' was ignored\n");
    }
    return Answer{to_json(result),
                  hits_text(result.hits) + std::to_string(result.total) + " found\n"};
}

namespace {

// "x,y,width,height" inside a picture.
Expected<Recti> rectangle_of(const std::string& text, Size size) {
    Recti r;
    int width = 0, height = 0, used = 0;
    const int read =
        std::sscanf(text.c_str(), "%d,%d,%d,%d%n", &r.x0, &r.y0, &width, &height, &used);
    if (read != 4 || used != static_cast<int>(text.size()) || width < 1 || height < 1) {
        return fail(ErrorCode::kUsage,
                    "--rectangle " + text + " must be x,y,width,height in pixels.");
    }
    r.x1 = r.x0 + std::min(width, 1 << 20);
    r.y1 = r.y0 + std::min(height, 1 << 20);
    if (r.x0 < 0 || r.y0 < 0 || r.x1 > size.width || r.y1 > size.height) {
        return fail(ErrorCode::kUsage, "--rectangle " + text + " exceeds the image of " +
                                           size_text(size) + " pixels.");
    }
    return r;
}

Expected<std::vector<SearchHit>> similar_hits(TextureLibrary& library,
                                              const TextureSimilarOptions& o) {
    std::error_code ignored;
    if (fs::is_regular_file(o.what, ignored)) {
        WEFT_TRY(picture, read_picture_file(o.what));
        Recti part = rect_of(picture.size());
        if (!o.rectangle.empty()) {
            WEFT_TRY(given, rectangle_of(o.rectangle, picture.size()));
            part = given;
        }
        return library.similar(picture.view().crop(part), o.count);
    }
    if (!o.rectangle.empty()) {
        return fail(ErrorCode::kUsage,
                    "--rectangle needs an image file, and " + o.what + " is not one.");
    }
    return library.similar(o.what, o.count);
}

Expected<std::vector<std::string>> ids_to_export(TextureLibrary& library,
                                                 const TextureExportOptions& o) {
    if (!o.ids.empty()) return o.ids;
    SearchQuery query;
    query.text = o.text;
    query.origins = origins_of(o.origins);
    query.facets = false;
    query.limit = o.seed > 0 ? 10'000'000 : o.count;
    WEFT_TRY(result, library.search(query));
    if (o.seed > 0) {
        const auto key = [&](const SearchHit& h) {
            return mix64(o.seed ^ mix64(std::strtoull(h.id.substr(0, 16).c_str(), nullptr, 16)));
        };
        std::sort(result.hits.begin(), result.hits.end(),
                  [&](const SearchHit& a, const SearchHit& b) { return key(a) < key(b); });
    }
    std::vector<std::string> ids;
    for (const SearchHit& hit : result.hits) {
        if (static_cast<int>(ids.size()) < o.count) ids.push_back(hit.id);
    }
    return ids;
}

}  // namespace

CommandResult texture_similar_command(const TextureCommandOptions& common,
                                      const TextureSimilarOptions& options) {
    WEFT_TRY(library, open_texture_library(common, false));
    WEFT_TRY(hits, similar_hits(*library, options));
    if (hits.empty()) {
        print(stderr,
              "weft: the descriptor is not trained. Add ten samples of each of two materials or "
              "more, and run 'weft texture train'.\n");
    }
    return Answer{to_json(hits), hits_text(hits)};
}

CommandResult texture_info_command(const TextureCommandOptions& common, const std::string& id) {
    WEFT_TRY(library, open_texture_library(common, false));
    WEFT_TRY(info, library->info(id));
    WEFT_TRY(picture, library->original(info.id));
    const SampleDescription sample = describe_sample(picture);
    std::string looks;
    for (const std::string& word : attribute_words(info.measured))
        looks += ", " + word;
    Json json = to_json(info);
    json["sample_kind"] = kind_name(sample.kind);
    json["sample_reason"] = reason_of(sample);
    return Answer{std::move(json),
                  info.id + "\n  name      " + info.name + "\n  material  " + info.material +
                      "\n  looks     " + colour_name(info.measured.mean) + looks +
                      "\n  kind      " + kind_name(sample.kind) + ": " + reason_of(sample) +
                      "\n  origin    " + name_of(info.origin) + " " + info.package +
                      "\n  source    " + info.source + "\n  author    " +
                      (info.author.empty() ? "unknown" : info.author) + "\n  licence   " +
                      info.licence + "\n"};
}

CommandResult texture_export_command(const TextureCommandOptions& common,
                                     const TextureExportOptions& o) {
    WEFT_TRY(library, open_texture_library(common, false));
    WEFT_TRY(ids, ids_to_export(*library, o));
    if (ids.empty())
        return fail(ErrorCode::kUsage, "Nothing to export.", "Give ids or --search words.");
    WEFT_TRY(rule, write_rule(o.write, {}));
    std::vector<std::pair<std::string, TextureInfo>> files;
    std::vector<ImageU8x3> pictures;
    for (const std::string& id : ids) {
        WEFT_TRY(info, library->info(id));
        WEFT_TRY(picture, o.originals ? library->original(info.id) : library->thumbnail(info.id));
        if (o.sheet) {
            pictures.push_back(std::move(picture));
            files.emplace_back(fs::path(o.output).filename().string(), std::move(info));
            continue;
        }
        WEFT_CHECK_OK(make_folder(o.output, rule));
        const std::string name = info.material + "_" + info.id.substr(0, 12) + ".png";
        WEFT_CHECK_OK(write_picture((fs::path(o.output) / name).string(), picture, rule));
        files.emplace_back(name, std::move(info));
    }
    const Json credits = credits_json(files);
    if (o.sheet) {
        WEFT_CHECK_OK(write_picture(o.output, contact_sheet(pictures, o.columns), rule));
    } else {
        WEFT_CHECK_OK(write_file_atomically(
            (fs::path(o.output) / "credits.json").string(),
            credits.dump(2, ' ', false, Json::error_handler_t::replace) + "\n", rule));
    }
    return Answer{
        {{"schema", "weft.credits/1"}, {"output", absolute_path(o.output)}, {"files", credits}},
        std::to_string(files.size()) + " samples written to " + o.output + "\n"};
}

CommandResult texture_stats_command(const TextureCommandOptions& common) {
    WEFT_TRY(library, open_texture_library(common, false));
    WEFT_TRY(stats, library->stats());
    return Answer{to_json(stats, library->path()), stats_text(stats, library->path())};
}

CommandResult texture_verify_command(const TextureCommandOptions& common) {
    WEFT_TRY(library, open_texture_library(common, false));
    WEFT_TRY(faults, library->verify(cancel_on_signals()));
    Answer answer{to_json(faults)};
    for (const LibraryFault& f : faults)
        answer.text += (f.id.empty() ? "file" : f.id) + ": " + f.what + "\n";
    if (faults.empty()) answer.text = "The library has no faults.\n";
    answer.exit = faults.empty() ? 0 : exit_code(ErrorCode::kDiffers);
    return answer;
}

CommandResult texture_evaluate_command(const TextureCommandOptions& common,
                                       const EvaluationOptions& options) {
    set_thread_count(common.threads);
    WEFT_TRY(report, evaluate_library(texture_library_path(common), options, cancel_on_signals(),
                                      plain_progress()));
    return Answer{to_json(report), evaluation_text(report)};
}

CommandResult texture_model_command(const TextureCommandOptions& common,
                                    const TextureModelOptions& o) {
    if (o.none && !o.folder.empty())
        return fail(ErrorCode::kUsage, "--none contradicts a folder.", "Give one of the two.");
    WEFT_TRY(library, open_texture_library(common, false));
    if (o.none || !o.folder.empty()) {
        // Absolute, since the library may be opened from any folder.
        const std::string folder = o.none ? "" : absolute_path(o.folder);
        WEFT_CHECK_OK(library->use_image_text_model(folder, cancel_on_signals(), plain_progress()));
    }
    WEFT_TRY(named, library->image_text_model());
    return Answer{{{"model", named}},
                  "image-text model: " + (named.empty() ? "none" : named) + "\n"};
}

CommandResult texture_train_command(const TextureCommandOptions& common) {
    WEFT_TRY(library, open_texture_library(common, false));
    WEFT_CHECK_OK(library->train_descriptor(cancel_on_signals(), plain_progress()));
    WEFT_TRY(stats, library->stats());
    return Answer{to_json(stats, library->path())};
}

}  // namespace weft
