#include "engine/media/exr_header.h"

#include <cstdint>
#include <fstream>

#include "engine/media/raster_errors.h"

namespace weft {
namespace {

constexpr std::uint32_t kMagic = 20000630;    // "Technical Introduction to OpenEXR"
constexpr std::uint32_t kMultiPart = 0x1000;  // flag in the version field
constexpr std::size_t kLongestName = 255;     // with the long-name flag; else 31
constexpr int kMostAttributes = 1'000'000;

bool read_u32(std::ifstream& file, std::uint32_t& value) {
    unsigned char b[4];
    if (!file.read(reinterpret_cast<char*>(b), sizeof b)) return false;
    value = b[0] | b[1] << 8 | b[2] << 16 | static_cast<std::uint32_t>(b[3]) << 24;
    return true;
}

// A text that ends with a zero byte. False where none does in time.
bool read_name(std::ifstream& file, std::string& name) {
    name.clear();
    for (char c = 0; file.get(c);) {
        if (c == 0) return true;
        if (name.size() == kLongestName) return false;
        name += c;
    }
    return false;
}

}  // namespace

Status check_exr_header(const std::string& path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) return {};
    const auto length = static_cast<std::int64_t>(file.tellg());
    file.seekg(0);
    std::uint32_t magic = 0, version = 0;
    if (!read_u32(file, magic) || magic != kMagic || !read_u32(file, version)) return {};
    const auto cut_off = [&] { return tl::unexpected(damaged(path, "its header is cut off")); };
    std::string name, type;
    bool begun = false;  // some attribute of the present part was there
    for (int count = 0; count < kMostAttributes; ++count) {
        if (!read_name(file, name)) return cut_off();
        if (name.empty()) {
            // An empty name ends a header; a second one ends the headers of several parts.
            if ((version & kMultiPart) == 0 || !begun) return {};
            begun = false;
            continue;
        }
        begun = true;
        std::uint32_t bytes = 0;
        if (!read_name(file, type) || !read_u32(file, bytes)) return cut_off();
        if (static_cast<std::int64_t>(bytes) > length - static_cast<std::int64_t>(file.tellg())) {
            return tl::unexpected(damaged(path, "its header claims " + std::to_string(bytes) +
                                                    " bytes for the attribute '" + name +
                                                    "', more than the file has"));
        }
        file.seekg(bytes, std::ios::cur);
    }
    return tl::unexpected(damaged(path, "its header does not end"));
}

}  // namespace weft
