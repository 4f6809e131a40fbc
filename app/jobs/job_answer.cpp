#include "app/jobs/job_answer.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <regex>

#include "app/project/parameters.h"
#include "engine/core/input_file.h"
#include "engine/core/setting.h"
#include "engine/media/sequence_pattern.h"

namespace weft {
namespace {

// The longest number that is a frame's (kMaxFrameNumber).
const std::regex& frame_in_words() {
    static const std::regex kFrame("\\b[Ff]rames? (-?[0-9]{1,9})\\b");
    return kFrame;
}

std::optional<int> named_frame(const std::string& message, const std::vector<int>& frames) {
    for (std::sregex_iterator at(message.begin(), message.end(), frame_in_words()), end; at != end;
         ++at) {
        const int frame = std::stoi((*at)[1]);
        if (std::find(frames.begin(), frames.end(), frame) != frames.end()) return frame;
    }
    return std::nullopt;
}

std::optional<int> frame_of_file(const std::string& message, const std::string& pattern,
                                 const std::vector<int>& frames) {
    const auto parsed = SequencePattern::parse(pattern);
    if (pattern.empty() || !parsed || parsed->is_single()) return std::nullopt;
    for (const int frame : frames)
        if (message.find(parsed->path_for(frame)) != std::string::npos) return frame;
    return std::nullopt;
}

std::optional<int> frame_by_files(const std::string& message, const Project& project,
                                  const std::vector<int>& frames) {
    std::vector<std::string> patterns{project.plate.path, project.output.path};
    for (const auto& region : project.regions)
        patterns.push_back(region->matte->files);
    for (const std::string& pattern : patterns)
        if (const auto frame = frame_of_file(message, pattern, frames)) return frame;
    return std::nullopt;
}

// "regions[2].texture.sample" is the third region and its "texture.sample".
void take_field(const std::string& field, const Project& project, JobProblem& out) {
    constexpr std::string_view kRegions = "regions[";
    if (!field.starts_with(kRegions)) {
        if (!field.starts_with("--")) out.setting = field;
        return;
    }
    std::size_t index = 0;
    const char* begin = field.data() + kRegions.size();
    const auto [end, error] = std::from_chars(begin, field.data() + field.size(), index);
    if (error == std::errc() && index < project.regions.size())
        out.region = project.regions[index]->name;
    const std::size_t dot = field.find('.');
    if (dot != std::string::npos) out.setting = field.substr(dot + 1);
}

std::string named_region(const std::string& message, const Project& project) {
    for (const auto& region : project.regions)
        if (message.find("egion '" + region->name + "'") != std::string::npos) return region->name;
    return {};
}

std::string named_setting(const std::string& message) {
    for (std::size_t at = message.find('{'); at != std::string::npos;
         at = message.find('{', at + 1)) {
        const std::size_t end = message.find_first_of("=}", at);
        if (end == std::string::npos) return {};
        const std::string key = message.substr(at + 1, end - at - 1);
        const bool known =
            std::find(setting::kAll.begin(), setting::kAll.end(), key) != setting::kAll.end() ||
            find_parameter(region_parameters(), key) || find_parameter(project_parameters(), key);
        if (known) return key;
    }
    return {};
}

}  // namespace

std::optional<JobAnswer> read_answer(const std::string& path) {
    const auto text = read_file(path, {});
    if (!text) return std::nullopt;
    const auto json = nlohmann::json::parse(*text, nullptr, false);
    if (!json.is_object() || !json.contains("exit_code")) return std::nullopt;
    try {
        JobAnswer out;
        out.exit_code = json.at("exit_code").get<int>();
        const auto error = json.value("error", nlohmann::json::object());
        out.message = error.value("message", "");
        out.field = error.value("field", "");
        return out;
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;
    }
}

JobProblem problem_of(const JobAnswer& answer, const Project& project,
                      const std::vector<int>& frames) {
    JobProblem out;
    take_field(answer.field, project, out);
    if (out.region.empty()) out.region = named_region(answer.message, project);
    if (out.setting.empty()) out.setting = named_setting(answer.message);
    out.frame = named_frame(answer.message, frames);
    if (!out.frame) out.frame = frame_by_files(answer.message, project, frames);
    return out;
}

}  // namespace weft
