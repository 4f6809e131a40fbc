// The camera in the header of a rendered EXR: read_camera().

#include <OpenImageIO/imageio.h>

#include <cmath>
#include <numbers>

#include "engine/media/form_passes.h"
#include "engine/media/picture_file.h"

namespace weft {
namespace {

using Rotation = std::array<double, 9>;
using Matrix = std::array<float, 16>;

std::optional<double> field_of_view(const OIIO::ImageSpec& spec) {
    double fov = spec.get_float_attribute("cameraFov", 0);
    const double aperture_mm = spec.get_float_attribute("cameraAperture", 0);
    const double focal_mm = spec.get_float_attribute("cameraFocalLength", 0);
    if (!(fov > 0) && aperture_mm > 0 && focal_mm > 0) {
        // Long double: see docs/decisions/0002-determinism.md.
        const auto half = std::atan(static_cast<long double>(aperture_mm) / (2 * focal_mm));
        fov = static_cast<double>(360 / std::numbers::pi_v<long double> * half);
    }
    return fov > 0.1 && fov < 179.9 ? std::optional(fov) : std::nullopt;
}

std::optional<Matrix> matrix(const OIIO::ImageSpec& spec, const char* name) {
    Matrix out{};
    if (!spec.getattribute(name, OIIO::TypeDesc::TypeMatrix44, out.data())) return std::nullopt;
    return out;
}

// From the world into the camera, as it acts on columns, with rows of length 1. OpenEXR's matrix
// leads into the camera and acts on rows; V-Ray's leads into the world and acts on columns. Either
// is the transpose of what is wanted.
std::optional<Rotation> camera_from_world(const Matrix& m) {
    Rotation out{};
    for (std::size_t i = 0; i < 3; ++i) {
        double squares = 0;
        for (std::size_t j = 0; j < 3; ++j) {
            out[3 * i + j] = m[4 * j + i];
            squares += out[3 * i + j] * out[3 * i + j];
        }
        if (!(squares > 1e-12 && squares < 1e12)) return std::nullopt;
        for (std::size_t j = 0; j < 3; ++j)
            out[3 * i + j] /= std::sqrt(squares);
    }
    return out;
}

}  // namespace

Expected<HeaderCamera> read_camera(const std::string& path) {
    WEFT_TRY(input, open_picture(path));
    const OIIO::ImageSpec& spec = input->spec();
    HeaderCamera out;
    out.fov_deg = field_of_view(spec);
    // The second is OpenImageIO's name for what is stored as cameraTransform.
    for (const char* name : {"worldToCamera", "worldtocamera"})
        if (const auto m = matrix(spec, name); m && !out.camera_from_world)
            out.camera_from_world = camera_from_world(*m);
    for (const OIIO::ParamValue& entry : spec.extra_attribs) {
        const std::string name(entry.name().string());
        out.by_blender |= name == "BlenderMultiChannel" || name.starts_with("cycles.");
    }
    return out;
}

}  // namespace weft
