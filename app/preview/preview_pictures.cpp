// The pictures of a rendered frame: their size, and how long they are kept.
#include <cstdlib>
#include <iterator>
#include <utility>

#include "app/preview/preview_impl.h"
#include "app/preview/preview_stages.h"

namespace weft {
namespace {

std::size_t bytes_of(const PreviewFrame& frame) {
    std::size_t sum = frame.layer ? frame.layer->size_bytes() : 0;
    if (frame.small) sum += frame.small->size_bytes();
    if (frame.seams) sum += frame.seams->size() * sizeof(SeamPoints::value_type);
    for (const PicturePtr& p : frame.stages)
        sum += p ? p->size_bytes() : 0;
    return sum;
}

}  // namespace

int Preview::Impl::factor_of(const Shot& shot, std::int64_t pixels) const {
    return ProxyShot::possible(shot) ? proxy_factor(shot.source->size(), pixels) : 1;
}

PicturePtr Preview::Impl::picture_of(const Shot& shot, const ImageF3& pixels) const {
    const bool eight_bit = shot.plan.display_referred && shot.plate->depth() == PixelDepth::kU8;
    return make_picture(pixels, eight_bit, srgb_from_out.get(), linear_from_out.get());
}

Expected<PreviewFrame> Preview::Impl::pictures_of(const Look& look, int frame, bool stages,
                                                  int factor, std::optional<LayerKind> layer,
                                                  float* seam) {
    const Shot& shot = look.shot;
    const auto picture = [&](const ImageF3& pixels) { return picture_of(shot, pixels); };
    if (factor == 1) {
        return render_stages({*shot.source, shot.plan, look.scenes, look.store, *backend}, frame,
                             stages, layer, picture, seam);
    }
    const ProxyShot small(shot, look.store, *proxies, factor);
    const std::vector<RegionScene> placed = proxy_scenes(look.scenes, factor);
    WEFT_TRY(made, render_stages({small.source(), small.plan(), placed, small.store(), *backend},
                                 frame, stages, layer, picture, seam));
    made.proxy = factor;
    return made;
}

void Preview::Impl::keep(const PreviewRequest& now, int frame, PreviewFrame made, double seconds) {
    std::vector<PreviewFrame> gone;  // freed after the lock is: pictures are large
    const auto shared = guarded.lock();
    // Full-size pictures only: reduced ones say little about render time.
    if (made.proxy == 1 && !made.stages[0]) shared->shown.frame_seconds = seconds;
    note_first(*shared, frame);
    if (std::exchange(shared->analysis_held, false)) wake.notify_all();
    if (const auto before = shared->frames.find(frame); before != shared->frames.end()) {
        shared->frame_bytes -= bytes_of(before->second);
        // Keep the small picture, so that neighbours are compared at one size.
        if (made.proxy == 1 && !before->second.approximate && before->second.comparable() &&
            (before->second.small || before->second.proxy > 1)) {
            made.small = before->second.comparable();
            made.seams = before->second.seams;
        }
    }
    if (shared->provisional_frame == frame) shared->provisional.reset();
    shared->frame_bytes += bytes_of(made);
    gone.push_back(std::exchange(shared->frames[frame], std::move(made)));
    while (shared->frame_bytes > budget_bytes && shared->frames.size() > 1) {
        // Free the frame furthest from the playhead.
        const auto first = shared->frames.begin(), last = std::prev(shared->frames.end());
        const auto far =
            std::abs(first->first - now.frame) > std::abs(last->first - now.frame) ? first : last;
        shared->frame_bytes -= bytes_of(far->second);
        gone.push_back(std::move(far->second));
        shared->frames.erase(far);
    }
    changed(*shared);
}

}  // namespace weft
