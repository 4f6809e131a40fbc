#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/cli/bench/bench_lighting.h"
#include "app/cli/commands.h"
#include "app/cli/engine_choice.h"
#include "engine/color/color_space.h"
#include "engine/core/isa.h"
#include "engine/core/parallel.h"
#include "engine/core/text.h"
#include "engine/media/frame_writer.h"
#include "engine/media/image_files.h"
#include "engine/pipeline/plate_views.h"
#include "engine/synthesis/repetition.h"

namespace weft {
namespace {

constexpr int kSamplePx = 96;

// Mean and standard deviation over runs.
struct Figure {
    double sum = 0, squares = 0;
    int n = 0;
    void add(double v) { sum += v, squares += v * v, ++n; }
    [[nodiscard]] double mean() const { return sum / n; }
    [[nodiscard]] double deviation() const {
        return n < 2 ? 0 : std::sqrt(std::max(0.0, (squares - sum * sum / n) / (n - 1)));
    }
};

struct Runs {
    Figure search, seam, refine, other, total, cpu, energy;
    std::size_t graph_bytes = 0;
    TexturePlane last;
};

Expected<Runs> measure(ViewU8x3 sample, const PlaneOptions& options, int runs) {
    Runs out;
    for (int i = 0; i < runs; ++i) {
        const double start = cpu_s();
        WEFT_TRY(plane, grow_plane(sample, options, cancel_on_signals()));
        out.cpu.add(cpu_s() - start);
        const PlaneStats& s = plane.stats;
        out.search.add(s.search_s), out.seam.add(s.seam_s), out.refine.add(s.refine_s);
        out.other.add(s.other_s), out.total.add(s.total_s), out.energy.add(s.seam_energy_per_area);
        out.graph_bytes = std::max(out.graph_bytes, s.peak_graph_bytes);
        out.last = std::move(plane);
    }
    return out;
}

nlohmann::ordered_json figures_json(const Figure& f) {
    return {{"mean", f.mean()}, {"deviation", f.deviation()}};
}

nlohmann::ordered_json figures_json(const Runs& r) {
    return {{"search_s", figures_json(r.search)},      {"seam_s", figures_json(r.seam)},
            {"refine_s", figures_json(r.refine)},      {"other_s", figures_json(r.other)},
            {"total_s", figures_json(r.total)},        {"cpu_s", figures_json(r.cpu)},
            {"seam_energy_per_area", r.energy.mean()}, {"peak_graph_bytes", r.graph_bytes}};
}

std::string runs_line(const std::string& name, const Runs& r) {
    char text[256];
    const auto percent = [&](const Figure& f) { return 100 * f.mean() / r.total.mean(); };
    std::snprintf(text, sizeof text,
                  "%-22s %8.1f ± %5.1f ms  cpu %8.1f ms  search %4.1f%%  seam %4.1f%%  refine "
                  "%4.1f%%  other %4.1f%%  energy/area %.3f  graph %zu bytes\n",
                  name.c_str(), 1e3 * r.total.mean(), 1e3 * r.total.deviation(), 1e3 * r.cpu.mean(),
                  percent(r.search), percent(r.seam), percent(r.refine), percent(r.other),
                  r.energy.mean(), r.graph_bytes);
    return text;
}

// The plane with the texels beside seams in red.
Status write_seams(const std::string& path, const TexturePlane& plane, const WriteRule& rule) {
    ImageF3 out(plane.pixels.size());
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            const std::int32_t* p = plane.source.pixel(x, y);
            bool seam = false;
            if (x + 1 < out.width()) seam |= p[2] != p[0] + 1 || p[3] != p[1];
            if (y + 1 < out.height()) {
                const std::int32_t* q = plane.source.pixel(x, y + 1);
                seam |= q[0] != p[0] || q[1] != p[1] + 1;
            }
            const std::uint8_t* rgb = plane.pixels.pixel(x, y);
            for (int c = 0; c < 3; ++c) {
                out.pixel(x, y)[c] =
                    seam ? (c == 0 ? 1.0f : 0.0f) : static_cast<float>(rgb[c]) / 255.0f;
            }
        }
    }
    WriteOptions write;
    write.depth = PixelDepth::kU8;
    write.rule = rule;
    return write_image(path, out, {}, write);
}

Expected<ImageU8x3> read_picture(const std::string& path) {
    WEFT_TRY(picture, read_image(path));
    WEFT_TRY(display, make_color_transform({"srgb"}, {"srgb"}));
    return make_views(picture.rgb, *display).display;
}

Expected<ImageU8x3> middle_of(const std::string& path) {
    WEFT_TRY(whole, read_picture(path));
    const int w = std::min(kSamplePx, whole.width()), h = std::min(kSamplePx, whole.height());
    const int x0 = (whole.width() - w) / 2, y0 = (whole.height() - h) / 2;
    ImageU8x3 sample(w, h);
    for (int y = 0; y < h; ++y)
        std::copy_n(whole.pixel(x0, y0 + y), 3 * w, sample.row(y));
    return sample;
}

class Bench {
  public:
    Bench(const BenchOptions& options, const Backend& backend, const ImageU8x3& sample)
        : options_(options), backend_(backend), sample_(sample) {}

    Expected<nlohmann::ordered_json> run() {
        WEFT_CHECK_OK(sizes());
        WEFT_CHECK_OK(overlaps());
        WEFT_CHECK_OK(methods());
        return std::move(json_);
    }

  private:
    Status add(const char* group, const std::string& name, PlaneOptions plane, int runs) {
        plane.backend = &backend_;
        WEFT_TRY(result, measure(sample_, plane, runs));
        const Repetition repetition = measure_repetition(result.last);
        nlohmann::ordered_json entry = figures_json(result);
        entry["repetition"] = repetition.peak;
        json_[group][name] = std::move(entry);
        if (!json_output()) print(stdout, runs_line(name, result));
        last_ = std::move(result.last);
        return {};
    }

    Status sizes() {
        for (const int refine : {0, kDefaultRefinePasses}) {
            for (const int side : options_.sizes) {
                PlaneOptions plane;
                plane.size = {side, side};
                plane.refine_passes = refine;
                const std::string name = std::to_string(side) + "x" + std::to_string(side) +
                                         (refine ? " refined" : " one sweep");
                WEFT_CHECK_OK(add("sizes", name, plane, options_.runs));
            }
        }
        return {};
    }

    Status overlaps() {
        for (int overlap = 12; overlap <= 60; overlap += 12) {
            if (overlap > std::min(sample_.width(), sample_.height())) break;
            PlaneOptions plane;
            plane.overlap_px = overlap;
            plane.refine_passes = 0;
            WEFT_CHECK_OK(add("overlaps", "overlap " + std::to_string(overlap), plane,
                              std::min(options_.runs, 3)));
        }
        return {};
    }

    Status methods() {
        const std::vector<std::pair<std::string, SeamMethod>> all{
            {"graphcut", SeamMethod::kGraphCut},
            {"dp", SeamMethod::kDynamicProgramming},
            {"none", SeamMethod::kNone}};
        for (const auto& [name, method] : all) {
            PlaneOptions plane;
            plane.seam = method;
            plane.refine_passes = 0;
            WEFT_CHECK_OK(add("methods", name, plane, std::min(options_.runs, 3)));
            if (options_.seams.empty()) continue;
            WEFT_TRY(rule, write_rule(options_.write, {options_.sample}));
            WEFT_CHECK_OK(make_folder(options_.seams, rule));
            WEFT_CHECK_OK(write_seams(options_.seams + "/seams_" + name + ".png", last_, rule));
        }
        return {};
    }

    const BenchOptions& options_;
    const Backend& backend_;
    const ImageU8x3& sample_;
    nlohmann::ordered_json json_;
    TexturePlane last_;
};

CommandResult report_repetition(const BenchOptions& options, const ImageU8x3& sample) {
    Answer answer;
    for (const std::string& path : options.repetition_of) {
        WEFT_TRY(picture, read_picture(path));
        const Repetition r = measure_repetition(picture.view(), find_period(sample));
        answer.json["repetition"][absolute_path(path)] = r.peak;
        answer.text += path + ": repetition " + std::to_string(r.peak) + "\n";
    }
    return answer;
}

CommandResult report_lighting(const BenchOptions& options, const ImageU8x3& sample) {
    WEFT_TRY(lighting, bench_lighting(sample, options.sizes, options.runs));
    Answer answer;
    answer.json["lighting"] = lighting_json(lighting);
    for (const LightingCost& cost : lighting)
        answer.text += lighting_line(cost);
    return answer;
}

void print_shot_case(const std::string& name, const nlohmann::ordered_json& figures) {
    const auto of = [&](const nlohmann::ordered_json& in, const char* key) {
        return in[key].get<double>();
    };
    char text[200];
    std::snprintf(text, sizeof text, "%-22s %6.2f frames/s  wall %6.2f s  cpu %6.2f s",
                  name.c_str(), of(figures, "frames_per_s"), of(figures, "wall_s"),
                  of(figures, "cpu_s"));
    std::string line = text;
    if (figures.contains("stages_s")) {
        std::snprintf(text, sizeof text,
                      "  %.2f cores  %5.0f MB  following %.2f s, rendering %.2f s",
                      of(figures, "cores_busy"), of(figures, "peak_bytes") / 1e6,
                      of(figures["stages_s"], "analyse"), of(figures["stages_s"], "render"));
        line += text;
    }
    if (figures.contains("faster")) {
        std::snprintf(text, sizeof text, "  %.2f times as fast (cpu %.2f)",
                      of(figures["faster"], "wall"), of(figures["faster"], "cpu"));
        line += text;
    }
    print(stdout, line + "\n");
}

CommandResult report_shot(const BenchOptions& options) {
    if (options.shot.matte.empty())
        return fail(ErrorCode::kUsage, "--shot needs the mattes of its frames.", "Add --matte.");
    ShotBenchOptions shot = options.shot;
    shot.texture = options.sample;
    shot.program = "/proc/self/exe";
    WEFT_TRY(figures, bench_shot(shot, json_output() ? ShotBenchCase() : print_shot_case));
    Answer answer;
    answer.json["shot"] = std::move(figures);
    answer.json["threads"] = shot.threads > 0 ? shot.threads : thread_count();
    return answer;
}

}  // namespace

CommandResult bench_command(const BenchOptions& options) {
    if (!options.shot.plate.empty()) return report_shot(options);
    WEFT_TRY(chosen, choose_engine(options.threads, options.isa, options.backend));
    const Backend& backend = *chosen.backend;
    WEFT_TRY(sample, middle_of(options.sample));
    if (!options.repetition_of.empty()) return report_repetition(options, sample);
    if (options.lighting) return report_lighting(options, sample);
    // The benchmark takes minutes, so each line is printed as soon as it is known.
    if (!json_output()) {
        print(stdout, backend.name() + ", " + std::string(isa_name(current_isa())) + ", " +
                          std::to_string(thread_count()) + " thread(s), overlap 36 px, sample " +
                          size_text(sample.size()) + "\n");
    }
    WEFT_TRY(result, Bench(options, backend, sample).run());
    for (const std::string& remark : backend.remarks())
        print_warning(remark);
    result["backend"] = backend.name();
    result["isa"] = isa_name(current_isa());
    result["threads"] = thread_count();
    return Answer{std::move(result)};
}

}  // namespace weft
