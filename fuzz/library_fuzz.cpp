// The texture database: a file that may be no database, or a damaged one.
#include "fuzz/fuzz_file.h"
#include "texture_db/library/library.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, unsigned long size) {
    const std::string path = weft::fuzz::put_file(data, size, ".weftdb");
    const auto library = weft::TextureLibrary::open(path);
    if (library) {
        static_cast<void>((*library)->size());
        static_cast<void>((*library)->search({}));
        static_cast<void>((*library)->stats());
    }
    std::remove((path + "-wal").c_str());
    std::remove((path + "-shm").c_str());
    std::remove((path + "-journal").c_str());
    return 0;
}
