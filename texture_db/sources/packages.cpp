#include "texture_db/sources/packages.h"

#include "engine/core/setting.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "engine/core/child_process.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

std::string last_line(const std::string& text) {
    std::string line, last;
    for (const char c : text) {
        if (c == '\n') {
            if (!line.empty()) last = line;
            line.clear();
        } else {
            line += c;
        }
    }
    return line.empty() ? last : line;
}

std::string field_of(const std::string& text, const std::string& name) {
    const std::string key = "\n" + name + ": ";
    const std::string all = "\n" + text;
    const auto at = all.find(key);
    if (at == std::string::npos) return {};
    return all.substr(at + key.size(), all.find('\n', at + 1) - at - key.size());
}

bool is_package_name(const std::string& name) {
    return !name.empty() && name.size() < 100 &&
           std::isalnum(static_cast<unsigned char>(name[0])) &&
           std::all_of(name.begin(), name.end(), [](char c) {
               return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '+' ||
                      c == '.';
           });
}

}  // namespace

Expected<std::string> run_program(const std::vector<std::string>& arguments,
                                  const std::string& folder, const CancelToken& cancel) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
        return fail(ErrorCode::kNoSpace,
                    std::string("No program can be started: ") + std::strerror(errno) + ".");
    ProcessOptions options;
    options.folder = folder;
    options.output_to = ends[1];
    const auto child = start_process(arguments, options);
    ::close(ends[1]);
    if (!child) {
        ::close(ends[0]);
        if (child.error().code == ErrorCode::kNoSpace) return tl::unexpected(child.error());
        return fail(ErrorCode::kUnreadable,
                    "The program " + arguments[0] +
                        " is not installed. Building from packages needs a Debian system.",
                    "Import images instead" + by({{setting::kImportTextures}}) + ".");
    }
    std::string out;
    bool killed = false;
    for (char buffer[4096];;) {
        pollfd waiting{ends[0], POLLIN, 0};
        const int ready = ::poll(&waiting, 1, 200);
        if (cancel.cancelled() && !killed) {
            ::kill(*child, SIGTERM);
            killed = true;
        }
        if (ready <= 0) continue;
        const ssize_t n = ::read(ends[0], buffer, sizeof buffer);
        if (n <= 0) break;
        if (out.size() < (1u << 20)) out.append(buffer, static_cast<std::size_t>(n));
    }
    ::close(ends[0]);
    const int code = wait_for_process(*child);
    if (killed)
        return fail(static_cast<ErrorCode>(cancel.reason()), arguments[0] + " was stopped.");
    if (code != 0) {
        const bool full = out.find("No space left") != std::string::npos;
        return fail(full ? ErrorCode::kNoSpace : ErrorCode::kUnreadable,
                    arguments[0] + " failed: " + last_line(out));
    }
    return out;
}

Expected<PackageInfo> find_package_info(const std::string& name) {
    if (!is_package_name(name))
        return fail(ErrorCode::kUsage, "'" + name + "' is not the name of a Debian package.");
    auto shown = run_program({"apt-cache", "show", "--no-all-versions", name}, {}, {});
    if (!shown || field_of(*shown, "Version").empty()) {
        return fail(ErrorCode::kUnreadable, "apt has no package " + name + ".",
                    "Run 'apt-get update', or leave it out" + by({{setting::kPackages}}) + "." +
                        (shown ? "" : " (" + shown.error().sentence() + ")"));
    }
    PackageInfo info;
    info.name = name;
    info.version = field_of(*shown, "Version");
    info.download_bytes = std::atoll(field_of(*shown, "Size").c_str());
    info.unpacked_bytes = std::atoll(field_of(*shown, "Installed-Size").c_str()) * 1024;
    return info;
}

Expected<std::string> download_package(const PackageInfo& package, const std::string& folder,
                                       const CancelToken& cancel) {
    const auto there = [&]() -> std::string {
        std::error_code error;
        for (const auto& entry : fs::directory_iterator(folder, error)) {
            const std::string name = entry.path().filename().string();
            if (name.starts_with(package.name + "_") && name.ends_with(".deb") &&
                static_cast<std::int64_t>(entry.file_size(error)) == package.download_bytes)
                return entry.path().string();
        }
        return {};
    };
    if (std::string deb = there(); !deb.empty()) return deb;
    const auto got = run_program({"apt-get", "download", package.name}, folder, cancel);
    if (!got) {
        Error error = got.error();
        if (error.code == ErrorCode::kUnreadable) {
            error.message =
                "The package " + package.name + " cannot be downloaded (" + error.sentence() + ").";
            error.remedy =
                "Check the connection and run the build again: it goes on where it stopped.";
        }
        return tl::unexpected(error);
    }
    std::string deb = there();
    if (deb.empty()) {
        return fail(ErrorCode::kUnreadable, "The download of " + package.name + " is not complete.",
                    "Run the build again.");
    }
    return deb;
}

Status unpack_package(const std::string& deb, const std::string& folder,
                      const CancelToken& cancel) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
        return fail(ErrorCode::kUnreadable,
                    "The folder " + folder + " cannot be created: " + error.message() + ".");
    }
    WEFT_TRY(output, run_program({"dpkg-deb", "-x", deb, folder}, {}, cancel));
    (void)output;
    return {};
}

}  // namespace weft
