#include "engine/form/form_guide.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/core/quad.h"
#include "engine/core/text.h"

namespace weft {
namespace {

constexpr double kLeast_px = 1;
constexpr double kMostTilt_deg = 80;
constexpr double kMost = 1e6;

void scale_places(FormGuide& guide, double by) {
    const std::size_t places = std::min(info_of(guide.kind).places, guide.numbers.size());
    for (std::size_t k = 0; k < places; k += 2)
        guide.numbers[k] *= by;
}

Expected<double> parse_number(std::string_view text) {
    double out = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(out))
        return fail(ErrorCode::kUsage, quoted(text) + " is not a number");
    return out;
}

std::string counts_text(const FormGuideInfo& info) {
    if (info.step > 1) return "a multiple of " + std::to_string(info.step);
    if (info.least == info.most) return std::to_string(info.least);
    return std::to_string(info.least) + " or " + std::to_string(info.most);
}

Expected<FormGuide> parse_guide(std::string_view text) {
    const std::size_t colon = text.find(':');
    const std::string_view name = trimmed(text.substr(0, colon));
    const auto* const info = std::find_if(kFormGuides.begin(), kFormGuides.end(),
                                          [&](const FormGuideInfo& k) { return k.name == name; });
    if (info == kFormGuides.end() || colon == std::string_view::npos) {
        return fail(ErrorCode::kUsage,
                    "Start with plane:, cylinder:, cone:, ball:, parallel:, level: or cut:");
    }
    FormGuide out{info->kind, {}};
    for (const std::string_view part : split(text.substr(colon + 1), ',')) {
        if (out.numbers.size() == kMostParallelNumbers)
            return fail(ErrorCode::kUsage, "It has too many numbers");
        WEFT_TRY(number, parse_number(part));
        out.numbers.push_back(number);
    }
    return out;
}

double length_between(glm::dvec2 a, glm::dvec2 b) {
    const glm::dvec2 d = b - a;
    return std::sqrt(d.x * d.x + d.y * d.y);
}

Status check_round(const FormGuide& guide) {
    const auto& v = guide.numbers;
    const std::string name(info_of(guide.kind).name);
    if (guide.kind == FormGuideKind::kBall) {
        if (v[2] < kLeast_px)
            return fail(ErrorCode::kUsage, "The ball collapses: its radius is below 1 px");
        return {};
    }
    if (length_between(guide.place(0), guide.place(2)) < kLeast_px)
        return fail(ErrorCode::kUsage, "The " + name + " collapses: its axis is shorter than 1 px.",
                    "Draw it longer");
    const double least = guide.kind == FormGuideKind::kCone ? 0 : kLeast_px;
    if (std::min(v[4], v[5]) < least || std::max(v[4], v[5]) < kLeast_px)
        return fail(ErrorCode::kUsage, "The " + name + " collapses: a radius is below 1 px.",
                    "Draw it wider");
    if (v.size() > 6 && std::abs(v[6]) > kMostTilt_deg)
        return fail(ErrorCode::kUsage, "The tilt must be from -80 to 80 degrees");
    return {};
}

}  // namespace

Status check_form_guide(const FormGuide& guide) {
    const FormGuideInfo& info = info_of(guide.kind);
    const std::size_t count = guide.numbers.size();
    if (count < info.least || count > info.most || (count - info.least) % info.step != 0)
        return fail(ErrorCode::kUsage, "A " + std::string(info.name) + " needs " +
                                           counts_text(info) + " numbers, not " +
                                           std::to_string(count));
    for (const double number : guide.numbers)
        if (!(std::abs(number) <= kMost))
            return fail(ErrorCode::kUsage, "Its numbers must be from -1000000 to 1000000");
    switch (guide.kind) {
        case FormGuideKind::kPlane: {
            const Quad<double> corners{guide.place(0), guide.place(2), guide.place(4),
                                       guide.place(6)};
            if (!is_convex(corners))
                return fail(
                    ErrorCode::kUsage,
                    "The plane collapses: its corners do not go round a convex quadrilateral.",
                    "Give them in order around it");
            for (std::size_t k = 0; k < 4; ++k)
                if (length_between(corners[k], corners[(k + 1) % 4]) < kLeast_px)
                    return fail(ErrorCode::kUsage,
                                "The plane collapses: a side is shorter than 1 px");
            return {};
        }
        case FormGuideKind::kParallel:
        case FormGuideKind::kLevel:
        case FormGuideKind::kCut:
            for (std::size_t k = 0; k < count; k += 4)
                if (length_between(guide.place(k), guide.place(k + 2)) < kLeast_px)
                    return fail(ErrorCode::kUsage, "A stroke is shorter than 1 px.",
                                "Draw it along the surface");
            return {};
        default:
            return check_round(guide);
    }
}

FormGuide unsqueezed(FormGuide guide, PixelAspect aspect) {
    scale_places(guide, static_cast<double>(aspect.ratio()));
    return guide;
}

FormGuide squeezed(FormGuide guide, PixelAspect aspect) {
    scale_places(guide, 1 / static_cast<double>(aspect.ratio()));
    return guide;
}

Expected<std::vector<FormGuide>> parse_form_guides(std::string_view text) {
    std::vector<FormGuide> out;
    for (const std::string_view part : split(text, ';')) {
        if (part.empty()) continue;
        auto guide = parse_guide(part);
        if (!guide) return fail_in(std::move(guide).error(), quoted(part.substr(0, 60)));
        out.push_back(std::move(*guide));
    }
    return out;
}

std::string form_guides_text(const std::vector<FormGuide>& guides) {
    std::string out;
    for (const FormGuide& guide : guides) {
        if (!out.empty()) out += "; ";
        out += info_of(guide.kind).name;
        char before = ':';
        for (const double number : guide.numbers) {
            out += before;
            out += shortest_text(number);
            before = ',';
        }
    }
    return out;
}

}  // namespace weft
