// The strip of small results, and what choosing one of them does.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/project/project_file.h"
#include "app/session/session.h"

namespace weft {
namespace {

struct Variant {
    std::string label;
    std::string key;
    ParameterValue value;
};

std::vector<Variant> variants_of(StripKind kind, const Region& region) {
    std::vector<Variant> out;
    const auto number = [&](const char* key, double value, const char* format) {
        char text[48];
        std::snprintf(text, sizeof text, format, value);
        out.push_back({text, key, value});
    };
    switch (kind) {
        case StripKind::kScale:
            for (const double factor : {0.5, 0.71, 1.0, 1.41, 2.0})
                number("placement.scale", region.placement.scale * factor, "Scale %.2f");
            break;
        case StripKind::kLight:
            for (const double strength : {0.0, 0.35, 0.7, 1.0})
                number("light.strength", strength, "Light %.2f");
            break;
        case StripKind::kSeams:
            out.push_back({"Best cut", "synthesis.seam", std::string("graphcut")});
            out.push_back({"Quick cut", "synthesis.seam", std::string("dp")});
            out.push_back({"No cut", "synthesis.seam", std::string("none")});
            for (const double factor : {0.5, 1.5})
                number("synthesis.overlap_px",
                       std::max(12.0, std::round(region.synthesis.overlap_px * factor)),
                       "Overlap %.0f px");
            break;
        case StripKind::kNone:
        case StripKind::kKeyframes:
        case StripKind::kSuggested:
        case StripKind::kTextures:
            break;
    }
    return out;
}

}  // namespace

// Frames 1, 10, 20 and 40 of the shot, as far as it goes, or evenly over the marked range.
std::vector<int> Session::strip_frames() const {
    const auto& frames = reader_->frames();
    const auto [first, last] = played_range();
    std::vector<int> out;
    constexpr int kCount = 4;
    for (int k = 0; k < kCount; ++k) {
        static constexpr int kUsual[] = {0, 9, 19, 39};
        const int index = mark_in_ || mark_out_ ? first + (last - first) * k / (kCount - 1)
                                                : std::min(first + kUsual[k], last);
        const int frame = frames[static_cast<std::size_t>(index)];
        if (out.empty() || out.back() != frame) out.push_back(frame);
    }
    return out;
}

// As many as tell two settings apart, evenly over the marked range or the shot.
std::vector<int> Session::sheet_frames() const {
    const auto& frames = reader_->frames();
    const auto [first, last] = played_range();
    constexpr int kCount = 8;
    std::vector<int> out;
    for (int k = 0; k < kCount; ++k) {
        const int frame =
            frames[static_cast<std::size_t>(first + (last - first) * k / (kCount - 1))];
        if (out.empty() || out.back() != frame) out.push_back(frame);
    }
    return out;
}

// The cards are asked for together with the picture; here what has come is put in their order.
void Session::show_strip() {
    StripView& shown = view_.strip;
    shown.kind = strip_kind_;
    shown.over_time = strip_over_time_;
    const Region* region = region_by_id(document(), selected_);
    const bool possible =
        reader_ && view_.result_wanted && (region || strip_kind_ == StripKind::kKeyframes);
    if (strip_kind_ == StripKind::kNone || !possible) {
        if (!strip_wishes_.empty()) request_due_ = true;
        strip_wishes_.clear();
        shown.cards.clear();
        shown.columns = 0;
        strip_version_ = 0;
        return;
    }
    const bool of_frame = strip_kind_ != StripKind::kKeyframes && !strip_is_sheet();
    const bool stale = strip_version_ != document_version_ || (of_frame && strip_frame_ != frame_);
    if (stale && !tried_ && !painting_ && !playing_) {
        strip_version_ = document_version_;
        strip_frame_ = frame_;
        strip_wishes_ = strip_wishes(region);
        for (StripWish& wish : strip_wishes_)
            wish.key = strip_key(wish);
        request_due_ = true;
    }
    shown.columns = strip_columns_;
    shown.cards.clear();
    for (const StripWish& wish : strip_wishes_) {
        StripCard card{wish.label, wish.note, wish.frame, nullptr, {}, wish.current};
        if (const auto made = preview_reading_.cards.find(wish.key);
            made != preview_reading_.cards.end()) {
            card.picture = made->second.picture;
            card.error = made->second.error;
        } else if (view_.preview.state == PreviewView::State::kFailed) {
            card.error = view_.preview.error;
        }
        shown.cards.push_back(std::move(card));
    }
}

std::vector<StripWish> Session::strip_wishes(const Region* region) {
    std::vector<StripWish> wishes;
    strip_choices_.clear();
    strip_columns_ = 0;
    bool any = false;
    const Project base = project_to_preview(any);
    if (strip_kind_ == StripKind::kKeyframes) {
        for (const int frame : strip_frames()) {
            wishes.push_back({"Frame " + std::to_string(frame), {}, base, frame, 0, {}});
            strip_choices_.push_back([this, frame] { act(GoToFrame{frame}); });
        }
        return wishes;
    }
    const auto with = [&](const Project& from, const Edit& edit, std::string label,
                          std::function<void()> choice) {
        if (auto changed = apply_edit(from, edit)) {
            wishes.push_back({std::move(label), {}, std::move(*changed), frame_, 0, {}});
            strip_choices_.push_back(std::move(choice));
        }
    };
    const RegionRef ref{region->id, {}};
    if (strip_kind_ == StripKind::kTextures || strip_kind_ == StripKind::kSuggested) {
        if (strip_kind_ == StripKind::kTextures) {
            wishes.push_back({"As it is", {}, base, frame_, 0, {}});
            strip_choices_.push_back([] {});
        }
        for (const std::string& path : strip_textures_) {
            TextureSource texture = region->texture;
            texture.sample =
                names_library_texture(path) ? path : resolve_path(project_dir(path_), path);
            texture.plane.clear();
            // A region without a texture is not shown yet; here it is.
            const bool hidden = !region->enabled || region->matte->empty();
            const Expected<Project> shown =
                hidden ? Expected<Project>(base)
                       : apply_edit(base, SetRegionParameter{ref, "enabled", true});
            if (!shown) continue;
            with(*shown, SetTexture{ref, texture}, std::filesystem::path(path).stem().string(),
                 [this, path] {
                     act(ApplyTexture{path, 0});
                 });
            if (!wishes.empty()) wishes.back().note = path;
            if (strip_kind_ == StripKind::kSuggested && !wishes.empty())
                wishes.back().around = region->id;
        }
    }
    const std::string shown_now = pixel_key(base);
    const std::vector<int> on = strip_is_sheet() ? sheet_frames() : std::vector<int>{frame_};
    strip_columns_ = strip_is_sheet() ? static_cast<int>(on.size()) : 0;
    for (const Variant& variant : variants_of(strip_kind_, *region)) {
        const std::size_t before = wishes.size();
        with(base, SetRegionParameter{ref, variant.key, variant.value}, variant.label,
             [this, id = region->id, variant] {
                 edit(SetRegionParameter{{id, {}}, variant.key, variant.value}, true);
             });
        if (wishes.size() == before) continue;
        wishes.back().current = pixel_key(wishes.back().project) == shown_now;
        wishes.back().frame = on.front();
        for (std::size_t k = 1; k < on.size(); ++k) {
            wishes.push_back(wishes.back());
            wishes.back().frame = on[k];
            strip_choices_.push_back(strip_choices_.back());
        }
    }
    return wishes;
}

void Session::choose_from_strip(int card) {
    if (card < 0 || card >= static_cast<int>(strip_choices_.size())) return;
    const auto choice = strip_choices_[static_cast<std::size_t>(card)];
    choice();
}

}  // namespace weft
