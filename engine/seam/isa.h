#pragma once
// Which instruction set the inner loops use. All give the same integers.

#include <optional>
#include <string_view>

namespace weft {

/// Scalar is what every x86-64 (and any other) processor runs; AVX-512 stands for F, BW, VL and
/// VNNI together.
enum class Isa { kScalar, kAvx2, kAvx512 };

/// Whether this processor has it.
[[nodiscard]] bool isa_available(Isa isa);

/// What the inner loops use: the one set by force_isa(), else the one that the environment variable
/// WEFT_ISA names (scalar, avx2 or avx512), else the best there is. What this processor lacks is
/// never chosen. Thread-safe.
[[nodiscard]] Isa current_isa();

/// For tests and comparisons; nothing gives the choice back. Not to be called while work runs.
void force_isa(std::optional<Isa> isa);

[[nodiscard]] std::optional<Isa> parse_isa(std::string_view name);
[[nodiscard]] std::string_view isa_name(Isa isa);

}  // namespace weft
