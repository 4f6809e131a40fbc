#include "app/session/where_to_correct.h"

#include <algorithm>
#include <map>

#include "app/session/session_view.h"
#include "engine/mask/keyframe_advice.h"

namespace weft {
namespace {

// Severity of a hint, 0–1, to choose between two hints on one frame.
float badness(CorrectionHint::Kind kind, const FrameMarks& mark) {
    switch (kind) {
        case CorrectionHint::Kind::kMatte:
            return mark.confidence < 0 ? 0.0f : 1.0f - mark.confidence;
        case CorrectionHint::Kind::kDrift:
            return std::clamp(mark.drift, 0.0f, 1.0f);
        case CorrectionHint::Kind::kStretch:
            // The engine gives up at a stretch of 3 (stretch_limit.h).
            return std::clamp((mark.stretch - 1.0f) / 2.0f, 0.0f, 1.0f);
    }
    return 0;
}

float value_of(CorrectionHint::Kind kind, const FrameMarks& mark) {
    return kind == CorrectionHint::Kind::kMatte   ? mark.confidence
           : kind == CorrectionHint::Kind::kDrift ? mark.drift
                                                  : mark.stretch;
}

}  // namespace

std::vector<CorrectionHint> where_to_correct(const std::vector<int>& frames,
                                             const std::vector<FrameMarks>& marks,
                                             const std::vector<int>& painted,
                                             const std::vector<int>& anchored) {
    using Kind = CorrectionHint::Kind;
    // By frame: its worst problem, and which of that kind's suggestions it is.
    struct Found {
        CorrectionHint hint;
        int turn = 0;
        float badness = 0;
    };
    std::map<int, Found> worst;
    for (const Kind kind : {Kind::kMatte, Kind::kDrift, Kind::kStretch}) {
        std::vector<FrameConfidence> list;
        for (std::size_t k = 0; k < std::min(frames.size(), marks.size()); ++k)
            if (value_of(kind, marks[k]) >= 0)
                list.push_back({frames[k], 1.0f - badness(kind, marks[k])});
        const std::vector<int>& done = kind == Kind::kMatte ? painted : anchored;
        if (list.empty() || done.empty()) continue;
        int turn = 0;
        for (const int frame : suggest_keyframes(list, done)) {
            const auto at = static_cast<std::size_t>(
                std::lower_bound(frames.begin(), frames.end(), frame) - frames.begin());
            const Found now{
                {frame, kind, value_of(kind, marks[at])}, turn++, badness(kind, marks[at])};
            const auto [kept, is_new] = worst.try_emplace(frame, now);
            if (!is_new && now.badness > kept->second.badness) kept->second = now;
        }
    }
    std::vector<Found> ranked;
    ranked.reserve(worst.size());
    for (const auto& [frame, found] : worst)
        ranked.push_back(found);
    std::stable_sort(ranked.begin(), ranked.end(), [](const Found& a, const Found& b) {
        return a.turn != b.turn ? a.turn < b.turn : a.badness > b.badness;
    });
    std::vector<CorrectionHint> out;
    out.reserve(ranked.size());
    for (const Found& found : ranked)
        out.push_back(found.hint);
    return out;
}

}  // namespace weft
