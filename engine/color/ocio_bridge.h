#pragma once
// Internal: wraps OpenColorIO. The only place that includes it.

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/color/color_space.h"
#include "engine/color/screen_view.h"
#include "engine/core/error.h"

namespace weft {

/// The config's space that equals a built-in one: `space` is linear, or encoded by the sRGB curve.
struct Meeting {
    std::string space;
    bool encoded = false;
};

/// The config of $OCIO. Immutable; thread-safe.
class OcioConfig {
  public:
    virtual ~OcioConfig() = default;
    /// Returns true if it has a space, role or alias of this name.
    [[nodiscard]] virtual bool knows(const std::string& name) const = 0;
    /// Some names, joined by commas.
    [[nodiscard]] virtual std::string some_names() const = 0;
    /// The space for linear or sRGB-encoded Rec.709 under a usual name, if there is one.
    [[nodiscard]] virtual std::optional<Meeting> rec709() const = 0;
    [[nodiscard]] virtual Expected<std::shared_ptr<const ColorTransform>> transform(
        const std::string& from, const std::string& to) const = 0;
    /// Its file, or "ocio://…" for one that OpenColorIO has built in.
    [[nodiscard]] virtual std::string path() const = 0;
    /// The look-up tables of transform(); none if there is no such conversion.
    [[nodiscard]] virtual std::set<std::string> files_between(const std::string& from,
                                                              const std::string& to) const = 0;
    /// As list_screens() and list_color_spaces().
    [[nodiscard]] virtual std::vector<ScreenName> screens() const = 0;
    [[nodiscard]] virtual std::vector<std::string> spaces() const = 0;
    /// As make_screen_view(). `meeting`: the config's Rec. 709 space.
    [[nodiscard]] virtual Expected<std::shared_ptr<const ScreenView>> screen(
        const ScreenName& name, const Meeting& meeting) const = 0;
};

/// Null if $OCIO is not set. Errors: Unreadable, with the path and OpenColorIO's reason.
[[nodiscard]] Expected<std::shared_ptr<const OcioConfig>> load_ocio_config();

}  // namespace weft
