// Project files: what is read must be written and read again as the same.
#include <cstdlib>

#include "app/project/codec/project_json.h"
#include "app/project/validate.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, unsigned long size) {
    const auto project = weft::project_from_json(
        {reinterpret_cast<const char*>(data), static_cast<std::size_t>(size)});
    if (!project) return 0;
    static_cast<void>(weft::validate(*project));
    const auto text = weft::project_to_json(*project);
    if (!text) return 0;
    const auto again = weft::project_from_json(*text);
    if (!again || weft::project_to_json(*again).value() != *text) std::abort();
    return 0;
}
