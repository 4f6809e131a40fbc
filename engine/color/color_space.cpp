#include "engine/color/color_space.h"

#include <algorithm>
#include <cctype>
#include <span>
#include <utility>
#include <vector>

#include "engine/color/ocio_bridge.h"
#include "engine/color/srgb_curve.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr int kBandRows = 16;

bool is_built_in(const std::string& name) {
    return name == "srgb" || name == "linear";
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

enum class Curve { kNone, kDecode, kEncode };

class CurveTransform final : public ColorTransform {
  public:
    explicit CurveTransform(Curve curve) : curve_(curve) {}

    void apply(ImageView<float, 3> rgb) const override {
        if (curve_ == Curve::kNone) return;
        const auto convert = curve_ == Curve::kDecode ? decode_srgb : encode_srgb;
        parallel_rows(rgb.height(), kBandRows, [&](int y0, int y1) {
            for (int y = y0; y < y1; ++y) {
                convert(std::span(rgb.row(y), static_cast<std::size_t>(rgb.width()) * 3));
            }
        });
    }
    bool identity() const override { return curve_ == Curve::kNone; }

  private:
    Curve curve_;
};

class Chain final : public ColorTransform {
  public:
    using Step = std::shared_ptr<const ColorTransform>;
    Chain(Step first, Step second) : first_(std::move(first)), second_(std::move(second)) {}

    void apply(ImageView<float, 3> rgb) const override {
        first_->apply(rgb);
        second_->apply(rgb);
    }
    bool identity() const override { return first_->identity() && second_->identity(); }

  private:
    Step first_, second_;
};

Error unknown_space(const std::string& name, const OcioConfig* config) {
    std::string message = "There is no colour space '" + name + "'. Built in are srgb and linear";
    message += config ? "; $OCIO has " + config->some_names() + "."
                      : "; set $OCIO to an OpenColorIO config for others.";
    return {ErrorCode::kUsage, message, {}};
}

/// The curve between two spaces with the same primaries, each linear or sRGB-encoded.
Curve curve_between(bool from_encoded, bool to_encoded) {
    if (from_encoded == to_encoded) return Curve::kNone;
    return from_encoded ? Curve::kDecode : Curve::kEncode;
}

Error no_meeting_place(const std::string& from, const std::string& to) {
    return {ErrorCode::kUsage,
            "The config of $OCIO has no linear Rec.709 space under a usual name such as "
            "'Linear Rec.709 (sRGB)' or 'lin_srgb', so '" +
                from + "' cannot become '" + to + "'. Name spaces of the config for both.",
            {}};
}

Expected<std::shared_ptr<const ColorTransform>> through_config(const OcioConfig& config,
                                                               const ColorSpace& from,
                                                               const ColorSpace& to) {
    if (!is_built_in(from.name) && !is_built_in(to.name))
        return config.transform(from.name, to.name);
    const auto meeting = config.rec709();
    if (!meeting) return tl::unexpected(no_meeting_place(from.name, to.name));
    if (is_built_in(from.name)) {
        WEFT_TRY(rest, config.transform(meeting->space, to.name));
        const Curve curve = curve_between(from.name == "srgb", meeting->encoded);
        return std::make_shared<Chain>(std::make_shared<CurveTransform>(curve), rest);
    }
    WEFT_TRY(first, config.transform(from.name, meeting->space));
    const Curve curve = curve_between(meeting->encoded, to.name == "srgb");
    return std::make_shared<Chain>(first, std::make_shared<CurveTransform>(curve));
}

}  // namespace

Expected<ColorSpace> parse_color_space(const std::string& name) {
    if (is_built_in(name)) return ColorSpace{name};
    WEFT_TRY(config, load_ocio_config());
    if (config && config->knows(name)) return ColorSpace{name};
    if (is_built_in(lower(name))) return ColorSpace{lower(name)};
    return tl::unexpected(unknown_space(name, config.get()));
}

Expected<std::shared_ptr<const ColorTransform>> make_color_transform(const ColorSpace& from,
                                                                     const ColorSpace& to) {
    if (is_built_in(from.name) && is_built_in(to.name)) {
        return std::make_shared<CurveTransform>(
            curve_between(from.name == "srgb", to.name == "srgb"));
    }
    WEFT_TRY(config, load_ocio_config());
    for (const ColorSpace* space : {&from, &to}) {
        if (!is_built_in(space->name) && !(config && config->knows(space->name))) {
            return tl::unexpected(unknown_space(space->name, config.get()));
        }
    }
    return through_config(*config, from, to);
}

Expected<std::vector<ScreenName>> list_screens() {
    WEFT_TRY(config, load_ocio_config());
    return config ? config->screens() : std::vector<ScreenName>{};
}

Expected<std::vector<std::string>> list_color_spaces() {
    WEFT_TRY(config, load_ocio_config());
    return config ? config->spaces() : std::vector<std::string>{};
}

Expected<std::shared_ptr<const ScreenView>> make_screen_view(const ScreenName& name) {
    WEFT_TRY(config, load_ocio_config());
    if (!config) {
        return fail(ErrorCode::kUsage, "There is no view '" + name.view +
                                           "': set $OCIO to an OpenColorIO config that has it.");
    }
    const auto meeting = config->rec709();
    if (!meeting) return tl::unexpected(no_meeting_place("linear", name.view));
    WEFT_TRY(view, config->screen(name, *meeting));
    if (!meeting->encoded) return view;
    auto encoded = std::make_shared<ScreenView>(*view);
    encoded->pixels =
        std::make_shared<Chain>(std::make_shared<CurveTransform>(Curve::kEncode), view->pixels);
    return std::shared_ptr<const ScreenView>(encoded);
}

}  // namespace weft
