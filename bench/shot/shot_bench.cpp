#include "bench/shot/shot_bench.h"

#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "bench/baselines/dis_chain.h"
#include "engine/color/color_space.h"
#include "engine/core/child_process.h"
#include "engine/core/input_file.h"
#include "engine/core/parallel.h"
#include "engine/core/stopwatch.h"
#include "engine/media/atomic_file.h"
#include "engine/media/frame_writer.h"
#include "engine/media/image_files.h"
#include "engine/media/sequence_pattern.h"
#include "engine/pipeline/plate_views.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

double cpu_of(int who) {
    rusage usage{};
    getrusage(who, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

struct Run {
    double wall_s = 0, cpu_s = 0;
    Json report;  // what the program said
};

struct Case {
    std::string quality;
    bool cached = false;  // the analysis of an earlier run with another texture
    [[nodiscard]] std::string name() const { return quality + (cached ? ", analysis cached" : ""); }
};

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

template <class F>
double median_of(const std::vector<Run>& runs, const F& value) {
    std::vector<double> values;
    values.reserve(runs.size());
    for (const Run& run : runs)
        values.push_back(value(run));
    return median(std::move(values));
}

class ShotBench {
  public:
    ShotBench(const ShotBenchOptions& options, const ShotBenchCase& each, std::string folder)
        : options_(options), each_(each), folder_(std::move(folder)) {}

    Expected<Json> run() {
        std::vector<std::string> programs{options_.program};
        if (!options_.against.empty()) programs.push_back(options_.against);
        Json out = Json::object();
        for (const Case& what :
             {Case{"draft"}, Case{"draft", true}, Case{"final"}, Case{"final", true}}) {
            std::vector<std::vector<Run>> runs(programs.size());
            for (int k = 0; k < options_.runs; ++k) {
                for (std::size_t p = 0; p < programs.size(); ++p) {
                    WEFT_TRY(run, render(programs[p], what));
                    runs[p].push_back(std::move(run));
                }
            }
            out[what.name()] = entry(runs);
            if (each_) each_(what.name(), out[what.name()]);
        }
        WEFT_TRY(floor, dis_chain());
        out["dis chain"] = {{"wall_s", floor.wall_s},
                            {"cpu_s", floor.cpu_s},
                            {"frames_per_s", frames_ / floor.wall_s}};
        if (each_) each_("dis chain", out["dis chain"]);
        return out;
    }

  private:
    [[nodiscard]] Expected<Run> render(const std::string& program, const Case& what) {
        const std::string cache = folder_ + "/cache";
        if (what.cached) {
            // Filled anew, since another program's cache is of no use.
            std::error_code ignored;
            fs::remove_all(cache, ignored);
            WEFT_TRY(first, start(program, {"--quality", what.quality, "--cache", cache}));
            return start(program, {"--quality", what.quality, "--cache", cache, "--seed", "2"});
        }
        return start(program, {"--quality", what.quality, "--no-cache"});
    }

    [[nodiscard]] Expected<Run> start(const std::string& program,
                                      const std::vector<std::string>& flags) {
        std::vector<std::string> words{program,       "replace",
                                       "--plate",     options_.plate,
                                       "--matte",     options_.matte,
                                       "--texture",   options_.texture,
                                       "-o",          folder_ + "/out/####.png",
                                       "--overwrite", "--json",
                                       "--progress",  "none"};
        if (options_.matte_value >= 0) {
            words.insert(words.end(), {"--matte-value", std::to_string(options_.matte_value)});
        }
        if (options_.threads > 0)
            words.insert(words.end(), {"--threads", std::to_string(options_.threads)});
        words.insert(words.end(), flags.begin(), flags.end());
        ProcessOptions process;
        process.output = folder_ + "/said.json";
        process.errors = folder_ + "/errors.txt";
        const double before = cpu_of(RUSAGE_CHILDREN);
        const auto began = Clock::now();
        WEFT_TRY(child, start_process(words, process));
        const int code = wait_for_process(child);
        Run run{seconds_since(began), cpu_of(RUSAGE_CHILDREN) - before, {}};
        constexpr std::uint64_t kMostBytes = std::uint64_t{64} << 20;
        WEFT_TRY(said, read_file(process.output, "The program's report", kMostBytes));
        run.report = Json::parse(said, nullptr, false);
        if (code != 0) {
            std::string message = program + " ended with exit code " + std::to_string(code) + ".";
            if (run.report.is_object() && run.report.contains("error"))
                message = run.report["error"].value("message", message);
            return fail(static_cast<ErrorCode>(code), std::move(message));
        }
        if (!run.report.is_object() || !run.report.contains("frames"))
            return fail(ErrorCode::kUnreadable, program + " printed no report.", "Give a weft.");
        frames_ = static_cast<double>(run.report["frames"].size());
        return run;
    }

    // Of one case: this program's figures, and the other's as ratios of each pair of runs.
    [[nodiscard]] Json entry(const std::vector<std::vector<Run>>& runs) const {
        const std::vector<Run>& own = runs.front();
        const double wall = median_of(own, [](const Run& r) { return r.wall_s; });
        const double cpu = median_of(own, [](const Run& r) { return r.cpu_s; });
        Json out{{"wall_s", wall},
                 {"cpu_s", cpu},
                 {"frames_per_s", frames_ / wall},
                 {"cores_busy", cpu / wall},
                 {"peak_bytes", median_of(own, [](const Run& r) {
                      return r.report.value("peak_rss_bytes", 0.0);
                  })}};
        for (const char* stage : {"open", "analyse", "synthesise", "render"}) {
            out["stages_s"][stage] = median_of(
                own, [&](const Run& r) { return r.report["seconds_per_stage"].value(stage, 0.0); });
        }
        if (runs.size() > 1) {
            std::vector<double> wall_ratios, cpu_ratios;
            for (std::size_t k = 0; k < own.size(); ++k) {
                wall_ratios.push_back(runs[1][k].wall_s / own[k].wall_s);
                cpu_ratios.push_back(runs[1][k].cpu_s / own[k].cpu_s);
            }
            out["faster"] = {{"wall", median(wall_ratios)}, {"cpu", median(cpu_ratios)}};
        }
        return out;
    }

    // In this process: reading and writing as in a render, a chain of motion, one lookup.
    [[nodiscard]] Expected<Run> dis_chain() {
        WEFT_TRY(plates, SequencePattern::parse(options_.plate));
        WEFT_TRY(mattes, SequencePattern::parse(options_.matte));
        WEFT_TRY(frames, plates.list_frames());
        WEFT_TRY(display, make_color_transform({"srgb"}, {"srgb"}));
        WEFT_TRY(sample, read_image(options_.texture));
        const ImageU8x3 picture = make_views(sample.rgb, *display).display;
        MatteSelect select;
        if (options_.matte_value >= 0) select.value = options_.matte_value;
        std::optional<DisChain> chain;
        const double before = cpu_of(RUSAGE_SELF);
        const auto began = Clock::now();
        for (const int frame : frames) {
            WEFT_TRY(plate, read_image(plates.path_for(frame)));
            const ImageU8x3 shown = make_views(plate.rgb, *display).display;
            WEFT_TRY(matte, read_matte(mattes.path_for(frame), select, shown.size()));
            if (!chain) chain.emplace(shown, picture);
            const ImageU8x3 result = chain->next(shown, matte);
            ImageF3 pixels(result.size());
            std::transform(result.data(), result.data() + result.size_bytes(), pixels.data(),
                           [](std::uint8_t v) { return static_cast<float>(v) / 255.0f; });
            WEFT_CHECK_OK(
                write_image(folder_ + "/floor_" + std::to_string(frame) + ".png", pixels, {}, {}));
        }
        frames_ = static_cast<double>(frames.size());
        return Run{seconds_since(began), cpu_of(RUSAGE_SELF) - before, {}};
    }

    const ShotBenchOptions& options_;
    const ShotBenchCase& each_;
    std::string folder_;
    double frames_ = 0;
};

}  // namespace

Expected<nlohmann::ordered_json> bench_shot(const ShotBenchOptions& options,
                                            const ShotBenchCase& each) {
    WEFT_TRY(folder, TemporaryFolder::create());
    return ShotBench(options, each, folder.path()).run();
}

}  // namespace weft
