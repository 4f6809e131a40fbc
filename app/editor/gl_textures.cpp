#define GL_GLEXT_PROTOTYPES
#include "app/editor/gl_textures.h"

#include <GL/gl.h>
#include <GL/glext.h>
#include <time.h>

#include <algorithm>

namespace weft {
namespace {

constexpr std::size_t kBudgetBytes = std::size_t{256} << 20;
constexpr int kPiecePixels = 1 << 18;
constexpr double kGrantedMs = 5;  // CPU time per frame

double thread_ms() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

// Three channels to four.
template <typename T>
void widen(const T* from, T* to, std::size_t pixels, T opaque) {
    for (std::size_t k = 0; k < pixels; ++k) {
        to[4 * k] = from[3 * k];
        to[4 * k + 1] = from[3 * k + 1];
        to[4 * k + 2] = from[3 * k + 2];
        to[4 * k + 3] = opaque;
    }
}

}  // namespace

GlTextures::~GlTextures() {
    for (const auto& [key, texture] : textures_)
        glDeleteTextures(1, &texture.id);
}

void GlTextures::begin_frame() {
    ++frame_;
    spent_ms_ = 0;
    pending_ = false;
    trim();
}

std::map<std::uint64_t, GlTextures::Texture>::iterator GlTextures::oldest() {
    const auto found = std::min_element(
        textures_.begin(), textures_.end(),
        [](const auto& a, const auto& b) { return a.second.used < b.second.used; });
    return found == textures_.end() || found->second.used + 1 >= frame_ ? textures_.end() : found;
}

void GlTextures::trim() {
    while (bytes_ > kBudgetBytes) {
        const auto gone = oldest();
        if (gone == textures_.end()) return;
        glDeleteTextures(1, &gone->second.id);
        bytes_ -= gone->second.bytes;
        textures_.erase(gone);
    }
}

GlTextures::Texture& GlTextures::made(const PicturePtr& picture, Values values) {
    const std::uint64_t codes = values == Values::kCodes ? std::uint64_t{1} << 63 : 0;
    const std::uint64_t key = picture->id | codes;
    if (const auto known = textures_.find(key); known != textures_.end()) {
        known->second.used = frame_;
        return known->second;
    }
    const int w = picture->size.width, h = picture->size.height;
    const bool half = picture->srgb.empty();
    Texture fresh;
    fresh.size = picture->size;
    fresh.format = half ? GL_RGBA16F : codes ? GL_RGBA8 : GL_SRGB8_ALPHA8;
    fresh.bytes = static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * (half ? 8 : 4);
    fresh.used = frame_;
    const auto old = bytes_ + fresh.bytes > kBudgetBytes ? oldest() : textures_.end();
    if (old != textures_.end() && old->second.size == fresh.size &&
        old->second.format == fresh.format) {
        // Reuse the old texture's memory: allocating a large texture costs more than its upload.
        fresh.id = old->second.id;
        textures_.erase(old);
        return textures_[key] = fresh;
    }
    glGenTextures(1, &fresh.id);
    glBindTexture(GL_TEXTURE_2D, fresh.id);
    glTexImage2D(GL_TEXTURE_2D, 0, fresh.format, w, h, 0, GL_RGBA,
                 half ? GL_HALF_FLOAT : GL_UNSIGNED_BYTE, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    bytes_ += fresh.bytes;
    return textures_[key] = fresh;
}

void GlTextures::hand_over(const Picture& picture, Texture& texture, int rows) {
    const int w = picture.size.width, first = texture.rows;
    rows = std::min(rows, picture.size.height - first);
    glBindTexture(GL_TEXTURE_2D, texture.id);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    const std::size_t row_pixels = static_cast<std::size_t>(w);
    staging_.resize(4 * row_pixels * static_cast<std::size_t>(rows));
    const bool half = picture.srgb.empty();
    auto* bytes = reinterpret_cast<std::uint8_t*>(staging_.data());
    for (int y = 0; y < rows; ++y) {
        const std::size_t at = 4 * row_pixels * static_cast<std::size_t>(y);
        constexpr std::uint16_t kHalfOne = 0x3C00;
        if (half)
            widen<std::uint16_t>(picture.half.row(first + y), staging_.data() + at, row_pixels,
                                 kHalfOne);
        else
            widen<std::uint8_t>(picture.srgb.row(first + y), bytes + at, row_pixels, 255);
    }
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, first, w, rows, GL_RGBA,
                    half ? GL_HALF_FLOAT : GL_UNSIGNED_BYTE, staging_.data());
    texture.rows += rows;
}

unsigned GlTextures::in_pieces(const PicturePtr& picture) {
    if (!picture || picture->size.empty()) return 0;
    const double start = thread_ms();
    Texture& texture = made(picture, Values::kLinear);
    const int rows = std::max(1, kPiecePixels / picture->size.width);
    while (texture.rows < picture->size.height) {
        hand_over(*picture, texture, rows);
        if (spent_ms_ + thread_ms() - start > kGrantedMs) break;
    }
    spent_ms_ += thread_ms() - start;
    if (texture.rows == picture->size.height) return texture.id;
    pending_ = true;
    return 0;
}

unsigned GlTextures::whole(const PicturePtr& picture, Values values) {
    if (!picture || picture->size.empty()) return 0;
    Texture& texture = made(picture, values);
    if (texture.rows < picture->size.height)
        hand_over(*picture, texture, picture->size.height - texture.rows);
    return texture.id;
}

}  // namespace weft
