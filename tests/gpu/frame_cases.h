#pragma once
// A frame with layers, and what the CPU makes of it.

#include <array>
#include <optional>
#include <vector>

#include "engine/compute/frame_canvas.h"

namespace weft::test {

struct FrameLayer {
    PlanePyramid plane;
    SampleQuality quality = SampleQuality::kFinal;
    Vec2i origin{0, 0};
    ImageF2 coords;
    Matte matte;
    std::array<float, 3> multiply{1, 1, 1};
    ImageF1 shading;  ///< Empty: no light.
    int downscale = 2;
    float reference = 0.5f, strength = 1;
};

struct FrameCase {
    const char* name = "";
    ImageF3 frame;
    std::vector<FrameLayer> layers;
    std::optional<float> knee;
};

[[nodiscard]] std::vector<FrameCase> frame_cases();

struct FrameResult {
    ImageF3 pixels;
    std::int64_t exceeded = 0;
};
/// By engine/compute, engine/lighting and engine/composite, as render_frame() does it.
[[nodiscard]] FrameResult composited_on_cpu(const FrameCase& c);
/// B of a layer over what the frame shows.
[[nodiscard]] ImageF3 old_surface(ViewF3 frame, const FrameLayer& layer);
[[nodiscard]] LayerRequest request_of(const FrameLayer& layer, ViewF3 old_surface);
[[nodiscard]] Recti box_of(const FrameLayer& layer);

}  // namespace weft::test
