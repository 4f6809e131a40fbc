#include "ui/parameters/setting_labels.h"

#include <algorithm>
#include <array>
#include <utility>

#include "ui/parameters/parameters.h"

namespace weft::ui {
namespace {

using Entry = std::pair<std::string_view, std::string_view>;

// Labels of sections, fields and menu entries that are not parameter sliders.
constexpr std::array kLabels{Entry{setting::kAddRegion, "Regions → +"},
                             Entry{setting::kBackend, "Backend"},
                             Entry{setting::kCryptoFiles, "Cryptomatte"},
                             Entry{setting::kExcludedLicences, "Exclude licences"},
                             Entry{setting::kFormShape, "Form → Draw"},
                             Entry{setting::kFormSource, "Form → Source"},
                             Entry{setting::kFormStrokes, "Form → Strokes"},
                             Entry{setting::kFov, "Form → Field of view"},
                             Entry{setting::kFrames, "Frames"},
                             Entry{setting::kHoldout, "Holdouts"},
                             Entry{setting::kWarp, "Grid warp"},
                             Entry{setting::kZone, "Zones"},
                             Entry{setting::kImportTextures, "Add textures…"},
                             Entry{setting::kLamps, "Painted lamps"},
                             Entry{setting::kLayers, "Layers for compositing"},
                             Entry{setting::kLayersOutput, "Separate files"},
                             Entry{setting::kLightSource, "Light"},
                             Entry{setting::kMatte, "Matte"},
                             Entry{setting::kMatteChannel, "Matte files"},
                             Entry{setting::kMatteFrozenFiles, "Freeze and export"},
                             Entry{setting::kOutput, "Folder"},
                             Entry{setting::kOverwrite, "If files exist: Overwrite"},
                             Entry{setting::kPlane, "Tile"},
                             Entry{setting::kPlate, "Open"},
                             Entry{setting::kPlateLayer, "Shot settings → Layer"},
                             Entry{setting::kPlateSpace, "Shot settings → Colour space"},
                             Entry{setting::kReferenceFrame, "Reference frames"},
                             Entry{setting::kSample, "Texture"},
                             Entry{setting::kSkipExisting, "If files exist: Skip"},
                             Entry{setting::kTemporalMode, "Temporal mode"},
                             Entry{setting::kTextureSpace, "Shot settings → Textures"},
                             Entry{setting::kTrack, "Planar track"}};

}  // namespace

std::string setting_label(const SettingRef& setting) {
    const auto at = std::find_if(kLabels.begin(), kLabels.end(),
                                 [&](const Entry& entry) { return entry.first == setting.key; });
    std::string label(at != kLabels.end() ? at->second : parameter_label(setting.key));
    if (!label.empty() && !setting.value.empty())
        label += ": " + std::string(choice_label(setting.key, setting.value));
    return label;
}

}  // namespace weft::ui
