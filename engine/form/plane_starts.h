#pragma once
// Where a search for a plane in front of a camera begins: its cost has several minima.

#include <array>
#include <glm/vec2.hpp>
#include <numbers>
#include <vector>

namespace weft {

/// Tangents of half the horizontal field of view: long, common and short lenses.
inline constexpr std::array kStartTangents{0.5, 0.9, 1.5};

/// Long side over focal length of the lenses that shots are made with: fields of view of 18° to
/// 108°.
inline constexpr double kLongestLens = 0.32, kWidestLens = 2.75;

/// Slopes of the nearness over a unit of the picture: none, then two steepnesses in eight
/// directions each.
[[nodiscard]] inline std::vector<glm::dvec2> start_slopes() {
    // Eighths of a turn, without trigonometry.
    constexpr double kDiagonal = std::numbers::sqrt2 / 2;
    constexpr std::array<std::array<double, 2>, 8> kAround{{{1, 0},
                                                            {kDiagonal, kDiagonal},
                                                            {0, 1},
                                                            {-kDiagonal, kDiagonal},
                                                            {-1, 0},
                                                            {-kDiagonal, -kDiagonal},
                                                            {0, -1},
                                                            {kDiagonal, -kDiagonal}}};
    std::vector<glm::dvec2> out{{0, 0}};
    for (const double slope : {0.25, 0.7})
        for (const auto& d : kAround)
            out.emplace_back(slope * d[0], slope * d[1]);
    return out;
}

}  // namespace weft
