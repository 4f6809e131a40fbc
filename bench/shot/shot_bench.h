#pragma once
// What a whole shot costs: a program, another one beside it, and the floor of any such tool.

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "engine/core/error.h"

namespace weft {

struct ShotBenchOptions {
    std::string program;       ///< The weft that is timed.
    std::string plate, matte;  ///< Patterns of files; the matte has every frame.
    int matte_value = -1;      ///< Of an id matte; below 0: a coverage.
    std::string texture;
    std::string against;  ///< Another weft, timed in turns with the program; empty: none.
    int runs = 3;
    int threads = 0;  ///< 0: one for each processor.
};

/// Called with each case as soon as it is known; its figures are those of the result.
using ShotBenchCase =
    std::function<void(const std::string& name, const nlohmann::ordered_json& figures)>;

/// Renders the shot in draft and final: with nothing cached, and once more with its analysis cached
/// and another seed. Each run is a process of its own, from its start to the last frame on disk;
/// the programs take turns. Also a chain of DIS and one lookup (bench/baselines/dis_chain.h), in
/// this process. Returns one object for each case (docs/CLI.md, "weft bench"). Errors: those of the
/// runs. Not thread-safe: it reads the CPU time of all child processes.
[[nodiscard]] Expected<nlohmann::ordered_json> bench_shot(const ShotBenchOptions& options,
                                                          const ShotBenchCase& each);

}  // namespace weft
