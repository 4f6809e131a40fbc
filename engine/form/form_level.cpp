#include "engine/form/form_level.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace weft {

namespace {

using Number = std::complex<double>;

Number flat_place(const FormMap& form, Vec2 place) {
    const Vec2 d = form.at(place);
    return {static_cast<double>(place.x) + d.x, static_cast<double>(place.y) + d.y};
}

// Of length 1, with a positive real part, without trigonometry; `square` has the length 1.
Number root_of(const Number& square) {
    const double real = std::sqrt(std::max(0.0, 0.5 * (1 + square.real())));
    return {real,
            std::copysign(std::sqrt(std::max(0.0, 0.5 * (1 - square.real()))), square.imag())};
}

void turn_about(FormMap& form, Vec2 centre, const Number& turn) {
    const Number middle = flat_place(form, centre);
    LatticeField& field = form.displacement;
    for (int j = 0; j < field.nodes().height(); ++j) {
        for (int i = 0; i < field.nodes().width(); ++i) {
            const Vec2 at = form.origin + field.node_position(i, j);
            const Number place(at.x, at.y);
            const Vec2 d = field.node(i, j);
            const Number turned = middle + turn * (place + Number(d.x, d.y) - middle) - place;
            field.set_node(i, j,
                           {static_cast<float>(turned.real()), static_cast<float>(turned.imag())});
        }
    }
}

}  // namespace

void turn_level(FormMap& form, const std::vector<FormGuide>& strokes, Vec2 centre) {
    // A row has no sense: directions are added as squares, which are the same for both.
    Number squares = 0;
    for (const FormGuide& stroke : strokes) {
        if (stroke.kind != FormGuideKind::kLevel) continue;
        const Number d =
            flat_place(form, Vec2(stroke.place(2))) - flat_place(form, Vec2(stroke.place(0)));
        const double length = std::sqrt(std::norm(d));
        if (length > 0) squares += d * d / length;
    }
    const double length = std::sqrt(std::norm(squares));
    if (length > 0) turn_about(form, centre, std::conj(root_of(squares / length)));
}

void turn_square(FormMap& form, Vec2 centre, Vec2 direction) {
    const Number d = flat_place(form, centre + direction) - flat_place(form, centre - direction);
    const double length = std::sqrt(std::norm(d));
    if (!(length > 0)) return;
    // Rows, columns and both senses are the same to the fourth power.
    const Number square = d * d / (length * length);
    turn_about(form, centre, std::conj(root_of(root_of(square * square))));
}

}  // namespace weft
