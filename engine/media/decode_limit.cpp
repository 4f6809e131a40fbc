#include "engine/media/decode_limit.h"

#include <unistd.h>

#include <atomic>

namespace weft {
namespace {

std::atomic<std::int64_t> limit_bytes{0};

}  // namespace

std::int64_t decode_limit_bytes() {
    if (const std::int64_t set = limit_bytes.load(); set > 0) return set;
    constexpr int kCopies = 4;
    return static_cast<std::int64_t>(sysconf(_SC_PHYS_PAGES)) * sysconf(_SC_PAGESIZE) / kCopies;
}

void set_decode_limit_bytes(std::int64_t bytes) {
    limit_bytes = bytes;
}

}  // namespace weft
