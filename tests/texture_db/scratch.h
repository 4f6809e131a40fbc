#pragma once
// A folder of its own for a test, and small pictures to put into libraries.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "engine/core/image.h"
#include "engine/core/rng.h"
#include "texture_db/library/library.h"

namespace weft {

class Scratch {
  public:
    Scratch() {
        std::string name =
            (std::filesystem::temp_directory_path() / "weft_textures_XXXXXX").string();
        path_ = ::mkdtemp(name.data());
    }
    ~Scratch() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    [[nodiscard]] std::string at(const std::string& name) const { return path_ + "/" + name; }

  private:
    std::string path_;
};

inline void write_file(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

/// Noise around one colour, different for every seed.
inline ImageU8x3 noise_picture(int side, std::uint64_t seed, int r = 128, int g = 128, int b = 128,
                               int spread = 40) {
    ImageU8x3 out(side, side);
    Rng rng(seed);
    const int base[3] = {r, g, b};
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const int d =
                static_cast<int>(rng.below(static_cast<std::uint64_t>(2 * spread + 1))) - spread;
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) = static_cast<std::uint8_t>(std::clamp(base[c] + d, 0, 255));
        }
    }
    return out;
}

inline NewTexture new_texture(std::uint64_t seed, const std::string& material,
                              const std::string& name, int r = 128, int g = 128, int b = 128) {
    NewTexture t;
    t.pixels = noise_picture(kSampleSide_px, seed, r, g, b);
    t.name = name;
    t.material = material;
    t.origin = TextureOrigin::kFile;
    t.source = "/nowhere/" + name + ".png";
    t.author = "Ada";
    t.licence = "CC-BY-4.0";
    return t;
}

inline std::shared_ptr<TextureLibrary> open_or_die(const std::string& path) {
    auto library = TextureLibrary::open(path);
    return library ? *library : nullptr;
}

}  // namespace weft
