#pragma once
// What a whole shot costs: this program, another one beside it, and the floor of any such tool.

#include <string>

#include "app/cli/answer.h"

namespace weft {

struct ShotBenchOptions {
    std::string plate, matte;  ///< Patterns of files; the matte has every frame.
    int matte_value = -1;      ///< Of an id matte; below 0: a coverage.
    std::string texture;
    std::string against;  ///< Another weft, timed in turns with this one; empty: none.
    int runs = 3;
    int threads = 0;
};

/// Renders the shot in draft and final: with nothing cached, and once more with its analysis cached
/// and another texture. Each run is a process of its own, from its start to the last frame on disk;
/// the programs take turns. Also a chain of DIS and one lookup (bench/baselines/dis_chain.h), in
/// this process. Errors: those of the runs, with what they printed.
[[nodiscard]] CommandResult bench_shot(const ShotBenchOptions& options);

}  // namespace weft
