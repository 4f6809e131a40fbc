#include "app/cli/commands.h"
#include "app/session/report.h"
#include "gpu/cuda_backend.h"

namespace weft {

std::string version_text() {
    const std::string commit = WEFT_COMMIT;
    std::string backends = "cpu";
    if (choose_backend("cuda")) backends += ", cuda";
    return std::string("weft ") + kVersion + (commit.empty() ? "" : " (commit " + commit + ")") +
           ", backends: " + backends;
}

}  // namespace weft
