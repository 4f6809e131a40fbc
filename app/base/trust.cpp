#include "app/base/trust.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/core/input_file.h"
#include "engine/core/setting.h"
#include "engine/media/atomic_file.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "weft.trusted/1";

// The parent folder of a path, which may not exist yet: absolute and without symbolic links.
std::string folder_of(const std::string& file) {
    return fs::path(real_path(file)).parent_path().string();
}

std::string real_folder(const std::string& folder) {
    return folder_of((fs::path(folder) / "file").string());
}

// Not resolved: on another machine the path may lead through other symbolic links.
void add_folder_of(const std::string& file, std::vector<std::string>& folders) {
    if (file.empty()) return;
    std::error_code ignored;
    const std::string folder = fs::absolute(file, ignored).parent_path().string();
    if (std::find(folders.begin(), folders.end(), folder) == folders.end())
        folders.push_back(folder);
}

bool lies_in(const std::string& path, const std::string& folder) {
    return path == folder || folder == "/" || path.starts_with(folder + "/");
}

}  // namespace

TrustList TrustList::of_user() {
    // Without a home directory no place belongs to the user alone.
    if (const char* given = std::getenv("XDG_CONFIG_HOME"); given && *given == '/')
        return TrustList((fs::path(given) / "weft" / "trusted.json").string());
    if (const char* home = std::getenv("HOME"); home && *home == '/')
        return TrustList((fs::path(home) / ".config" / "weft" / "trusted.json").string());
    return TrustList("");
}

std::vector<TrustedFolder> TrustList::folders() const {
    std::vector<TrustedFolder> out;
    const auto text = file_.empty() ? Expected<std::string>("") : read_file(file_, "The list");
    if (!text) return out;
    const Json json = Json::parse(*text, nullptr, false);
    if (!json.is_object() || json.value("schema", Json()) != kSchema) return out;
    const Json folders = json.value("folders", Json());
    if (!folders.is_array()) return out;
    for (const Json& entry : folders) {
        if (!entry.is_object() || out.size() == kMostFolders) continue;
        const Json path = entry.value("path", Json()), below = entry.value("below", Json());
        if (path.is_string() && below.is_boolean() && path.get<std::string>().starts_with('/'))
            out.push_back({path.get<std::string>(), below.get<bool>()});
    }
    return out;
}

bool TrustList::trusts(const std::string& project_file) const {
    const std::string folder = folder_of(project_file);
    const std::vector<TrustedFolder> all = folders();
    return std::any_of(all.begin(), all.end(), [&](const TrustedFolder& trusted) {
        return trusted.path == folder || (trusted.below && lies_in(folder, trusted.path));
    });
}

Expected<std::string> TrustList::add(const std::string& folder, bool below) {
    std::error_code error;
    if (!fs::is_directory(folder, error)) {
        return fail(ErrorCode::kUnreadable, "Folder " + folder + " not found.",
                    "Give the project's folder.");
    }
    const std::string real = real_folder(folder);
    std::vector<TrustedFolder> all = folders();
    const auto known = std::find_if(all.begin(), all.end(),
                                    [&](const TrustedFolder& f) { return f.path == real; });
    if (known != all.end()) {
        if (known->below || !below) return real;
        all.erase(known);
    }
    all.push_back({real, below});
    if (all.size() > kMostFolders) all.erase(all.begin());
    WEFT_CHECK_OK(write(all));
    return real;
}

Status TrustList::remove(const std::string& folder) {
    const std::string real = real_folder(folder);
    std::vector<TrustedFolder> all = folders();
    if (std::erase_if(all, [&](const TrustedFolder& f) { return f.path == real; }) == 0) {
        return fail(ErrorCode::kUsage, real + " is not in the list of trusted folders.",
                    "Choose one from the list" + by({{setting::kListTrusted}}) + ".");
    }
    return write(all);
}

Status TrustList::write(const std::vector<TrustedFolder>& folders) const {
    if (file_.empty()) {
        return fail(ErrorCode::kUnreadable, "No folder for the list of trusted folders was found.",
                    "Set HOME or XDG_CONFIG_HOME, or trust the project for one run" +
                        by({{setting::kTrustOnce}}) + ".");
    }
    Json list = Json::array();
    for (const TrustedFolder& folder : folders)
        list.push_back({{"path", folder.path}, {"below", folder.below}});
    std::string text;
    try {
        text = Json{{"schema", kSchema}, {"folders", list}}.dump(2) + "\n";
    } catch (const Json::exception&) {
        return fail(
            ErrorCode::kUsage, "The folder's name is not UTF-8 and cannot be stored.",
            "Rename it, or trust the project for one run" + by({{setting::kTrustOnce}}) + ".");
    }
    WEFT_CHECK_OK(make_folder_of(file_, WriteRule::own()));
    return write_file_atomically(file_, text, WriteRule::own());
}

std::vector<std::string> outputs_outside(const Project& project, const std::string& project_file) {
    const std::string folder = folder_of(project_file);
    std::vector<std::string> out;
    for (const std::string& path :
         {project.output.path, project.output.layers_path, project.output.movie}) {
        if (!path.empty() && !lies_in(folder_of(path), folder)) out.push_back(path);
    }
    return out;
}

Status check_trust(const Project& project, const std::string& project_file,
                   const NamedByUser& by_user, const TrustList& trusted) {
    if (project_file.empty() || by_user.trust || !by_user.output_root.empty()) return {};
    Project own = project;
    if (by_user.frames) own.output.path.clear();
    if (by_user.layers) own.output.layers_path.clear();
    if (by_user.movie) own.output.movie.clear();
    const std::vector<std::string> outside = outputs_outside(own, project_file);
    if (outside.empty() || trusted.trusts(project_file)) return {};
    return fail(ErrorCode::kRefused,
                project_file + " writes to " + outside.front() +
                    ", outside its folder, and is not trusted.",
                "Trust its folder once" + by({{setting::kTrustFolder, folder_of(project_file)}}) +
                    ", or allow the output folder for this run" +
                    by({{setting::kOutputRoot, folder_of(outside.front())}}) + ".");
}

std::vector<std::string> output_folders(const Project& project) {
    std::vector<std::string> out;
    for (const std::string& path :
         {project.output.path, project.output.layers_path, project.output.movie})
        add_folder_of(path, out);
    return out;
}

std::vector<std::string> permitted_roots(const Project& project, const std::string& project_file,
                                         const NamedByUser& by_user, const TrustList& trusted) {
    std::vector<std::string> out;
    if (project_file.empty() || by_user.trust || !by_user.output_root.empty() ||
        trusted.trusts(project_file))
        return out;
    add_folder_of(project_file, out);
    if (by_user.frames) add_folder_of(project.output.path, out);
    if (by_user.layers) add_folder_of(project.output.layers_path, out);
    if (by_user.movie) add_folder_of(project.output.movie, out);
    return out;
}

}  // namespace weft
