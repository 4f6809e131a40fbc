// Motion files: .flo and KITTI PNG.
#include "engine/media/image_files.h"
#include "fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, unsigned long size) {
    if (size < 1) return 0;
    const std::string path =
        weft::fuzz::put_file(data + 1, size - 1, data[0] % 4 != 0 ? ".flo" : ".png");
    static_cast<void>(weft::read_flow(path, {}));
    return 0;
}
