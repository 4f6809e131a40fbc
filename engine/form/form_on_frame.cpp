#include "engine/form/form_on_frame.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/form/eigen_types.h"
#include "engine/form/rigid_pose.h"
#include "engine/form/view_camera.h"

namespace weft {
namespace {

constexpr double kPosePlaces = 240;  // that decide the pose
constexpr std::size_t kLeastPlaces = 12;
constexpr double kSigma = 0.3 / 854;        // of a place, by the longer side
constexpr double kHalfTrusted = 1.5 / 854;  // at which the confidence has fallen by half
constexpr float kStill_px = 1e-3f;
constexpr float kHalf_px = 1;  // of the step by which slopes are taken

Vector3 vector_of(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

// The surface over the reference frame.
class Relief {
  public:
    Relief(const FormMap& form, Size picture)
        : form_(form), camera_(camera_with(static_cast<double>(form.relief_fov_deg), picture)) {}

    [[nodiscard]] const ViewCamera& camera() const { return camera_; }
    [[nodiscard]] float known(Vec2 pixel) const {
        return std::clamp(form_.relief.at(pixel - form_.origin).y, 0.0f, 1.0f);
    }
    [[nodiscard]] Vector3 place(Vec2 pixel) const {
        // Long double: see docs/decisions/0002-determinism.md.
        const auto depth =
            static_cast<double>(std::exp(static_cast<long double>(log_depth(pixel))));
        return depth * vector_of(camera_.ray(pixel));
    }
    // Of length 1, towards the camera. The tangents are ∂(z r) = z (∂r + r ∂ ln z), and their cross
    // product is, with a = ∂ ln z, (−f aₓ, −f a_y, 1 + f a · r) up to a factor.
    [[nodiscard]] Vector3 normal(Vec2 pixel) const {
        const Vec2 x(kHalf_px, 0), y(0, kHalf_px);
        const double f = camera_.focal_px / (2 * static_cast<double>(kHalf_px));
        const double ax = f * (log_depth(pixel + x) - log_depth(pixel - x));
        const double ay = f * (log_depth(pixel + y) - log_depth(pixel - y));
        const glm::dvec3 ray = camera_.ray(pixel);
        return Vector3(ax, ay, -1 - ax * ray.x - ay * ray.y).normalized();
    }

  private:
    [[nodiscard]] double log_depth(Vec2 pixel) const {
        return static_cast<double>(form_.relief.at(pixel - form_.origin).x);
    }

    const FormMap& form_;
    ViewCamera camera_;
};

// A frame's pixels unsqueezed and at the size of the reference frame, and where they come from.
struct Way {
    const LatticeField& ref_from_cur;
    float smaller;
    PixelAspect aspect;

    [[nodiscard]] Vec2 frame(int x, int y) const {
        const Vec2 centre(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
        return aspect.unsqueezed(smaller * centre);
    }
    [[nodiscard]] Vec2 displacement(Vec2 frame) const {
        return aspect.unsqueezed(smaller * ref_from_cur.at(aspect.squeezed(frame) / smaller));
    }
};

struct Pose {
    bool known = false;
    RigidPose rigid;
};

Pose find_pose(const Relief& relief, const Way& way, ViewU8x1 matte, const Recti& box,
               double sigma_px) {
    double area = 0;
    for (int y = 0; y < box.height(); ++y)
        area += static_cast<double>(std::count_if(matte.row(y), matte.row(y) + box.width(),
                                                  [](std::uint8_t v) { return v >= 128; }));
    const int step = std::max(1, static_cast<int>(std::sqrt(area / kPosePlaces)));
    std::vector<SeenPlace> seen;
    bool still = true;
    for (int y = step / 2; y < box.height(); y += step) {
        for (int x = step / 2; x < box.width(); x += step) {
            if (matte.row(y)[x] < 128) continue;
            const Vec2 at = way.frame(box.x0 + x, box.y0 + y), d = way.displacement(at);
            if (!(relief.known(at + d) >= 0.5f)) continue;
            seen.push_back({relief.place(at + d), at});
            still = still && std::max(std::abs(d.x), std::abs(d.y)) < kStill_px;
        }
    }
    if (seen.size() < kLeastPlaces) return {};
    // The reference frame shows the surface as it is.
    if (still) return {true, {}};
    return {true, pose_of(seen, relief.camera(), sigma_px)};
}

}  // namespace

ShownForm form_on_frame(const FormMap& form, const LatticeField& ref_from_cur, ViewU8x1 matte,
                        const Recti& box, float smaller) {
    ShownForm out{ImageF3(box.size()), ImageF1(box.size()), ImageF1(box.size())};
    if (form.finding.source == FormFinding::Source::kNone || form.relief.empty()) return out;
    const Way way{ref_from_cur, smaller, form.aspect};
    const Size frame = ref_from_cur.full_size();
    const auto full = [&](int side) {
        return static_cast<int>(std::lround(smaller * static_cast<float>(side)));
    };
    const Size picture = form.aspect.unsqueezed(Size{full(frame.width), full(frame.height)});
    const double side = std::max(picture.width, picture.height);
    const Relief relief(form, picture);
    const Pose pose = find_pose(relief, way, matte, box, kSigma * side);
    if (!pose.known) return out;
    parallel_rows(box.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < box.width(); ++x) {
                if (matte.row(y)[x] == 0) continue;
                const Vec2 at = way.frame(box.x0 + x, box.y0 + y);
                const Vec2 from = at + way.displacement(at);
                const Vector3 place = relief.place(from);
                const Vector3 normal = pose.rigid.rotation * relief.normal(from);
                const Vector3 moved = pose.rigid.rotation * place + pose.rigid.shift;
                const double off =
                    error_px(pose.rigid, relief.camera(), {place, at}) / (kHalfTrusted * side);
                if (!normal.allFinite() || !(moved.z() > 0) || !std::isfinite(off)) continue;
                // From view space, whose y points down and whose z points into the scene.
                float* n = out.normal.pixel(x, y);
                n[0] = static_cast<float>(normal.x());
                n[1] = static_cast<float>(-normal.y());
                n[2] = static_cast<float>(-normal.z());
                out.depth.at(x, y) = static_cast<float>(moved.z());
                out.confidence.at(x, y) = form.finding.belief * relief.known(from) *
                                          static_cast<float>(1 / (1 + off * off));
            }
        }
    });
    return out;
}

}  // namespace weft
