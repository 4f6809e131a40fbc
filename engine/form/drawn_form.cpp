#include "engine/form/drawn_form.h"

#include <algorithm>
#include <string>

#include "engine/core/setting.h"

namespace weft {
namespace {

constexpr int kAlong = 17;    // places of a stroke that are looked at
constexpr int kAcross = 432;  // places of the picture's long side that are

bool shows(ViewU8x1 matte, glm::dvec2 place) {
    return place.x >= 0 && place.y >= 0 && place.x < matte.width() && place.y < matte.height() &&
           matte.row(static_cast<int>(place.y))[static_cast<int>(place.x)] >= 128;
}

}  // namespace

Expected<DrawnSurface> surface_of_guides(const std::vector<FormGuide>& guides,
                                         const DrawnCamera& camera) {
    const auto shape = std::find_if(guides.begin(), guides.end(),
                                    [](const FormGuide& guide) { return is_shape(guide.kind); });
    auto surface =
        shape != guides.end() ? drawn_surface(*shape, camera) : drawn_plane(guides, camera);
    if (surface) return surface;
    Error error = std::move(surface).error();
    std::string& last = error.remedy.empty() ? error.message : error.remedy;
    last += by({{setting::kFormShape}, {setting::kFormStrokes}}) + ".";
    return tl::unexpected(std::move(error));
}

Status check_strokes(const std::vector<FormGuide>& guides, FormGuideKind kind, ViewU8x1 visible) {
    for (const FormGuide& stroke : guides) {
        if (stroke.kind != kind) continue;
        for (std::size_t k = 0; k < stroke.numbers.size(); k += 4) {
            bool inside = false;
            for (int i = 0; i < kAlong; ++i) {
                const double t = static_cast<double>(i) / (kAlong - 1);
                inside |= shows(visible, (1 - t) * stroke.place(k) + t * stroke.place(k + 2));
            }
            if (!inside)
                return fail(ErrorCode::kUsage,
                            "A " + std::string(info_of(stroke.kind).name) +
                                " stroke lies outside of the region on its reference frame.",
                            "Draw it on the surface" + by({{setting::kFormStrokes}}) + ".");
        }
    }
    return {};
}

Status check_drawn_form(const std::vector<FormGuide>& guides, const DrawnCamera& camera,
                        ViewU8x1 visible) {
    WEFT_CHECK_OK(check_strokes(guides, FormGuideKind::kParallel, visible));
    WEFT_TRY(surface, surface_of_guides(guides, camera));
    WEFT_CHECK_OK(check_strokes(guides, FormGuideKind::kLevel, visible));
    const int step = std::max(1, std::max(visible.width(), visible.height()) / kAcross);
    bool any = false;
    for (int y = step / 2; y < visible.height(); y += step) {
        for (int x = step / 2; x < visible.width(); x += step) {
            if (visible.row(y)[x] < 128) continue;
            any = true;
            const auto metric =
                surface.metric({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
            if (metric && facing(*metric) > 0 && metric->determinant() > 0) return {};
        }
    }
    if (!any)
        return fail(ErrorCode::kUsage,
                    "The region's matte is empty on its reference frame, so a shape has nothing "
                    "to lie on.",
                    "Choose another reference frame" + by({{setting::kReferenceFrame}}) + ".");
    return fail(ErrorCode::kUsage, "The shape does not lie on the region on its reference frame.",
                "Draw it over the surface" + by({{setting::kFormShape}}) + ".");
}

}  // namespace weft
