#include "app/base/folder_lister.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>

#include "app/base/background.h"
#include "engine/media/plates.h"
#include "engine/media/sequence_pattern.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

struct Run {
    int first = 0, last = 0, count = 0;
    std::string first_file;
};

// The name with its last number replaced by placeholders; empty if there is no number.
std::string pattern_of(const std::string& name, int& number) {
    const std::size_t stem = fs::path(name).stem().string().size();
    std::size_t end = stem;
    while (end > 0 && !std::isdigit(static_cast<unsigned char>(name[end - 1])))
        --end;
    std::size_t begin = end;
    while (begin > 0 && std::isdigit(static_cast<unsigned char>(name[begin - 1])))
        --begin;
    if (begin == end || end - begin > 9) return {};
    number = std::stoi(name.substr(begin, end - begin));
    return name.substr(0, begin) + std::string(end - begin, '#') + name.substr(end);
}

bool before(const FolderEntry& a, const FolderEntry& b) {
    const bool folder_a = a.kind == EntryKind::kFolder, folder_b = b.kind == EntryKind::kFolder;
    if (folder_a != folder_b) return folder_a;
    return std::lexicographical_compare(a.name.begin(), a.name.end(), b.name.begin(), b.name.end(),
                                        [](char x, char y) {
                                            return std::tolower(static_cast<unsigned char>(x)) <
                                                   std::tolower(static_cast<unsigned char>(y));
                                        });
}

}  // namespace

Expected<std::vector<FolderEntry>> list_folder(const std::string& folder) {
    std::vector<FolderEntry> out;
    std::map<std::string, Run> runs;
    std::error_code error;
    fs::directory_iterator it(folder, error);
    for (const fs::directory_iterator end; !error && it != end; it.increment(error)) {
        const std::string name = it->path().filename().string(), path = it->path().string();
        if (name.starts_with('.')) continue;
        std::error_code ignored;
        FolderEntry entry{EntryKind::kOther, name, path, {}, {}};
        if (it->is_directory(ignored)) {
            entry.kind = EntryKind::kFolder;
        } else if (name.ends_with(".weft")) {
            entry.kind = EntryKind::kProject;
            entry.detail = "Project";
        } else if (has_movie_extension(name)) {
            entry.kind = EntryKind::kMovie;
            entry.detail = "Movie";
        } else if (has_picture_extension(name)) {
            int number = 0;
            const std::string pattern = pattern_of(name, number);
            if (!pattern.empty()) {
                Run& run = runs[pattern];
                if (run.count++ == 0 || number < run.first) {
                    run.first = number;
                    run.first_file = path;
                }
                run.last = run.count == 1 ? number : std::max(run.last, number);
                continue;
            }
            entry.kind = EntryKind::kPicture;
            entry.preview = path;
        } else {
            continue;
        }
        out.push_back(std::move(entry));
    }
    if (error) {
        if (error == std::errc::no_such_file_or_directory)
            return fail(ErrorCode::kUnreadable, "There is no folder " + folder + ".");
        return fail(ErrorCode::kUnreadable,
                    "The folder " + folder + " cannot be read: " + error.message() + ".",
                    "Check its permissions.");
    }
    for (const auto& [pattern, run] : runs) {
        FolderEntry entry;
        entry.preview = run.first_file;
        if (run.count == 1) {
            entry.kind = EntryKind::kPicture;
            entry.name = fs::path(run.first_file).filename().string();
            entry.path = run.first_file;
        } else {
            entry.kind = EntryKind::kSequence;
            entry.name = pattern;
            entry.path = (fs::path(folder) / pattern).string();
            entry.detail = std::to_string(run.first) + "–" + std::to_string(run.last) + ", " +
                           std::to_string(run.count) + " frames";
            const int missing = run.last - run.first + 1 - run.count;
            if (missing > 0) entry.detail += ", " + std::to_string(missing) + " missing";
        }
        out.push_back(std::move(entry));
    }
    std::sort(out.begin(), out.end(), before);
    return out;
}

FolderLister::Listed FolderLister::listed(const std::string& path) {
    std::error_code none;
    if (fs::is_regular_file(path, none))
        return {list_folder(fs::path(path).parent_path().string()), path};
    auto here = list_folder(path);
    const std::string begins = fs::path(path).filename().string();
    if (here || begins.empty() || fs::exists(path, none)) return {std::move(here), {}};
    auto beside = list_folder(fs::path(path).parent_path().string());
    if (!beside) return {std::move(here), {}};
    const auto same = [](unsigned char a, unsigned char b) {
        return std::tolower(a) == std::tolower(b);
    };
    std::erase_if(*beside, [&](const FolderEntry& entry) {
        return entry.name.size() < begins.size() ||
               !std::equal(begins.begin(), begins.end(), entry.name.begin(), same);
    });
    if (beside->empty()) return {std::move(here), {}};
    return {std::move(beside), {}, true};
}

const std::vector<FolderEntry>* FolderLister::entries(const std::string& folder) {
    if (pending_.valid() &&
        pending_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
        auto [found, file, completes] = pending_.get();
        ready_ = found.has_value();
        error_ = found ? std::string() : found.error().text();
        entries_ = found ? std::move(*found) : std::vector<FolderEntry>{};
        file_ = std::move(file);
        completes_ = completes;
    }
    if (folder != folder_ && !pending_.valid()) {
        folder_ = folder;
        ready_ = false;
        error_.clear();
        file_.clear();
        completes_ = false;
        pending_ = in_background([folder] { return listed(folder); });
    }
    return ready_ && folder == folder_ ? &entries_ : nullptr;
}

}  // namespace weft
