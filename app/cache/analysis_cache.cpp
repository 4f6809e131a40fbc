#include "app/cache/analysis_cache.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <shared_mutex>

#include "app/base/guarded.h"
#include "app/cache/analysis_key.h"
#include "app/cache/blob_file.h"
#include "app/shot/shot_inputs.h"
#include "engine/core/setting.h"
#include "engine/media/atomic_file.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLockName = "analysing.lock";

// Creates the folders of the regions below `root` and marks them as just used.
Status make_folders(const fs::path& root, const std::set<std::string>& names) {
    std::error_code error;
    for (const std::string& name : names) {
        const fs::path folder = root / name;
        fs::create_directories(folder, error);
        if (error) {
            return fail(
                ErrorCode::kNoSpace,
                "The folder " + folder.string() + " cannot be created: " + error.message() + ".",
                "Free disk space, or choose another folder" + by({{setting::kCache}}) + ".");
        }
        fs::last_write_time(folder, fs::file_time_type::clock::now(), error);
        remove_stale_temporaries((folder / "blob").string());
    }
    return {};
}

std::set<std::string> folder_names(const std::vector<RegionKeys>& regions) {
    std::set<std::string> out;
    for (const RegionKeys& keys : regions)
        for (const std::string& name : keys.all())
            out.insert(name);
    return out;
}

const char* kind_name(AnalysisKind kind) {
    switch (kind) {
        case AnalysisKind::kMatteForward:
            return "matte-forward";
        case AnalysisKind::kMatteBackward:
            return "matte-backward";
        case AnalysisKind::kMatte:
            return "matte";
        case AnalysisKind::kCoords:
            return "coords";
        case AnalysisKind::kCoordsOneWay:
            return "coords-one-way";
        case AnalysisKind::kTrackBefore:
            return "track-before";
        case AnalysisKind::kTrackAfter:
            return "track-after";
        case AnalysisKind::kHeldBetween:
            return "held-between";
        case AnalysisKind::kHidingFrames:
            return "hiding-frames";
        case AnalysisKind::kLightSample:
            return "light-sample";
        case AnalysisKind::kShading:
            return "shading";
        case AnalysisKind::kForm:
            return "form";
        case AnalysisKind::kStillSurface:
            return "still-surface";
        case AnalysisKind::kGrain:
            return "grain";
        case AnalysisKind::kShutter:
            return "shutter";
        case AnalysisKind::kFocus:
            return "focus";
        case AnalysisKind::kPaperTexture:
            return "paper";
    }
    return "";
}

class DiskStore final : public AnalysisCache {
  public:
    DiskStore(fs::path root, std::vector<RegionKeys> keys,
              std::optional<TemporaryFolder> private_root, bool required)
        : root_(std::move(root)),
          keys_(std::move(keys)),
          private_root_(std::move(private_root)),
          may_overflow_(!private_root_ && !required) {}

    // Returns true for an intact blob; a damaged one is computed again. What was found intact is
    // asked for often, and not read again.
    [[nodiscard]] bool has(const AnalysisKey& key) const override {
        {
            const std::shared_lock names(names_);
            const std::string path = path_of(key).string();
            std::error_code error;
            if (intact_.lock()->contains(path) && fs::exists(path, error)) return true;
        }
        return get(key).has_value();
    }

    [[nodiscard]] Status put(const AnalysisKey& key, const Bytes& bytes) override {
        const std::shared_lock names(names_);
        const fs::path path = path_of(key);
        if (overflow_folder().empty() && write_blob(path.string(), bytes)) {
            intact_.lock()->insert(path.string());
            return {};
        }
        intact_.lock()->erase(path.string());
        if (const auto overflow = open_overflow();
            overflow && write_blob((*overflow / overflow_name(key)).string(), bytes))
            return {};
        return fail(ErrorCode::kNoSpace,
                    "The analysis cache " + path.parent_path().string() + " cannot be written.",
                    "Free disk space, or choose another folder" + by({{setting::kCache}}) + ".");
    }

    [[nodiscard]] Expected<Bytes> get(const AnalysisKey& key) const override {
        const std::shared_lock names(names_);
        // Prefer the overflow folder: its blob is newer than one in the cache that could not be
        // replaced.
        if (const fs::path overflow = overflow_folder(); !overflow.empty()) {
            if (auto bytes = read_blob((overflow / overflow_name(key)).string()))
                return std::move(*bytes);
        }
        const std::string path = path_of(key).string();
        auto bytes = read_blob(path);
        if (bytes) {
            intact_.lock()->insert(path);
            return std::move(*bytes);
        }
        intact_.lock()->erase(path);
        return missing(key);
    }

    void mattes_written(const Shot& shot) override {
        const std::unique_lock names(names_);
        for (std::size_t k = 0; k < keys_.size(); ++k) {
            if (!all_written(shot, k)) continue;
            const auto written = region_keys(shot, k, {});
            if (!written) continue;
            keys_[k].adopt(*written, [this](const std::string& from, const std::string& to) {
                return move_folder(from, to);
            });
        }
    }

    // In one order everywhere, so that no two wait for each other.
    [[nodiscard]] std::optional<AnalysisClaim> try_claim() const override {
        const std::shared_lock names(names_);
        AnalysisClaim out;
        for (const std::string& name : folder_names(keys_)) {
            const std::string path = (root_ / name / kLockName).string();
            // It may be there already, or nowhere: then nobody is excluded.
            static_cast<void>(write_file_atomically(path, std::string_view(), WriteRule{}));
            auto lock = FileLock::take(path, std::chrono::milliseconds(0));
            if (!lock) return std::nullopt;
            out.push_back(std::move(*lock));
        }
        return out;
    }

    [[nodiscard]] std::vector<std::string> remarks() const override {
        const std::shared_lock names(names_);
        if (overflow_folder().empty()) return {};
        return {"The cache folder " + root_.string() +
                " cannot be written any more (is the disk full?); the rest of this analysis will "
                "not be kept."};
    }

  private:
    // Returns whether the results are in the folder `to` now. What is there already was computed
    // from the same files; regions may share a folder.
    [[nodiscard]] bool move_folder(const std::string& from, const std::string& to) const {
        std::error_code error;
        if (from == to || fs::exists(root_ / to, error)) return true;
        fs::rename(root_ / from, root_ / to, error);
        return !error;
    }
    [[nodiscard]] static bool all_written(const Shot& shot, std::size_t index) {
        const Region& region = *shot.project.regions[shot.region_index[index]];
        const auto is_there = [&](const std::string& path) {
            std::error_code error;
            return !shot.painted.contains(path) || fs::exists(path, error);
        };
        const auto written = [&](const MatteSource& source) {
            return std::all_of(source.keyframes.begin(), source.keyframes.end(),
                               [&](const auto& key) { return is_there(key.second.path); }) &&
                   std::all_of(source.confirmed.begin(), source.confirmed.end(),
                               [&](const auto& edge) {
                                   return is_there(edge.second.path) && is_there(edge.second.area);
                               });
        };
        return written(*region.matte) &&
               std::all_of(region.holdouts->begin(), region.holdouts->end(), written) &&
               std::all_of(region.zones->begin(), region.zones->end(),
                           [&](const Zone& zone) { return written(zone.matte); });
    }
    [[nodiscard]] fs::path overflow_folder() const {
        const std::lock_guard lock(mutex_);
        return overflow_ ? fs::path(overflow_->path()) : fs::path();
    }
    // Used from the first failure on, because a full disk is likely to fill up again.
    [[nodiscard]] std::optional<fs::path> open_overflow() {
        const std::lock_guard lock(mutex_);
        if (!overflow_ && may_overflow_) {
            if (auto made = TemporaryFolder::create()) overflow_.emplace(std::move(*made));
        }
        if (!overflow_) return std::nullopt;
        return fs::path(overflow_->path());
    }
    [[nodiscard]] static std::string overflow_name(const AnalysisKey& key) {
        return std::to_string(key.region) + "." + blob_name(key);
    }
    [[nodiscard]] static std::string blob_name(const AnalysisKey& key) {
        std::string layer;
        if (is_zone_layer(key.layer))
            layer = "-zone" + std::to_string(zone_of_layer(key.layer) + 1);
        else if (key.layer > 0)
            layer = "-in-front" + std::to_string(key.layer);
        return kind_name(key.kind) + layer + "." + std::to_string(key.frame);
    }
    [[nodiscard]] fs::path path_of(const AnalysisKey& key) const {
        return root_ / keys_[static_cast<std::size_t>(key.region)].of(key) / blob_name(key);
    }
    static tl::unexpected<Error> missing(const AnalysisKey& key) {
        return fail(
            ErrorCode::kRenderFailed,
            "The cached analysis of frame " + std::to_string(key.frame) + " is missing or damaged.",
            "Render again.");
    }

    const fs::path root_;
    // protects the folder names; locked for writing while they are renamed
    mutable std::shared_mutex names_;
    std::vector<RegionKeys> keys_;
    std::optional<TemporaryFolder> private_root_;  // deleted with the store
    bool may_overflow_ = false;
    Guarded<std::set<std::string>> intact_;  // paths of blobs that were read or written
    mutable std::mutex mutex_;
    std::optional<TemporaryFolder> overflow_;  // used when the cache's disk is full
};

fs::path default_folder() {
    if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg && *xdg) return fs::path(xdg) / "weft";
    if (const char* home = std::getenv("HOME"); home && *home)
        return fs::path(home) / ".cache" / "weft";
    return {};
}

bool writable(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    return !error && access(folder.c_str(), W_OK | X_OK) == 0;
}

// Deletes the least recently used analyses until the rest fits the limit, except those in use.
void prune(const fs::path& root, const std::set<std::string>& in_use, std::uint64_t limit_bytes) {
    struct Entry {
        fs::file_time_type used;
        std::uint64_t bytes;
        fs::path path;
    };
    std::vector<Entry> entries;
    std::uint64_t total = 0;
    std::error_code error;
    for (const auto& folder : fs::directory_iterator(root, error)) {
        Entry entry{fs::last_write_time(folder.path(), error), 0, folder.path()};
        if (folder.is_regular_file(error)) entry.bytes = folder.file_size(error);
        for (const auto& file : fs::directory_iterator(folder.path(), error)) {
            entry.bytes += file.is_regular_file(error) ? file.file_size(error) : 0;
        }
        total += entry.bytes;
        if (!in_use.contains(entry.path.filename().string())) entries.push_back(entry);
    }
    std::sort(entries.begin(), entries.end(),
              [](const Entry& a, const Entry& b) { return a.used < b.used; });
    for (const Entry& entry : entries) {
        if (total <= limit_bytes) return;
        fs::remove_all(entry.path, error);
        total -= entry.bytes;
    }
}

}  // namespace

std::string cache_root(const AnalysisCacheOptions& options) {
    return options.folder.empty() ? default_folder().string() : options.folder;
}

std::string fingerprint_folder(const std::string& cache) {
    return (fs::path(cache) / "fingerprints").string();
}

std::shared_ptr<Fingerprints> open_fingerprints(const AnalysisCacheOptions& options) {
    const std::string root = options.keep ? cache_root(options) : std::string();
    return std::make_shared<Fingerprints>(root.empty() ? root : fingerprint_folder(root));
}

Expected<std::shared_ptr<AnalysisCache>> open_analysis_cache(const Shot& shot,
                                                             const AnalysisCacheOptions& options,
                                                             std::vector<std::string>& warnings) {
    fs::path root = cache_root(options);
    bool keep = options.keep;
    if (keep && !root.empty()) root /= "analysis";
    if (keep && (root.empty() || !writable(root))) {
        if (!options.folder.empty()) {
            return fail(ErrorCode::kUnreadable,
                        "The cache folder " + options.folder + " cannot be written.",
                        "Choose another" + by({{setting::kCache}}) + ".");
        }
        warnings.push_back("The cache folder cannot be written; this analysis will not be kept.");
        keep = false;
    }
    WEFT_TRY(inputs, input_files(shot));
    shot.files->look_at(inputs);
    shot.files->save();
    std::vector<RegionKeys> keys;
    for (std::size_t k = 0; k < shot.plan.regions.size(); ++k) {
        WEFT_TRY(of_region, region_keys(shot, k, shot.painted));
        keys.push_back(std::move(of_region));
    }
    const std::set<std::string> folders = folder_names(keys);
    if (keep) {
        const Status made = make_folders(root, folders);
        if (!made && options.required) return tl::unexpected(made.error());
        if (!made) {
            warnings.push_back("The cache folder " + root.string() +
                               " cannot be written (is the disk full?); this analysis will not be "
                               "kept.");
            keep = false;
        }
    }
    std::optional<TemporaryFolder> private_root;
    if (!keep) {
        WEFT_TRY(folder, TemporaryFolder::create());
        root = folder.path();
        WEFT_CHECK_OK(make_folders(root, folders));
        private_root.emplace(std::move(folder));
    }
    if (keep) {
        prune(root, folders, options.limit_bytes);
        // Motion gets a larger limit than planes, which are synthesized again in seconds.
        prune(root.parent_path() / "motion", {}, options.limit_bytes / 2);
        prune(root.parent_path() / "planes", {}, options.limit_bytes / 16);
        prune(root.parent_path() / "fingerprints", {}, options.limit_bytes / 256);
    }
    return std::make_shared<DiskStore>(std::move(root), std::move(keys), std::move(private_root),
                                       options.required);
}

}  // namespace weft
