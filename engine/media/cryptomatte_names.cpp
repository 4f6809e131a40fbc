// Names of Cryptomatte: their hashes, and the manifest that lists them.
#include <bit>
#include <cctype>
#include <cstring>

#include "engine/media/cryptomatte.h"

namespace weft {
namespace {

class ManifestReader {
  public:
    explicit ManifestReader(std::string_view text) : text_(text) {}

    Expected<std::map<std::string, std::uint32_t>> read() {
        std::map<std::string, std::uint32_t> out;
        if (!take('{')) return wrong("it does not begin with {");
        if (take('}')) return out;
        do {
            WEFT_TRY(name, string());
            if (!take(':')) return wrong("a name has no value");
            WEFT_TRY(hex, string());
            std::uint32_t id = 0;
            if (hex.empty() || hex.size() > 8) return wrong("a value does not have 1 to 8 digits");
            for (const char c : hex) {
                const int digit = digit_of(c);
                if (digit < 0) return wrong("a value is not hexadecimal");
                id = id * 16 + static_cast<std::uint32_t>(digit);
            }
            out[std::move(name)] = id;
        } while (take(','));
        if (!take('}')) return wrong("it ends early");
        return out;
    }

  private:
    static tl::unexpected<Error> wrong(const char* why) {
        return fail(ErrorCode::kUnreadable,
                    std::string("The Cryptomatte manifest cannot be read: ") + why + ".");
    }
    static int digit_of(char c) {
        if (c >= '0' && c <= '9') return c - '0';
        if (c >= 'a' && c <= 'f') return c - 'a' + 10;
        if (c >= 'A' && c <= 'F') return c - 'A' + 10;
        return -1;
    }
    bool take(char wanted) {
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])))
            ++at_;
        if (at_ >= text_.size() || text_[at_] != wanted) return false;
        ++at_;
        return true;
    }
    Expected<std::string> string() {
        if (!take('"')) return wrong("a string is missing");
        std::string out;
        while (at_ < text_.size() && text_[at_] != '"') {
            if (text_[at_] != '\\') {
                out += text_[at_++];
                continue;
            }
            if (++at_ >= text_.size()) break;
            const char c = text_[at_++];
            if (c == 'u') {
                WEFT_CHECK_OK(unicode(out));
            } else {
                static constexpr std::string_view kFrom = "nrtbf", kTo = "\n\r\t\b\f";
                const std::size_t k = kFrom.find(c);
                out += k == std::string_view::npos ? c : kTo[k];
            }
        }
        if (at_ >= text_.size()) return wrong("a string does not end");
        ++at_;
        return out;
    }
    // Four digits. Each half of a surrogate pair becomes three bytes. A name's hash is not made of
    // those, but such names do not occur in practice.
    Status unicode(std::string& out) {
        unsigned code = 0;
        for (int k = 0; k < 4; ++k, ++at_) {
            const int digit = at_ < text_.size() ? digit_of(text_[at_]) : -1;
            if (digit < 0) return wrong("an escape is cut off");
            code = code * 16 + static_cast<unsigned>(digit);
        }
        if (code < 0x80) {
            out += static_cast<char>(code);
        } else if (code < 0x800) {
            out += static_cast<char>(0xC0 | (code >> 6));
            out += static_cast<char>(0x80 | (code & 0x3F));
        } else {
            out += static_cast<char>(0xE0 | (code >> 12));
            out += static_cast<char>(0x80 | ((code >> 6) & 0x3F));
            out += static_cast<char>(0x80 | (code & 0x3F));
        }
        return {};
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

}  // namespace

std::uint32_t cryptomatte_id(std::string_view name) {
    constexpr std::uint32_t c1 = 0xcc9e2d51, c2 = 0x1b873593;
    std::uint32_t h = 0;
    const auto mix = [&](std::uint32_t k) { return std::rotl(k * c1, 15) * c2; };
    const std::size_t blocks = name.size() / 4;
    for (std::size_t i = 0; i < blocks; ++i) {
        std::uint32_t k = 0;
        std::memcpy(&k, name.data() + 4 * i, 4);
        h = std::rotl(h ^ mix(k), 13) * 5 + 0xe6546b64;
    }
    std::uint32_t tail = 0;
    for (std::size_t i = name.size(); i > 4 * blocks; --i)
        tail = (tail << 8) | static_cast<unsigned char>(name[i - 1]);
    h ^= mix(tail);
    h ^= static_cast<std::uint32_t>(name.size());
    h = (h ^ (h >> 16)) * 0x85ebca6b;
    h = (h ^ (h >> 13)) * 0xc2b2ae35;
    h ^= h >> 16;
    const std::uint32_t exponent = (h >> 23) & 255;
    return exponent == 0 || exponent == 255 ? h ^ (1u << 23) : h;
}

Expected<std::map<std::string, std::uint32_t>> parse_cryptomatte_manifest(std::string_view text) {
    return ManifestReader(text).read();
}

}  // namespace weft
