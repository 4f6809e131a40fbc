#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "app/shot/shot.h"
#include "engine/pipeline/analysis_store.h"

namespace weft {

/// Keys of everything that the parts of a region's analysis depend on, 32 hexadecimal digits each.
struct RegionKeys {
    /// The mattes that are propagated from the keyframes of one layer. A matte depends on the
    /// keyframes before and after it and on what is confirmed between them only, so a stroke leaves
    /// all others as they are.
    struct Layer {
        std::vector<int> keyframes;  ///< Ascending, at least one.
        /// From each keyframe to the next one, in front of them the frames before the first.
        std::vector<std::string> stretches;
        [[nodiscard]] const std::string& at(int frame) const;
        bool operator==(const Layer&) const = default;
    };

    std::string surface;                ///< Of all but mattes, the form and the focus.
    std::string form;                   ///< As `surface` without a form.
    std::string focus;                  ///< Of the plate's focus.
    std::map<int, Layer> mattes;        ///< By the layers of AnalysisKey; painted ones only.
    std::map<int, std::string> around;  ///< Of the motion around zones, by their layers.
    bool operator==(const RegionKeys&) const = default;

    /// The key of one result.
    [[nodiscard]] const std::string& of(const AnalysisKey& key) const;
    /// All of them; one may occur twice.
    [[nodiscard]] std::vector<std::string> all() const;
    /// Takes over each key of `now`, the keys of the same region, for which moving what is kept
    /// under the old one succeeds.
    void adopt(const RegionKeys& now,
               const std::function<bool(const std::string& from, const std::string& to)>& move);
};

/// The keys of a region; `index`: into ShotPlan::regions. `painted`: mattes without a file. Errors:
/// those of listing the matte and motion files.
[[nodiscard]] Expected<RegionKeys> region_keys(const Shot& shot, std::size_t index,
                                               const PaintedMattes& painted);

}  // namespace weft
