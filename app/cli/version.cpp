#include "app/cli/commands.h"
#include "app/render/report.h"
#include "gpu/cuda_backend.h"

namespace weft {

Answer version_answer() {
    const std::string commit = WEFT_COMMIT;
    std::vector<std::string> backends{"cpu"};
    if (choose_backend("cuda")) backends.emplace_back("cuda");
    std::string text = std::string("weft ") + kVersion;
    if (!commit.empty()) text += " (commit " + commit + ")";
    text += ", backends: " + backends.front();
    for (std::size_t i = 1; i < backends.size(); ++i)
        text += ", " + backends[i];
    return {{{"version", kVersion}, {"commit", commit}, {"backends", backends}}, text + "\n"};
}

}  // namespace weft
