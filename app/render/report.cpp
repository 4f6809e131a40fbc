#include "app/render/report.h"

#include <nlohmann/json.hpp>

#include "app/project/parameters.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

using Json = nlohmann::ordered_json;

Json value_json(const ParameterInfo& info, const ParameterValue& value) {
    return std::visit(
        [&](const auto& v) -> Json {
            using T = std::decay_t<decltype(v)>;
            if constexpr (std::is_same_v<T, std::monostate>) {
                return nullptr;
            } else if constexpr (std::is_same_v<T, KeyedNumbers> ||
                                 std::is_same_v<T, std::vector<Lamp>> ||
                                 std::is_same_v<T, GridWarp> ||
                                 std::is_same_v<T, std::vector<FormGuide>>) {
                return format_parameter(info, value);
            } else {
                return v;
            }
        },
        value);
}

template <class Owner>
Json settings_of(const Owner& owner, std::span<const Parameter<Owner>> table) {
    Json out = Json::object();
    for (const auto& parameter : table)
        out[parameter.full_key()] = value_json(parameter, parameter.read(owner));
    return out;
}

Json plane_json(const PlaneStats& stats) {
    return {{"seconds",
             {{"search", stats.search_s},
              {"seam", stats.seam_s},
              {"refine", stats.refine_s},
              {"other", stats.other_s},
              {"total", stats.total_s}}},
            {"seam_energy", stats.seam_energy},
            {"seam_length_px", stats.seam_length_px},
            {"seam_energy_per_area", stats.seam_energy_per_area},
            {"peak_graph_bytes", stats.peak_graph_bytes},
            {"placements", stats.placements},
            {"refinements", stats.refinements},
            {"on_lattice", !stats.lattice.empty()}};
}

void add_credit(const ShotTexture& texture, Json& entry) {
    entry["author"] = texture.author.empty() ? "unknown" : texture.author;
    entry["licence"] = texture.licence.empty() ? "unknown" : texture.licence;
    if (!texture.source.empty()) entry["source"] = texture.source;
    if (!texture.library_id.empty()) entry["library_id"] = texture.library_id;
}

Json textures_json(const JobResult& result) {
    Json out = Json::array();
    for (std::size_t k = 0; k < result.textures.size(); ++k) {
        const ShotTexture& t = result.textures[k];
        Json entry{{"region", t.region},
                   {"path", t.path},
                   {"id", t.id},
                   {"size", {t.size.width, t.size.height}},
                   {"space", result.spaces.textures[k].name},
                   {"kind", t.is_plane ? "plane" : "sample"}};
        if (!t.sample_reason.empty()) {
            entry["sample_kind"] = kind_name(t.sample_kind);
            entry["sample_reason"] = t.sample_reason;
        }
        add_credit(t, entry);
        for (const ShotTexture& further : t.also) {
            Json sample{{"path", further.path},
                        {"id", further.id},
                        {"size", {further.size.width, further.size.height}}};
            add_credit(further, sample);
            entry["also"].push_back(std::move(sample));
        }
        if (k < result.planes.size() && result.planes[k])
            entry["synthesis"] = plane_json(*result.planes[k]);
        out.push_back(std::move(entry));
    }
    return out;
}

Json references_json(const JobResult& result) {
    Json out = Json::array();
    if (!result.shot) return out;
    const Shot& shot = *result.shot;
    for (std::size_t k = 0; k < shot.references.size(); ++k)
        out.push_back({{"region", shot.project.regions[shot.region_index[k]]->name},
                       {"frame", shot.references[k].frame},
                       {"chosen", shot.references[k].by_default}});
    return out;
}

Json forms_json(const JobResult& result) {
    Json out = Json::array();
    for (const FormReport& form : result.forms)
        out.push_back(form_json(form));
    return out;
}

Json lights_json(const JobResult& result) {
    Json out = Json::array();
    for (const LightReport& light : result.lights)
        out.push_back(light_json(light));
    return out;
}

Json frames_json(const JobResult& result) {
    Json out = Json::array();
    for (const FrameResult& f : result.frames) {
        Json entry{{"frame", f.frame}, {"path", f.path}, {"seconds", f.seconds}};
        if (f.skipped) entry["skipped"] = true;
        if (f.above_one > 0) entry["rolled_off_px"] = f.above_one;
        if (f.nonfinite > 0) entry["nonfinite_px"] = f.nonfinite;
        if (f.filled > 0) entry["filled_px"] = f.filled;
        out.push_back(std::move(entry));
    }
    return out;
}

}  // namespace

Json settings_json(const Project& project) {
    Json regions = Json::array();
    for (const auto& region : project.regions)
        regions.push_back(settings_of(*region, region_parameters()));
    return {{"project", settings_of(project, project_parameters())}, {"regions", regions}};
}

std::string report_json(const JobSpec& spec, const JobResult& result) {
    Json report{{"schema", "weft.report/1"},
                {"version", kVersion},
                {"backend",
                 {{"name", result.backend},
                  {"device", result.backend_description},
                  {"passed_over", result.passed_over}}},
                {"threads", thread_count()},
                {"size", {result.size.width, result.size.height}},
                {"spaces",
                 {{"plate", result.spaces.plate.name},
                  {"working", result.spaces.working.name},
                  {"out", result.spaces.out.name}}},
                {"references", references_json(result)},
                {"forms", forms_json(result)},
                {"lights", lights_json(result)},
                {"frames", frames_json(result)},
                {"fps", result.fps},
                {"seconds_per_stage",
                 {{"open", result.seconds.open},
                  {"analyse", result.seconds.analyse},
                  {"synthesise", result.seconds.synthesise},
                  {"render", result.seconds.render},
                  {"total", result.seconds.total}}},
                {"peak_rss_bytes", result.peak_rss_bytes},
                {"textures", textures_json(result)},
                {"settings", settings_json(spec.project)},
                {"movie", result.movie},
                {"warnings", result.warnings}};
    if (!result.changed_inputs.empty()) report["changed_inputs"] = result.changed_inputs;
    // Paths may contain bytes that are not UTF-8; those are replaced.
    return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace weft
