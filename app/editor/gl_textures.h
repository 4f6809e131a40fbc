#pragma once
// Uploads pictures to OpenGL in parts, so that no frame waits for a large one.

#include <cstdint>
#include <map>
#include <vector>

#include "app/base/picture.h"

namespace weft {

/// Needs a current OpenGL 3.3 context during its lifetime. Belongs to one thread.
class GlTextures {
  public:
    /// Values of the texture: linear light (the driver decodes before filtering), or the picture's
    /// codes unchanged, as ImGui's shader shows them.
    enum class Values : int { kLinear, kCodes };

    GlTextures() = default;
    ~GlTextures();
    GlTextures(const GlTextures&) = delete;
    GlTextures& operator=(const GlTextures&) = delete;

    /// Returns the picture's texture once it is uploaded completely, otherwise 0. Each call uploads
    /// a part, and more parts while this frame's time lasts.
    [[nodiscard]] unsigned in_pieces(const PicturePtr& picture);
    /// Uploads a small picture at once.
    [[nodiscard]] unsigned whole(const PicturePtr& picture, Values values);
    /// Starts a frame: resets the upload time, and frees unused textures when there are many.
    void begin_frame();
    /// Returns true if a picture requested in this frame is incomplete.
    [[nodiscard]] bool pending() const { return pending_; }

  private:
    struct Texture {
        unsigned id = 0;
        int rows = 0;  // uploaded so far
        Size size;
        int format = 0;
        std::size_t bytes = 0;
        std::uint64_t used = 0;
    };
    Texture& made(const PicturePtr& picture, Values values);
    void hand_over(const Picture& picture, Texture& texture, int rows);
    // The least recently used texture, or end().
    [[nodiscard]] std::map<std::uint64_t, Texture>::iterator oldest();
    void trim();

    std::map<std::uint64_t, Texture> textures_;
    // rows padded to four channels, which drivers copy fastest
    std::vector<std::uint16_t> staging_;
    std::size_t bytes_ = 0;
    std::uint64_t frame_ = 0;
    double spent_ms_ = 0;
    bool pending_ = false;
};

}  // namespace weft
