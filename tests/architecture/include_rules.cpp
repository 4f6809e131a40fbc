#include "tests/architecture/include_rules.h"

#include <algorithm>
#include <cctype>
#include <optional>

namespace weft::architecture {
namespace {

struct Include {
    std::string_view name;
    bool quoted = false;
    int line = 0;
};

/// The include in a line of source, if any.
std::optional<Include> include_of(std::string_view line) {
    const auto skip_blanks = [&] {
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    };
    skip_blanks();
    if (!line.starts_with('#')) return std::nullopt;
    line.remove_prefix(1);
    skip_blanks();
    constexpr std::string_view kWord = "include";
    if (!line.starts_with(kWord)) return std::nullopt;
    line.remove_prefix(kWord.size());
    skip_blanks();
    if (line.empty() || (line[0] != '"' && line[0] != '<')) return std::nullopt;
    const bool quoted = line[0] == '"';
    const std::size_t end = line.find(quoted ? '"' : '>', 1);
    if (end == std::string_view::npos) return std::nullopt;
    return Include{line.substr(1, end - 1), quoted, 0};
}

std::vector<Include> includes_of(std::string_view contents) {
    std::vector<Include> out;
    for (int number = 1; !contents.empty(); ++number) {
        const std::size_t end = std::min(contents.find('\n'), contents.size());
        if (auto include = include_of(contents.substr(0, end))) {
            include->line = number;
            out.push_back(*include);
        }
        contents.remove_prefix(std::min(end + 1, contents.size()));
    }
    return out;
}

/// Returns true if `path` is the file or folder `place`, or inside it.
bool lies_in(std::string_view path, std::string_view place) {
    return path == place ||
           (path.starts_with(place) && path.size() > place.size() && path[place.size()] == '/');
}

bool lies_in_any(std::string_view path, const std::vector<std::string_view>& places) {
    return std::any_of(places.begin(), places.end(),
                       [&](std::string_view place) { return lies_in(path, place); });
}

/// Returns the most specific entry, so that a single file can have its own floor.
const Floor* floor_of(std::string_view path, std::span<const Floor> floors) {
    const Floor* best = nullptr;
    for (const Floor& floor : floors)
        if (lies_in(path, floor.folder) && (!best || floor.folder.size() > best->folder.size()))
            best = &floor;
    return best;
}

bool is_header(std::string_view path) {
    return path.ends_with(".h") || path.ends_with(".hpp") || path.ends_with(".cuh");
}

std::string check_own(std::string_view path, const Include& include, const Floor& floor,
                      std::span<const Floor> floors) {
    const Floor* named = floor_of(include.name, floors);
    // A subfolder with a floor of its own is excluded.
    if (named == &floor || lies_in_any(include.name, floor.may_use)) return {};
    if (!named)
        return "\"" + std::string(include.name) +
               "\" is no file of a known folder; write the path from the root";
    return std::string(floor.folder) + " may not use \"" + std::string(include.name) + "\"" +
           (is_header(path) ? " (in a header)" : "");
}

std::string check_library(std::string_view path, const Include& include,
                          std::span<const Library> libraries) {
    for (const Library& library : libraries) {
        const bool matches =
            std::any_of(library.includes.begin(), library.includes.end(),
                        [&](std::string_view begin) { return include.name.starts_with(begin); });
        if (!matches) continue;
        // A header listed by itself is a deliberate exception.
        const bool named =
            std::find(library.places.begin(), library.places.end(), path) != library.places.end();
        if (!lies_in_any(path, library.places))
            return std::string(library.name) + " may not be used here: <" +
                   std::string(include.name) + ">";
        if (is_header(path) && !library.in_headers && !named)
            return std::string(library.name) + " may not be used in a header: <" +
                   std::string(include.name) + ">";
    }
    return {};
}

}  // namespace

std::vector<std::string> broken_rules(std::string_view path, std::string_view contents,
                                      std::span<const Floor> floors,
                                      std::span<const Library> libraries) {
    const Floor* floor = floor_of(path, floors);
    if (!floor)
        return {
            std::string(path) +
            ": this folder has no floor; give it one in floors_test.cpp and docs/ARCHITECTURE.md"};
    std::vector<std::string> out;
    for (const Include& include : includes_of(contents)) {
        // A library's header may be written in quotes too.
        std::string what = check_library(path, include, libraries);
        if (what.empty() && include.quoted) what = check_own(path, include, *floor, floors);
        if (!what.empty())
            out.push_back(std::string(path) + ":" + std::to_string(include.line) + ": " + what);
    }
    return out;
}

std::vector<std::string> broken_reads(std::string_view path, std::string_view contents,
                                      std::span<const ReadRule> rules) {
    std::vector<std::string> out;
    std::size_t number = 0;
    for (std::size_t start = 0; start < contents.size(); ++number) {
        const std::size_t end = std::min(contents.find('\n', start), contents.size());
        std::string_view line = contents.substr(start, end - start);
        start = end + 1;
        line = line.substr(0, line.find("//"));
        for (const ReadRule& rule : rules) {
            const std::size_t at = line.find(rule.call);
            if (at == std::string_view::npos) continue;
            // "Library::open(" is Weft's function; "::open(" is the system's.
            const bool qualified = at > 0 && rule.call.starts_with("::") &&
                                   (std::isalnum(static_cast<unsigned char>(line[at - 1])) != 0 ||
                                    line[at - 1] == '_');
            const bool guarded = !rule.guard.empty() && contents.find(rule.guard) != contents.npos;
            const bool allowed =
                std::any_of(rule.exceptions.begin(), rule.exceptions.end(),
                            [&](const ReadRule::Exception& e) { return e.file == path; });
            if (qualified || guarded || allowed) continue;
            out.push_back(std::string(path) + ":" + std::to_string(number + 1) + ": " +
                          std::string(rule.call) + " may not be used here; read by " +
                          (rule.guard.empty()
                               ? "engine/core/input_file.h"
                               : "name only after " + std::string(rule.guard) + ")"));
        }
    }
    return out;
}

}  // namespace weft::architecture
