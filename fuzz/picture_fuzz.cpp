// Pictures by their bytes, EXR and PNG: the first byte chooses which.
#include "engine/media/cryptomatte.h"
#include "engine/media/decode_limit.h"
#include "engine/media/frame_reader.h"
#include "engine/media/image_files.h"
#include "engine/media/metadata.h"
#include "fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, unsigned long size) {
    if (size < 2) return 0;
    // What a header may claim: a run must not be killed for memory that a user's machine has.
    constexpr std::int64_t kMost_bytes = 64 << 20;
    weft::set_decode_limit_bytes(kMost_bytes);
    static const char* const kExtensions[] = {".exr", ".png"};
    const std::string path = weft::fuzz::put_file(data + 1, size - 1, kExtensions[data[0] % 2]);
    static_cast<void>(weft::read_image(path));
    weft::MatteSelect ids;
    ids.value = 3;
    static_cast<void>(weft::read_matte(path, ids, {}));
    static_cast<void>(weft::read_recipe_metadata(path));
    if (data[0] % 2 == 0) static_cast<void>(weft::list_cryptomatte(path));
    return 0;
}
