#include "engine/media/exr_header.h"

#include <array>
#include <cstdint>

#include "engine/core/input_file.h"
#include "engine/media/raster_errors.h"

namespace weft {
namespace {

constexpr std::uint32_t kMagic = 20000630;    // "Technical Introduction to OpenEXR"
constexpr std::uint32_t kMultiPart = 0x1000;  // flag in the version field
constexpr std::size_t kLongestName = 255;     // with the long-name flag; else 31
constexpr int kMostAttributes = 1'000'000;

// Reads a file from its start in blocks.
class Cursor {
  public:
    explicit Cursor(const InputFile& file) : file_(file) {}

    [[nodiscard]] std::uint64_t bytes_left() const {
        return at_ < file_.bytes() ? file_.bytes() - at_ : 0;
    }
    void skip(std::uint64_t bytes) { at_ += bytes; }
    bool byte(unsigned char& value) {
        if (at_ < start_ || at_ >= start_ + held_) {
            start_ = at_;
            held_ = file_.read_at(at_, block_.data(), block_.size()).value_or(0);
            if (held_ == 0) return false;
        }
        value = block_[static_cast<std::size_t>(at_++ - start_)];
        return true;
    }
    bool u32(std::uint32_t& value) {
        value = 0;
        for (int shift = 0; shift < 32; shift += 8) {
            unsigned char b = 0;
            if (!byte(b)) return false;
            value |= static_cast<std::uint32_t>(b) << shift;
        }
        return true;
    }
    // A string that ends with a zero byte; false if there is none within the limit.
    bool name(std::string& text) {
        text.clear();
        for (unsigned char c = 0; byte(c);) {
            if (c == 0) return true;
            if (text.size() == kLongestName) return false;
            text += static_cast<char>(c);
        }
        return false;
    }

  private:
    const InputFile& file_;
    std::array<unsigned char, 4096> block_{};
    std::uint64_t at_ = 0, start_ = 0;
    std::size_t held_ = 0;
};

}  // namespace

Status check_exr_header(const std::string& path) {
    WEFT_TRY(opened, InputFile::open(path));
    Cursor file(opened);
    std::uint32_t magic = 0, version = 0;
    if (!file.u32(magic) || magic != kMagic || !file.u32(version)) return {};
    const auto cut_off = [&] { return tl::unexpected(damaged(path, "its header is cut off")); };
    std::string name, type;
    bool begun = false;  // some attribute of the present part was there
    for (int count = 0; count < kMostAttributes; ++count) {
        if (!file.name(name)) return cut_off();
        if (name.empty()) {
            // An empty name ends a header; a second one ends the headers of several parts.
            if ((version & kMultiPart) == 0 || !begun) return {};
            begun = false;
            continue;
        }
        begun = true;
        std::uint32_t bytes = 0;
        if (!file.name(type) || !file.u32(bytes)) return cut_off();
        if (bytes > file.bytes_left()) {
            return tl::unexpected(damaged(path, "its header claims " + std::to_string(bytes) +
                                                    " bytes for the attribute '" + name +
                                                    "', more than the file has"));
        }
        file.skip(bytes);
    }
    return tl::unexpected(damaged(path, "its header does not end"));
}

}  // namespace weft
