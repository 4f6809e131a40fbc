#include "engine/synthesis/sample_atlas.h"

#include <algorithm>

namespace weft {
namespace {

constexpr int kTurns = 4;

// Where the pixel at p of the oriented picture lies in the sample of size `s`.
Vec2i unoriented(Vec2i p, int orientation, Size s) {
    Vec2i q = p;
    switch (orientation % kTurns) {
        case 1:
            q = {s.width - 1 - p.y, p.x};
            break;
        case 2:
            q = {s.width - 1 - p.x, s.height - 1 - p.y};
            break;
        case 3:
            q = {p.y, s.height - 1 - p.x};
            break;
        default:
            break;
    }
    if (orientation >= kTurns) q.x = s.width - 1 - q.x;
    return q;
}

Vec2i oriented(Vec2i q, int orientation, Size s) {
    if (orientation >= kTurns) q.x = s.width - 1 - q.x;
    switch (orientation % kTurns) {
        case 1:
            return {q.y, s.width - 1 - q.x};
        case 2:
            return {s.width - 1 - q.x, s.height - 1 - q.y};
        case 3:
            return {s.height - 1 - q.y, q.x};
        default:
            return q;
    }
}

Size oriented_size(Size s, int orientation) {
    return orientation % 2 == 0 ? s : Size{s.height, s.width};
}

}  // namespace

SampleAtlas::SampleAtlas(const std::vector<ViewU8x3>& samples, Orientations allowed) {
    int y = 0, width = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        sample_sizes_.push_back(samples[i].size());
        for (int o = 0; o < 2 * kTurns; ++o) {
            if ((o % kTurns != 0 && !allowed.rotations) || (o >= kTurns && !allowed.mirror)) {
                continue;
            }
            const Size s = oriented_size(samples[i].size(), o);
            pages_.push_back({{0, y, s.width, y + s.height}, static_cast<int>(i), o});
            width = std::max(width, s.width);
            y += s.height + 1;
        }
    }
    page_of_row_.assign(static_cast<std::size_t>(y), 0);
    for (std::size_t i = 0; i < pages_.size(); ++i) {
        std::fill(page_of_row_.begin() + pages_[i].rect.y0,
                  page_of_row_.begin() + pages_[i].rect.y1 + 1, static_cast<std::uint16_t>(i));
    }
    if (pages_.size() == 1) {
        view_ = samples.front();
        return;
    }
    stacked_ = ImageU8x3(width, y - 1);
    for (const Page& page : pages_) {
        const ViewU8x3 sample = samples[static_cast<std::size_t>(page.sample)];
        for (int py = 0; py < page.rect.height(); ++py) {
            for (int px = 0; px < page.rect.width(); ++px) {
                const Vec2i q = unoriented({px, py}, page.orientation, sample.size());
                std::copy_n(sample.pixel(q.x, q.y), 3,
                            stacked_.pixel(page.rect.x0 + px, page.rect.y0 + py));
            }
        }
    }
    view_ = stacked_;
}

SampleAtlas::Place SampleAtlas::place_of(Vec2i at) const {
    const Page& page = page_of(at);
    return {page.sample, page.orientation,
            unoriented({at.x - page.rect.x0, at.y - page.rect.y0}, page.orientation,
                       sample_sizes_[static_cast<std::size_t>(page.sample)])};
}

Vec2i SampleAtlas::position_of(const Place& place) const {
    const auto page = std::find_if(pages_.begin(), pages_.end(), [&](const Page& p) {
        return p.sample == place.sample && p.orientation == place.orientation;
    });
    return oriented(place.at, place.orientation,
                    sample_sizes_[static_cast<std::size_t>(place.sample)]) +
           Vec2i{page->rect.x0, page->rect.y0};
}

}  // namespace weft
