#include "app/cli/texture_commands.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "app/cli/console.h"
#include "app/cli/texture_console.h"
#include "app/cli/texture_json.h"
#include "app/cli/texture_sheet.h"
#include "engine/core/parallel.h"
#include "engine/core/rng.h"
#include "engine/media/atomic_file.h"
#include "engine/media/frame_reader.h"
#include "engine/media/image_files.h"
#include "texture_db/picture_file.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

ProgressFn plain_progress() {
    return [](const ProgressEvent& e) {
        print(stderr,
              e.stage + " " + std::to_string(e.done) + "/" + std::to_string(e.total) + "\n");
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

void print_hits(const std::vector<SearchHit>& hits) {
    for (const SearchHit& hit : hits)
        print(stdout, texture_hit_line(hit.id, hit.score, hit.material, hit.name, hit.reasons));
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

Status print_estimate(const TextureCommandOptions& common, const BuildOptions& options, bool only) {
    WEFT_TRY(estimate, estimate_build(options));
    if (only && common.json) {
        print(stdout, to_json(estimate));
        return {};
    }
    std::string text;
    for (const auto& p : estimate.packages)
        text += "  " + p.name + " " +
                (p.known ? p.version + ", " + bytes_text(p.download_bytes) : p.fault) + "\n";
    char line[160];
    std::snprintf(line, sizeof line,
                  "%s to download, %s of disk (%s free), about %.0f minutes besides the download\n",
                  bytes_text(estimate.download_bytes).c_str(),
                  bytes_text(estimate.disk_bytes).c_str(), bytes_text(estimate.free_bytes).c_str(),
                  estimate.minutes);
    print(only ? stdout : stderr, text + line);
    return {};
}

Status run_build(const TextureCommandOptions& common, const BuildOptions& options, bool estimate) {
    WEFT_CHECK_OK(print_estimate(common, options, estimate));
    if (estimate) return {};
    WEFT_TRY(library, open_texture_library(common, true));
    WEFT_TRY(report, build_library(*library, options, cancel_on_signals(), plain_progress()));
    WEFT_TRY(stats, library->stats());
    if (common.json) {
        print(stdout, to_json(report, stats));
    } else {
        print(stdout, std::to_string(report.samples) + " samples added from " +
                          std::to_string(report.pictures) + " pictures, " +
                          std::to_string(report.voted_out) + " voted out, " +
                          std::to_string(report.duplicates) + " seen before\n");
        for (const auto& [why, count] : report.refused)
            print(stdout, "  " + std::to_string(count) + " pictures left out: " + why + "\n");
        print(stdout, stats_text(stats, library->path()));
    }
    if (report.unreachable.empty()) return {};
    std::string what;
    for (const std::string& fault : report.unreachable)
        what += (what.empty() ? "" : " ") + fault;
    return fail(ErrorCode::kUnreadable, what);
}

Status run_import(const TextureCommandOptions& common, const std::vector<std::string>& paths,
                  const ImportOptions& options, bool watch) {
    if (watch && paths.size() != 1) return fail(ErrorCode::kUsage, "Give one folder to watch.");
    WEFT_TRY(library, open_texture_library(common, true));
    const auto say = [&](const ImportReport& r) {
        if (common.json) {
            print(stdout, to_json(r));
            return;
        }
        for (const auto& [path, why] : r.refused)
            print_warning(path + " was left out: " + why);
        print(stdout, std::to_string(r.samples) + " samples added from " +
                          std::to_string(r.pictures) + " pictures, " + std::to_string(r.skipped) +
                          " skipped, " + std::to_string(r.refused.size()) + " left out\n");
    };
    const CancelToken cancel = cancel_on_signals();
    if (watch) return watch_folder(*library, paths[0], options, cancel, say);
    WEFT_TRY(report, import_pictures(*library, paths, options, cancel,
                                     common.json ? ProgressFn() : plain_progress()));
    WEFT_TRY(stats, library->stats());
    if (!stats.descriptor_trained && stats.samples > 50) {
        const Status learned = library->train_descriptor(cancel);
        if (!learned && learned.error().code != ErrorCode::kUsage)
            return learned;  // too few: another time
    }
    say(report);
    return {};
}

Status run_search(const TextureCommandOptions& common, TextureSearchOptions options) {
    static const std::map<std::string, TextureSort> kSorts{{"relevance", TextureSort::kRelevance},
                                                           {"name", TextureSort::kName},
                                                           {"material", TextureSort::kMaterial},
                                                           {"newest", TextureSort::kNewest},
                                                           {"rating", TextureSort::kRating},
                                                           {"brightness", TextureSort::kBrightness},
                                                           {"hue", TextureSort::kHue},
                                                           {"scale", TextureSort::kScale}};
    options.query.sort = kSorts.at(options.sort);
    options.query.origins = origins_of(options.origins);
    WEFT_TRY(library, open_texture_library(common, false));
    WEFT_TRY(result, library->search(options.query));
    if (common.json) {
        print(stdout, to_json(result));
        return {};
    }
    for (const std::string& line : result.understood)
        print(stderr, "weft: " + line + "\n");
    for (const std::string& word : result.ignored)
        print(stderr, "weft: nothing is known of '" + word + "'\n");
    print_hits(result.hits);
    print(stdout, std::to_string(result.total) + " found\n");
    return {};
}

// "x,y,width,height" inside a picture.
Expected<Recti> rectangle_of(const std::string& text, Size size) {
    Recti r;
    int width = 0, height = 0, used = 0;
    const int read =
        std::sscanf(text.c_str(), "%d,%d,%d,%d%n", &r.x0, &r.y0, &width, &height, &used);
    if (read != 4 || used != static_cast<int>(text.size()) || width < 1 || height < 1) {
        return fail(ErrorCode::kUsage,
                    "--rectangle " + text + " is not of the form x,y,width,height in pixels.");
    }
    r.x1 = r.x0 + std::min(width, 1 << 20);
    r.y1 = r.y0 + std::min(height, 1 << 20);
    if (r.x0 < 0 || r.y0 < 0 || r.x1 > size.width || r.y1 > size.height) {
        return fail(ErrorCode::kUsage, "--rectangle " + text + " reaches beyond the picture of " +
                                           std::to_string(size.width) + "x" +
                                           std::to_string(size.height) + " pixels.");
    }
    return r;
}

Status run_similar(const TextureCommandOptions& common, const TextureSimilarOptions& o) {
    WEFT_TRY(library, open_texture_library(common, false));
    std::vector<SearchHit> hits;
    std::error_code ignored;
    if (fs::is_regular_file(o.what, ignored)) {
        WEFT_TRY(picture, read_picture_file(o.what));
        Recti part = rect_of(picture.size());
        if (!o.rectangle.empty()) {
            WEFT_TRY(given, rectangle_of(o.rectangle, picture.size()));
            part = given;
        }
        WEFT_TRY(found, library->similar(picture.view().crop(part), o.count));
        hits = std::move(found);
    } else {
        if (!o.rectangle.empty()) {
            return fail(ErrorCode::kUsage,
                        "--rectangle is of a picture, and " + o.what + " is no picture file.");
        }
        WEFT_TRY(found, library->similar(o.what, o.count));
        hits = std::move(found);
    }
    if (hits.empty()) {
        print(
            stderr,
            "weft: nothing is learned yet by which to compare. Where the library holds ten samples "
            "of each of two materials or more, run weft texture train.\n");
    }
    common.json ? print(stdout, to_json(hits)) : print_hits(hits);
    return {};
}

Status run_info(const TextureCommandOptions& common, const std::string& id) {
    WEFT_TRY(library, open_texture_library(common, false));
    WEFT_TRY(info, library->info(id));
    if (common.json) {
        print(stdout, to_json(info));
        return {};
    }
    std::string looks;
    for (const std::string& word : attribute_words(info.measured))
        looks += ", " + word;
    print(stdout, info.id + "\n  name      " + info.name + "\n  material  " + info.material +
                      "\n  looks     " + colour_name(info.measured.mean) + looks +
                      "\n  origin    " + name_of(info.origin) + " " + info.package +
                      "\n  source    " + info.source + "\n  author    " +
                      (info.author.empty() ? "unknown" : info.author) + "\n  licence   " +
                      info.licence + "\n");
    return {};
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

Status run_export(const TextureCommandOptions& common, const TextureExportOptions& o) {
    WEFT_TRY(library, open_texture_library(common, false));
    WEFT_TRY(ids, ids_to_export(*library, o));
    if (ids.empty())
        return fail(ErrorCode::kUsage, "There is nothing to export. Give ids or --search words.");
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
        std::error_code error;
        fs::create_directories(o.output, error);
        const std::string name = info.material + "_" + info.id.substr(0, 12) + ".png";
        WEFT_CHECK_OK(write_picture((fs::path(o.output) / name).string(), picture));
        files.emplace_back(name, std::move(info));
    }
    if (o.sheet) WEFT_CHECK_OK(write_picture(o.output, contact_sheet(pictures, o.columns)));
    const std::string credits = credits_json(files);
    if (!o.sheet)
        WEFT_CHECK_OK(
            write_file_atomically((fs::path(o.output) / "credits.json").string(), credits));
    print(stdout, common.json
                      ? credits
                      : std::to_string(files.size()) + " samples written to " + o.output + "\n");
    return {};
}

}  // namespace

int texture_build_command(const TextureCommandOptions& common, const BuildOptions& options,
                          bool estimate) {
    return texture_exit_code(run_build(common, options, estimate));
}
int texture_import_command(const TextureCommandOptions& common,
                           const std::vector<std::string>& paths, const ImportOptions& options,
                           bool watch) {
    return texture_exit_code(run_import(common, paths, options, watch));
}
int texture_search_command(const TextureCommandOptions& common,
                           const TextureSearchOptions& options) {
    return texture_exit_code(run_search(common, options));
}
int texture_similar_command(const TextureCommandOptions& common,
                            const TextureSimilarOptions& options) {
    return texture_exit_code(run_similar(common, options));
}
int texture_info_command(const TextureCommandOptions& common, const std::string& id) {
    return texture_exit_code(run_info(common, id));
}
int texture_export_command(const TextureCommandOptions& common,
                           const TextureExportOptions& options) {
    return texture_exit_code(run_export(common, options));
}

int texture_stats_command(const TextureCommandOptions& common) {
    const auto library = open_texture_library(common, false);
    if (!library) return report_error(library.error());
    const auto stats = (*library)->stats();
    if (!stats) return report_error(stats.error());
    print(stdout, common.json ? to_json(*stats, (*library)->path())
                              : stats_text(*stats, (*library)->path()));
    return 0;
}

int texture_verify_command(const TextureCommandOptions& common) {
    const auto library = open_texture_library(common, false);
    if (!library) return report_error(library.error());
    const auto faults = (*library)->verify(cancel_on_signals());
    if (!faults) return report_error(faults.error());
    if (common.json) {
        print(stdout, to_json(*faults));
    } else {
        for (const LibraryFault& f : *faults)
            print(stdout, (f.id.empty() ? "file" : f.id) + ": " + f.what + "\n");
        if (faults->empty()) print(stdout, "The library is sound.\n");
    }
    return faults->empty() ? 0 : exit_code(ErrorCode::kDiffers);
}

int texture_evaluate_command(const TextureCommandOptions& common,
                             const EvaluationOptions& options) {
    set_thread_count(common.threads);
    const auto report = evaluate_library(texture_library_path(common), options, cancel_on_signals(),
                                         common.json ? ProgressFn() : plain_progress());
    if (!report) return report_error(report.error());
    print(stdout, common.json ? to_json(*report) : evaluation_text(*report));
    return 0;
}

int texture_model_command(const TextureCommandOptions& common, const TextureModelOptions& o) {
    const auto run = [&]() -> Status {
        if (o.none && !o.folder.empty())
            return fail(ErrorCode::kUsage, "Give a folder or --none, and not both.");
        WEFT_TRY(library, open_texture_library(common, false));
        if (o.none || !o.folder.empty()) {
            // A library is opened from anywhere: the folder is noted as it is found from anywhere.
            const std::string folder = o.none ? "" : fs::absolute(o.folder).lexically_normal();
            WEFT_CHECK_OK(library->use_image_text_model(
                folder, cancel_on_signals(), common.json ? ProgressFn() : plain_progress()));
        }
        WEFT_TRY(named, library->image_text_model());
        print(stdout, common.json ? nlohmann::ordered_json{{"model", named}}.dump(2) + "\n"
                                  : "image-text model: " + (named.empty() ? "none" : named) + "\n");
        return {};
    };
    return texture_exit_code(run());
}

int texture_train_command(const TextureCommandOptions& common) {
    const auto library = open_texture_library(common, false);
    if (!library) return report_error(library.error());
    return texture_exit_code((*library)->train_descriptor(cancel_on_signals(), plain_progress()));
}

}  // namespace weft
