#include "bench/study/study_methods.h"

#include <algorithm>
#include <cstdio>

namespace weft {
namespace {

using Kind = StudyMethod::Kind;

class Planner {
  public:
    Planner(const StudyOptions& options, const Project& project, const std::string& plane)
        : options_(options), project_(project), plane_(plane) {}

    Expected<std::vector<StudyMethod>> plan() {
        if (wanted("anew")) {
            add("anew", "Per-frame synthesis (graph cut)", StudyRole::kBaseline,
                [](Region& r) { make_anew(r); });
        }
        if (wanted("patchmatch")) {
            // A paper-mode frame brings a picture of its own; PatchMatch makes it here.
            add("patchmatch", "PatchMatch every frame", StudyRole::kBaseline,
                [](Region& r) { make_anew(r, TemporalMode::kPaper); });
            methods_.back().kind = Kind::kPatchMatch;
        }
        if (wanted("poisson")) {
            add("poisson", "Poisson blending every frame", StudyRole::kBaseline, [](Region&) {});
            methods_.back().kind = Kind::kPoisson;
        }
        if (wanted("still")) {
            add("still", "Still texture on the screen", StudyRole::kBaseline, [&](Region& r) {
                r.temporal.mode = TemporalMode::kNone;
                r.texture.sample.clear();
                r.texture.also.clear();
                if (r.texture.plane.empty()) r.placement.fit = false;
                r.texture.plane = plane_;
            });
        }
        if (wanted("paper")) {
            for (const double alpha : options_.alphas)
                add_paper(alpha);
        }
        add("locked", "Surface-locked", StudyRole::kLocked,
            [](Region& r) { r.temporal.mode = TemporalMode::kLocked; });
        if (wanted("light")) add_light();
        if (wanted("ablation")) add_ablation();
        return std::move(methods_);
    }

  private:
    [[nodiscard]] bool wanted(const std::string& name) const {
        return options_.methods.empty() ||
               std::find(options_.methods.begin(), options_.methods.end(), name) !=
                   options_.methods.end();
    }

    template <class Change>
    StudyMethod& add(const std::string& id, const std::string& title, StudyRole role,
                     Change&& change) {
        StudyMethod method;
        method.run.id = id;
        method.run.title = title;
        method.run.role = role;
        method.run.lit = role == StudyRole::kAblation || role == StudyRole::kLight;
        method.run.pattern = options_.folder + "/frames/" + id + "/#####.png";
        method.project = project_;
        method.project.output = Output{};
        method.project.output.path = method.run.pattern;
        method.project.regions.front() = project_.regions.front().with([&](Region& region) {
            if (!method.run.lit) {
                region.light.source = LightSource::kNone;
                region.lines = LineParams{};
            }
            // Other methods know no form.
            region.form.source = FormSource::kFlat;
            // Grain is new in every frame, as in the plate, and is not flicker of the method. Blur
            // would lower every method's TDE.
            region.finish.grain = region.finish.focus = 0;
            region.finish.shutter_deg = 0;
            change(region);
        });
        methods_.push_back(std::move(method));
        return methods_.back();
    }

    void add_paper(double alpha) {
        char number[32];
        std::snprintf(number, sizeof number, "%.3g", alpha);
        add(std::string("paper-") + number, std::string("Paper, α = ") + number, StudyRole::kPaper,
            [&](Region& r) {
                make_anew(r, TemporalMode::kPaper);
                r.temporal.blend = alpha;
            })
            .run.alpha = alpha;
    }

    // Baselines for light: transfers of statistics, and the paper's own eq. 8. The last is the
    // result as delivered, with the plate's grain and blur.
    void add_light() {
        const auto with_form = [&](const char* id, const char* title, LightForm form) {
            add(id, title, StudyRole::kLight, [form](Region& r) { r.light.form = form; });
        };
        with_form("light-statistics", "Light by mean and deviation", LightForm::kStatistics);
        with_form("light-histogram", "Light by the histogram", LightForm::kHistogram);
        with_form("light-literal", "Light by the paper's eq. 8", LightForm::kLiteral);
        const FinishParams finish = project_.regions.front()->finish;
        add("finished", "Finished, with grain and focus", StudyRole::kLight,
            [&finish](Region& r) { r.finish = finish; });
    }

    // The paper's Fig. 7. Without light is the surface-locked run itself.
    void add_ablation() {
        add("full", "Full method, with light", StudyRole::kAblation,
            [](Region& r) { r.temporal.mode = TemporalMode::kLocked; });
        add("no-graphcut", "Without graph cut", StudyRole::kAblation, [](Region& r) {
            r.temporal.mode = TemporalMode::kLocked;
            r.synthesis.seam = SeamMethod::kNone;
        });
        add("no-time", "Without time", StudyRole::kAblation, [](Region& r) { make_anew(r); });
    }

    // A given plane serves as the sample: shown as it is, it would be no synthesis at all.
    static void make_anew(Region& region, TemporalMode mode = TemporalMode::kNone) {
        region.temporal.mode = mode;
        if (region.texture.plane.empty()) return;
        region.texture.sample = region.texture.plane;
        region.texture.plane.clear();
    }

    const StudyOptions& options_;
    const Project& project_;
    const std::string& plane_;
    std::vector<StudyMethod> methods_;
};

}  // namespace

const std::vector<std::string>& study_method_names() {
    static const std::vector<std::string> names{"anew",  "patchmatch", "poisson", "still",
                                                "paper", "locked",     "light",   "ablation"};
    return names;
}

Status check_study(const StudyOptions& options) {
    const std::vector<std::string>& known = study_method_names();
    for (const std::string& name : options.methods) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        std::string all;
        for (const std::string& k : known)
            all += (all.empty() ? "" : ", ") + k;
        return fail(ErrorCode::kUsage, "Unknown method '" + name + "'.",
                    "Choose among " + all + ".");
    }
    for (const double alpha : options.alphas) {
        if (!(alpha >= 0 && alpha <= 1))
            return fail(ErrorCode::kUsage, "The blends (--alphas) must lie between 0 and 1.");
    }
    return {};
}

Expected<std::vector<StudyMethod>> plan_study(const StudyOptions& options, const Project& project,
                                              const std::string& plane) {
    return Planner(options, project, plane).plan();
}

}  // namespace weft
