#include "ui/jobs/problem.h"

#include <array>
#include <utility>

#include "ui/parameters/setting_labels.h"

namespace weft::ui {
namespace {

// Where settings are, by the beginning of their keys.
constexpr std::array<std::pair<std::string_view, Workspace>, 16> kPlaces{
    {{"matte", Workspace::kMask},
     {"holdouts", Workspace::kMask},
     {"zones", Workspace::kMask},
     {"texture.", Workspace::kTexture},
     {"placement.", Workspace::kTexture},
     {"form.", Workspace::kTexture},
     {"motion.", Workspace::kMotion},
     {"temporal.", Workspace::kMotion},
     {"reference_frames", Workspace::kMotion},
     {"synthesis.", Workspace::kLight},
     {"light.", Workspace::kLight},
     {"grade.", Workspace::kLight},
     {"layer.", Workspace::kLight},
     {"finish.", Workspace::kLight},
     {"output.", Workspace::kJobs},
     {"run.", Workspace::kJobs}}};

// A frame or region alone is looked at where its matte is.
Workspace place_of(std::string_view key) {
    for (const auto& [begins, workspace] : kPlaces)
        if (key.starts_with(begins)) return workspace;
    return Workspace::kMask;
}

// "Form → Source" is the control Source of the section Form, "If files exist: Skip" its button
// Skip.
void point_at(Ctx& c, const std::string& key) {
    constexpr std::string_view kArrow = " → ";
    constexpr double kShown_s = 5;
    std::string label = setting_label({key});
    if (const std::size_t colon = label.find(": "); colon != std::string::npos)
        label.erase(0, colon + 2);
    PointedSetting& pointed = c.state.pointed;
    pointed = {};
    const std::size_t arrow = label.find(kArrow);
    if (arrow != std::string::npos) {
        pointed.section = label.substr(0, arrow);
        label.erase(0, arrow + kArrow.size());
    }
    pointed.name = label;
    pointed.until_s = c.view.now_s + kShown_s;
}

}  // namespace

bool shows(const Ctx& c, const JobView& job) {
    return c.view.open && job.plate == c.view.plate.path;
}

void show_problem(Ctx& c, const JobProblem& problem) {
    for (const auto& region : c.view.project.regions)
        if (region->name == problem.region) c.emit(SelectRegion{region->id});
    if (problem.frame) c.emit(GoToFrame{*problem.frame});
    // The shot's settings are in a window of their own.
    const bool of_shot =
        problem.setting.starts_with("plate.") || problem.setting == "color.texture_space";
    c.state.shot_open |= of_shot;
    set_workspace(c.state, place_of(problem.setting));
    if (!problem.setting.empty()) point_at(c, problem.setting);
}

}  // namespace weft::ui
