#include "app/cli/engine_choice.h"

#include <cstdio>

#include "app/cli/console.h"
#include "engine/core/parallel.h"
#include "engine/seam/isa.h"

namespace weft {

Expected<BackendChoice> choose_engine(int threads, const std::string& isa,
                                      const std::string& backend) {
    set_thread_count(threads);
    const auto instructions = parse_isa(isa);
    if (instructions && !isa_available(*instructions))
        return fail(ErrorCode::kNoBackend, "This processor lacks " + isa + ". Leave --isa out.");
    force_isa(instructions);
    WEFT_TRY(chosen, choose_backend(backend));
    for (const std::string& line : chosen.passed_over)
        print(stderr, "weft: passed over " + line + "\n");
    return chosen;
}

}  // namespace weft
