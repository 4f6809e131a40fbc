#include "engine/synthesis/plane_phase.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/core/luma.h"

namespace weft {
namespace {

constexpr int kBins = 48;  // Of a period, to find the phase that most texels have.
constexpr int kStride_px = 8;
constexpr int kLeastWindow_px = 24;
constexpr int kHarmonics = 3;
constexpr double kWeak = 0.35;  // Of the median amplitude.

double turn(double v) {
    return v - std::floor(v);
}

PlanePhase phase_of(std::vector<double> miss, std::size_t places) {
    PlanePhase out;
    if (miss.empty()) return out;
    std::sort(miss.begin(), miss.end());
    const auto at = [&](double share) {
        return miss[std::min(miss.size() - 1,
                             static_cast<std::size_t>(share * static_cast<double>(miss.size())))];
    };
    out = {at(0.5), at(0.95), miss.back(),
           static_cast<double>(miss.size()) / static_cast<double>(places)};
    return out;
}

using Complex = std::complex<double>;

// exp(−2πi·wave·t) for t = 0 … n − 1. Long double: see docs/decisions/0002-determinism.md.
std::vector<Complex> carrier(double wave, int n) {
    std::vector<Complex> out;
    out.reserve(static_cast<std::size_t>(n));
    const long double turns = 2 * std::acos(-1.0L) * static_cast<long double>(wave);
    for (int t = 0; t < n; ++t) {
        out.emplace_back(static_cast<double>(std::cos(turns * t)),
                         static_cast<double>(-std::sin(turns * t)));
    }
    return out;
}

double angle_in_turns(Complex z) {
    const long double angle =
        std::atan2(static_cast<long double>(z.imag()), static_cast<long double>(z.real()));
    return static_cast<double>(angle / (2 * std::acos(-1.0L)));
}

// The plane's luma times a wave, summed over windows.
class Demodulated {
  public:
    Demodulated(const Image<float, 1>& luma, glm::dvec2 wave)
        : sums_(luma.width() + 1, luma.height() + 1) {
        const auto cx = carrier(wave.x, luma.width()), cy = carrier(wave.y, luma.height());
        for (int x = 0; x <= luma.width(); ++x)
            sums_.pixel(x, 0)[0] = sums_.pixel(x, 0)[1] = 0;
        for (int y = 0; y < luma.height(); ++y) {
            Complex row = 0;
            sums_.pixel(0, y + 1)[0] = sums_.pixel(0, y + 1)[1] = 0;
            for (int x = 0; x < luma.width(); ++x) {
                row += static_cast<double>(luma.at(x, y)) * cx[static_cast<std::size_t>(x)] *
                       cy[static_cast<std::size_t>(y)];
                sums_.pixel(x + 1, y + 1)[0] = sums_.pixel(x + 1, y)[0] + row.real();
                sums_.pixel(x + 1, y + 1)[1] = sums_.pixel(x + 1, y)[1] + row.imag();
            }
        }
    }
    [[nodiscard]] Complex over(const Recti& r) const {
        const auto at = [&](int x, int y) {
            return Complex(sums_.pixel(x, y)[0], sums_.pixel(x, y)[1]);
        };
        return at(r.x1, r.y1) - at(r.x0, r.y1) - at(r.x1, r.y0) + at(r.x0, r.y0);
    }
    [[nodiscard]] Complex whole() const {
        return over({0, 0, sums_.width() - 1, sums_.height() - 1});
    }

  private:
    Image<double, 2> sums_;
};

Image<float, 1> luma_less_mean(ViewU8x3 plane) {
    Image<float, 1> out(plane.size());
    double sum = 0;
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            const std::uint8_t* p = plane.pixel(x, y);
            out.at(x, y) = luma_709(static_cast<float>(p[0]), static_cast<float>(p[1]),
                                    static_cast<float>(p[2]));
            sum += static_cast<double>(out.at(x, y));
        }
    }
    const auto mean = static_cast<float>(sum / (static_cast<double>(out.width()) * out.height()));
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x)
            out.at(x, y) -= mean;
    }
    return out;
}

// The strongest wave, and the strongest that spans the lattice's waves with it.
std::vector<glm::dvec2> strongest(const Image<float, 1>& luma, const PlaneLattice& lattice) {
    struct Wave {
        int i, j;
        double power;
    };
    std::vector<Wave> all;
    const int far = lattice.count() == 2 ? kHarmonics : 0;
    for (int i = 0; i <= kHarmonics; ++i) {
        for (int j = -far; j <= far; ++j) {
            if (i == 0 && j <= 0) continue;
            const glm::dvec2 w = static_cast<double>(i) * lattice.waves()[0] +
                                 static_cast<double>(j) * lattice.waves()[1];
            if (std::max(std::abs(w.x), std::abs(w.y)) > 0.4) continue;
            all.push_back({i, j, std::norm(Demodulated(luma, w).whole())});
        }
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Wave& a, const Wave& b) { return a.power > b.power; });
    const auto wave = [&](const Wave& w) {
        return static_cast<double>(w.i) * lattice.waves()[0] +
               static_cast<double>(w.j) * lattice.waves()[1];
    };
    for (const Wave& a : all) {
        if (lattice.count() == 1 && a.i == 1) return {wave(a)};
        for (const Wave& b : all) {
            if (lattice.count() == 2 && std::abs(a.i * b.j - a.j * b.i) == 1)
                return {wave(a), wave(b)};
        }
    }
    return {};
}

// A strained lattice may be reduced to other steps than the sample's: both phases count in the
// sample's, which differ from the plane's by the strain alone.
LatticeWaves waves_on_plane(const LatticeWaves& sample, const PlaneLattice& plane, int count) {
    LatticeWaves out = plane.waves();
    if (count < 2) return out;
    const auto steps = steps_of(plane.waves(), count);
    for (std::size_t k = 0; k < 2; ++k) {
        const double i = std::round(glm::dot(sample[k], steps[0]));
        const double j = std::round(glm::dot(sample[k], steps[1]));
        out[k] = i * plane.waves()[0] + j * plane.waves()[1];
    }
    return out;
}

}  // namespace

PlanePhase source_phase(ImageView<const std::int32_t, 2> source, const SampleLattice& sample,
                        const PlaneLattice& lattice) {
    if (sample.count == 0 || lattice.empty()) return {};
    const auto count = static_cast<std::size_t>(sample.count);
    const LatticeWaves waves = waves_of(sample);
    const LatticeWaves on_plane = waves_on_plane(waves, lattice, sample.count);
    const auto plane_steps = steps_of(on_plane, sample.count);
    const auto turns = [&](int x, int y) {
        const std::int32_t* s = source.pixel(x, y);
        std::array<double, 2> out{};
        for (std::size_t k = 0; k < count; ++k)
            out[k] = glm::dot(waves[k], glm::dvec2(s[0], s[1])) -
                     glm::dot(on_plane[k], glm::dvec2(x, y));
        return out;
    };
    Image<int, 1> votes(kBins, kBins, 0);
    const auto bin = [](double t) {
        return std::min(kBins - 1, static_cast<int>(turn(t) * kBins));
    };
    for (int y = 0; y < source.height(); ++y) {
        for (int x = 0; x < source.width(); ++x) {
            const auto t = turns(x, y);
            ++votes.at(bin(t[0]), bin(t[1]));
        }
    }
    Vec2i best{0, 0};
    for (int y = 0; y < kBins; ++y) {
        for (int x = 0; x < kBins; ++x)
            if (votes.at(x, y) > votes.at(best.x, best.y)) best = {x, y};
    }
    const auto miss_of = [&](int x, int y, glm::dvec2 zero) {
        const auto t = turns(x, y);
        glm::dvec2 p = (t[0] - (best.x + 0.5) / kBins) * plane_steps[0];
        if (count == 2) p += (t[1] - (best.y + 0.5) / kBins) * plane_steps[1];
        return lattice.miss(p - zero);
    };
    // The voters' mean is the plane's phase.
    glm::dvec2 zero{0};
    double near = 0;
    const double cell = glm::length(plane_steps[0]) * 2 / kBins;
    for (int y = 0; y < source.height(); ++y) {
        for (int x = 0; x < source.width(); ++x) {
            const glm::dvec2 m = miss_of(x, y, {0, 0});
            if (glm::length(m) > std::max(1.5, cell)) continue;
            zero += m, ++near;
        }
    }
    if (near > 0) zero /= near;
    std::vector<double> miss;
    for (int y = 0; y < source.height(); ++y) {
        for (int x = 0; x < source.width(); ++x)
            miss.push_back(glm::length(miss_of(x, y, zero)));
    }
    const std::size_t places = miss.size();
    return phase_of(std::move(miss), places);
}

PlanePhase seen_phase(ViewU8x3 plane, const PlaneLattice& lattice) {
    if (lattice.empty()) return {};
    const Image<float, 1> luma = luma_less_mean(plane);
    const std::vector<glm::dvec2> waves = strongest(luma, lattice);
    if (waves.empty()) return {};
    LatticeWaves pair{};
    std::copy(waves.begin(), waves.end(), pair.begin());
    const auto steps = steps_of(pair, lattice.count());
    std::vector<Demodulated> bands;
    double longest = 0;
    for (std::size_t k = 0; k < waves.size(); ++k) {
        bands.emplace_back(luma, waves[k]);
        longest = std::max(longest, glm::length(steps[k]));
    }
    const int window = std::min(
        {std::max(kLeastWindow_px, static_cast<int>(1.5 * longest)), luma.width(), luma.height()});
    struct Seen {
        std::array<Complex, 2> z{};
    };
    std::vector<Seen> all;
    for (int y = 0; y + window <= luma.height(); y += kStride_px) {
        for (int x = 0; x + window <= luma.width(); x += kStride_px) {
            Seen& s = all.emplace_back();
            for (std::size_t k = 0; k < bands.size(); ++k)
                s.z[k] = bands[k].over({x, y, x + window, y + window});
        }
    }
    std::array<double, 2> least{};
    std::array<Complex, 2> mean{};
    for (std::size_t k = 0; k < bands.size(); ++k) {
        std::vector<double> amplitudes;
        for (const Seen& s : all)
            amplitudes.push_back(std::abs(s.z[k])), mean[k] += s.z[k];
        std::nth_element(amplitudes.begin(),
                         amplitudes.begin() + static_cast<std::ptrdiff_t>(amplitudes.size() / 2),
                         amplitudes.end());
        least[k] = kWeak * amplitudes[amplitudes.size() / 2];
    }
    std::vector<double> miss;
    for (const Seen& s : all) {
        glm::dvec2 d{0};
        bool clear = true;
        for (std::size_t k = 0; k < bands.size(); ++k) {
            clear &= std::abs(s.z[k]) >= least[k];
            d += angle_in_turns(s.z[k] * std::conj(mean[k])) * steps[k];
        }
        if (clear) miss.push_back(glm::length(lattice.miss(d)));
    }
    return phase_of(std::move(miss), all.size());
}

}  // namespace weft
