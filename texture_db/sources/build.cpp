#include "texture_db/sources/build.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "engine/core/parallel.h"
#include "engine/core/setting.h"
#include "engine/core/stopwatch.h"
#include "texture_db/describe/near_duplicates.h"
#include "texture_db/sources/package_pictures.h"
#include "texture_db/sources/packages.h"
#include "texture_db/sources/photo_samples.h"
#include "texture_db/sources/picture_corrections.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kBatch = 16;
// Measured: a 96×96 sample with its share of the original, and the starter library.
constexpr std::int64_t kSamples_bytes = 700ll << 20;
constexpr double kMinutesPerGigabyte = 4;

std::string work_folder_of(const BuildOptions& options) {
    if (!options.work_folder.empty()) return options.work_folder;
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache)
        return (fs::path(cache) / "weft" / "texture-packages").string();
    const char* home = std::getenv("HOME");
    return (fs::path(home ? home : ".") / ".cache" / "weft" / "texture-packages").string();
}

Error stopped(const CancelToken& cancel) {
    return {static_cast<ErrorCode>(cancel.reason()),
            "The build was stopped",
            "run it again to continue.",
            {}};
}

// One run of a build.
class Builder {
  public:
    Builder(TextureLibrary& library, const BuildOptions& options, const CancelToken& cancel,
            const ProgressFn& progress)
        : library_(library),
          options_(options),
          cancel_(cancel),
          progress_(progress),
          work_(work_folder_of(options)) {}

    Expected<BuildReport> run() {
        const auto start = Clock::now();
        std::error_code error;
        fs::create_directories(work_, error);
        if (error) {
            return fail(ErrorCode::kUnreadable,
                        "The folder " + work_ + " cannot be created: " + error.message() + ".");
        }
        WEFT_CHECK_OK(check_space());
        if (options_.starter) WEFT_CHECK_OK(add_starter_textures(library_, cancel_, progress_));
        WEFT_CHECK_OK(remember_known());
        for (const std::string& package : options_.packages)
            WEFT_CHECK_OK(build_package(package));
        WEFT_TRY(done, library_.note(outliers_key()));
        if (done.empty() && !options_.packages.empty()) {
            WEFT_TRY(removed, library_.remove_outliers(was_inspected, cancel_, progress_));
            report_.outliers = removed;
            if (report_.unreachable.empty())
                WEFT_CHECK_OK(library_.set_note(outliers_key(), "done"));
        }
        for (const auto& [why, count] : refused_)
            report_.refused.emplace_back(why, count);
        report_.seconds = seconds_since(start);
        return report_;
    }

  private:
    [[nodiscard]] std::string outliers_key() const {
        std::string key = "build.removed:";
        for (const std::string& package : options_.packages)
            key += package + ",";
        return key;
    }

    Status check_space() const {
        WEFT_TRY(estimate, estimate_build(options_));
        if (estimate.free_bytes >= estimate.disk_bytes) return {};
        return fail(ErrorCode::kNoSpace,
                    "Building needs about " + std::to_string(estimate.disk_bytes >> 20) +
                        " MB, but " + work_ + " has " + std::to_string(estimate.free_bytes >> 20) +
                        " MB free.",
                    "Free some space, or build fewer packages" + by({{setting::kPackages}}) + ".");
    }

    // Thumbnails of what earlier runs stored, so that duplicates of it are detected.
    Status remember_known() {
        SearchQuery all;
        all.origins = {TextureOrigin::kPackage};
        all.limit = 1'000'000;
        all.facets = false;
        all.sort = TextureSort::kNewest;
        WEFT_TRY(found, library_.search(all));
        for (const SearchHit& hit : found.hits) {
            WEFT_TRY(pixels, library_.thumbnail(hit.id));
            samples_seen_.add_if_new(pixels);
        }
        return {};
    }

    Status build_package(const std::string& name) {
        const std::string key = "build:" + name;
        WEFT_TRY(note, library_.note(key));
        if (note == "done") return {};
        if (cancel_.cancelled()) return tl::unexpected(stopped(cancel_));
        if (progress_) progress_(ProgressEvent::titled("download " + name, 0, 1));
        auto unpacked = fetch(name);
        if (!unpacked) {
            if (unpacked.error().code != ErrorCode::kUnreadable)
                return tl::unexpected(unpacked.error());
            report_.unreachable.push_back(unpacked.error().text());
            return {};
        }
        const std::string extracted = (fs::path(work_) / (name + ".pictures")).string();
        WEFT_TRY(pictures, find_package_pictures(name, *unpacked, extracted, cancel_));
        report_.not_named += pictures.not_named;
        report_.looked_wrong += pictures.looked_wrong;
        std::size_t at =
            std::min(static_cast<std::size_t>(std::max(0l, std::strtol(note.c_str(), nullptr, 10))),
                     pictures.photos.size());
        while (at < pictures.photos.size()) {
            if (cancel_.cancelled()) return tl::unexpected(stopped(cancel_));
            const std::size_t n = std::min(kBatch, pictures.photos.size() - at);
            WEFT_CHECK_OK(add_batch(pictures.photos, at, n));
            at += n;
            WEFT_CHECK_OK(library_.set_note(key, std::to_string(at)));
            if (progress_) {
                progress_(ProgressEvent::titled(name, static_cast<std::int64_t>(at),
                                                static_cast<std::int64_t>(pictures.photos.size())));
            }
        }
        WEFT_CHECK_OK(library_.set_note(key, "done"));
        if (!options_.keep_downloads) clean_up(name, extracted, *unpacked);
        return {};
    }

    Expected<std::string> fetch(const std::string& name) {
        const std::string folder = (fs::path(work_) / name).string();
        const std::string mark = folder + ".unpacked";
        if (fs::exists(mark)) return folder;
        WEFT_TRY(info, find_package_info(name));
        WEFT_TRY(deb, download_package(info, work_, cancel_));
        if (progress_) progress_(ProgressEvent::titled("unpack " + name, 0, 1));
        WEFT_CHECK_OK(unpack_package(deb, folder, cancel_));
        WEFT_TRY(made, run_program({"touch", mark}, {}, cancel_));
        (void)made;
        return folder;
    }

    void clean_up(const std::string& name, const std::string& extracted,
                  const std::string& unpacked) const {
        std::error_code ignored;
        fs::remove_all(extracted, ignored);
        fs::remove_all(unpacked, ignored);
        fs::remove(unpacked + ".unpacked", ignored);
        for (const auto& entry : fs::directory_iterator(work_, ignored)) {
            const std::string file = entry.path().filename().string();
            if (file.starts_with(name + "_") && file.ends_with(".deb"))
                fs::remove(entry.path(), ignored);
        }
    }

    Status add_batch(const std::vector<Photo>& photos, std::size_t at, std::size_t n) {
        const ChoiceRules rules{options_.most_per_picture, true};
        std::vector<PhotoSamples> done(n);
        parallel_for(n, [&](std::size_t i) { done[i] = samples_of(photos[at + i], rules); });
        std::vector<NewTexture> samples;
        for (PhotoSamples& photo : done) {
            if (!photo.fault.empty()) {
                // Reasons that contain a path are all counted as "cannot be read".
                ++refused_[photo.fault.size() < 60 ? photo.fault : "cannot be read"];
                continue;
            }
            if (!photos_seen_.add_if_new(photo.picture)) {
                ++report_.duplicates;
                continue;
            }
            ++report_.pictures;
            for (NewTexture& t : photo.samples) {
                if (!samples_seen_.add_if_new(t.pixels)) {
                    ++report_.duplicates;
                    continue;
                }
                samples.push_back(std::move(t));
            }
        }
        WEFT_TRY(added, library_.add(samples));
        report_.samples += added;
        return {};
    }

    TextureLibrary& library_;
    const BuildOptions& options_;
    const CancelToken& cancel_;
    const ProgressFn& progress_;
    std::string work_;
    NearDuplicates photos_seen_, samples_seen_;
    std::map<std::string, int> refused_;
    BuildReport report_;
};

}  // namespace

const std::vector<std::string>& default_texture_packages() {
    static const std::vector<std::string> kPackages{"ufoai-textures", "nexuiz-textures",
                                                    "supertuxkart-data", "openarena-081-textures"};
    return kPackages;
}

Expected<BuildEstimate> estimate_build(const BuildOptions& options) {
    BuildEstimate out;
    std::int64_t unpacked = 0;
    for (const std::string& name : options.packages) {
        const auto info = find_package_info(name);
        if (!info) {
            out.packages.push_back({name, "", 0, false, info.error().text()});
            continue;
        }
        out.packages.push_back({name, info->version, info->download_bytes, true, ""});
        out.download_bytes += info->download_bytes;
        // One package at a time is unpacked, with its pictures beside it; then both are removed.
        const std::int64_t mine = info->download_bytes + 2 * info->unpacked_bytes;
        unpacked = options.keep_downloads ? unpacked + mine : std::max(unpacked, mine);
    }
    out.disk_bytes = unpacked + kSamples_bytes;
    out.minutes = kMinutesPerGigabyte * static_cast<double>(out.download_bytes) / 1e9 + 1.5;
    fs::path folder = work_folder_of(options);
    std::error_code error;
    while (!fs::exists(folder, error) && folder.has_parent_path() && folder != folder.parent_path())
        folder = folder.parent_path();
    const fs::space_info space = fs::space(folder, error);
    if (error) {
        return fail(ErrorCode::kUnreadable,
                    "The folder " + folder.string() + " cannot be read: " + error.message() + ".");
    }
    out.free_bytes = static_cast<std::int64_t>(space.available);
    return out;
}

Expected<BuildReport> build_library(TextureLibrary& library, const BuildOptions& options,
                                    const CancelToken& cancel, const ProgressFn& progress) {
    return Builder(library, options, cancel, progress).run();
}

}  // namespace weft
