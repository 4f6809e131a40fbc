// Motion from renderers' passes: read_motion().

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/setting.h"
#include "engine/media/image_files.h"
#include "engine/media/pass_layers.h"
#include "engine/media/raster_errors.h"

namespace weft {
namespace {

// A renderer's convention: a vector in `units`, y up; times `sign` it leads to the other frame.
struct Convention {
    std::array<const char*, 2> forward, backward;  // channels after "LAYER."
    std::array<const char*, 2> layers;             // where to look when none is named
    enum { kPixels, kHalfPicture, kPicture } units;
    float forward_sign, backward_sign;
    bool premultiplied;
    bool layer_by_direction = false;  // the first layer leads forward, the second backward
};

Convention convention_of(MotionConvention convention) {
    using C = Convention;
    switch (convention) {
        case MotionConvention::kBlender:
            // Cycles' Vector pass: X, Y lead to the previous frame; Z, W come from the next one.
            return {{"Z", "W"}, {"X", "Y"}, {"Vector", ""}, C::kPixels, -1, 1, false};
        case MotionConvention::kNuke:
            return {{"u", "v"}, {"u", "v"}, {"forward", "backward"}, C::kPixels, 1, 1, false, true};
        case MotionConvention::kMoonray:
            // Screen space, −1 to 1 over the picture's width; filtered, so premultiplied by alpha.
            return {{"R", "G"}, {"R", "G"}, {"motionvec", "motion_vectors"}, C::kHalfPicture, 1,
                    -1,         true};
        case MotionConvention::kFlame:
            // Of the picture's size; the backward vector comes from the previous frame.
            return {{"R", "G"}, {"R", "G"}, {"", ""}, C::kPicture, 1, -1, false};
        case MotionConvention::kArnold:
        case MotionConvention::kFiles:
            break;
    }
    // Arnold's motionvector with its raw values: pixels over the frame.
    return {{"R", "G"}, {"R", "G"}, {"motionvector", ""}, C::kPixels, 1, -1, false};
}

PassKind pass_kind(const Convention& convention, bool forward) {
    const auto& channels = forward ? convention.forward : convention.backward;
    PassKind kind{"motion", {}, {{channels[0], channels[1]}}, setting::kMotionLayer};
    for (std::size_t k = 0; k < convention.layers.size(); ++k) {
        const bool other_way = convention.layer_by_direction && k != (forward ? 0 : 1);
        const std::string layer = convention.layers[k];
        if (!layer.empty() && !other_way) kind.layers.push_back(layer);
    }
    return kind;
}

// Channels without a layer's name, where no other layer could be meant. R and G beside others are a
// picture.
std::optional<FoundPass> find_unnamed(const std::vector<PassLayer>& layers, const PassKind& kind) {
    if (layers.size() > 1 && kind.channels.front().front() == "R") return std::nullopt;
    std::optional<FoundPass> only;
    for (const PassLayer& layer : layers) {
        if (layer.prefixed || !layer.has(kind.channels.front())) continue;
        if (only) return std::nullopt;
        only = pass_in(layer, kind);
    }
    return only;
}

// Blender's File Output node writes a vector's first three channels: W, a part of the motion to the
// next frame, is lost.
Error lacks_w(const std::string& path, const std::string& layer) {
    return unreadable(
        path, "its layer '" + layer + "' has X and Y, the motion to the previous frame, but no W",
        "Use it backwards" + by({{setting::kMotionDirection, "backward"}}) +
            "; a File Output node of Blender drops W, the render's own multilayer EXR has it.");
}

}  // namespace

Expected<FoundPass> locate_motion(const std::string& path, const MotionSelect& select,
                                  const std::vector<std::string>& beside) {
    WEFT_CHECK_OK(check_picture_exists(path));
    const PassKind kind =
        pass_kind(convention_of(select.convention), select.direction == MotionDirection::kForward);
    WEFT_TRY(layers, list_pass_layers(path));
    auto found = find_pass(layers, kind, select.layer, beside);
    if (!found && select.layer.empty()) found = find_unnamed(layers, kind);
    if (found) return std::move(*found);
    if (select.convention == MotionConvention::kBlender &&
        select.direction == MotionDirection::kForward) {
        PassKind cut = kind;
        cut.channels = {{"X", "Y"}};
        if (const auto there = find_pass(layers, cut, select.layer, beside))
            return tl::unexpected(lacks_w(path, there->layer.name));
    }
    return tl::unexpected(no_such_pass(path, kind, select.layer, layers));
}

namespace {

// The samples of the alpha that a vector was multiplied by; empty without one.
std::vector<float> alpha_of(const std::string& path, const FoundPass& pass) {
    const PassKind kind{"motion", {}, {{"A"}}, {}};
    for (const std::string& name : {pass.layer.channel("A"), std::string("A")}) {
        if (name.empty()) continue;
        FoundPass alpha{pass.layer, {name}, {}};
        Size size;
        if (auto found = read_pass(path, kind, alpha, {}, size)) return std::move(found->front());
    }
    return {};
}

// A vector that leads so far out of the picture is none: Cycles writes 10000 beside its render
// region, others infinity or a large number where nothing moves.
float longest_px(Size size) {
    return 2.0f * static_cast<float>(std::max(size.width, size.height));
}

}  // namespace

Expected<FlowField> read_motion(const std::string& path, const MotionSelect& select,
                                Size expected) {
    if (select.convention == MotionConvention::kFiles) return read_flow(path, expected);
    const Convention convention = convention_of(select.convention);
    const bool forward = select.direction == MotionDirection::kForward;
    const PassKind kind = pass_kind(convention, forward);
    WEFT_TRY(pass, locate_motion(path, select));
    Size size;
    WEFT_TRY(vector, read_pass(path, kind, pass, expected, size));
    const std::vector<float>&u = vector[0], &v = vector[1];
    const std::vector<float> alpha =
        convention.premultiplied ? alpha_of(path, pass) : std::vector<float>();
    const float sign = forward ? convention.forward_sign : convention.backward_sign;
    const float share = convention.units == Convention::kPixels        ? 0.0f
                        : convention.units == Convention::kHalfPicture ? 0.5f
                                                                       : 1.0f;
    // MoonRay's screen space has one unit for both axes: half of the width.
    const bool square = convention.units == Convention::kHalfPicture;
    const float unit_x = share > 0 ? share * static_cast<float>(size.width) : 1.0f;
    const float unit_y =
        share > 0 ? share * static_cast<float>(square ? size.width : size.height) : 1.0f;
    FlowField flow(size);
    constexpr float kOutsideRegion = 10000;  // of Cycles
    const float longest = longest_px(size);
    for (std::size_t i = 0; i < u.size(); ++i) {
        const float a = alpha.empty() ? 1.0f : alpha[i];
        const float x = sign * unit_x * u[i] / a, y = -sign * unit_y * v[i] / a;
        const bool known = std::abs(x) < longest && std::abs(y) < longest &&  // false for NaN
                           std::abs(u[i]) != kOutsideRegion;
        flow.d.data()[2 * i] = known ? x : 0.0f;
        flow.d.data()[2 * i + 1] = known ? y : 0.0f;
        flow.valid.data()[i] = known ? 255 : 0;
    }
    return flow;
}

}  // namespace weft
