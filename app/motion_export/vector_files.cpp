#include "app/motion_export/vector_files.h"

#include <array>
#include <functional>
#include <utility>
#include <vector>

#include "engine/core/geometry.h"
#include "engine/media/exr_frame.h"

namespace weft {
namespace {

// What a pixel has.
struct PixelMotion {
    Vec2 forward{0}, backward{0};  // px, y up
    float visible = 0;
};
using Samples = std::function<std::array<float, 4>(const PixelMotion&)>;

// A convention's channels, up to four, and their samples.
struct Layout {
    std::vector<std::string> channels;
    Samples samples;
};

Layout layout_of(MotionConvention convention, Vec2 size) {
    switch (convention) {
        case MotionConvention::kBlender:
            // To the previous frame; and from the next one, which is the other way round.
            return {{"Vector.X", "Vector.Y", "Vector.Z", "Vector.W"}, [](const PixelMotion& m) {
                        return std::array{m.backward.x, m.backward.y, -m.forward.x, -m.forward.y};
                    }};
        case MotionConvention::kMoonray:
            // Half of the width is 1 on both axes; premultiplied.
            return {{"motionvec.R", "motionvec.G", "motionvec.A"}, [size](const PixelMotion& m) {
                        const Vec2 v = m.visible * m.forward / (0.5f * size.x);
                        return std::array{v.x, v.y, m.visible, 0.0f};
                    }};
        case MotionConvention::kArnold:
            return {{"motionvector.R", "motionvector.G"}, [](const PixelMotion& m) {
                        return std::array{m.forward.x, m.forward.y, 0.0f, 0.0f};
                    }};
        case MotionConvention::kFlame:
            return {};  // the picture itself holds it
        case MotionConvention::kNuke:
        case MotionConvention::kFiles:
            break;
    }
    return {{"forward.u", "forward.v", "backward.u", "backward.v"}, [](const PixelMotion& m) {
                return std::array{m.forward.x, m.forward.y, m.backward.x, m.backward.y};
            }};
}

PixelMotion motion_at(const FrameVectors& vectors, int x, int y, bool single) {
    const auto upwards = [&](const ImageF2& field) {
        const float* d = field.pixel(x, y);
        return Vec2(d[0], -d[1]);
    };
    PixelMotion out{upwards(vectors.forward), upwards(vectors.backward), vectors.visible.at(x, y)};
    if (single && !vectors.has_forward) out.forward = -out.backward;
    // Neither "−0" nor sign bits that depend on the direction.
    out.forward += Vec2(0.0f);
    out.backward += Vec2(0.0f);
    return out;
}

}  // namespace

Status write_vectors(const std::string& path, const FrameVectors& vectors,
                     MotionConvention convention, WriteOptions write) {
    const Size size = vectors.visible.size();
    const Vec2 wide(static_cast<float>(size.width), static_cast<float>(size.height));
    const Layout layout = layout_of(convention, wide);
    const bool flame = convention == MotionConvention::kFlame;
    const bool single = flame || convention == MotionConvention::kMoonray ||
                        convention == MotionConvention::kArnold;
    const std::size_t pixels =
        static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
    ImageF3 picture(size);
    ImageF1 confidence(size);
    ExrLayer layer{layout.channels, true, {}};
    layer.samples.reserve(pixels * layout.channels.size());
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const PixelMotion motion = motion_at(vectors, x, y, single);
            const Vec2 shown = flame ? motion.forward / wide : motion.forward;
            float* to = picture.pixel(x, y);
            to[0] = shown.x, to[1] = shown.y, to[2] = motion.visible;
            confidence.at(x, y) = motion.visible > 0 ? vectors.confidence : 0.0f;
            if (flame) continue;
            const std::array<float, 4> samples = layout.samples(motion);
            layer.samples.insert(
                layer.samples.end(), samples.begin(),
                samples.begin() + static_cast<std::ptrdiff_t>(layout.channels.size()));
        }
    }
    ExrFrame frame;
    frame.rgb = picture;
    frame.alpha = confidence;
    if (!flame) frame.layers.push_back(std::move(layer));
    write.depth = PixelDepth::kFloat;
    write.exr_compression = "zip";
    return write_exr(path, frame, write);
}

}  // namespace weft
