#pragma once
// Names of enumerators. Internal; other code uses choice_name() of parameters.h.

#include <array>
#include <string_view>
#include <utility>

#include "app/project/project.h"

namespace weft {

template <class E>
struct Choices;

template <>
struct Choices<Quality> {
    static constexpr std::array<std::pair<Quality, std::string_view>, 2> kNames{
        {{Quality::kDraft, "draft"}, {Quality::kFinal, "final"}}};
};
template <>
struct Choices<OutputDepth> {
    static constexpr std::array<std::pair<OutputDepth, std::string_view>, 5> kNames{
        {{OutputDepth::kAuto, "auto"},
         {OutputDepth::k8, "8"},
         {OutputDepth::k16, "16"},
         {OutputDepth::kHalf, "half"},
         {OutputDepth::kFloat, "float"}}};
};
template <>
struct Choices<WrapMode> {
    static constexpr std::array<std::pair<WrapMode, std::string_view>, 3> kNames{
        {{WrapMode::kRepeat, "repeat"},
         {WrapMode::kMirror, "mirror"},
         {WrapMode::kClamp, "clamp"}}};
};
template <>
struct Choices<MotionDirection> {
    static constexpr std::array<std::pair<MotionDirection, std::string_view>, 2> kNames{
        {{MotionDirection::kForward, "forward"}, {MotionDirection::kBackward, "backward"}}};
};
template <>
struct Choices<PropagationDirection> {
    static constexpr std::array<std::pair<PropagationDirection, std::string_view>, 3> kNames{
        {{PropagationDirection::kBoth, "both"},
         {PropagationDirection::kForward, "forward"},
         {PropagationDirection::kBackward, "backward"}}};
};
template <>
struct Choices<ZoneKind> {
    static constexpr std::array<std::pair<ZoneKind, std::string_view>, 6> kNames{
        {{ZoneKind::kLight, "light"},
         {ZoneKind::kDetail, "detail"},
         {ZoneKind::kIgnore, "ignore"},
         {ZoneKind::kStiffer, "stiffer"},
         {ZoneKind::kCalmer, "calmer"},
         {ZoneKind::kSurroundings, "surroundings"}}};
};
template <>
struct Choices<MissingFrames> {
    static constexpr std::array<std::pair<MissingFrames, std::string_view>, 4> kNames{
        {{MissingFrames::kError, "error"},
         {MissingFrames::kHold, "hold"},
         {MissingFrames::kBlack, "black"},
         {MissingFrames::kSkip, "skip"}}};
};
template <>
struct Choices<MotionConvention> {
    static constexpr std::array<std::pair<MotionConvention, std::string_view>, 6> kNames{
        {{MotionConvention::kFiles, "files"},
         {MotionConvention::kBlender, "blender"},
         {MotionConvention::kNuke, "nuke"},
         {MotionConvention::kMoonray, "moonray"},
         {MotionConvention::kFlame, "flame"},
         {MotionConvention::kArnold, "arnold"}}};
};
template <>
struct Choices<FormSource> {
    static constexpr std::array<std::pair<FormSource, std::string_view>, 6> kNames{
        {{FormSource::kAuto, "auto"},
         {FormSource::kPass, "pass"},
         {FormSource::kDepth, "depth"},
         {FormSource::kShape, "shape"},
         {FormSource::kInflate, "inflate"},
         {FormSource::kFlat, "flat"}}};
};
template <>
struct Choices<NormalSpace> {
    static constexpr std::array<std::pair<NormalSpace, std::string_view>, 3> kNames{
        {{NormalSpace::kAuto, "auto"},
         {NormalSpace::kCamera, "camera"},
         {NormalSpace::kWorld, "world"}}};
};
template <>
struct Choices<DepthKind> {
    static constexpr std::array<std::pair<DepthKind, std::string_view>, 2> kNames{
        {{DepthKind::kZ, "z"}, {DepthKind::kRay, "ray"}}};
};
template <>
struct Choices<PlaneMode> {
    static constexpr std::array<std::pair<PlaneMode, std::string_view>, 5> kNames{
        {{PlaneMode::kAuto, "auto"},
         {PlaneMode::kSynthesize, "synthesize"},
         {PlaneMode::kTile, "tile"},
         {PlaneMode::kStretch, "stretch"},
         {PlaneMode::kMirror, "mirror"}}};
};
template <>
struct Choices<SeamMethod> {
    static constexpr std::array<std::pair<SeamMethod, std::string_view>, 3> kNames{
        {{SeamMethod::kGraphCut, "graphcut"},
         {SeamMethod::kDynamicProgramming, "dp"},
         {SeamMethod::kNone, "none"}}};
};
template <>
struct Choices<SeamCost> {
    static constexpr std::array<std::pair<SeamCost, std::string_view>, 2> kNames{
        {{SeamCost::kGradient, "gradient"}, {SeamCost::kPaper, "paper"}}};
};
template <>
struct Choices<SurfaceKind> {
    static constexpr std::array<std::pair<SurfaceKind, std::string_view>, 5> kNames{
        {{SurfaceKind::kFound, "found"},
         {SurfaceKind::kPlane, "plane"},
         {SurfaceKind::kRigid, "rigid"},
         {SurfaceKind::kCloth, "cloth"},
         {SurfaceKind::kBody, "body"}}};
};
template <>
struct Choices<TemporalMode> {
    static constexpr std::array<std::pair<TemporalMode, std::string_view>, 3> kNames{
        {{TemporalMode::kLocked, "locked"},
         {TemporalMode::kPaper, "paper"},
         {TemporalMode::kNone, "none"}}};
};
template <>
struct Choices<LightSource> {
    static constexpr std::array<std::pair<LightSource, std::string_view>, 4> kNames{
        {{LightSource::kPlate, "plate"},
         {LightSource::kNone, "none"},
         {LightSource::kPainted, "painted"},
         {LightSource::kImage, "image"}}};
};
template <>
struct Choices<LightForm> {
    static constexpr std::array<std::pair<LightForm, std::string_view>, 5> kNames{
        {{LightForm::kGain, "gain"},
         {LightForm::kDetail, "detail"},
         {LightForm::kLiteral, "literal"},
         {LightForm::kStatistics, "statistics"},
         {LightForm::kHistogram, "histogram"}}};
};

template <>
struct Choices<BlendMode> {
    static constexpr std::array<std::pair<BlendMode, std::string_view>, 6> kNames{
        {{BlendMode::kNormal, "normal"},
         {BlendMode::kMultiply, "multiply"},
         {BlendMode::kScreen, "screen"},
         {BlendMode::kOverlay, "overlay"},
         {BlendMode::kSoftLight, "soft-light"},
         {BlendMode::kColor, "color"}}};
};

template <>
struct Choices<LayerKind> {
    static constexpr std::array<std::pair<LayerKind, std::string_view>, kLayers.size()> kNames =
        [] {
            std::array<std::pair<LayerKind, std::string_view>, kLayers.size()> names;
            for (std::size_t k = 0; k < kLayers.size(); ++k)
                names[k] = {kLayers[k].kind, kLayers[k].name};
            return names;
        }();
};

template <class E>
[[nodiscard]] constexpr std::string_view name_of(E value) {
    for (const auto& [candidate, name] : Choices<E>::kNames)
        if (candidate == value) return name;
    return {};
}

/// `name` is a valid choice, checked by normalise().
template <class E>
[[nodiscard]] constexpr E choice_from(std::string_view name) {
    for (const auto& [value, candidate] : Choices<E>::kNames)
        if (candidate == name) return value;
    return E{};
}

}  // namespace weft
