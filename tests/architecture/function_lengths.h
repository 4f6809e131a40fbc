#pragma once
// Finds the functions of a C++ source and their lengths by counting braces.

#include <string>
#include <string_view>
#include <vector>

namespace weft::architecture {

struct FunctionLength {
    std::string name;  ///< Name before the parameters: "Session::act", "operator==".
    int line = 0;      ///< Line of its declaration, from 1.
    int lines = 0;     ///< Number of lines up to its closing brace, inclusive.
};

/// The functions defined in `source` outside other functions, in order of their ends. Comments,
/// literals and preprocessor lines are skipped. A lambda counts as part of its function; one that
/// initialises a global variable counts under the variable's name. Never throws; the result for
/// text that is not C++ is meaningless.
[[nodiscard]] std::vector<FunctionLength> function_lengths(std::string_view source);

}  // namespace weft::architecture
