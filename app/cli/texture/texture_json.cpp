#include "app/cli/texture/texture_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/cli/answer.h"

namespace weft {
namespace {

using Json = nlohmann::ordered_json;

// Rounds scores to four digits for readability.
double four_digits(float v) {
    return std::round(static_cast<double>(v) * 1e4) / 1e4;
}

Json hit_json(const SearchHit& hit) {
    return {{"id", hit.id},
            {"material", hit.material},
            {"name", hit.name},
            {"score", four_digits(hit.score)},
            {"reasons", hit.reasons}};
}

Json counts(const std::vector<FacetCount>& facets) {
    Json out = Json::object();
    for (const FacetCount& f : facets)
        out[f.value] = f.count;
    return out;
}

Json hits_json(const std::vector<SearchHit>& hits) {
    Json out = Json::array();
    for (const SearchHit& hit : hits)
        out.push_back(hit_json(hit));
    return out;
}

Json suggestion_json(const Suggestion& s) {
    const ScoreTerms& p = s.parts;
    return {{"id", s.id},
            {"material", s.material},
            {"name", s.name},
            {"score", four_digits(s.score)},
            {"reasons", s.reasons},
            {"parts",
             {{"material", four_digits(p.material)},
              {"use", four_digits(p.use)},
              {"colour", four_digits(p.colour)},
              {"style", four_digits(p.style)},
              {"scale", four_digits(p.scale)},
              {"synthesis", four_digits(p.synthesis)},
              {"wish", four_digits(p.adjustment)},
              {"coherence", four_digits(p.coherence)}}}};
}

Json suggestions_json(const std::vector<Suggestion>& suggestions) {
    Json out = Json::array();
    for (const Suggestion& s : suggestions)
        out.push_back(suggestion_json(s));
    return out;
}

Json refused_json(const std::vector<std::pair<std::string, std::string>>& refused) {
    Json out = Json::array();
    for (const auto& [path, why] : refused)
        out.push_back({{"path", path}, {"why", why}});
    return out;
}

Json info_json(const TextureInfo& i) {
    static const char* kNames[]{"brightness",     "saturation", "warmth",    "contrast",
                                "colour_variety", "scale",      "roughness", "regularity",
                                "directionality", "line_angle", "gloss"};
    Json attributes = Json::object();
    for (std::size_t a = 0; a < kTextureAttributes; ++a)
        attributes[kNames[a]] = four_digits(i.measured.attributes.values[a]);
    const LabColor& c = i.measured.mean;
    return {{"id", i.id},
            {"material", i.material},
            {"name", i.name},
            {"category", i.category},
            {"tags", i.tags},
            {"colour", colour_name(c)},
            {"lab", {four_digits(c.l), four_digits(c.a), four_digits(c.b)}},
            {"looks", attribute_words(i.measured)},
            {"attributes", attributes},
            {"origin", name_of(i.origin)},
            {"package", i.package},
            {"source", i.source},
            {"author", i.author},
            {"licence", i.licence},
            {"original_size", {i.original_size.width, i.original_size.height}},
            {"original_in_file", i.original_in_file},
            {"synthesisability", four_digits(i.synthesisability)},
            {"favourite", i.favourite},
            {"rating", i.rating}};
}

}  // namespace

Json to_json(const SearchResult& r) {
    return {{"total", r.total},
            {"results", hits_json(r.hits)},
            {"facets",
             {{"materials", counts(r.materials)},
              {"origins", counts(r.origins)},
              {"packages", counts(r.packages)},
              {"licences", counts(r.licences)},
              {"categories", counts(r.categories)},
              {"colours", counts(r.colours)}}},
            {"understood", r.understood},
            {"ignored", r.ignored},
            {"missing", r.missing},
            {"seconds", r.seconds}};
}

Json to_json(const std::vector<SearchHit>& hits) {
    return {{"results", hits_json(hits)}};
}

Json to_json(const TextureInfo& info) {
    return info_json(info);
}

Json to_json(const LibraryStats& s, const std::string& path) {
    return {{"library", absolute_path(path)},
            {"samples", s.samples},
            {"materials", counts(s.materials)},
            {"origins", counts(s.origins)},
            {"packages", counts(s.packages)},
            {"licences", counts(s.licences)},
            {"bytes", s.file_bytes},
            {"schema", s.schema_version},
            {"descriptor", {{"trained", s.descriptor_trained}, {"samples", s.descriptor_samples}}}};
}

Json to_json(const Recommendation& r) {
    Json regions = Json::array();
    for (const RegionSuggestions& region : r.regions) {
        Json schemes = Json::array();
        for (const SuggestionScheme& s : region.schemes)
            schemes.push_back(
                {{"name", s.name}, {"why", s.why}, {"results", suggestions_json(s.suggestions)}});
        regions.push_back({{"region", region.region},
                           {"seen_as", region.seen_as},
                           {"results", suggestions_json(region.suggestions)},
                           {"schemes", schemes}});
    }
    Json together = Json::array();
    for (const SceneSuggestion& s : r.together)
        together.push_back({{"score", four_digits(s.score)},
                            {"why", s.why},
                            {"results", suggestions_json(s.per_region)}});
    Json out{{"regions", regions}, {"together", together}, {"seconds", r.seconds}};
    if (r.regions.size() == 1) out["results"] = suggestions_json(r.regions[0].suggestions);
    return out;
}

Json to_json(const ImportReport& r) {
    return {{"pictures", r.pictures},
            {"samples", r.samples},
            {"skipped", r.skipped},
            {"refused", refused_json(r.refused)},
            {"seconds", r.seconds}};
}

Json to_json(const BuildReport& r, const LibraryStats& s) {
    Json refused = Json::object();
    for (const auto& [why, count] : r.refused)
        refused[why] = count;
    return {{"samples", s.samples},       {"materials", counts(s.materials)},
            {"added", r.samples},         {"pictures", r.pictures},
            {"not_named", r.not_named},   {"looked_wrong", r.looked_wrong},
            {"duplicates", r.duplicates}, {"outliers", r.outliers},
            {"refused", refused},         {"unreachable", r.unreachable},
            {"seconds", r.seconds}};
}

Json to_json(const BuildEstimate& e) {
    Json packages = Json::array();
    for (const auto& p : e.packages)
        packages.push_back({{"name", p.name},
                            {"version", p.version},
                            {"download_bytes", p.download_bytes},
                            {"fault", p.fault}});
    return {{"packages", packages},
            {"download_bytes", e.download_bytes},
            {"disk_bytes", e.disk_bytes},
            {"free_bytes", e.free_bytes},
            {"minutes", e.minutes}};
}

Json to_json(const std::vector<LibraryFault>& faults) {
    Json list = Json::array();
    for (const LibraryFault& f : faults)
        list.push_back({{"id", f.id}, {"what", f.what}});
    return {{"sound", faults.empty()}, {"faults", list}};
}

Json to_json(const EvaluationReport& report) {
    const auto score = [](const RetrievalScore& s) {
        return Json{{"asked", s.asked},
                    {"first", s.first},
                    {"among_five", s.among_five},
                    {"merged_first", s.merged_first},
                    {"merged_among_five", s.merged_among_five}};
    };
    Json materials = Json::object();
    for (const RetrievalScore& s : report.materials)
        materials[s.material] = score(s);
    return Json{{"samples", report.samples},
                {"left_out", report.left_out},
                {"asked", report.asked},
                {"average", score(report.average)},
                {"materials", materials}};
}

Json credits_json(const std::vector<std::pair<std::string, TextureInfo>>& files) {
    Json out = Json::array();
    for (const auto& [file, info] : files) {
        Json entry{{"file", file}};
        entry.update(info_json(info));
        out.push_back(entry);
    }
    return out;
}

}  // namespace weft
