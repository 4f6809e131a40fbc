#include "app/exchange/relink.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "engine/media/sequence_pattern.h"
#include "engine/pipeline/sweep.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// A folder tree that is larger is not searched to its end, so that "/" ends in seconds.
constexpr int kMostEntries = 200'000;
constexpr int kMostDepth = 8;

bool is_there(const std::string& path) {
    std::error_code error;
    if (names_library_texture(path) || fs::exists(path, error)) return true;
    const auto pattern = SequencePattern::parse(path);
    if (!pattern || pattern->is_single()) return false;
    const auto frames = pattern->list_frames();
    return frames && !frames->empty();
}

Project inputs_only(const Project& project) {
    Project inputs = project;
    inputs.output.path.clear();
    inputs.output.movie.clear();
    inputs.output.layers_path.clear();
    return inputs;
}

// How many names the ends of both paths have in common.
int common_end(const fs::path& a, const fs::path& b) {
    int count = 0;
    for (auto x = a.end(), y = b.end(); x != a.begin() && y != b.begin(); ++count)
        if (*--x != *--y) break;
    return count;
}

// Collects candidates for the missing paths while a folder tree is walked.
class Candidates {
  public:
    explicit Candidates(const std::vector<std::string>& missing) : missing_(missing) {}

    void visit_file(const fs::path& file) {
        for (const std::string& path : missing_) {
            if (fs::path(path).filename() == file.filename()) {
                offer(path, file);
                continue;
            }
            // Any frame of a sequence stands for the sequence.
            const fs::path pattern_path = file.parent_path() / fs::path(path).filename();
            const auto pattern = SequencePattern::parse(pattern_path.string());
            if (pattern && !pattern->is_single() && pattern->frame_of(file.string()))
                offer(path, pattern_path);
        }
    }
    void visit_folder(const fs::path& folder) {
        for (const std::string& path : missing_)
            if (fs::path(path).filename() == folder.filename()) offer(path, folder);
    }
    [[nodiscard]] const std::map<std::string, fs::path>& best() const { return best_; }

  private:
    void offer(const std::string& missing, const fs::path& found) {
        const auto [at, fresh] = best_.emplace(missing, found);
        if (fresh) return;
        const int before = common_end(at->second, missing), now = common_end(found, missing);
        if (now > before || (now == before && found < at->second)) at->second = found;
    }

    const std::vector<std::string>& missing_;
    std::map<std::string, fs::path> best_;
};

Status walk(const std::string& folder, const CancelToken& cancel, Candidates& candidates) {
    std::error_code error;
    fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied,
                                           error);
    int seen = 0;
    for (const fs::recursive_directory_iterator end; !error && entry != end && seen < kMostEntries;
         entry.increment(error), ++seen) {
        if (cancel.cancelled()) return cancelled(cancel);
        std::error_code ignored;
        if (entry->is_directory(ignored)) {
            candidates.visit_folder(entry->path());
            if (entry.depth() + 1 >= kMostDepth) entry.disable_recursion_pending();
        } else if (entry->is_regular_file(ignored)) {
            candidates.visit_file(entry->path());
        }
    }
    return {};
}

}  // namespace

std::vector<std::string> missing_inputs(const Project& project) {
    std::vector<std::string> out;
    std::set<std::string> seen;
    static_cast<void>(map_paths(inputs_only(project), [&](const std::string& path) {
        if (seen.insert(path).second && !is_there(path)) out.push_back(path);
        return path;
    }));
    return out;
}

Expected<Relinked> relink_inputs(const Project& project, const std::string& folder,
                                 const CancelToken& cancel) {
    std::error_code error;
    if (!fs::is_directory(folder, error))
        return fail(ErrorCode::kMissingFrames, folder + " is not a folder.", "Choose another one.");
    Relinked out;
    const std::vector<std::string> missing = missing_inputs(project);
    Candidates candidates(missing);
    if (!missing.empty()) WEFT_CHECK_OK(walk(folder, cancel, candidates));
    const auto& best = candidates.best();
    for (const std::string& path : missing)
        (best.contains(path) ? out.found : out.missing).push_back(path);
    out.project = map_paths(inputs_only(project), [&](const std::string& path) {
        const auto found = best.find(path);
        return found == best.end() ? path : found->second.string();
    });
    out.project.output = project.output;
    return out;
}

}  // namespace weft
