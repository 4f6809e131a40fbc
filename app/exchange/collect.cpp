#include "app/exchange/collect.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include "app/exchange/kept_textures.h"
#include "app/project/codec/project_file.h"
#include "engine/media/atomic_file.h"
#include "engine/media/sequence_pattern.h"
#include "engine/pipeline/sweep.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// The files that a path of the project names.
Expected<std::vector<fs::path>> files_of(const std::string& path) {
    std::vector<fs::path> files;
    std::error_code error;
    if (fs::is_directory(path, error)) {
        for (const auto& entry : fs::directory_iterator(path, error))
            if (entry.is_regular_file()) files.push_back(entry.path());
    } else if (fs::is_regular_file(path, error)) {
        files.emplace_back(path);
    } else if (const auto pattern = SequencePattern::parse(path);
               pattern && !pattern->is_single()) {
        WEFT_TRY(frames, pattern->list_frames());
        for (const int frame : frames)
            files.emplace_back(pattern->path_for(frame));
    }
    if (files.empty()) {
        return fail(ErrorCode::kMissingFrames, path + " not found.",
                    "Restore it, or change the project.");
    }
    return files;
}

Status copy_whole(const fs::path& from, const fs::path& to, const WriteRule& rule,
                  Collected& collected) {
    WEFT_CHECK_OK(copy_file_atomically(from.string(), to.string(), rule));
    std::error_code error;
    ++collected.files;
    collected.bytes += static_cast<std::int64_t>(fs::file_size(to, error));
    return {};
}

class Collector {
  public:
    /// `total`: how many files progress counts up to. `fresh`: the folder was not there before.
    Collector(fs::path folder, WriteRule rule, CancelToken cancel, const ProgressFn& progress,
              std::int64_t total, bool fresh)
        : folder_(std::move(folder)),
          fresh_(fresh),
          rule_(std::move(rule)),
          cancel_(std::move(cancel)),
          progress_(progress),
          total_(total) {}
    Collector(const Collector&) = delete;
    Collector& operator=(const Collector&) = delete;
    // A project that is not whole is of no use, and its files would be in the way of the next try.
    ~Collector() {
        if (whole_) return;
        std::error_code none;
        for (const fs::path& file : copied_)
            fs::remove(file, none);
        for (const auto& [parent, name] : folders_)
            fs::remove(folder_ / "files" / name, none);  // only where they are empty
        fs::remove(folder_ / "files", none);
        if (fresh_) fs::remove(folder_, none);
    }
    void keep() { whole_ = true; }

    // Inputs of one folder stay together, so equal names from different folders do not collide.
    Expected<std::string> take(const std::string& path) {
        const auto before = taken_.find(path);
        if (before != taken_.end()) return before->second;
        const bool is_folder = fs::is_directory(path);
        const fs::path parent = is_folder ? fs::path(path) : fs::path(path).parent_path();
        auto [place, fresh] = folders_.try_emplace(parent, "");
        if (fresh) {
            std::string name = parent.filename().string();
            if (name.empty() || name == "." || name == "..") name = "files";
            for (int k = 2; !names_.insert(name).second; ++k)
                name = parent.filename().string() + "_" + std::to_string(k);
            place->second = name;
        }
        const fs::path relative = fs::path("files") / place->second;
        std::error_code error;
        WEFT_CHECK_OK(make_folder((folder_ / relative).string(), rule_));
        WEFT_TRY(files, files_of(path));
        for (const fs::path& file : files) {
            if (cancel_.cancelled()) return cancelled(cancel_);
            const fs::path to = folder_ / relative / file.filename();
            if (copied_.contains(to)) continue;
            WEFT_CHECK_OK(copy_whole(file, to, rule_, collected));
            copied_.insert(to);
            ++done_;
            const fs::path credit = file.string() + ".credit.json";
            if (const fs::path beside = folder_ / relative / credit.filename();
                fs::exists(credit, error)) {
                WEFT_CHECK_OK(copy_whole(credit, beside, rule_, collected));
                copied_.insert(beside);
            }
            if (progress_) progress_({WorkStage::kCollect, done_, std::max(done_, total_), 0, 0});
        }
        const std::string out =
            is_folder ? relative.string() : (relative / fs::path(path).filename()).string();
        taken_[path] = out;
        return out;
    }

    Collected collected;

  private:
    fs::path folder_;
    bool fresh_;
    WriteRule rule_;
    CancelToken cancel_;
    const ProgressFn& progress_;
    std::int64_t done_ = 0, total_;
    bool whole_ = false;
    std::map<std::string, std::string> taken_;
    std::map<fs::path, std::string> folders_;
    std::set<std::string> names_;
    std::set<fs::path> copied_;
};

// How many files there are to copy, each counted once; what is missing is found when it is copied.
std::int64_t count_files(const Project& inputs) {
    std::set<fs::path> files;
    (void)map_paths(inputs, [&](const std::string& path) {
        if (!names_library_texture(path))
            if (const auto found = files_of(path)) files.insert(found->begin(), found->end());
        return path;
    });
    return static_cast<std::int64_t>(files.size());
}

}  // namespace

Expected<Collected> collect_project(const Project& project, const std::string& name,
                                    const std::string& folder, const std::string& library,
                                    const WriteLimits& limits, const CancelToken& cancel,
                                    const ProgressFn& progress) {
    const fs::path root(folder);
    const fs::path file = root / name;
    std::error_code error;
    if (fs::exists(file, error)) {
        return fail(ErrorCode::kUsage, file.string() + " exists already.",
                    "Choose another folder.");
    }
    WriteRule rule;
    WEFT_TRY(fence, make_fence(project, limits));
    rule.fence = fence;
    const bool fresh = !fs::exists(root, error);
    WEFT_CHECK_OK(make_folder(folder, rule));
    Project inputs = project;
    inputs.output.path.clear();
    inputs.output.movie.clear();
    inputs.output.layers_path.clear();
    Collector collector(root, rule, cancel, progress, progress ? count_files(inputs) : 0, fresh);
    Status status;
    inputs = map_paths(inputs, [&](const std::string& path) {
        if (!status || names_library_texture(path)) return path;
        auto taken = collector.take(path);
        if (taken) return *taken;
        status = tl::unexpected(taken.error());
        return path;
    });
    WEFT_CHECK_OK(status);
    const auto out = [](const std::string& path) {
        return path.empty() ? path : (fs::path("out") / fs::path(path).filename()).string();
    };
    inputs.output.path = out(project.output.path);
    inputs.output.movie = out(project.output.movie);
    inputs.output.layers_path =
        project.output.layers_path.empty()
            ? ""
            : (fs::path("out/layers") / fs::path(project.output.layers_path).filename()).string();
    WEFT_TRY(kept, keep_library_textures(inputs, file.string(), library, rule));
    WEFT_CHECK_OK(save_project(file.string(), kept, rule));
    collector.keep();
    collector.collected.project = file.string();
    return collector.collected;
}

}  // namespace weft
