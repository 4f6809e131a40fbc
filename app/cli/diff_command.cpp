#include <nlohmann/json.hpp>

#include <algorithm>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "engine/core/frame_range.h"
#include "engine/media/atomic_file.h"
#include "engine/media/frame_reader.h"
#include "engine/media/frame_writer.h"
#include "engine/media/matte_files.h"
#include "engine/metrics/likeness.h"
#include "engine/metrics/sequence_diff.h"

namespace weft {
namespace {

using Json = nlohmann::ordered_json;

struct Outcome {
    SequenceDiff all;
    SequenceLikeness likeness;
    Json frames = Json::array();
    std::string text;
};

Expected<std::vector<int>> common_frames(const DiffOptions& options, const FrameReader& a,
                                         const FrameReader& b) {
    std::vector<int> wanted = a.frames();
    if (!options.frames.empty()) {
        WEFT_TRY(list, parse_frame_list(options.frames));
        wanted = std::move(list);
    } else if (a.frames() != b.frames() && a.frames().size() + b.frames().size() > 2) {
        return fail(ErrorCode::kDiffers,
                    options.a + " has frames " + format_frame_list(a.frames()) + ", " + options.b +
                        " has " + format_frame_list(b.frames()) + ".",
                    "Compare those in both with --frames.");
    }
    return wanted;
}

Expected<Outcome> compare(const DiffOptions& options) {
    WEFT_TRY(a, open_plate(options.a, {}));
    WEFT_TRY(b, open_plate(options.b, {}));
    WEFT_TRY(frames, common_frames(options, *a, *b));
    std::optional<MatteFiles> mattes;
    if (!options.matte.empty()) {
        WEFT_TRY(files, MatteFiles::parse(options.matte, a->frames().front()));
        mattes = std::move(files);
    }
    const bool single =
        a->frames().size() == 1 && b->frames().size() == 1 && options.frames.empty();
    Outcome out;
    for (const int frame : frames) {
        WEFT_TRY(left, a->read(frame));
        WEFT_TRY(right, b->read(single ? b->frames().front() : frame));
        auto diff = diff_frames(left.rgb, right.rgb);
        if (!diff) return fail_in(std::move(diff).error(), "Frame " + std::to_string(frame));
        if (mattes) {
            WEFT_TRY(matte, mattes->read(frame, {options.matte_value, options.matte_channel, false},
                                         left.rgb.size()));
            out.likeness.add(frame, left.rgb, right.rgb, matte);
        }
        const double largest = *std::max_element(diff->max_abs.begin(), diff->max_abs.end());
        if (largest <= options.tolerance) {
            out.all.add(frame, FrameDiff{});
            continue;
        }
        out.all.add(frame, *diff);
        const Recti& box = diff->box;
        out.frames.push_back({{"frame", frame},
                              {"differing_px", diff->differing},
                              {"max_abs", diff->max_abs},
                              {"mean_abs", diff->mean_abs},
                              {"box", {box.x0, box.y0, box.x1, box.y1}},
                              {"psnr_db", diff->psnr_db ? Json(*diff->psnr_db) : Json()}});
        char line[200];
        std::snprintf(
            line, sizeof line,
            "frame %d: %lld of %lld pixels differ, by at most %.6f, inside %d,%d to %d,%d\n", frame,
            static_cast<long long>(diff->differing), static_cast<long long>(diff->pixels), largest,
            box.x0, box.y0, box.x1, box.y1);
        out.text += line;
    }
    return out;
}

Json number_or_null(double value) {
    return value >= 0 ? Json(value) : Json();
}

Json likeness_json(const SequenceLikeness& likeness) {
    const auto all = likeness.summary();
    Json frames = Json::array();
    for (const FrameLikeness& f : likeness.frames()) {
        frames.push_back(
            {{"frame", f.frame},
             {"offset_px", f.features.patches > 0 ? Json(f.features.mean_px) : Json()},
             {"offset_x_px", f.features.patches > 0 ? Json(f.features.mean_x_px) : Json()},
             {"offset_y_px", f.features.patches > 0 ? Json(f.features.mean_y_px) : Json()},
             {"patches", f.features.patches},
             {"lost_patches", f.features.lost},
             {"interior", number_or_null(f.interior)},
             {"soft_edge", number_or_null(f.soft_edge)},
             {"soft_edge_change", number_or_null(f.soft_edge_change)},
             {"outside", number_or_null(f.outside)}});
    }
    return {{"offset_px", all.offset_px},
            {"largest_offset_px", all.largest_offset_px},
            {"interior", all.interior},
            {"soft_edge", all.soft_edge},
            {"soft_edge_change", all.soft_edge_change},
            {"outside", all.outside},
            {"per_frame", frames}};
}

std::string likeness_text(const SequenceLikeness& likeness) {
    const auto all = likeness.summary();
    char line[300];
    std::snprintf(
        line, sizeof line,
        "features off by %.3f px (%.3f in the worst frame); difference inside %.2f, in the "
        "soft edge %.2f (its change in time %.2f), outside %.3f levels\n",
        all.offset_px, all.largest_offset_px, all.interior, all.soft_edge, all.soft_edge_change,
        all.outside);
    return line;
}

// Writes 8-bit codes as an image.
Status write_strip(const std::string& path, const SequenceLikeness& likeness,
                   const WriteRule& rule) {
    const ImageU8x3 strip = strip_of(likeness.worst());
    if (strip.empty()) {
        print_warning("No patch could be compared, so " + path + " was not written.");
        return {};
    }
    WEFT_CHECK_OK(make_folder_of(path, rule));
    ImageF3 rgb(strip.size());
    std::transform(strip.data(), strip.data() + strip.size_bytes(), rgb.data(),
                   [](std::uint8_t v) { return static_cast<float>(v) / 255.0f; });
    WriteOptions write;
    write.rule = rule;
    return write_image(path, rgb, {}, write);
}

}  // namespace

CommandResult diff_command(const DiffOptions& options) {
    WEFT_TRY(rule, write_rule(options.write, {options.a, options.b, options.matte}));
    if (!options.worst.empty()) WEFT_CHECK_OK(check_output(options.worst, rule));
    WEFT_TRY(outcome, compare(options));
    const SequenceDiff& all = outcome.all;
    const bool alike = !options.matte.empty();
    if (alike && !options.worst.empty())
        WEFT_CHECK_OK(write_strip(options.worst, outcome.likeness, rule));
    Answer answer;
    answer.json = {{"equal", all.equal()},
                   {"frames", all.frames},
                   {"differing_frames", all.differing_frames},
                   {"max_abs", all.max_abs},
                   {"differences", outcome.frames}};
    answer.text = outcome.text;
    if (alike) {
        answer.json["likeness"] = likeness_json(outcome.likeness);
        answer.text += likeness_text(outcome.likeness);
    }
    answer.text += (all.equal() ? "The same: " : "Different: ") +
                   std::to_string(all.frames - all.differing_frames) + " of " +
                   std::to_string(all.frames) + " frames are equal.\n";
    answer.exit = all.equal() ? 0 : exit_code(ErrorCode::kDiffers);
    return answer;
}

}  // namespace weft
