#include "engine/pipeline/region_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/parallel.h"
#include "engine/pipeline/paper_walker.h"
#include "engine/pipeline/synthesis_inputs.h"

namespace weft {
namespace {

// How many instants stand for the time that the shutter is open: one for every pixel that the
// surface moves in it; a single one where that is less than half of one.
int shutter_samples(const LatticeField& motion, const Recti& box, const Matte& matte, float open) {
    constexpr int kStep = 8, kMost = 32;
    float longest = 0;
    for (int y = 0; y < box.height(); y += kStep) {
        for (int x = 0; x < box.width(); x += kStep) {
            if (matte.at(x, y) == 0) continue;
            const Vec2 v =
                motion.at({static_cast<float>(box.x0 + x), static_cast<float>(box.y0 + y)});
            longest = std::max(longest, open * std::hypot(v.x, v.y));
        }
    }
    if (longest < 0.5f) return 1;
    return std::clamp(static_cast<int>(std::ceil(longest)) + 1, 2, kMost);
}

// The texture coordinates `time` frames later: what is at x then was at x − time · v.
ImageF2 coords_at_time(const LatticeField& ref_from_cur, const ImageF2& velocity,
                       const TextureMapping& mapping, const Recti& box, float time) {
    ImageF2 out(box.size());
    parallel_rows(box.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < box.width(); ++x) {
                const float* v = velocity.pixel(x, y);
                const Vec2 p(static_cast<float>(box.x0 + x) + 0.5f - time * v[0],
                             static_cast<float>(box.y0 + y) + 0.5f - time * v[1]);
                const Vec2 u = mapping.texel(p + ref_from_cur.at(p));
                out.pixel(x, y)[0] = u.x;
                out.pixel(x, y)[1] = u.y;
            }
        }
    });
    return out;
}

}  // namespace

Expected<LatticeField> RegionSurface::stored(AnalysisKind kind) const {
    WEFT_TRY(bytes, store_.get({index_, frame_, kind}));
    return decode_lattice(bytes);
}

Expected<TextureMapping> RegionSurface::mapping() const {
    return mapping_on(region_, scene_, frame_);
}

// Towards the reference, so that a frame does not depend on what else is rendered.
Expected<LatticeField> RegionSurface::velocity() const {
    if (!(scene_.shutter_deg > 0) || region_.shutter_evidence.empty()) return LatticeField();
    const int step = frame_ > region_.reference_frames.front() ? -1 : 1;
    WEFT_TRY(here, stored(AnalysisKind::kCoords));
    WEFT_TRY(bytes, store_.get({index_, frame_ + step, AnalysisKind::kCoords}));
    WEFT_TRY(there, decode_lattice(bytes));
    LatticeField motion = compose(here, inverse(there));
    if (step < 0) {
        for (int j = 0; j < motion.nodes().height(); ++j) {
            for (int i = 0; i < motion.nodes().width(); ++i)
                motion.set_node(i, j, -motion.node(i, j));
        }
    }
    return motion;
}

bool RegionSurface::is_one_lookup() const {
    if (region_.has_uv) return false;
    return !seam() && (!(scene_.shutter_deg > 0) || region_.shutter_evidence.empty());
}

Expected<TextureCoords> RegionSurface::coords(const Recti& box) const {
    if (exact_) return *exact_;
    if (region_.temporal != TemporalMode::kLocked) {
        constexpr int kCoarse = 64;
        return texture_coords(LatticeField(plate_, kCoarse), scene_.mapping, box);
    }
    WEFT_TRY(mapping, this->mapping());
    WEFT_TRY(ref_from_cur, stored(AnalysisKind::kCoords));
    return texture_coords(ref_from_cur, mapping, box);
}

Expected<SurfaceLookup> RegionSurface::lookup(const Recti& box) const {
    WEFT_TRY(at, coords(box));
    SurfaceLookup out;
    if (!scene_.plane.empty()) {
        out.coords = std::move(at);
        out.plane = &scene_.plane;
        return out;
    }

    // A plane of this frame alone, which begins at a texel of its own.
    WEFT_TRY(frame_area, frame_plane(region_.placement, plate_));
    ImageF3 picture;
    if (region_.temporal == TemporalMode::kPaper) {
        WEFT_TRY(bytes, store_.get({index_, frame_, AnalysisKind::kPaperTexture}));
        WEFT_TRY(codes, decode_picture(bytes));
        picture = ImageF3(codes.size());
        std::transform(codes.data(), codes.data() + codes.size_bytes(), picture.data(),
                       [](std::uint8_t v) { return static_cast<float>(v) / 255.0f; });
        region_.working_from_display->apply(picture);
    } else {
        PlaneOptions options = plane_options(region_, plan_.seed, frame_area.size, &backend_);
        options.mode = PlaneMode::kSynthesize;  // The comparison to the locked mode.
        options.frame = static_cast<std::uint64_t>(static_cast<std::int64_t>(frame_));
        WEFT_TRY(plane, grow_texture(region_, options));
        picture = plane_in_working_space(region_, plane);
    }
    for (int y = 0; y < at.uv.height(); ++y) {
        for (int x = 0; x < at.uv.width(); ++x) {
            at.uv.pixel(x, y)[0] -= static_cast<float>(frame_area.origin.x);
            at.uv.pixel(x, y)[1] -= static_cast<float>(frame_area.origin.y);
        }
    }
    out.coords = std::move(at);
    out.own.emplace(picture, WrapMode::kMirror);
    return out;
}

Expected<ImageF3> RegionSurface::layer(const LatticeField& ref_from_cur, const Recti& box,
                                       const Matte& matte) const {
    WEFT_TRY(mapping, this->mapping());
    WEFT_TRY(motion, velocity());
    SampleRequest request;
    request.plane = &scene_.plane;
    request.matte = matte;
    request.quality = quality();
    ImageF3 out(box.size());
    const float open = scene_.shutter_deg / 360.0f;
    const int times = motion.empty() ? 1 : shutter_samples(motion, box, matte, open);
    if (times == 1) {
        const TextureCoords at = texture_coords(ref_from_cur, mapping, box);
        request.coords = at.uv;
        backend_.sample_plane(request, out);
        return out;
    }
    // The blur hides what a coarser lookup loses.
    request.quality = SampleQuality::kDraft;
    const ImageF2 path = motion.dense(box);
    ImageF3 instant(box.size());
    for (int k = 0; k < times; ++k) {
        const float time =
            open * ((static_cast<float>(k) + 0.5f) / static_cast<float>(times) - 0.5f);
        const ImageF2 at = coords_at_time(ref_from_cur, path, mapping, box, time);
        request.coords = at;
        backend_.sample_plane(request, instant);
        const float share = 1.0f / static_cast<float>(times);
        std::transform(out.data(), out.data() + 3 * box.width() * box.height(), instant.data(),
                       out.data(), [&](float sum, float v) { return sum + share * v; });
    }
    return out;
}

const TrackSeam* RegionSurface::seam() const {
    for (const TrackSeam& seam : scene_.seams) {
        if (seam.covers(frame_) && store_.has({index_, frame_, AnalysisKind::kTrackAfter}))
            return &seam;
    }
    return nullptr;
}

Expected<ImageF3> RegionSurface::two_tracks(const TrackSeam& seam, const Recti& box,
                                            const Matte& matte) const {
    WEFT_TRY(place, stored(AnalysisKind::kCoords));
    const ImageF2 d = place.dense(box);
    ImageF1 share(box.size());
    std::array<Matte, 2> inside{Matte(box.size()), Matte(box.size())};
    parallel_rows(box.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < box.width(); ++x) {
                if (matte.at(x, y) == 0) continue;
                const Vec2 p(static_cast<float>(box.x0 + x) + 0.5f,
                             static_cast<float>(box.y0 + y) + 0.5f);
                const float after =
                    seam.share_after(frame_, p + Vec2(d.pixel(x, y)[0], d.pixel(x, y)[1]));
                share.at(x, y) = after;
                inside[0].at(x, y) = after < 1 ? 255 : 0;
                inside[1].at(x, y) = after > 0 ? 255 : 0;
            }
        }
    });
    ImageF3 out;
    for (const bool after : {false, true}) {
        const auto kind = after ? AnalysisKind::kTrackAfter : AnalysisKind::kTrackBefore;
        WEFT_TRY(ref_from_cur, stored(kind));
        WEFT_TRY(shown, layer(ref_from_cur, box, inside[after ? 1 : 0]));
        if (!after) {
            out = std::move(shown);
            continue;
        }
        for (int y = 0; y < box.height(); ++y) {
            for (int x = 0; x < box.width(); ++x) {
                const float w = share.at(x, y);
                if (w <= 0) continue;
                for (int c = 0; c < 3; ++c)
                    out.at(x, y, c) = (1 - w) * out.at(x, y, c) + w * shown.at(x, y, c);
            }
        }
    }
    return out;
}

Expected<ImageF3> RegionSurface::texture(const Recti& box, const Matte& matte) const {
    const TrackSeam* between = exact_ ? nullptr : seam();
    if (between) return two_tracks(*between, box, matte);
    if (region_.temporal == TemporalMode::kLocked && !exact_) {
        WEFT_TRY(ref_from_cur, stored(AnalysisKind::kCoords));
        return layer(ref_from_cur, box, matte);
    }
    WEFT_TRY(at, lookup(box));
    SampleRequest request;
    request.plane = at.shown();
    request.coords = at.coords.uv;
    request.matte = matte;
    request.quality = quality();
    ImageF3 out(box.size());
    backend_.sample_plane(request, out);
    return out;
}

}  // namespace weft
