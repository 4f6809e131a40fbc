#include "engine/color/color_space.h"

#include <set>
#include <span>
#include <utility>
#include <vector>

#include "engine/color/cineon_curve.h"
#include "engine/color/color_files.h"
#include "engine/color/ocio_bridge.h"
#include "engine/color/srgb_curve.h"
#include "engine/core/parallel.h"
#include "engine/core/text.h"

namespace weft {
namespace {

constexpr int kBandRows = 16;

bool is_built_in(const std::string& name) {
    return name == "srgb" || name == "linear" || name == "cineon";
}

// A curve for single values, in place; null: none.
using CurveFn = void (*)(std::span<float>);

CurveFn decoding(const std::string& built_in) {
    if (built_in == "linear") return nullptr;
    return built_in == "srgb" ? decode_srgb : decode_cineon;
}

CurveFn encoding(const std::string& built_in) {
    if (built_in == "linear") return nullptr;
    return built_in == "srgb" ? encode_srgb : encode_cineon;
}

// Converts between two spaces with the same primaries, through linear light.
class CurveTransform final : public ColorTransform {
  public:
    CurveTransform(CurveFn decode, CurveFn encode) : decode_(decode), encode_(encode) {}

    void apply(ImageView<float, 3> rgb) const override {
        if (identity()) return;
        parallel_rows(rgb.height(), kBandRows, [&](int y0, int y1) {
            for (int y = y0; y < y1; ++y) {
                const std::span row(rgb.row(y), static_cast<std::size_t>(rgb.width()) * 3);
                if (decode_) decode_(row);
                if (encode_) encode_(row);
            }
        });
    }
    bool identity() const override { return !decode_ && !encode_; }

  private:
    CurveFn decode_, encode_;
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
    std::string known = "Built in are srgb, linear and cineon";
    known += config ? "; $OCIO has " + config->some_names() + "."
                    : "; set $OCIO to an OpenColorIO config for others.";
    return {ErrorCode::kUsage, "Unknown colour space '" + name + "'.", known, {}};
}

std::shared_ptr<const ColorTransform> between(const std::string& from, const std::string& to) {
    const bool same = from == to;
    return std::make_shared<CurveTransform>(same ? nullptr : decoding(from),
                                            same ? nullptr : encoding(to));
}

std::string name_of(const Meeting& meeting) {
    return meeting.encoded ? "srgb" : "linear";
}

Error no_meeting_place(const std::string& from, const std::string& to) {
    return {ErrorCode::kUsage,
            "The config of $OCIO has no linear Rec.709 space under a usual name such as "
            "'Linear Rec.709 (sRGB)' or 'lin_srgb', so '" +
                from + "' cannot become '" + to + "'.",
            "Name spaces of the config for both.",
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
        return std::make_shared<Chain>(between(from.name, name_of(*meeting)), rest);
    }
    WEFT_TRY(first, config.transform(from.name, meeting->space));
    return std::make_shared<Chain>(first, between(name_of(*meeting), to.name));
}

}  // namespace

Expected<ColorSpace> parse_color_space(const std::string& name) {
    if (is_built_in(name)) return ColorSpace{name};
    WEFT_TRY(config, load_ocio_config());
    if (config && config->knows(name)) return ColorSpace{name};
    if (is_built_in(lower_case(name))) return ColorSpace{lower_case(name)};
    return tl::unexpected(unknown_space(name, config.get()));
}

Expected<std::shared_ptr<const ColorTransform>> make_color_transform(const ColorSpace& from,
                                                                     const ColorSpace& to) {
    if (is_built_in(from.name) && is_built_in(to.name)) {
        return between(from.name, to.name);
    }
    WEFT_TRY(config, load_ocio_config());
    for (const ColorSpace* space : {&from, &to}) {
        if (!is_built_in(space->name) && !(config && config->knows(space->name))) {
            return tl::unexpected(unknown_space(space->name, config.get()));
        }
    }
    return through_config(*config, from, to);
}

std::vector<std::string> color_files(const std::vector<ColorSpace>& spaces) {
    std::set<std::string> names;
    for (const ColorSpace& space : spaces)
        if (!is_built_in(space.name)) names.insert(space.name);
    if (names.empty()) return {};
    const auto config = load_ocio_config();
    if (!config || !*config) return {};
    if (const auto meeting = (*config)->rec709()) names.insert(meeting->space);
    std::set<std::string> files{(*config)->path()};
    for (const std::string& from : names) {
        for (const std::string& to : names)
            if (from != to) files.merge((*config)->files_between(from, to));
    }
    return {files.begin(), files.end()};
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
        return fail(ErrorCode::kUsage, "Unknown view '" + name.view +
                                           "': set $OCIO to an OpenColorIO config that has it.");
    }
    const auto meeting = config->rec709();
    if (!meeting) return tl::unexpected(no_meeting_place("linear", name.view));
    WEFT_TRY(view, config->screen(name, *meeting));
    if (!meeting->encoded) return view;
    auto encoded = std::make_shared<ScreenView>(*view);
    encoded->pixels = std::make_shared<Chain>(between("linear", "srgb"), view->pixels);
    return std::shared_ptr<const ScreenView>(encoded);
}

}  // namespace weft
