#include "engine/pipeline/form_laid.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "engine/form/flat_plane.h"
#include "engine/form/flatten.h"
#include "engine/form/form_relief.h"
#include "engine/form/pulled_back.h"
#include "engine/pipeline/plate_views.h"

namespace weft {
namespace {

constexpr double kLeastNearness = 0.04;  // of a plane towards its horizon

// Adds the surface at the places that a frame shows of it. Returns the least nearness of them.
double add_places(MetricField& field, const RigidSurface& surface, const FormEvidence& at,
                  double weight) {
    const int step = std::max(1, field.spacing() / 4);
    double least = std::numeric_limits<double>::infinity();
    for (int y = step / 2; y < at.visible.height(); y += step) {
        for (int x = step / 2; x < at.visible.width(); x += step) {
            if (at.visible.row(y)[x] != 255) continue;
            const Vec2 frame = centre_of_pixel(x, y);
            const Vec2 place = frame + at.ref_from_cur.at(frame);
            const double nearness = surface.nearness(place);
            if (!(nearness >= kLeastNearness)) continue;
            least = std::min(least, nearness);
            const Metric metric = surface.metric(place);
            const double cosine = facing(metric);
            if (cosine > 0) field.add(place, metric, weight * cosine * cosine);
        }
    }
    return least;
}

}  // namespace

FormMap flat_over(Size plate, const FormFinding& finding) {
    return {{}, LatticeField(plate, std::max(plate.width, plate.height)), finding};
}

FormMap laid_flat(const RigidSurface& surface, const FormFinding& finding,
                  const std::vector<FormEvidence>& evidence, Size plate) {
    MetricField field = field_over(plate, evidence);
    double least = add_places(field, surface, evidence.front(), 1);
    MetricField::Beyond beyond;
    if (finding.plane) {
        for (std::size_t k = 1; k < evidence.size(); ++k)
            least = std::min(least, add_places(field, surface, evidence[k], kOtherFrames));
        least *= kGoesOn;
        beyond = [&surface, least](Vec2 place) {
            return surface.nearness(place) >= least ? std::optional(surface.metric(place))
                                                    : std::nullopt;
        };
    }
    if (!field.finish(beyond)) {
        FormFinding none = finding;
        none.source = FormFinding::Source::kNone;
        return flat_over(plate, none);
    }
    FormMap out = finding.plane ? flat_plane(surface.plane(finding.belief), least, field)
                                : flat_from_reference(field);
    out.finding = finding;
    add_relief(out, field, static_cast<double>(finding.fov_deg), plate, finding.plane);
    return out;
}

}  // namespace weft
