#pragma once
// What form was found for each region, in the words of the command line, the report and the editor.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/shot/shot.h"
#include "engine/form/form_guide.h"
#include "engine/form/form_map.h"
#include "engine/pipeline/analysis_store.h"

namespace weft {

struct FormReport {
    /// Why no form was looked for.
    enum class NotSought : std::uint8_t {
        kSought,
        kChosen,   ///< The artist chose flat.
        kNoPass,   ///< A pass is to show it, and there is none.
        kCorners,  ///< Corners give the perspective.
        kUvPass,   ///< A UV pass gives the exact place.
        kUnlocked  ///< The temporal mode is not the locked one.
    };

    std::string region;  ///< Its name.
    int frame = 0;       ///< Its reference frame.
    std::string pass;    ///< "the position pass"; empty: another source.
    /// What was drawn: a shape, or kParallel for strokes.
    std::optional<FormGuideKind> drawn;
    float amount = 1;  ///< As set: how far the texture follows the form, 0–1; with keys the most.
    bool keyed = false;   ///< The amount has keys.
    FormFinding finding;  ///< kNone: flat.
    NotSought not_sought = NotSought::kSought;
    bool lines_asked = true;  ///< Whether straight lines could show it: not of cloth or a body.

    [[nodiscard]] bool is_flat() const {
        return finding.source == FormFinding::Source::kNone || !(amount > 0);
    }
};

/// The forms of the plan's regions in their order. A region whose form is still to be found has no
/// entry. Errors: those of the store.
[[nodiscard]] Expected<std::vector<FormReport>> form_reports(const Shot& shot,
                                                             const AnalysisStore& store);

/// One line without the region's name: "plane, from 12 frames of motion, tilted 71° ± 2°, field of
/// view 47°", "flat, because the camera only turns or zooms". Thread-safe.
[[nodiscard]] std::string form_text(const FormReport& form);

/// An entry of `forms` in the report (docs/FORMATS.md). Thread-safe.
[[nodiscard]] nlohmann::ordered_json form_json(const FormReport& form);

}  // namespace weft
