#pragma once
#include <cstddef>
#include <optional>
#include <string>

namespace weft {

/// Why `frames` frames cannot be written to `output`, a pattern such as `out/####.png`, in a
/// sentence or two; nothing if its form is right. Looks at no disk. Thread-safe.
[[nodiscard]] std::optional<std::string> output_problem(const std::string& output,
                                                        std::size_t frames);

}  // namespace weft
