#include "app/textures/provenance.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

int wrapped_texel(float v, int n) {
    const int k = static_cast<int>(std::floor(v)) % n;
    return k < 0 ? k + n : k;
}

// The patch at (u, v) and the nearest other patch on a plane that repeats.
std::optional<std::pair<int, int>> nearest_neighbours(const Image<std::int32_t, 1>& patch, int u,
                                                      int v) {
    const std::int32_t here = patch.at(u, v);
    const int w = patch.width(), h = patch.height();
    int nearest = Provenance::kSeamReach * Provenance::kSeamReach + 1;
    std::int32_t other = here;
    for (int dy = -Provenance::kSeamReach; dy <= Provenance::kSeamReach; ++dy)
        for (int dx = -Provenance::kSeamReach; dx <= Provenance::kSeamReach; ++dx) {
            const std::int32_t there = patch.at((u + dx + w) % w, (v + dy + h) % h);
            if (there == here || dx * dx + dy * dy >= nearest) continue;
            nearest = dx * dx + dy * dy;
            other = there;
        }
    if (other == here) return std::nullopt;
    return std::minmax({here, other});
}

}  // namespace

std::optional<float> Provenance::share_after(Vec2 p) const {
    if (!two) return std::nullopt;
    if (!two->seam) return two->share_after;
    return two->seam->labels.share_after(frame, p + ref_from_cur.at(p));
}

Vec2 Provenance::on_reference(Vec2 p) const {
    if (!two || !two->seam) return p + ref_from_cur.at(p);
    return p + (*share_after(p) > 0.5f ? two->seam->after : two->seam->before).at(p);
}

Vec2 Provenance::texel_at(Vec2 p) const {
    return mapping.texel(on_reference(p));
}

Provenance::Answer Provenance::at(Vec2 p) const {
    Answer out;
    out.on_reference = on_reference(p);
    out.texel = texel_at(p);
    out.sample = texture;
    out.sample_id = texture_id;
    const bool tracked = temporal == TemporalMode::kLocked ||
                         (temporal == TemporalMode::kPaper && frame != track_frame);
    if (!tracked) {
        out.made_anew = 1;
    } else if (temporal == TemporalMode::kPaper) {
        out.made_anew = fresh;
        out.tracks = {{frame + (frame < track_frame ? 1 : -1), 1 - fresh}};
    } else if (const auto after = share_after(p)) {
        if (*after < 1) out.tracks.push_back({two->before, 1 - *after});
        if (*after > 0) out.tracks.push_back({two->after, *after});
    } else {
        out.tracks = {{track_frame, 1}};
    }
    if (plane && std::isfinite(out.texel.x) && std::isfinite(out.texel.y)) {
        const int u = wrapped_texel(out.texel.x, plane->source.width());
        const int v = wrapped_texel(out.texel.y, plane->source.height());
        const std::int32_t* from = plane->source.pixel(u, v);
        out.in_sample = Vec2i(from[0], from[1]);
        constexpr int kSeam = 48;
        if (const int cost = plane->energy.at(u, v); cost > 0) out.seam = std::max(0, cost - kSeam);
        if (!plane->which.empty()) {
            const std::size_t which =
                std::min<std::size_t>(plane->which.at(u, v), plane->samples.size() - 1);
            out.sample = plane->samples[which];
            if (which < plane->ids.size()) out.sample_id = plane->ids[which];
        }
        if (!plane->patch.empty()) out.patch = plane->patch.at(u, v);
        if (out.seam && out.patch) out.seam_between = nearest_neighbours(plane->patch, u, v);
    }
    if (shading && !shading->value.empty()) {
        const int x =
            std::clamp(static_cast<int>(p.x) / shading->downscale, 0, shading->value.width() - 1);
        const int y =
            std::clamp(static_cast<int>(p.y) / shading->downscale, 0, shading->value.height() - 1);
        out.light = shading->value.at(x, y) / std::max(reference_shading, 1e-6f);
    }
    return out;
}

}  // namespace weft
