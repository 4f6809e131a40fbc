#include "ui/base/theme.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/input_file.h"
#include "ui/base/icons.h"

namespace weft {
namespace {

constexpr ImU32 rgb(unsigned hex) {
    return IM_COL32((hex >> 16) & 255, (hex >> 8) & 255, hex & 255, 255);
}

struct Shade {
    ImU32 Theme::*of;
    ImU32 dark, light;
};
constexpr std::array kShades{
    Shade{&Theme::surround, rgb(0x1E1E1E), rgb(0xBDBDBD)},
    Shade{&Theme::panel, rgb(0x262626), rgb(0xE4E4E4)},
    Shade{&Theme::raised, rgb(0x343434), rgb(0xF4F4F4)},
    Shade{&Theme::field, rgb(0x1A1A1A), rgb(0xFAFAFA)},
    Shade{&Theme::line, rgb(0x141414), rgb(0xBEBEBE)},
    Shade{&Theme::text, rgb(0xDADADA), rgb(0x202020)},
    Shade{&Theme::quiet, rgb(0x9C9C9C), rgb(0x5C5C5C)},
    Shade{&Theme::off, rgb(0x616161), rgb(0x9A9A9A)},
    Shade{&Theme::accent, rgb(0x4F94DC), rgb(0x2B6CB3)},
    Shade{&Theme::accent_hover, rgb(0x62A4EA), rgb(0x3B7FC6)},
    Shade{&Theme::accent_press, rgb(0x3B7FC6), rgb(0x22588F)},
    Shade{&Theme::on_accent, rgb(0x0E1620), rgb(0xFFFFFF)},
    Shade{&Theme::good, rgb(0x58A86B), rgb(0x19522A)},
    Shade{&Theme::warn, rgb(0xD9A441), rgb(0x6B4400)},
    Shade{&Theme::bad, rgb(0xD8605A), rgb(0x8E231E)},
    Shade{&Theme::hover, IM_COL32(255, 255, 255, 16), IM_COL32(0, 0, 0, 18)},
    Shade{&Theme::scrim, IM_COL32(24, 24, 24, 220), IM_COL32(244, 244, 244, 230)}};

constexpr const char* kRegular = "/usr/share/fonts/opentype/inter/Inter-Regular.otf";
constexpr const char* kStrong = "/usr/share/fonts/opentype/inter/Inter-SemiBold.otf";
constexpr const char* kIcons =
    "/usr/share/fonts/truetype/materialdesignicons-webfont/materialdesignicons-webfont.ttf";

// Latin, Greek (symbols of the method), punctuation, arrows and mathematical signs.
constexpr ImWchar kTextRanges[] = {0x0020, 0x017F, 0x0370, 0x03FF, 0x2010, 0x205E, 0x2070,
                                   0x209F, 0x2190, 0x22FF, 0x25A0, 0x25FF, 0};
constexpr ImWchar kIconRanges[] = {icons::kFirst, icons::kLast, 0};

// Inter's em is 0.826 of its line height, which ImGui uses as font size.
constexpr float kLinePerEm = 1.21f;

ImFont* load(const char* path, float em_px, float icon_px) {
    ImFontAtlas* atlas = ImGui::GetIO().Fonts;
    if (!check_input_file(path)) {
        ImFontConfig config;
        config.SizePixels = std::round(em_px);
        return atlas->AddFontDefault(&config);
    }
    ImFontConfig config;
    config.OversampleH = 3;
    config.OversampleV = 1;
    config.PixelSnapH = true;
    ImFont* font =
        atlas->AddFontFromFileTTF(path, std::round(em_px * kLinePerEm), &config, kTextRanges);
    if (check_input_file(kIcons)) {
        ImFontConfig merged;
        merged.MergeMode = true;
        merged.PixelSnapH = true;
        merged.GlyphMinAdvanceX = icon_px;
        merged.GlyphOffset.y = std::round(icon_px * 0.16f);
        atlas->AddFontFromFileTTF(kIcons, icon_px, &merged, kIconRanges);
    }
    return font;
}

// Tabular figures, so that changing numbers do not jump: all digits get the width of the widest.
void make_figures_tabular(ImFont* font) {
    float widest = 0;
    for (ImWchar c = '0'; c <= '9'; ++c)
        if (const ImFontGlyph* glyph = font->FindGlyphNoFallback(c))
            widest = std::max(widest, glyph->AdvanceX);
    for (ImWchar c = '0'; c <= '9'; ++c) {
        auto* glyph = const_cast<ImFontGlyph*>(font->FindGlyphNoFallback(c));
        if (!glyph) continue;
        const float shift = std::round((widest - glyph->AdvanceX) * 0.5f);
        glyph->X0 += shift;
        glyph->X1 += shift;
        glyph->AdvanceX = widest;
        font->IndexAdvanceX[c] = widest;
    }
}

}  // namespace

Theme make_theme(bool dark, bool grey_surround, float scale) {
    Theme t{};
    t.scale = scale;
    for (const Shade& shade : kShades)
        t.*shade.of = dark ? shade.dark : shade.light;
    if (grey_surround) t.surround = rgb(0x767676);
    t.gap = t.px(8);
    t.pad = t.px(8);
    t.group = t.px(16);
    t.row = t.px(26);
    t.radius = t.px(3);
    t.splitter = t.px(4);
    t.splitter_hit = t.px(8);
    t.thumb = t.px(96);
    t.icon_button = t.px(28);
    return t;
}

void apply_theme(const Theme& t) {
    ImGuiStyle& s = ImGui::GetStyle();
    s = ImGuiStyle();
    s.WindowPadding = {t.pad, t.pad};
    s.WindowBorderSize = 0;
    s.ChildBorderSize = 0;
    s.PopupBorderSize = 1;
    s.FrameBorderSize = 0;
    s.WindowRounding = s.ChildRounding = 0;
    s.PopupRounding = s.FrameRounding = s.GrabRounding = s.ScrollbarRounding = t.radius;
    s.FramePadding = {t.px(8), std::floor((t.row - t.px(17)) / 2)};
    s.ItemSpacing = {t.gap, t.px(6)};
    s.ItemInnerSpacing = {t.px(6), t.px(4)};
    s.ScrollbarSize = t.px(10);
    s.IndentSpacing = t.px(14);
    const auto set = [&](ImGuiCol at, ImU32 color) {
        s.Colors[at] = ImGui::ColorConvertU32ToFloat4(color);
    };
    set(ImGuiCol_Text, t.text);
    set(ImGuiCol_TextDisabled, t.off);
    set(ImGuiCol_WindowBg, t.panel);
    set(ImGuiCol_ChildBg, 0);
    set(ImGuiCol_PopupBg, t.raised);
    set(ImGuiCol_Border, t.line);
    set(ImGuiCol_FrameBg, t.field);
    set(ImGuiCol_FrameBgHovered, t.field);
    set(ImGuiCol_FrameBgActive, t.field);
    set(ImGuiCol_Button, t.raised);
    set(ImGuiCol_ButtonHovered, t.raised);
    set(ImGuiCol_ButtonActive, t.field);
    set(ImGuiCol_Header, faded(t.accent, 0.28f));
    set(ImGuiCol_HeaderHovered, t.hover);
    set(ImGuiCol_HeaderActive, faded(t.accent, 0.4f));
    set(ImGuiCol_ScrollbarBg, 0);
    set(ImGuiCol_ScrollbarGrab, faded(t.off, 0.6f));
    set(ImGuiCol_ScrollbarGrabHovered, t.off);
    set(ImGuiCol_ScrollbarGrabActive, t.quiet);
    set(ImGuiCol_Separator, t.line);
    set(ImGuiCol_CheckMark, t.accent);
    set(ImGuiCol_TextSelectedBg, faded(t.accent, 0.45f));
    set(ImGuiCol_NavHighlight, t.accent);
    set(ImGuiCol_ModalWindowDimBg, IM_COL32(0, 0, 0, 140));
    set(ImGuiCol_DragDropTarget, t.accent);
}

void load_fonts(Theme& t) {
    ImFontAtlas* atlas = ImGui::GetIO().Fonts;
    atlas->Clear();
    atlas->TexDesiredWidth = t.scale > 1.4f ? 4096 : 2048;
    t.regular = load(kRegular, t.px(13.5f), t.px(17));
    t.strong = load(kStrong, t.px(13.5f), t.px(17));
    t.small = load(kRegular, t.px(12), t.px(15));
    t.title = load(kStrong, t.px(18), t.px(22));
    t.display = load(kStrong, t.px(30), t.px(32));
    atlas->Build();
    for (ImFont* font : {t.regular, t.small})
        make_figures_tabular(font);
}

ImU32 region_color(int index) {
    constexpr unsigned kHues[] = {0xE69F00, 0x56B4E9, 0x009E73, 0xF0E442,
                                  0x0072B2, 0xD55E00, 0xCC79A7};
    constexpr int kCount = 7;
    return rgb(kHues[((index % kCount) + kCount) % kCount]);
}

ImU32 region_color(int index, unsigned id) {
    return region_color(index > 0 ? index : static_cast<int>(id) - 1);
}

ImU32 heat_color(float value) {
    // Samples of the inferno colour map (Smith and van der Walt 2015), interpolated linearly.
    constexpr unsigned kPoints[] = {0x000004, 0x1F0C48, 0x550F6D, 0x88226A, 0xBA3655,
                                    0xE35933, 0xF98C0A, 0xF9C932, 0xFCFFA4};
    constexpr int kLast = 8;
    const float at = std::clamp(value, 0.0f, 1.0f) * kLast;
    const int k = std::min(static_cast<int>(at), kLast - 1);
    const float t = at - static_cast<float>(k);
    const auto mix = [&](int shift) {
        const auto a = static_cast<float>((kPoints[k] >> shift) & 255);
        const auto b = static_cast<float>((kPoints[k + 1] >> shift) & 255);
        return static_cast<int>(a + t * (b - a) + 0.5f);
    };
    return IM_COL32(mix(16), mix(8), mix(0), 255);
}

float flicker_heat(float flicker, float plate, float floor) {
    constexpr float kKnown = 0.15f, kWorst = 6.0f;
    if (flicker < 0) return -1;
    return std::clamp(kKnown + std::max(0.0f, flicker - std::max(plate, floor)) / kWorst, 0.0f,
                      1.0f);
}

ImU32 faded(ImU32 color, float opacity) {
    const auto alpha = static_cast<float>((color >> IM_COL32_A_SHIFT) & 255) * opacity;
    return (color & ~IM_COL32_A_MASK) |
           (static_cast<ImU32>(std::clamp(alpha, 0.0f, 255.0f) + 0.5f) << IM_COL32_A_SHIFT);
}

}  // namespace weft
