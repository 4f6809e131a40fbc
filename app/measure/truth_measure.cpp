#include "app/measure/truth_measure.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/core/luma.h"
#include "engine/core/setting.h"
#include "engine/pipeline/sweep.h"

namespace weft {
namespace {

struct Read {
    ImageF3 result, truth;
    Matte matte;
};

Expected<Read> read_frame(const Shot& shot, const ResultReader& result, const ResultReader& truth,
                          int frame) {
    WEFT_TRY(mine, result.read(frame));
    WEFT_TRY(real, truth.read(frame));
    WEFT_TRY(matte, visible_matte(shot, frame));
    return Read{std::move(mine.display), std::move(real.display), std::move(matte)};
}

}  // namespace

Expected<TruthMeasures> measure_truth(const Shot& shot, const ResultReader& result,
                                      const ResultReader& truth, const std::vector<int>& frames,
                                      float blur_px, const CancelToken& cancel) {
    if (truth.files().size() != shot.plate->size())
        return fail(ErrorCode::kUnreadable, "The truth and the plate differ in size.");
    std::vector<int> both;
    const std::vector<int> known = truth.files().frames();
    std::set_intersection(frames.begin(), frames.end(), known.begin(), known.end(),
                          std::back_inserter(both));
    if (both.empty()) {
        return fail(ErrorCode::kMissingFrames, "The truth has none of the measured frames.",
                    "Check its pattern" + by({{setting::kTruth}}) + ".");
    }
    TruthComparison comparison(blur_px);
    for (const int frame : both) {
        if (cancel.cancelled()) return cancelled(cancel);
        WEFT_TRY(at, read_frame(shot, result, truth, frame));
        comparison.gather(at.result, at.truth, at.matte);
    }
    TruthMeasures out;
    for (const int frame : both) {
        if (cancel.cancelled()) return cancelled(cancel);
        WEFT_TRY(at, read_frame(shot, result, truth, frame));
        const TruthComparison::Frame f = comparison.compare(at.result, at.truth, at.matte);
        out.inside.add(f.inside), out.soft_edge.add(f.soft_edge), out.shadow.add(f.shadow);
        if (f.true_brightness > 0) {
            out.brightness_error =
                std::max(out.brightness_error, std::abs(f.brightness / f.true_brightness - 1.0));
        }
        if (blur_px > 0) continue;
        ImageF1 mine(at.result.size()), real(at.result.size());
        Matte inside(at.matte.size());
        for (int y = 0; y < mine.height(); ++y) {
            for (int x = 0; x < mine.width(); ++x) {
                const auto light = [&](const ImageF3& picture) {
                    const float* p = picture.pixel(x, y);
                    return luma_709(srgb_to_linear(p[0]), srgb_to_linear(p[1]),
                                    srgb_to_linear(p[2]));
                };
                mine.row(y)[x] = light(at.result), real.row(y)[x] = light(at.truth);
                inside.row(y)[x] = at.matte.row(y)[x] == 255 ? 255 : 0;
            }
        }
        out.edges.add(mine, real, inside);
    }
    return out;
}

}  // namespace weft
