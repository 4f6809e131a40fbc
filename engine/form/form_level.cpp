#include "engine/form/form_level.h"

#include <cmath>
#include <complex>

namespace weft {

void turn_level(FormMap& form, const std::vector<FormGuide>& strokes, Vec2 centre) {
    using Number = std::complex<double>;
    const auto flat = [&](Vec2 place) {
        const Vec2 d = form.at(place);
        return Number(static_cast<double>(place.x) + d.x, static_cast<double>(place.y) + d.y);
    };
    // A row has no sense: directions are added as squares, which are the same for both.
    Number squares = 0;
    for (const FormGuide& stroke : strokes) {
        if (stroke.kind != FormGuideKind::kLevel) continue;
        const Number d = flat(Vec2(stroke.place(2))) - flat(Vec2(stroke.place(0)));
        const double length = std::sqrt(std::norm(d));
        if (length > 0) squares += d * d / length;
    }
    const double length = std::sqrt(std::norm(squares));
    if (!(length > 0)) return;
    // The root with a positive real part, without trigonometry.
    const double cosine = squares.real() / length;
    const double real = std::sqrt(0.5 * (1 + cosine));
    const double imaginary = std::copysign(std::sqrt(0.5 * (1 - cosine)), squares.imag());
    const Number back(real, -imaginary);
    const Number middle = flat(centre);
    LatticeField& field = form.displacement;
    for (int j = 0; j < field.nodes().height(); ++j) {
        for (int i = 0; i < field.nodes().width(); ++i) {
            const Number place(form.origin.x + static_cast<float>(field.spacing()) *
                                                   static_cast<float>(i - LatticeField::kMargin),
                               form.origin.y + static_cast<float>(field.spacing()) *
                                                   static_cast<float>(j - LatticeField::kMargin));
            const Vec2 d = field.node(i, j);
            const Number u = place + Number(d.x, d.y);
            const Number turned = middle + back * (u - middle) - place;
            field.set_node(i, j,
                           {static_cast<float>(turned.real()), static_cast<float>(turned.imag())});
        }
    }
}

}  // namespace weft
