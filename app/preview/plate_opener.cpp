#include "app/preview/plate_opener.h"

#include <chrono>

#include "app/base/background.h"

namespace weft {
namespace {

Expected<OpenedPlate> opened(const Plate& plate, const std::shared_ptr<std::atomic<int>>& counted) {
    OpenedPlate out;
    WEFT_TRY(reader,
             open_plate(plate.path, {plate.layer, plate.movie_start, plate.pixel_aspect, counted}));
    out.reader = reader;
    out.space = plate.space.empty() ? reader->color().space : plate.space;
    WEFT_TRY(space, parse_color_space(out.space));
    WEFT_TRY(srgb, make_color_transform(space, {"srgb"}));
    WEFT_TRY(linear, make_color_transform(space, {"linear"}));
    out.srgb = srgb;
    out.linear = linear;
    return out;
}

}  // namespace

bool PlateOpener::open(const Plate& plate) {
    if (asked_ == plate) return false;
    asked_ = plate;
    if (opening_.valid()) abandoned_.push_back(std::move(opening_));
    counted_ = std::make_shared<std::atomic<int>>(0);
    if (!plate.path.empty())
        opening_ = in_background([plate, counted = counted_] { return opened(plate, counted); });
    return true;
}

std::optional<Expected<OpenedPlate>> PlateOpener::take() {
    const auto over = [](const auto& future) {
        return future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    };
    std::erase_if(abandoned_, over);
    if (!opening_.valid() || !over(opening_)) return std::nullopt;
    return opening_.get();
}

}  // namespace weft
