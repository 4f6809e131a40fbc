#include "tests/architecture/product_sources.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/support/places.h"

namespace weft::architecture {

std::vector<SourceFile> sources_below(const std::vector<std::string>& folders) {
    namespace fs = std::filesystem;
    static const std::vector<std::string> kKinds{".h", ".hpp", ".cuh", ".cpp", ".cc", ".cu"};
    const fs::path root = test::source_folder();
    std::vector<SourceFile> out;
    for (const std::string& folder : folders) {
        if (!fs::exists(root / folder)) continue;
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            const std::string kind = entry.path().extension().string();
            if (!entry.is_regular_file() ||
                std::find(kKinds.begin(), kKinds.end(), kind) == kKinds.end())
                continue;
            std::ifstream file(entry.path(), std::ios::binary);
            out.push_back({entry.path().lexically_relative(root).generic_string(),
                           std::string(std::istreambuf_iterator<char>(file), {})});
        }
    }
    std::sort(out.begin(), out.end(),
              [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
    return out;
}

std::vector<SourceFile> product_sources() {
    return sources_below({"app", "bench", "engine", "gpu", "texture_db", "ui"});
}

}  // namespace weft::architecture
