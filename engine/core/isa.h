#pragma once
// The instruction set of the inner loops. All sets give the same integers.

#include <optional>
#include <string_view>

namespace weft {

/// Every x86-64 processor runs kScalar. kAvx512 needs F, BW, VL and VNNI.
enum class Isa { kScalar, kAvx2, kAvx512 };

/// Returns true if this processor has it.
[[nodiscard]] bool isa_available(Isa isa);

/// The set in use: the one from force_isa(), else the one that the environment variable WEFT_ISA
/// names (scalar, avx2 or avx512), else the best. A set that this processor lacks is never used.
/// Thread-safe.
[[nodiscard]] Isa current_isa();

/// For tests and comparisons. No value restores the default. Not to be called while work runs.
void force_isa(std::optional<Isa> isa);

[[nodiscard]] std::optional<Isa> parse_isa(std::string_view name);
[[nodiscard]] std::string_view isa_name(Isa isa);

}  // namespace weft
