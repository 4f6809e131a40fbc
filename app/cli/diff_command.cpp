#include <nlohmann/json.hpp>

#include <algorithm>

#include "app/cli/commands.h"
#include "engine/core/frame_range.h"
#include "engine/media/frame_reader.h"
#include "engine/metrics/sequence_diff.h"

namespace weft {
namespace {

using Json = nlohmann::ordered_json;

struct Outcome {
    SequenceDiff all;
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
        return fail(ErrorCode::kDiffers, options.a + " has frames " +
                                             format_frame_list(a.frames()) + ", " + options.b +
                                             " has " + format_frame_list(b.frames()) +
                                             ". Compare those in both with --frames.");
    }
    return wanted;
}

Expected<Outcome> compare(const DiffOptions& options) {
    WEFT_TRY(a, open_plate(options.a, {}));
    WEFT_TRY(b, open_plate(options.b, {}));
    WEFT_TRY(frames, common_frames(options, *a, *b));
    const bool single =
        a->frames().size() == 1 && b->frames().size() == 1 && options.frames.empty();
    Outcome out;
    for (const int frame : frames) {
        WEFT_TRY(left, a->read(frame));
        WEFT_TRY(right, b->read(single ? b->frames().front() : frame));
        auto diff = diff_frames(left.rgb, right.rgb);
        if (!diff) return fail_in(std::move(diff).error(), "Frame " + std::to_string(frame));
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

}  // namespace

int diff_command(const DiffOptions& options) {
    const auto outcome = compare(options);
    if (!outcome) return report_error(outcome.error());
    const SequenceDiff& all = outcome->all;
    if (options.json) {
        const Json json{{"equal", all.equal()},
                        {"frames", all.frames},
                        {"differing_frames", all.differing_frames},
                        {"max_abs", all.max_abs},
                        {"differences", outcome->frames}};
        print(stdout, json.dump(2) + "\n");
    } else {
        print(stdout, outcome->text + (all.equal() ? "The same: " : "Different: ") +
                          std::to_string(all.frames - all.differing_frames) + " of " +
                          std::to_string(all.frames) + " frames are equal.\n");
    }
    return all.equal() ? 0 : exit_code(ErrorCode::kDiffers);
}

}  // namespace weft
