#pragma once
// The functions of a C++ source and how long they are, by counting braces.

#include <string>
#include <string_view>
#include <vector>

namespace weft::architecture {

struct FunctionLength {
    std::string name;  ///< As it stands before the parameters: "Session::act", "operator==".
    int line = 0;      ///< Where its declaration begins, from 1.
    int lines = 0;     ///< Up to its closing brace, both included.
};

/// The functions that are defined in `source` outside of other functions, in the order in which
/// they end. Comments, literals and preprocessor lines are skipped. A lambda counts for the
/// function around it; one that initialises a variable outside of any function counts by the
/// variable's name. Never throws; of text that is not C++ it finds nothing useful.
[[nodiscard]] std::vector<FunctionLength> function_lengths(std::string_view source);

}  // namespace weft::architecture
