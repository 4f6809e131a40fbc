#include "texture_db/sources/import.h"

#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include "engine/core/parallel.h"
#include "engine/core/stopwatch.h"
#include "texture_db/describe/material_words.h"
#include "texture_db/sources/photo_samples.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kImportBatch = 12;

struct Found {
    std::string file, category;
};

// Changes whenever the file may have changed, so that an unchanged file is not read again.
std::string stamp_of(const std::string& file) {
    struct stat s {};
    if (::stat(file.c_str(), &s) != 0) return "?";
    return std::to_string(s.st_size) + "." + std::to_string(s.st_mtim.tv_sec) + "." +
           std::to_string(s.st_mtim.tv_nsec);
}

std::string note_key(const std::string& file) {
    return "import:" + file;
}

Photo photo_of(const Found& found, const ImportOptions& options) {
    Photo photo;
    std::error_code ignored;
    photo.file = found.file;
    photo.source = fs::absolute(found.file, ignored).string();
    photo.category = found.category;
    photo.name = words_of_name(fs::path(found.file).filename().string());
    const std::string in_folder =
        (fs::path(found.category) / fs::path(found.file).filename()).generic_string();
    photo.material = !options.material.empty() ? options.material : material_of_path(in_folder);
    if (photo.material.empty()) photo.material = "other";
    photo.tags = options.tags;
    photo.author = options.author;
    photo.licence = options.licence;
    photo.keep_original = options.keep_originals;
    return photo;
}

Expected<std::vector<Found>> find_all(const std::vector<std::string>& paths) {
    std::vector<Found> out;
    for (const std::string& path : paths) {
        WEFT_TRY(files, pictures_below(path));
        std::error_code ignored;
        const bool folder = fs::is_directory(path, ignored);
        for (const std::string& file : files) {
            const fs::path parent = fs::path(file).parent_path();
            std::string category = folder ? parent.lexically_relative(path).generic_string() : "";
            if (category == ".") category = fs::path(path).lexically_normal().filename().string();
            out.push_back({file, category});
        }
    }
    return out;
}

}  // namespace

bool is_other_map(const std::string& file_name) {
    static const std::vector<std::string> kMaps{
        "nor",       "normal",       "normals",  "normalgl",
        "normaldx",  "gl",           "dx",       "nrm",
        "nm",        "norm",         "rough",    "roughness",
        "disp",      "displacement", "ao",       "ambientocclusion",
        "occlusion", "metalness",    "metallic", "spec",
        "specular",  "sm",           "gm",       "rm",
        "arm",       "orm",          "bump",     "height",
        "opacity",   "emission",     "gloss",    "glossiness",
        "mask",      "local",        "glow",     "luma",
        "blend",     "reflect",      "pants",    "shirt"};
    static const std::vector<std::string> kColors{"color",  "colour",    "diff", "diffuse",
                                                  "albedo", "basecolor", "col"};
    std::vector<std::string> words = split_words(words_of_name(file_name));
    const auto among = [](const std::vector<std::string>& list, const std::string& word) {
        return std::find(list.begin(), list.end(), word) != list.end();
    };
    // "NormalGL" is split into "normal gl"; resolutions (1K, 2k, 4k) may stand anywhere.
    std::erase_if(words, [](const std::string& w) {
        return w == "k" || w.find_first_not_of("0123456789") == std::string::npos || w == "jpg" ||
               w == "png";
    });
    if (words.size() < 2) return false;
    if (among(kColors, words.back())) return false;
    const bool two =
        words.size() >= 3 && words[words.size() - 2] == "ambient" && words.back() == "occlusion";
    return two || among(kMaps, words.back());
}

Expected<ImportReport> import_pictures(TextureLibrary& library,
                                       const std::vector<std::string>& paths,
                                       const ImportOptions& options, const CancelToken& cancel,
                                       const ProgressFn& progress) {
    const auto start = Clock::now();
    WEFT_TRY(found, find_all(paths));
    ImportReport report;
    std::vector<Found> todo;
    for (Found& f : found) {
        if (is_other_map(fs::path(f.file).filename().string())) {
            ++report.skipped;
            continue;
        }
        WEFT_TRY(note, library.note(note_key(f.file)));
        if (note == stamp_of(f.file))
            ++report.skipped;
        else
            todo.push_back(std::move(f));
    }
    const ChoiceRules rules{options.most_per_picture, options.strict};
    for (std::size_t at = 0; at < todo.size(); at += kImportBatch) {
        if (cancel.cancelled()) {
            return fail(static_cast<ErrorCode>(cancel.reason()), "The import was stopped",
                        "run it again to continue.");
        }
        const std::size_t n = std::min(kImportBatch, todo.size() - at);
        std::vector<PhotoSamples> done(n);
        parallel_for(n, [&](std::size_t i) {
            done[i] = samples_of(photo_of(todo[at + i], options), rules);
        });
        std::vector<NewTexture> samples;
        for (std::size_t i = 0; i < n; ++i) {
            if (!done[i].fault.empty()) {
                report.refused.emplace_back(todo[at + i].file, done[i].fault);
                continue;
            }
            ++report.pictures;
            for (NewTexture& t : done[i].samples)
                samples.push_back(std::move(t));
        }
        WEFT_TRY(added, library.add(samples));
        report.samples += added;
        for (std::size_t i = 0; i < n; ++i) {
            if (done[i].fault.empty())
                WEFT_CHECK_OK(
                    library.set_note(note_key(todo[at + i].file), stamp_of(todo[at + i].file)));
        }
        if (progress) {
            progress(ProgressEvent::titled("import", static_cast<std::int64_t>(at + n),
                                           static_cast<std::int64_t>(todo.size())));
        }
    }
    report.seconds = seconds_since(start);
    return report;
}

Status watch_folder(TextureLibrary& library, const std::string& folder,
                    const ImportOptions& options, const CancelToken& cancel,
                    const std::function<void(const ImportReport&)>& on_import, double every_s) {
    // A file that cannot be read is reported once, until it changes.
    std::vector<std::pair<std::string, std::string>> known_faults;
    while (!cancel.cancelled()) {
        WEFT_TRY(report, import_pictures(library, {folder}, options, cancel));
        std::vector<std::pair<std::string, std::string>> fresh;
        for (const auto& [file, fault] : report.refused) {
            const auto mark = std::pair(file, stamp_of(file));
            if (std::find(known_faults.begin(), known_faults.end(), mark) == known_faults.end()) {
                known_faults.push_back(mark);
                fresh.emplace_back(file, fault);
            }
        }
        report.refused = std::move(fresh);
        if (report.pictures > 0 || !report.refused.empty()) on_import(report);
        const auto until = Clock::now() + std::chrono::duration<double>(every_s);
        while (!cancel.cancelled() && Clock::now() < until)
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return {};
}

}  // namespace weft
