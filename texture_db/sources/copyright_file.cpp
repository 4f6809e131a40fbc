#include "texture_db/sources/copyright_file.h"

#include <fnmatch.h>

#include <algorithm>
#include <cctype>

#include "engine/core/text.h"
#include "texture_db/describe/material_words.h"

namespace weft {
namespace {

std::string trimmed(std::string text) {
    const auto space = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
    while (!text.empty() && space(text.back()))
        text.pop_back();
    std::size_t at = 0;
    while (at < text.size() && space(text[at]))
        ++at;
    return text.substr(at);
}

// "© 2003-2010 Jane Doe <jane@x>" → "Jane Doe".
std::string holder(std::string line) {
    line = trimmed(std::move(line));
    for (const std::string_view sign : {"©", "(c)", "(C)", "Copyright"}) {
        if (const auto at = line.find(sign); at != std::string::npos) line.erase(at, sign.size());
    }
    if (const auto mail = line.find('<'); mail != std::string::npos) line.erase(mail);
    line = trimmed(std::move(line));
    std::size_t at = 0;
    while (at < line.size() && (std::isdigit(static_cast<unsigned char>(line[at])) ||
                                line[at] == '-' || line[at] == ',' || line[at] == ' '))
        ++at;
    // A name that begins with a digit is not a year.
    if (at >= 4) line.erase(0, at);
    while (!line.empty() && (line.back() == ',' || line.back() == '.'))
        line.pop_back();
    return trimmed(std::move(line));
}

std::string authors_of(const std::vector<std::string>& lines) {
    std::string out;
    int count = 0;
    for (const std::string& line : lines) {
        const std::string name = holder(line);
        if (name.empty() || out.find(name) != std::string::npos) continue;
        if (++count > 4) return out + " and others";
        out += (out.empty() ? "" : ", ") + name;
    }
    return out;
}

FileLicence of_free_text(std::string_view text) {
    FileLicence out{"", "unknown"};
    const std::string lower = lower_case(text);
    const bool later = lower.find("or (at your option) any later") != std::string::npos ||
                       lower.find("or any later version") != std::string::npos ||
                       lower.find("any later version") != std::string::npos;
    if (lower.find("general public license") != std::string::npos ||
        lower.find("gpl") != std::string::npos) {
        const bool three = lower.find("version 3") != std::string::npos;
        out.licence = std::string("GPL-") + (three ? "3" : "2") + (later ? "+" : "");
    }
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string line(text.substr(at, end - at));
        if (const auto sign = line.find("©"); sign != std::string::npos) {
            out.author = holder(line.substr(sign));
            break;
        }
        at = end + 1;
    }
    return out;
}

}  // namespace

CopyrightFile CopyrightFile::parse(std::string_view text) {
    CopyrightFile out;
    if (text.find("Files:") == std::string_view::npos) {
        out.paragraphs_.push_back({{"*"}, of_free_text(text)});
        return out;
    }
    std::string field;
    std::vector<std::string> files, copyright;
    std::string licence;
    const auto finish = [&] {
        Paragraph p;
        for (const std::string& line : files) {
            for (std::string& word : split_words(line))
                p.patterns.push_back(std::move(word));
        }
        if (!p.patterns.empty()) {
            p.licence = {authors_of(copyright), licence.empty() ? "unknown" : licence};
            out.paragraphs_.push_back(std::move(p));
        }
        files.clear();
        copyright.clear();
        licence.clear();
        field.clear();
    };
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        std::string line(text.substr(at, end - at));
        at = end + 1;
        if (!line.empty() && line.back() == '\r') line.pop_back();
        if (trimmed(line).empty()) {
            finish();
            continue;
        }
        const bool goes_on = line[0] == ' ' || line[0] == '\t';
        if (!goes_on) {
            const auto colon = line.find(':');
            field = lower_case(line.substr(0, colon));
            line = colon == std::string::npos ? std::string() : line.substr(colon + 1);
        }
        if (field == "files") files.push_back(line);
        if (field == "copyright") copyright.push_back(line);
        if (field == "license" && !goes_on) licence = trimmed(line);
    }
    finish();
    return out;
}

FileLicence CopyrightFile::of(std::string_view path) const {
    const std::string name(path);
    FileLicence best{"", "unknown"};
    for (const Paragraph& p : paragraphs_) {
        const bool fits =
            std::any_of(p.patterns.begin(), p.patterns.end(), [&](const std::string& pattern) {
                if (::fnmatch(pattern.c_str(), name.c_str(), 0) == 0) return true;
                // The pattern may begin with folders that the package left out, or the other way
                // round.
                for (std::size_t at = pattern.find('/'); at != std::string::npos;
                     at = pattern.find('/', at + 1)) {
                    const char* rest = pattern.c_str() + at + 1;
                    if (*rest && *rest != '*' && ::fnmatch(rest, name.c_str(), 0) == 0) return true;
                }
                for (std::size_t at = name.find('/'); at != std::string::npos;
                     at = name.find('/', at + 1)) {
                    if (pattern.find('/') != std::string::npos &&
                        ::fnmatch(pattern.c_str(), name.c_str() + at + 1, 0) == 0)
                        return true;
                }
                return false;
            });
        if (fits) best = p.licence;
    }
    return best;
}

}  // namespace weft
