#pragma once
// The product's source files, for tests that check them.

#include <string>
#include <vector>

namespace weft::architecture {

struct SourceFile {
    std::string path;  ///< From the root.
    std::string contents;
};

/// C++ and CUDA below app, bench, engine, gpu, texture_db and ui; by path.
[[nodiscard]] std::vector<SourceFile> product_sources();
/// The same below other folders.
[[nodiscard]] std::vector<SourceFile> sources_below(const std::vector<std::string>& folders);

}  // namespace weft::architecture
