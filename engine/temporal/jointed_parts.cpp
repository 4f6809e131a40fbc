#include "engine/temporal/jointed_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/motion/moving_parts.h"
#include "engine/motion/photometric_register.h"
#include "engine/motion/surface_fit.h"
#include "engine/temporal/joined_field.h"
#include "engine/temporal/part_islands.h"
#include "engine/temporal/part_outlines.h"
#include "engine/temporal/stretch_limit.h"

namespace weft {
namespace {

// Arms, legs, head and torso, with some in two pieces.
constexpr std::size_t kMostParts = 8;

StepEvidence evidence_of(const StepFrame& prev, const StepFrame& cur,
                         const FlowField& prev_from_cur, const SurfaceWalkerOptions& options) {
    return gather_evidence(prev, cur, prev_from_cur, options.quality, options.spacing_px);
}

// What the pictures must say for a part: how much better its motion finds it again than the body's
// does, and than one smooth field of all does, in correlation and in standard errors.
struct Demands {
    double gain, errors, smooth_gain, smooth_errors;
};
// Most surfaces have no parts. By the part that shows most, bodies lead by 0.37 to 0.98 (3 to 12
// errors) and by 0.2 to 0.33 (1.9 to 3.8); what stripes, folds and shades made of a sleeve, a coat
// and two balls by 0.17 to 0.5 and by 0.14 at most.
constexpr Demands kFirst{0.3, 2.5, 0.17, 1.5};
// Of what has parts, others need less: an upper arm moves little beside the torso.
constexpr Demands kFurther{0.2, 2, 0, 1};

// Whether the pictures bear out that a part moves by itself, which raw motion alone does not tell:
// along stripes it may have any length.
bool is_borne_out(const StepFrame& prev, const StepFrame& alone, const LatticeField& own,
                  const LatticeField& body, const LatticeField& smooth, const Demands& demands) {
    constexpr double kFoundAgain = 0.6;
    const RegistrationPicture &there = prev.picture(), &here = alone.picture();
    if (registration_agreement(there, here, own) < kFoundAgain) return false;
    const RegistrationLead before_body = registration_lead(there, here, own, body);
    const RegistrationLead before_smooth = registration_lead(there, here, own, smooth);
    return before_body.gain > demands.gain && before_body.errors > demands.errors &&
           before_smooth.gain > demands.smooth_gain && before_smooth.errors > demands.smooth_errors;
}

void add_to(Matte& all, const Matte& one) {
    for (int y = 0; y < all.height(); ++y) {
        for (int x = 0; x < all.width(); ++x)
            all.at(x, y) = std::max(all.at(x, y), one.at(x, y));
    }
}

void take_away(Matte& from, const Matte& part) {
    for (int y = 0; y < from.height(); ++y) {
        for (int x = 0; x < from.width(); ++x) {
            if (part.at(x, y) != 0) from.at(x, y) = 0;
        }
    }
}

// Where a part was before the step by which it was found, 255 or 0.
Matte on_the_frame_before(const PartOutline& part) {
    const Size size = part.matte.size();
    const ImageF2 way = inverse(part.motion).dense(rect_of(size));
    Matte out(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const float* d = way.pixel(x, y);
            const int u = x + static_cast<int>(std::lround(d[0]));
            const int v = y + static_cast<int>(std::lround(d[1]));
            if (u >= 0 && v >= 0 && u < size.width && v < size.height)
                out.at(x, y) = part.matte.at(u, v);
        }
    }
    return out;
}

}  // namespace

void JointedParts::look(const SurfaceWalker& whole, const std::shared_ptr<const StepFrame>& last,
                        const WalkStep& to, const SurfaceWalkerOptions& options) {
    if (to.evidence.parts.count == 0 || last->display().empty()) return;
    const ViewU8x1 visible = to.frame->view().visible;
    Next now{Matte(visible.size()), to.frame, to.evidence};
    for (int y = 0; y < visible.height(); ++y)
        std::copy_n(visible.row(y), visible.width(), now.matte.row(y));
    Part body{whole, last, {}};
    if (found_in(body, now, *to.evidence.raw, options).empty()) return;
    body.walker.become_part();
    parts_.push_back(std::move(body));
}

// Where the parts of the frame before have gone. Two may claim a pixel; the body has what is left.
std::vector<JointedParts::Next> JointedParts::propagated(const WalkStep& to) {
    const ViewU8x1 visible = to.frame->view().visible;
    std::vector<Matte> claims(parts_.size());
    parallel_for(parts_.size(), [&](std::size_t k) {
        if (!parts_[k].matte) return;
        claims[k] = parts_[k].matte->advance(to.frame->display(), *to.evidence.raw).matte;
    });
    std::vector<Next> next(parts_.size());
    for (Next& n : next)
        n.matte = Matte(visible.size());
    for (int y = 0; y < visible.height(); ++y) {
        for (int x = 0; x < visible.width(); ++x) {
            if (visible.at(x, y) < 128) continue;
            std::size_t owner = 0;
            std::uint8_t most = 127;
            for (std::size_t k = 1; k < claims.size(); ++k) {
                if (claims[k].at(x, y) <= most) continue;
                most = claims[k].at(x, y);
                owner = k;
            }
            next[owner].matte.at(x, y) = 255;
        }
    }
    for (std::size_t k = 1; k < next.size(); ++k)
        drop_islands(k, next);
    return next;
}

// What has come off a part is the body's.
void JointedParts::drop_islands(std::size_t part, std::vector<Next>& next) {
    Matte& matte = next[part].matte;
    Matte islands = part_islands(matte);
    if (islands.empty()) return;
    take_away(matte, islands);
    add_to(next[0].matte, islands);
    static_cast<void>(parts_[part].matte->confirm({matte, std::move(islands)}));
}

// The parts of a part.
std::vector<PartOutline> JointedParts::found_in(const Part& part, const Next& now,
                                                const FlowField& prev_from_cur,
                                                const SurfaceWalkerOptions& options) const {
    std::vector<PartOutline> out;
    if (now.evidence.parts.count == 0) return out;
    PartOutlines found = part_outlines(*part.last, *now.frame, prev_from_cur, now.evidence.parts,
                                       options.spacing_px);
    for (PartOutline& one : found.parts) {
        const auto alone = now.frame->part(one.matte, part.last.get());
        if (is_borne_out(*part.last, *alone, one.motion, found.body_motion, now.evidence.by_picture,
                         any() ? kFurther : kFirst))
            out.push_back(std::move(one));
    }
    return out;
}

void JointedParts::split(std::size_t part, std::vector<Next>& next, const WalkStep& to,
                         const SurfaceWalkerOptions& options) {
    std::vector<PartOutline> found = found_in(parts_[part], next[part], *to.evidence.raw, options);
    if (found.size() > kMostParts - parts_.size())
        found.erase(found.begin() + static_cast<std::ptrdiff_t>(kMostParts - parts_.size()),
                    found.end());
    if (found.empty()) return;
    // Where it looks for itself again, no arm is in front of it.
    Matte others(to.frame->size(), 255);
    for (PartOutline& one : found) {
        take_away(next[part].matte, one.matte);
        take_away(others, on_the_frame_before(one));
        parts_.push_back(
            {parts_[part].walker, parts_[part].last, MatteWalker(to.frame->display(), one.matte)});
        next.push_back({std::move(one.matte), nullptr, {}});
    }
    parts_[part].walker.keep_on_anchors(others);
    if (parts_[part].matte) parts_[part].matte = MatteWalker(to.frame->display(), next[part].matte);
    next[part].frame = nullptr;
}

void JointedParts::advance(const WalkStep& to, const SurfaceWalkerOptions& options) {
    std::vector<Next> next = propagated(to);
    const auto gather = [&](std::size_t k) {
        if (next[k].frame) return;
        next[k].frame = to.frame->part(next[k].matte, parts_[k].last.get());
        next[k].evidence = evidence_of(*parts_[k].last, *next[k].frame, *to.evidence.raw, options);
    };
    parallel_for(next.size(), gather);
    const std::size_t before = parts_.size();
    for (std::size_t k = 0; k < before && parts_.size() < kMostParts; ++k)
        split(k, next, to, options);
    parallel_for(next.size(), [&](std::size_t k) {
        gather(k);
        Part& part = parts_[k];
        part.walker.advance(WalkStep{next[k].frame, std::move(next[k].evidence)});
        // Of frames that have passed, nobody knows the parts any more.
        static_cast<void>(part.walker.take_found_late());
        part.last = next[k].frame;
    });
    give_up_lost(next);
    owner_ = Image<std::uint8_t, 1>(to.frame->size(), kNobody);
    for (std::size_t k = 0; k < next.size(); ++k) {
        for (int y = 0; y < owner_.height(); ++y) {
            for (int x = 0; x < owner_.width(); ++x) {
                if (next[k].matte.at(x, y) >= 128) owner_.at(x, y) = static_cast<std::uint8_t>(k);
            }
        }
    }
}

// A part that has all but gone, or whose texture is stretched or squeezed too far to be its own, is
// the body's again: what is left of it must not smear.
void JointedParts::give_up_lost(std::vector<Next>& next) {
    constexpr std::int64_t kFewest_px = 150;  // of a frame 480 wide
    const std::int64_t unit = std::max(1, next[0].matte.width() / 480);
    for (std::size_t k = parts_.size() - 1; k > 0; --k) {
        const Matte& matte = next[k].matte;
        const auto area = std::count_if(matte.data(), matte.data() + matte.size_bytes(),
                                        [](std::uint8_t code) { return code >= 128; });
        if (area >= kFewest_px * unit * unit &&
            !relaxed_stretch(parts_[k].walker.ref_from_cur(), matte))
            continue;
        add_to(next[0].matte, matte);
        parts_.erase(parts_.begin() + static_cast<std::ptrdiff_t>(k));
        next.erase(next.begin() + static_cast<std::ptrdiff_t>(k));
    }
}

void JointedParts::hold() {
    for (Part& part : parts_)
        part.walker.hold();
}

// Each part takes over by how much its pixels were moved, and carries it on beyond them.
void JointedParts::anchor_here(const LatticeField* ref_from_here) {
    if (!ref_from_here) {
        for (Part& part : parts_)
            part.walker.anchor_here();
        return;
    }
    constexpr int kBorder_px = 3;
    const Recti all = rect_of(owner_.size());
    const ImageF2 wanted = ref_from_here->dense(all);
    const Matte known(owner_.size(), 255);
    for (Part& part : parts_) {
        LatticeField field = part.walker.ref_from_cur();
        ImageF2 moved = field.dense(all);
        for (std::size_t k = 0; k < moved.size_bytes() / sizeof(float); ++k)
            moved.data()[k] = wanted.data()[k] - moved.data()[k];
        const OutlineView view = part.last->view();
        SurfaceFitOptions fit;
        fit.spacing_px = field.spacing();
        fit.correlation_px = 1;
        const LatticeField by = fit_surface_motion(
            moved, motion_weights(view.luma, view.visible, known, kBorder_px), fit);
        for (int j = 0; j < field.nodes().height(); ++j) {
            for (int i = 0; i < field.nodes().width(); ++i)
                field.set_node(i, j, field.node(i, j) + by.node(i, j));
        }
        part.walker.anchor_here(&field);
    }
}

LatticeField JointedParts::joined(const std::vector<LatticeField>& fields) const {
    constexpr int kFiner = 4;
    return joined_field(fields, owner_, std::max(1, fields[0].spacing() / kFiner));
}

LatticeField JointedParts::ref_from_cur() const {
    std::vector<LatticeField> fields;
    for (const Part& part : parts_)
        fields.push_back(part.walker.ref_from_cur());
    return joined(fields);
}

LatticeField JointedParts::prev_from_cur() const {
    std::vector<LatticeField> fields;
    for (const Part& part : parts_)
        fields.push_back(part.walker.prev_from_cur());
    return joined(fields);
}

}  // namespace weft
