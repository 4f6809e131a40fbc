#include "app/editor/script.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <thread>

#include "engine/core/input_file.h"
#include "engine/core/stopwatch.h"
#include "engine/media/atomic_file.h"
#include "ui/canvas/view_map.h"
#include "ui/shell/robot.h"

namespace weft {
namespace {

using Json = nlohmann::json;
constexpr double kPatienceS = 60;

// The step that saves, collects or relinks; none for other steps.
std::optional<Action> file_action(const Json& step) {
    if (step.contains("save_as")) return SaveAs{step.at("save_as").get<std::string>()};
    if (step.contains("save_version")) return SaveVersion{};
    if (step.contains("collect")) return CollectProject{step.at("collect").get<std::string>()};
    if (step.contains("relink")) return RelinkFiles{step.at("relink").get<std::string>()};
    return std::nullopt;
}

class ScriptRunner {
  public:
    ScriptRunner(EditorApp& app, std::function<void()> frame,
                 std::function<Status(const std::string&)> write)
        : app_(app),
          frame_(frame),
          write_(std::move(write)),
          robot_(app.shell(), std::move(frame)) {}

    Status step(const Json& step);
    Status settle(double patience_s);

  private:
    [[nodiscard]] const SessionView& view() const { return app_.session().view(); }
    [[nodiscard]] bool reached(const std::string& what) const;
    Status wait_for(const std::string& what, double patience_s);
    Status select(const std::string& name);
    [[nodiscard]] ImVec2 on_screen(const Json& point) const;
    static Status missing(const std::string& name) {
        return fail(ErrorCode::kRenderFailed, "Widget '" + name + "' is not on the screen.");
    }

    EditorApp& app_;
    std::function<void()> frame_;
    std::function<Status(const std::string&)> write_;
    Robot robot_;
    std::map<std::string, std::string> times_;  // lines of the step "times", by file path
};

bool ScriptRunner::reached(const std::string& what) const {
    const SessionView& v = view();
    if (what == "plate") return v.plate_picture != nullptr;
    if (what == "cached")
        return !v.marks.empty() && std::all_of(v.marks.begin(), v.marks.end(),
                                               [](const FrameMarks& m) { return m.plate; });
    if (what == "mattes") {
        for (const RegionMatteView& matte : v.mattes)
            if (matte.kind == RegionMatteView::Kind::kLoading ||
                matte.kind == RegionMatteView::Kind::kUnreached || matte.outdated)
                return false;
        return !v.matte_busy;
    }
    if (what == "provisional") return v.stages.provisional && !v.stages.partial;
    if (what == "result") return v.result_current && !v.stages.approximate;
    if (what == "stages") return v.stages.stages[0] && !v.stages.provisional;
    if (what == "full_result")
        return v.result_current && !v.stages.approximate && v.stages.proxy == 1;
    if (what == "strip") {
        for (const StripCard& card : v.strip.cards)
            if ((!card.picture || card.provisional) && card.error.empty()) return false;
        return !v.strip.cards.empty();
    }
    if (what == "overlay") return v.overlay_picture != nullptr;
    if (what == "analysis") return !v.preview.analysing && v.result_current;
    if (what == "failure") return v.preview.state == PreviewView::State::kFailed;
    if (what == "report") return v.report.state == QualityReport::State::kDone;
    if (what == "jobs") {
        for (const JobView& job : v.jobs)
            if (job.state == JobState::kRunning || job.state == JobState::kWaiting) return false;
        return true;
    }
    if (what == "job_frame") return !v.jobs.empty() && v.jobs.back().thumbnail != nullptr;
    return false;
}

Status ScriptRunner::wait_for(const std::string& what, double patience_s) {
    const auto start = Clock::now();
    while (!reached(what)) {
        if (seconds_since(start) > patience_s)
            return fail(ErrorCode::kRenderFailed,
                        "'" + what + "' did not come within " + std::to_string(patience_s) + " s.");
        frame_();
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    robot_.frames(3);
    return {};
}

// Waits until nothing changes for a while: thumbnails and pictures arrive one by one.
Status ScriptRunner::settle(double patience_s) {
    const auto start = Clock::now();
    auto quiet_since = start;
    std::uint64_t changes = app_.changes();
    for (;;) {
        frame_();
        std::this_thread::sleep_for(std::chrono::milliseconds(15));
        const auto now = Clock::now();
        if (app_.changes() != changes || !app_.idle()) {
            changes = app_.changes();
            quiet_since = now;
        }
        if (seconds_between(quiet_since, now) > 0.4 || seconds_between(start, now) > patience_s)
            break;
    }
    robot_.frames(3);
    return {};
}

Status ScriptRunner::select(const std::string& name) {
    for (const Leaf<Region>& region : view().project.regions) {
        if (region->name != name) continue;
        app_.session().act(SelectRegion{region->id});
        robot_.frames(2);
        return {};
    }
    return fail(ErrorCode::kRenderFailed, "Unknown region '" + name + "'.");
}

ImVec2 ScriptRunner::on_screen(const Json& point) const {
    const ViewerState& s = app_.shell().state().viewer;
    const DrawnItem* canvas = robot_.find("Viewer/Canvas");
    if (!canvas) return {0, 0};
    const ViewMap map{canvas->min, canvas->max, s.center, s.zoom};
    return map.to_screen({point.at(0).get<float>(), point.at(1).get<float>()});
}

Status ScriptRunner::step(const Json& step) {
    const double patience = step.value("timeout", kPatienceS);
    const auto text = [&](const char* key) { return step.at(key).get<std::string>(); };
    if (step.contains("click") || step.contains("double_click")) {
        const bool twice = step.contains("double_click");
        const std::string name = text(twice ? "double_click" : "click");
        if (!robot_.click(name, twice ? 2 : 1)) return missing(name);
    } else if (step.contains("hover")) {
        if (!robot_.hover(text("hover"))) return missing(text("hover"));
        robot_.frames(4);
    } else if (step.contains("drag")) {
        const auto by = step.at("by");
        if (!robot_.drag(text("drag"), {by.at(0).get<float>(), by.at(1).get<float>()}))
            return missing(text("drag"));
    } else if (step.contains("drag_onto")) {
        const auto pair = step.at("drag_onto");
        if (!robot_.drag_onto(pair.at(0), pair.at(1))) return missing(pair.at(0));
    } else if (step.contains("stroke")) {
        std::vector<ImVec2> points;
        for (const Json& point : step.at("stroke"))
            points.push_back(on_screen(point));
        robot_.stroke(points);
    } else if (step.contains("point")) {
        robot_.move(on_screen(step.at("point")));
    } else if (step.contains("press_at")) {
        robot_.move(on_screen(step.at("press_at")));
        robot_.press();
        robot_.release();
    } else if (step.contains("wheel")) {
        robot_.wheel(step.at("wheel").get<float>());
    } else if (step.contains("type")) {
        robot_.type(text("type"));
    } else if (step.contains("key")) {
        if (!robot_.key(text("key")))
            return fail(ErrorCode::kUnreadable, "Unknown key '" + text("key") + "'.");
    } else if (step.contains("hold")) {
        robot_.hold(text("hold"), step.value("down", true));
        robot_.frames(2);
    } else if (step.contains("workspace")) {
        if (!robot_.click("Top/" + text("workspace"))) return missing(text("workspace"));
    } else if (step.contains("select")) {
        return select(text("select"));
    } else if (step.contains("frame")) {
        app_.session().act(GoToFrame{step.at("frame").get<int>()});
        robot_.frames(3);
    } else if (step.contains("open")) {
        app_.session().act(OpenAny{text("open")});
        robot_.frames(2);
    } else if (const auto action = file_action(step)) {
        app_.session().act(*action);
        app_.session().flush();
        robot_.frames(2);
    } else if (step.contains("demo")) {
        app_.session().act(OpenDemo{});
        robot_.frames(2);
    } else if (step.contains("texture")) {
        app_.session().act(ApplyTexture{text("texture"), 0});
        robot_.frames(2);
    } else if (step.contains("notice")) {
        app_.session().notify(NoticeKind::kError, text("notice"));
        robot_.frames(2);
    } else if (step.contains("wait")) {
        const auto start = Clock::now();
        const double wait = step.at("wait").get<double>();
        while (seconds_since(start) < wait) {
            frame_();
            std::this_thread::sleep_for(std::chrono::milliseconds(15));
        }
    } else if (step.contains("wait_for")) {
        return wait_for(text("wait_for"), patience);
    } else if (step.contains("settle")) {
        return settle(patience);
    } else if (step.contains("items")) {
        std::ostringstream out;
        for (const DrawnItem& item : app_.shell().items())
            out << item.name << " " << item.min.x << " " << item.min.y << " " << item.max.x << " "
                << item.max.y << "\n";
        return write_file_atomically(text("items"), out.str(), app_.session().export_rule());
    } else if (step.contains("times")) {
        const FrameTimes& t = app_.times();
        std::ostringstream out;
        const double frames = std::max(1, t.frames);
        out << step.value("label", "") << ": work " << t.cpu_sum_ms / frames
            << " ms a frame, worst " << t.cpu_worst_ms << " ms; by the clock " << t.sum_ms / frames
            << " ms, worst " << t.worst_ms << " ms; " << t.frames << " frames\n";
        std::string& lines = times_[text("times")];
        lines += out.str();
        return write_file_atomically(text("times"), lines, app_.session().export_rule());
    } else if (step.contains("repeat")) {
        for (int k = step.at("repeat").get<int>(); k > 0; --k)
            for (const Json& inner : step.at("steps"))
                WEFT_CHECK_OK(this->step(inner));
    } else if (step.contains("reset_times")) {
        app_.reset_times();
    } else if (step.contains("screenshot")) {
        // A large picture is uploaded in parts.
        do
            robot_.frames(2);
        while (app_.pictures().pending());
        return write_(text("screenshot"));
    } else {
        return fail(ErrorCode::kUnreadable, "This step is not known.");
    }
    return {};
}

}  // namespace

Status run_script(const std::string& path, EditorApp& app, const std::function<void()>& frame,
                  const std::function<Status(const std::string&)>& write) {
    ScriptRunner runner(app, frame, write);
    if (path.empty()) return runner.settle(30);
    WEFT_TRY(text, read_file(path, "The script"));
    const Json script = Json::parse(text, nullptr, false);
    if (!script.is_array())
        return fail(ErrorCode::kUnreadable, "The script " + path + " is not a JSON list of steps.");
    frame();
    int number = 0;
    for (const Json& step : script) {
        ++number;
        try {
            if (Status done = runner.step(step); !done)
                return fail_in(done.error(), path + ", step " + std::to_string(number));
        } catch (const Json::exception&) {
            return fail(ErrorCode::kUnreadable, path + ", step " + std::to_string(number) +
                                                    ": a value is missing or of another type.");
        }
    }
    return {};
}

}  // namespace weft
