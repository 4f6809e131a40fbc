#pragma once
// Pictures as textures: handed to OpenGL a piece a frame, so that no frame waits for a large one.

#include <cstdint>
#include <map>
#include <vector>

#include "app/base/picture.h"

namespace weft {

/// Needs a current OpenGL 3.3 context for its whole life. One thread.
class GlTextures {
  public:
    /// Whether the texture's values are linear light (decoded by the driver before it filters), or
    /// the picture's codes as they stand, as ImGui's own shader shows them.
    enum class Values : int { kLinear, kCodes };

    GlTextures() = default;
    ~GlTextures();
    GlTextures(const GlTextures&) = delete;
    GlTextures& operator=(const GlTextures&) = delete;

    /// The picture's texture once all of it is there, else 0. Each call hands a piece over; further
    /// ones as long as this frame's time for it lasts.
    [[nodiscard]] unsigned in_pieces(const PicturePtr& picture);
    /// The same at once: for small ones.
    [[nodiscard]] unsigned whole(const PicturePtr& picture, Values values);
    /// A new frame: time is granted anew, textures that nobody used go when they are many.
    void begin_frame();
    /// Whether a picture that was asked for in this frame is not all there.
    [[nodiscard]] bool pending() const { return pending_; }

  private:
    struct Texture {
        unsigned id = 0;
        int rows = 0;  // handed over so far
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
    std::vector<std::uint16_t> staging_;  // rows with a fourth channel, which drivers copy fastest
    std::size_t bytes_ = 0;
    std::uint64_t frame_ = 0;
    double spent_ms_ = 0;
    bool pending_ = false;
};

}  // namespace weft
