#include "app/session/viewer/strip.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "app/project/codec/project_file.h"

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
                number("light.strength", strength, "Strength %.2f");
            break;
        case StripKind::kSeams:
            out.push_back({"Graph cut", "synthesis.seam", std::string("graphcut")});
            out.push_back({"Dynamic programming", "synthesis.seam", std::string("dp")});
            out.push_back({"None (blocks)", "synthesis.seam", std::string("none")});
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

// Collects the cards.
struct CardMaker {
    const StripQuery& question;
    const StripSubject& subject;
    StripCards& out;

    void add(CardRequest request, std::optional<Action> choice) const {
        out.requests.push_back(std::move(request));
        out.choices.push_back(std::move(choice));
    }
    // Returns false if the edit fails.
    [[nodiscard]] bool add_edited(const Project& from, const Edit& edit, std::string label,
                                  Action choice) const {
        auto changed = apply_edit(from, edit);
        if (!changed) return false;
        add({std::move(label), {}, std::move(*changed), question.frame, 0, {}}, std::move(choice));
        return true;
    }

    void keyframes() const {
        for (const int frame : question.frames)
            add({"Frame " + std::to_string(frame), {}, subject.project, frame, 0, {}},
                GoToFrame{frame});
    }

    void textures(const Region& region) const {
        const Project& base = subject.project;
        const bool suggested = question.kind == StripKind::kSuggested;
        if (!suggested) add({"Current", {}, base, question.frame, 0, {}}, std::nullopt);
        for (const std::string& path : question.textures) {
            TextureSource texture = region.texture;
            texture.sample =
                names_library_texture(path) ? path : resolve_path(subject.folder, path);
            texture.plane.clear();
            const RegionRef ref{region.id, {}};
            // The region may have no texture and be disabled; enable it.
            const Expected<Project> shown =
                subject.shown ? apply_edit(base, SetRegionParameter{ref, "enabled", true})
                              : Expected<Project>(base);
            if (!shown ||
                !add_edited(*shown, SetTexture{ref, texture},
                            std::filesystem::path(path).stem().string(), ApplyTexture{path, 0}))
                continue;
            out.requests.back().note = path;
            if (suggested) out.requests.back().around = region.id;
        }
    }

    void settings(const Region& region) const {
        const Project& base = subject.project;
        const std::string shown_now = pixel_key(base);
        const std::vector<int> on =
            question.is_sheet() ? question.frames : std::vector<int>{question.frame};
        out.columns = question.is_sheet() ? static_cast<int>(on.size()) : 0;
        for (const Variant& variant : variants_of(question.kind, region)) {
            const SetRegionParameter edit{{region.id, {}}, variant.key, variant.value};
            if (!add_edited(base, edit, variant.label, DoEdit{edit})) continue;
            out.requests.back().current = pixel_key(out.requests.back().project) == shown_now;
            out.requests.back().frame = on.front();
            for (std::size_t k = 1; k < on.size(); ++k) {
                add(out.requests.back(), out.choices.back());
                out.requests.back().frame = on[k];
            }
        }
    }
};

}  // namespace

StripCards make_strip_cards(const StripQuery& question, const StripSubject& subject) {
    StripCards out;
    out.question = question;
    const CardMaker make{question, subject, out};
    if (question.kind == StripKind::kKeyframes) {
        make.keyframes();
    } else if (const Region* region = region_by_id(subject.project, question.region)) {
        if (question.kind == StripKind::kTextures || question.kind == StripKind::kSuggested)
            make.textures(*region);
        else
            make.settings(*region);
    }
    for (CardRequest& request : out.requests)
        request.key = strip_key(request);
    return out;
}

std::vector<int> strip_frames(const std::vector<int>& frames, int first, int last, bool marked) {
    std::vector<int> out;
    constexpr int kCount = 4;
    for (int k = 0; k < kCount; ++k) {
        static constexpr int kUsual[] = {0, 9, 19, 39};
        const int index =
            marked ? first + (last - first) * k / (kCount - 1) : std::min(first + kUsual[k], last);
        const int frame = frames[static_cast<std::size_t>(index)];
        if (out.empty() || out.back() != frame) out.push_back(frame);
    }
    return out;
}

std::vector<int> sheet_frames(const std::vector<int>& frames, int first, int last) {
    constexpr int kCount = 8;
    std::vector<int> out;
    for (int k = 0; k < kCount; ++k) {
        const int frame =
            frames[static_cast<std::size_t>(first + (last - first) * k / (kCount - 1))];
        if (out.empty() || out.back() != frame) out.push_back(frame);
    }
    return out;
}

void Strip::show(StripKind kind, std::vector<std::string> textures, bool over_time) {
    kind_ = kind;
    textures_ = std::move(textures);
    over_time_ = over_time;
}

void Strip::ask(const StripQuery& question, StripSubject subject) {
    asked_ = question;
    (void)worker_.ask(question, [question, subject = std::move(subject)](const CancelToken&) {
        return std::optional(make_strip_cards(question, subject));
    });
}

bool Strip::update() {
    auto newest = worker_.newest();
    // Ignore results of requests before clear().
    if (!asked_ || !newest || newest == cards_) return false;
    cards_ = std::move(newest);
    return true;
}

bool Strip::clear() {
    asked_.reset();
    return std::exchange(cards_, nullptr) != nullptr;
}

std::shared_ptr<const StripCards> Strip::cards() const {
    const bool current =
        cards_ && cards_->question.kind == kind_ && cards_->question.over_time == over_time_;
    return current ? cards_ : nullptr;
}

}  // namespace weft
