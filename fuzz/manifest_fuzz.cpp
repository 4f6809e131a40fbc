// Cryptomatte manifests and the hash of names.
#include "engine/media/cryptomatte.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, unsigned long size) {
    const std::string_view text(reinterpret_cast<const char*>(data),
                                static_cast<std::size_t>(size));
    static_cast<void>(weft::parse_cryptomatte_manifest(text));
    static_cast<void>(weft::cryptomatte_id(text));
    return 0;
}
