// The cards of the strip, rendered by the preview's rendering thread after the picture.
#include <algorithm>

#include "app/preview/preview_impl.h"
#include "engine/color/color_space.h"
#include "engine/pipeline/analyse.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_mattes.h"
#include "engine/pipeline/render_frame.h"

namespace weft {
namespace {

constexpr int kLongest_px = 480;
constexpr std::int64_t kCardPixels = 240'000;

// A crop around a matte, with the aspect ratio of a card.
Recti around(const Recti& box, Size frame) {
    const int margin = std::max(box.width(), box.height()) / 6;
    Recti out{box.x0 - margin, box.y0 - margin, box.x1 + margin, box.y1 + margin};
    const int width = std::max(out.width(), out.height() * 4 / 3);
    const int height = std::max(out.height(), out.width() * 9 / 16);
    out.x0 -= (width - out.width()) / 2;
    out.x1 = out.x0 + width;
    out.y0 -= (height - out.height()) / 2;
    out.y1 = out.y0 + height;
    // Moved inside the frame rather than clipped, so that all cards have one shape.
    const auto inside = [](int& low, int& high, int limit) {
        if (low < 0) high -= low, low = 0;
        if (high > limit) low = std::max(0, low - (high - limit)), high = limit;
    };
    inside(out.x0, out.x1, frame.width);
    inside(out.y0, out.y1, frame.height);
    return out;
}

ImageF3 cut(const ImageF3& picture, const Recti& box) {
    ImageF3 out(box.size());
    for (int y = 0; y < box.height(); ++y)
        std::copy_n(picture.pixel(box.x0, box.y0 + y), 3 * box.width(), out.row(y));
    return out;
}

// Returns true if the open analysis also serves this project. Without light, less is needed.
bool served_by(const Project& wanted, const std::string& analysis) {
    if (analysis_key(wanted) == analysis) return true;
    Project lit = wanted;
    for (Leaf<Region>& region : lit.regions)
        if (region->light.strength <= 0)
            region = region.with([](Region& r) { r.light.strength = 1; });
    return analysis_key(lit) == analysis;
}

}  // namespace

Expected<PicturePtr> Preview::Impl::card_picture(const Look& look, const CardRequest& request) {
    const Shot& shot = look.shot;
    const int factor = factor_of(shot, kCardPixels);
    const ProxyShot small(shot, look.store, *proxies, factor);
    const std::vector<RegionScene> placed = proxy_scenes(look.scenes, factor);
    WEFT_TRY(made, render_frame(small.source(), small.plan(), placed, small.store(), *backend,
                                request.frame));
    ImageF3 pixels = std::move(made.pixels);
    for (std::size_t k = 0; request.around != 0 && k < shot.region_index.size(); ++k) {
        if (shot.project.regions[shot.region_index[k]]->id != request.around) continue;
        WEFT_TRY(matte, small.source().matte(static_cast<int>(k), request.frame));
        const Recti box = matte_bounds(matte);
        if (!box.empty()) pixels = cut(pixels, around(box, pixels.size()));
    }
    return make_picture(shrink(*picture_of(shot, pixels), kLongest_px));
}

// A region without a texture is not part of the shot's analysis.
Status Preview::Impl::open_card_store(OpenedShot& of, const CardRequest& request) {
    of.analysis = analysis_key(request.project);
    if (card_analysis != of.analysis) {
        std::vector<std::string> warnings;
        WEFT_TRY(store, open_analysis_cache(*of.shot, cache, warnings));
        card_store = std::move(store);
        card_analysis = of.analysis;
    }
    of.store = card_store;
    return {};
}

// Analyses this frame alone.
Status Preview::Impl::analyse_card(OpenedShot& of, const CardRequest& request,
                                   const CancelToken& cancel) {
    WEFT_CHECK_OK(open_card_store(of, request));
    ShotPlan plan = of.shot->plan;
    plan.frames = {request.frame};
    return analyse_shot(*of.shot->source, plan, *of.store, cancel, {});
}

bool Preview::Impl::put_card(const CardRequest& request, PicturePtr picture, std::string error,
                             bool provisional) {
    const auto shared = guarded.lock();
    shared->cards[request.key] = {request.label,    request.note, request.frame, std::move(picture),
                                  std::move(error), false,        provisional};
    changed(*shared);
    return true;
}

// From the card's frame alone where it has not been analysed, with a quickly synthesized texture.
// Null: nothing can be shown yet.
Expected<PicturePtr> Preview::Impl::quick_card(const PreviewRequest& now,
                                               const CardRequest& request,
                                               const CancelToken& cancel) {
    WEFT_TRY(opened, open(request.project, now.painted));
    OpenedShot of{opened, current->store, current->pixels, current->analysis};
    const bool served = served_by(request.project, current->analysis);
    if (!served) WEFT_CHECK_OK(open_card_store(of, request));
    Shot shot = *opened;
    std::vector<bool> shown(shot.plan.regions.size(), true);
    std::unique_ptr<AnalysisStore> alone;
    if (!served || !ready(request.frame)) {
        WEFT_TRY(made, provisional_of(of, request.frame, cancel));
        if (!made.shows_anything()) return PicturePtr();
        shot.plan = std::move(made.plan);
        shown = std::move(made.shown);
        alone = std::move(made.store);
    }
    const AnalysisStore& store = alone ? *alone : *of.store;
    WEFT_TRY(made, scenes.quick(shot, shot.plan, store, request.frame, shown, kCardPixels, cancel));
    return card_picture({shot, store, made}, request);
}

// All cards are made quickly before any is made exactly. Errors are left to step_card().
bool Preview::Impl::step_quick_card(const PreviewRequest& now) {
    const CancelToken token;
    const CardRequest* next = nullptr;
    {
        const auto shared = guarded.lock();
        if (!shared->wanted || shared->wanted->frame != now.frame || now.interactive) return false;
        shared->card_cancel = token;
        for (const CardRequest& request : now.cards) {
            const auto tried = tried_cards.find(request.key);
            if (shared->cards.contains(request.key) ||
                (tried != tried_cards.end() && tried->second == shared->visits))
                continue;
            next = &request;
            tried_cards[request.key] = shared->visits;
            break;
        }
    }
    if (!next) return false;
    auto made = quick_card(now, *next, token);
    if (token.cancelled())
        tried_cards.erase(next->key);
    else if (made && *made)
        put_card(*next, std::move(*made), {}, true);
    return true;
}

// Synthesizes the planes of a card. Returns false if something else is to be done first.
bool Preview::Impl::grow_card(const PreviewRequest& now, const OpenedShot& of, Status& grown) {
    while (!scenes.exact()) {
        CancelToken token;
        {
            const auto shared = guarded.lock();
            if (shared->stop || !shared->wanted || shared->wanted_pixels != current->pixels)
                return false;
            shared->grow_cancel = token;
        }
        grown = scenes.grow_one(*of.shot, *of.store, of.analysis, token);
        if (token.cancelled()) return false;
        if (!grown) return true;
        const auto shared = guarded.lock();
        if (shared->wanted->frame != now.frame) return false;  // the new frame comes first
    }
    return true;
}

bool Preview::Impl::step_card(const PreviewRequest& now) {
    const CancelToken card;
    const auto is_asked = [&](const auto& made) {
        return std::any_of(now.cards.begin(), now.cards.end(),
                           [&](const CardRequest& request) { return request.key == made.first; });
    };
    {
        const auto shared = guarded.lock();
        if (!shared->wanted || shared->wanted->frame != now.frame) return true;
        shared->card_cancel = card;
        std::erase_if(shared->cards, [&](const auto& made) { return !is_asked(made); });
    }
    std::erase_if(tried_cards, [&](const auto& tried) { return !is_asked(tried); });
    for (const CardRequest& request : now.cards) {
        {
            const auto shared = guarded.lock();
            const auto made = shared->cards.find(request.key);
            if (made != shared->cards.end() && !made->second.provisional) continue;
        }
        const bool served = served_by(request.project, current->analysis);
        if (served && !ready(request.frame)) continue;  // wait for the analysis of its frame
        auto shot = open(request.project, now.painted);
        if (!shot) return put_card(request, nullptr, shot.error().text());
        OpenedShot of{*shot, current->store, current->pixels, current->analysis};
        if (!served) {
            const Status analysed = analyse_card(of, request, card);
            if (card.cancelled()) return true;
            if (!analysed) return put_card(request, nullptr, analysed.error().text());
        }
        (void)scenes.adopt(*of.shot, of.analysis);
        Status grown;
        if (!grow_card(now, of, grown)) return true;
        if (!grown) return put_card(request, nullptr, grown.error().text());
        auto made = card_picture({*of.shot, *of.store, scenes.scenes()}, request);
        if (!made) return put_card(request, nullptr, made.error().text());
        return put_card(request, std::move(*made), {});
    }
    return false;
}

}  // namespace weft
