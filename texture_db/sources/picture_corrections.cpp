#include "texture_db/sources/picture_corrections.h"

#include <algorithm>
#include <map>
#include <set>

namespace weft {
namespace {

struct Corrections {
    std::map<std::string, std::string, std::less<>> materials;  // By "package\tpath".
    std::set<std::string, std::less<>> packages;
};

Corrections read_corrections(std::string_view text) {
    Corrections out;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const std::size_t first = line.find('\t'), last = line.rfind('\t');
        if (line.empty() || line.front() == '#' || first == last) continue;
        out.packages.emplace(line.substr(0, first));
        out.materials.emplace(line.substr(0, last), line.substr(last + 1));
    }
    return out;
}

const Corrections& corrections() {
    static const Corrections kCorrections = read_corrections(pictures_looked_at());
    return kCorrections;
}

}  // namespace

std::optional<std::string> corrected_material(const std::string& package,
                                              const std::string& source) {
    const auto& all = corrections().materials;
    const auto at = all.find(package + '\t' + source);
    return at == all.end() ? std::nullopt : std::optional(at->second);
}

bool was_inspected(const std::string& package) {
    return corrections().packages.contains(package);
}

}  // namespace weft
