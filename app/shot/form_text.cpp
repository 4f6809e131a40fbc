#include "app/shot/form_text.h"

#include <cmath>

namespace weft {
namespace {

constexpr float kCertain = 0.995f;

std::string whole(float value) {
    return std::to_string(std::lround(value));
}

std::string frames_text(int frames) {
    return std::to_string(frames) + (frames == 1 ? " frame" : " frames");
}

std::string drawn_text(const FormParams& form) {
    if (form.shape.empty()) return "Plane, from parallel strokes";
    std::string name(info_of(form.shape.front().kind).name);
    name[0] = static_cast<char>(name[0] - 'a' + 'A');
    return name + ", as drawn";
}

std::string pass_text(const FormParams& form) {
    if (form.source == FormSource::kDepth) return "depth pass";
    return form.position.empty() ? "normal pass" : "position pass";
}

}  // namespace

std::string form_text(const FormParams& form, const FormFinding& finding) {
    std::string out;
    switch (finding.source) {
        case FormFinding::Source::kNone:
            return "Nothing shows the form: the surface stays flat";
        case FormFinding::Source::kPass:
            return "From the " + pass_text(form) + " on " + frames_text(finding.frames);
        case FormFinding::Source::kMotion:
            out = std::string(finding.plane ? "Plane" : "Curved surface") + ", from " +
                  frames_text(finding.frames) + " of motion";
            break;
        case FormFinding::Source::kShape:
            out = drawn_text(form);
            break;
    }
    if (finding.plane) {
        out += ", tilted " + whole(finding.tilt_deg) + "°";
        if (finding.tilt_error_deg >= 0.5f) out += " ± " + whole(finding.tilt_error_deg) + "°";
    } else if (finding.source == FormFinding::Source::kMotion && finding.tilt_error_deg >= 0.5f) {
        out += ", ± " + whole(finding.tilt_error_deg) + "°";
    }
    if (finding.belief < kCertain) out += ", " + whole(100 * finding.belief) + " % of it used";
    return out;
}

}  // namespace weft
