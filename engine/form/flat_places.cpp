#include "engine/form/flat_places.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <utility>

namespace weft {
namespace {

using Number = std::complex<double>;

// Which cells say where the result is to lie.
std::vector<Vec2i> anchors(const MetricField& field) {
    std::vector<Vec2i> inside, all;
    for (int j = 0; j < field.cells().height; ++j) {
        for (int i = 0; i < field.cells().width; ++i) {
            if (!(field.evidence(i, j) > 0)) continue;
            all.emplace_back(i, j);
            if (field.in_frame(i, j)) inside.emplace_back(i, j);
        }
    }
    return inside.empty() ? all : inside;
}

class FlatNodes {
  public:
    FlatNodes(const MetricField& field, std::vector<glm::dvec2> flat)
        : spacing_(field.spacing()), columns_(field.cells().width + 1), flat_(std::move(flat)) {}

    [[nodiscard]] Number at(int i, int j) const {
        const glm::dvec2 place =
            flat_[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(i)];
        return {place.x, place.y};
    }
    [[nodiscard]] Number centre(const Vec2i& cell) const {
        const auto [i, j] = std::pair(cell.x, cell.y);
        return 0.25 * (at(i, j) + at(i + 1, j) + at(i, j + 1) + at(i + 1, j + 1));
    }
    // By pixel of the reference frame, along x and along y.
    [[nodiscard]] std::pair<Number, Number> slopes(const Vec2i& cell) const {
        const auto [i, j] = std::pair(cell.x, cell.y);
        const double by = 1 / (2.0 * spacing_);
        return {by * (at(i + 1, j) - at(i, j) + at(i + 1, j + 1) - at(i, j + 1)),
                by * (at(i, j + 1) - at(i, j) + at(i + 1, j + 1) - at(i + 1, j))};
    }

  private:
    int spacing_, columns_;
    std::vector<glm::dvec2> flat_;
};

// From places to where they are to lie: first `from` is taken off, then a turn with a scale.
struct Stand {
    Number turn = 1, from = 0, to = 0;
    [[nodiscard]] Number operator()(Number place) const { return turn * (place - from) + to; }
};

Stand upright(const MetricField& field, const FlatNodes& nodes) {
    const std::vector<Vec2i> cells = anchors(field);
    if (cells.empty()) return {};
    Stand out;
    Number turn = 0;
    std::vector<double> areas;
    for (const Vec2i& cell : cells) {
        const auto [x, y] = nodes.slopes(cell);
        // The rotation of the slope's polar decomposition.
        const Number rotation(x.real() + y.imag(), x.imag() - y.real());
        turn += rotation / std::max(std::sqrt(std::norm(rotation)), 1e-12);
        areas.push_back(x.real() * y.imag() - x.imag() * y.real());
        out.from += nodes.centre(cell);
        out.to += static_cast<double>(field.spacing()) * Number(cell.x + 0.5, cell.y + 0.5);
    }
    const auto count = static_cast<double>(cells.size());
    out.from /= count;
    out.to /= count;
    const auto middle = areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2);
    std::nth_element(areas.begin(), middle, areas.end());
    out.turn = std::conj(turn) / std::max(std::sqrt(std::norm(turn)), 1e-12) /
               std::sqrt(std::max(*middle, 1e-12));
    return out;
}

}  // namespace

FormMap form_of_places(const MetricField& field, std::vector<glm::dvec2> flat) {
    const FlatNodes nodes(field, std::move(flat));
    const Stand stand = upright(field, nodes);
    LatticeField out(field.domain().size(), field.spacing());
    for (int j = 0; j < out.nodes().height(); ++j) {
        for (int i = 0; i < out.nodes().width(); ++i) {
            const Number d =
                stand(nodes.at(i, j)) - static_cast<double>(field.spacing()) * Number(i, j);
            out.set_node(i, j, {static_cast<float>(d.real()), static_cast<float>(d.imag())});
        }
    }
    return {Vec2(static_cast<float>(field.domain().x0), static_cast<float>(field.domain().y0)),
            std::move(out)};
}

}  // namespace weft
