#include "engine/media/write_rule.h"

#include "engine/core/setting.h"

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>

namespace weft {
namespace {

namespace fs = std::filesystem;

std::string real_folder(const fs::path& folder) {
    std::error_code error;
    const fs::path absolute = fs::absolute(folder.empty() ? fs::path(".") : folder, error);
    const fs::path real = fs::weakly_canonical(absolute, error);
    std::string out = (error ? absolute.lexically_normal() : real).string();
    while (out.size() > 1 && out.back() == '/')
        out.pop_back();
    return out;
}

bool lies_in(const std::string& path, const std::string& folder) {
    return path == folder || folder == "/" || path.starts_with(folder + "/");
}

std::optional<std::pair<dev_t, ino_t>> identity_of(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
    return std::pair{status.st_dev, status.st_ino};
}

Error outside(const std::string& path, const std::string& root) {
    return {ErrorCode::kUsage,
            path + " is outside the output root " + root + ".",
            "Choose a path inside it, or another root" + by({{setting::kOutputRoot}}) + ".",
            {}};
}

}  // namespace

Error exists_already(const std::string& path) {
    return {ErrorCode::kUsage,
            path + " exists already.",
            "Overwrite it" + by({{setting::kOverwrite}}) + ", or use another name.",
            {}};
}

std::string real_path(const std::string& path) {
    const fs::path whole(path);
    return (fs::path(real_folder(whole.parent_path())) / whole.filename()).string();
}

Status WriteFence::add_root(const std::string& folder) {
    std::error_code error;
    if (fs::exists(folder, error) && !fs::is_directory(folder, error)) {
        return fail(ErrorCode::kUsage, "The output root " + folder + " is a file.",
                    "Give a folder" + by({{setting::kOutputRoot}}) + ".");
    }
    roots_.push_back(real_folder(folder));
    return {};
}

bool WriteFence::allows(const std::string& real_folder) const {
    return roots_.empty() || std::any_of(roots_.begin(), roots_.end(), [&](const auto& root) {
               return lies_in(real_folder, root);
           });
}

// The frames of a sequence share a folder, and resolving it checks each of its parents.
std::string WriteFence::real_name(const std::string& path) {
    const fs::path whole(path);
    const fs::path folder = whole.parent_path();
    auto [at, fresh] = real_folders_.try_emplace(folder.string());
    if (fresh) at->second = real_folder(folder);
    return (fs::path(at->second) / whole.filename()).string();
}

void WriteFence::protect(const std::string& path) {
    if (path.empty()) return;
    const std::string real = real_name(path);
    names_.insert(real);
    if (const auto identity = identity_of(real)) files_.insert(*identity);
}

void WriteFence::protect_frames(const SequencePattern& pattern) {
    if (pattern.is_single()) return protect(pattern.text());
    const fs::path whole(real_name(pattern.text()));
    // Only the name, because a folder may contain what looks like a second placeholder.
    if (auto name = SequencePattern::parse(whole.filename().string()))
        frames_.push_back({whole.parent_path().string(), std::move(*name)});
}

Status WriteFence::check(const std::string& shown, const std::string& real) const {
    const fs::path whole(real);
    const std::string folder = whole.parent_path().string(), name = whole.filename().string();
    bool input = names_.contains(real);
    for (const Frames& frames : frames_)
        input = input || (frames.folder == folder && frames.name.frame_of(name));
    if (const auto identity = identity_of(real); identity && !input)
        input = files_.contains(*identity);
    if (input) {
        return fail(ErrorCode::kUsage, shown + " is an input of this run and would be overwritten.",
                    "Choose another name or folder.");
    }
    if (!allows(folder)) return tl::unexpected(outside(shown, roots_.front()));
    return {};
}

Status WriteFence::check_folder(const std::string& folder) const {
    if (allows(real_folder(folder))) return {};
    return tl::unexpected(outside(folder, roots_.front()));
}

}  // namespace weft
