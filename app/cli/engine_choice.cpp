#include "app/cli/engine_choice.h"

#include "engine/core/isa.h"
#include "engine/core/parallel.h"

namespace weft {

Expected<BackendChoice> choose_engine(int threads, const std::string& isa,
                                      const std::string& backend) {
    set_thread_count(threads);
    const auto instructions = parse_isa(isa);
    if (instructions && !isa_available(*instructions))
        return fail(ErrorCode::kNoBackend, "This processor lacks " + isa + ".", "Leave --isa out.");
    force_isa(instructions);
    return choose_backend(backend);
}

}  // namespace weft
