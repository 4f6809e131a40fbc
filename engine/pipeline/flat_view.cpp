#include "engine/pipeline/flat_view.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/parallel.h"
#include "engine/pipeline/frame_light.h"
#include "engine/pipeline/motion_zones.h"
#include "engine/pipeline/plate_alpha.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_mattes.h"

namespace weft {
namespace {

constexpr int kEdge_px = 3;           // of the surface, where antialiasing and blur mix it
constexpr float kLeastTrust = 0.02f;  // of a pixel that is all surface
constexpr float kBurntOut = 0.985f;   // display-encoded: what is brighter may be anything
constexpr float kBurntTrust = 0.05f;
constexpr float kLeastGain = 1e-3f;  // a gain that can be divided by
constexpr int kCell_px = 2;          // of the grid that is laid out; the field bends little in it

// The share of the pixels around that are all surface. Beyond the picture there is none that is
// not.
ImageF1 all_surface_around(const Matte& matte, const Recti& box) {
    const auto full = [&](int x, int y) { return matte.at(x, y) == 255 ? 1 : 0; };
    // Sums over rows, then over columns.
    ImageF1 rows(matte.width(), box.height() + 2 * kEdge_px), out(box.size());
    const auto at_row = [&](int y) { return std::clamp(y, 0, matte.height() - 1); };
    for (int j = 0; j < rows.height(); ++j) {
        const int y = at_row(box.y0 - kEdge_px + j);
        for (int x = box.x0; x < box.x1; ++x) {
            int sum = 0;
            for (int d = -kEdge_px; d <= kEdge_px; ++d)
                sum += full(std::clamp(x + d, 0, matte.width() - 1), y);
            rows.at(x, j) = static_cast<float>(sum);
        }
    }
    constexpr float kAll = (2 * kEdge_px + 1) * (2 * kEdge_px + 1);
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            float sum = 0;
            for (int d = 0; d <= 2 * kEdge_px; ++d)
                sum += rows.at(box.x0 + x, y + d);
            out.at(x, y) = sum / kAll;
        }
    }
    return out;
}

// Divides by the light and says what can be trusted.
void divide_light(const ImageF3& working, const ImageF3& display, const Matte& matte,
                  const ImageF3& gain, float white, UnlitFrame& out) {
    const ImageF1 around = all_surface_around(matte, out.box);
    parallel_rows(out.box.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < out.box.width(); ++x) {
                const int u = out.box.x0 + x, v = out.box.y0 + y;
                if (matte.at(u, v) != 255) continue;
                const float* lit = working.pixel(u, v);
                const float* light = gain.pixel(x, y);
                float* to = out.colour.pixel(x, y);
                bool known = true;
                for (int c = 0; c < 3; ++c) {
                    const float own = light[c] - white;
                    known = known && own > kLeastGain && std::isfinite(lit[c]);
                    to[c] = known ? (lit[c] - white) / own : 0.0f;
                }
                if (!known) continue;
                const float share = around.at(x, y);
                float trust = std::max(kLeastTrust, share * share);
                const float* shown = display.pixel(u, v);
                if (std::max({shown[0], shown[1], shown[2]}) >= kBurntOut) trust *= kBurntTrust;
                out.trust.at(x, y) = trust;
            }
        }
    });
}

// Weights of four neighbours (Catmull–Rom), at `t` between the inner two.
std::array<float, 4> cubic_weights(float t) {
    const float t2 = t * t, t3 = t2 * t;
    return {-0.5f * t + t2 - 0.5f * t3, 1 - 2.5f * t2 + 1.5f * t3, 0.5f * t + 2 * t2 - 1.5f * t3,
            -0.5f * t2 + 0.5f * t3};
}

// The frame at a place of its own, px; returns its trust.
float look_up_unlit(const UnlitFrame& frame, Vec2 at, float* rgb) {
    const float u = at.x - 0.5f - static_cast<float>(frame.box.x0);
    const float v = at.y - 0.5f - static_cast<float>(frame.box.y0);
    const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
    const std::array<float, 4> wx = cubic_weights(u - static_cast<float>(i));
    const std::array<float, 4> wy = cubic_weights(v - static_cast<float>(j));
    float trust = 1, sum = 0, least = 1e30f, most = -1e30f;
    std::array<float, 3> mix{};
    for (int b = 0; b < 4; ++b) {
        for (int a = 0; a < 4; ++a) {
            // Beyond the picture its last pixels go on; beyond the surface nothing does.
            const int x = std::clamp(i - 1 + a, 0, frame.box.width() - 1);
            const int y = std::clamp(j - 1 + b, 0, frame.box.height() - 1);
            const float known = frame.trust.at(x, y);
            const bool inner = (a == 1 || a == 2) && (b == 1 || b == 2);
            if (!(known > 0)) {
                if (inner) return 0;
                continue;
            }
            if (inner) trust = std::min(trust, known);
            const float w = wx[static_cast<std::size_t>(a)] * wy[static_cast<std::size_t>(b)];
            const float* p = frame.colour.pixel(x, y);
            sum += w;
            for (std::size_t c = 0; c < 3; ++c)
                mix[c] += w * p[c];
            least = std::min({least, p[0], p[1], p[2]}), most = std::max({most, p[0], p[1], p[2]});
        }
    }
    if (!(sum > 0.5f)) return 0;
    for (std::size_t c = 0; c < 3; ++c)
        rgb[c] = std::clamp(mix[c] / sum, least, most);
    return trust;
}

// A triangle of the surface: corners in the picture, texels, and on the frame, px.
struct Triangle {
    std::array<Vec2, 3> texel, pixel;
};

float cross(Vec2 a, Vec2 b) {
    return a.x * b.y - a.y * b.x;
}

// Writes the frame's place into each texel whose centre the triangle covers.
void lay_triangle(const Triangle& t, int first_row, ImageF2& place, ImageF1& fineness) {
    const Vec2 e1 = t.texel[1] - t.texel[0], e2 = t.texel[2] - t.texel[0];
    const float area = cross(e1, e2);
    if (!(std::abs(area) > 1e-9f) || !(std::abs(area) < 1e7f)) return;
    const float own = cross(t.pixel[1] - t.pixel[0], t.pixel[2] - t.pixel[0]);
    const float finer = std::min(1.0f, std::abs(own / area));
    const auto [x_low, x_high] = std::minmax({t.texel[0].x, t.texel[1].x, t.texel[2].x});
    const auto [y_low, y_high] = std::minmax({t.texel[0].y, t.texel[1].y, t.texel[2].y});
    const auto last = static_cast<float>(place.width()), rows = static_cast<float>(place.height());
    const auto shift = static_cast<float>(first_row);
    const int x0 = static_cast<int>(std::clamp(std::floor(x_low - 0.5f), 0.0f, last));
    const int x1 = static_cast<int>(std::clamp(std::ceil(x_high + 0.5f), 0.0f, last));
    const int y0 = static_cast<int>(std::clamp(std::floor(y_low - 0.5f) - shift, 0.0f, rows));
    const int y1 = static_cast<int>(std::clamp(std::ceil(y_high + 0.5f) - shift, 0.0f, rows));
    constexpr float kOnEdge = -1e-4f;
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
            const Vec2 at(static_cast<float>(x) + 0.5f, static_cast<float>(y + first_row) + 0.5f);
            const Vec2 d = at - t.texel[0];
            const float b = cross(d, e2) / area, c = cross(e1, d) / area;
            if (b < kOnEdge || c < kOnEdge || b + c > 1 - kOnEdge) continue;
            if (fineness.at(x, y) > finer) continue;  // a fold: the squarer view of the two
            const Vec2 p =
                t.pixel[0] + b * (t.pixel[1] - t.pixel[0]) + c * (t.pixel[2] - t.pixel[0]);
            place.pixel(x, y)[0] = p.x, place.pixel(x, y)[1] = p.y;
            fineness.at(x, y) = finer;
        }
    }
}

// Whether any pixel of a cell, or beside it, shows the surface.
bool cell_shows(const UnlitFrame& frame, int x, int y) {
    const Recti cell =
        Recti{x, y, x + kCell_px, y + kCell_px}.grown(1).intersected(rect_of(frame.box.size()));
    for (int v = cell.y0; v < cell.y1; ++v)
        for (int u = cell.x0; u < cell.x1; ++u)
            if (frame.trust.at(u, v) > 0) return true;
    return false;
}

// Where the corners of the cells lie on the reference frame, px.
ImageF2 corner_places(const UnlitFrame& frame) {
    ImageF2 out((frame.box.width() + kCell_px - 1) / kCell_px + 1,
                (frame.box.height() + kCell_px - 1) / kCell_px + 1);
    parallel_rows(out.height(), 16, [&](int y0, int y1) {
        for (int j = y0; j < y1; ++j) {
            for (int i = 0; i < out.width(); ++i) {
                const Vec2 p(static_cast<float>(frame.box.x0 + i * kCell_px),
                             static_cast<float>(frame.box.y0 + j * kCell_px));
                const Vec2 r = p + frame.ref_from_cur.at(p);
                out.pixel(i, j)[0] = r.x, out.pixel(i, j)[1] = r.y;
            }
        }
    });
    return out;
}

}  // namespace

Expected<UnlitFrame> unlit_frame(const ShotSource& source, const ShotPlan& plan,
                                 const AnalysisStore& analysis, int region,
                                 const RegionScene& scene, int frame) {
    const ZonedAnalysis store(source, plan, analysis);
    UnlitFrame out;
    WEFT_TRY(plate, source.plate(frame));
    WEFT_TRY(alpha, source.alpha(frame));
    WEFT_TRY(extent, extent_matte(source, plan, store, region, frame));
    WEFT_TRY(holdout, holdout_matte(source, plan, store, region, frame));
    Matte matte = without_holdout(extent, holdout);
    take_share_of_element(matte, alpha);
    const Recti box = matte_bounds(matte);
    if (box.empty()) return out;
    WEFT_TRY(working, working_plate(source, plan, frame, *plate));
    WEFT_TRY(light,
             FrameLight::find({source, plan, store, region, frame, working, scene, matte, box}));
    if (light.all_white()) return out;
    ImageF3 gain(box.size(), 1.0f);
    WEFT_CHECK_OK(light.apply(cropped(matte, box), gain));
    out.box = box;
    out.colour = ImageF3(box.size());
    out.trust = ImageF1(box.size());
    const ImageF3 display = transformed(working, *plan.display_from_working);
    divide_light(working, display, matte, gain, light.white(), out);
    WEFT_TRY(bytes, store.get({region, frame, AnalysisKind::kCoords}));
    WEFT_TRY(field, decode_lattice(bytes));
    out.ref_from_cur = std::move(field);
    return out;
}

Recti places_of(const UnlitFrame& frame, Size plate, int most_px) {
    Recti out;
    if (frame.box.empty()) return out;
    const Recti most = rect_of(plate).grown(most_px);
    const ImageF2 places = corner_places(frame);
    for (int j = 0; j < places.height(); ++j) {
        for (int i = 0; i < places.width(); ++i) {
            const float* p = places.pixel(i, j);
            if (!(std::abs(p[0]) < 1e6f && std::abs(p[1]) < 1e6f)) continue;
            if (!cell_shows(frame, i * kCell_px, j * kCell_px)) continue;
            const int x = static_cast<int>(std::floor(p[0])),
                      y = static_cast<int>(std::floor(p[1]));
            out = out.united(Recti{x, y, x + 1, y + 1}.intersected(most));
        }
    }
    return out;
}

UnlitFrame beyond_plane(const UnlitFrame& frame, const FlatLayout& layout,
                        const PlanePyramid& plane, const Backend& backend) {
    UnlitFrame out = frame;
    if (frame.box.empty()) return out;
    const Size size = frame.box.size();
    ImageF2 coords(size);
    Matte matte(size);
    parallel_rows(size.height, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < size.width; ++x) {
                const Vec2 p(static_cast<float>(frame.box.x0 + x) + 0.5f,
                             static_cast<float>(frame.box.y0 + y) + 0.5f);
                const Vec2 u = layout.texel(p + frame.ref_from_cur.at(p));
                coords.pixel(x, y)[0] = u.x, coords.pixel(x, y)[1] = u.y;
                matte.at(x, y) = frame.trust.at(x, y) > 0 ? 255 : 0;
            }
        }
    });
    ImageF3 shown(size);
    SampleRequest request;
    request.plane = &plane;
    request.coords = coords;
    request.matte = matte;
    request.quality = SampleQuality::kFinal;
    backend.sample_plane(request, shown);
    const auto count = static_cast<std::ptrdiff_t>(shown.size_bytes() / sizeof(float));
    std::transform(out.colour.data(), out.colour.data() + count, shown.data(), out.colour.data(),
                   [](float lit, float is) { return lit - is; });
    return out;
}

FlatView flat_view(const UnlitFrame& frame, const FlatLayout& layout, int first_row, int end_row) {
    const Size size{layout.size().width, end_row - first_row};
    FlatView out{ImageF3(size), ImageF1(size)};
    if (frame.box.empty()) return out;
    ImageF2 place(size);
    ImageF1 fineness(size);
    const ImageF2 corners = corner_places(frame);
    const auto corner = [&](int i, int j) {
        return layout.texel({corners.pixel(i, j)[0], corners.pixel(i, j)[1]});
    };
    const auto pixel = [&](int i, int j) {
        return Vec2(static_cast<float>(frame.box.x0 + i * kCell_px),
                    static_cast<float>(frame.box.y0 + j * kCell_px));
    };
    for (int j = 0; j + 1 < corners.height(); ++j) {
        for (int i = 0; i + 1 < corners.width(); ++i) {
            if (!cell_shows(frame, i * kCell_px, j * kCell_px)) continue;
            for (const int half : {0, 1}) {
                const std::array<Vec2i, 3> at{Vec2i(i + half, j + half), Vec2i(i + 1, j),
                                              Vec2i(i, j + 1)};
                Triangle t;
                for (std::size_t k = 0; k < 3; ++k)
                    t.texel[k] = corner(at[k].x, at[k].y), t.pixel[k] = pixel(at[k].x, at[k].y);
                lay_triangle(t, first_row, place, fineness);
            }
        }
    }
    parallel_rows(size.height, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < size.width; ++x) {
                const float fine = fineness.at(x, y);
                if (!(fine > 0)) continue;
                const float* p = place.pixel(x, y);
                out.weight.at(x, y) =
                    fine * look_up_unlit(frame, {p[0], p[1]}, out.colour.pixel(x, y));
            }
        }
    });
    return out;
}

}  // namespace weft
