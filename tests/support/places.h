#pragma once
// Where the tests find what they do not make. One library holds the paths, so that no other object
// file depends on where the checkout is: a compiler cache then serves every clone.

#include <string>

namespace weft::test {

/// The root of the source tree.
[[nodiscard]] std::string source_folder();
/// Clips and photographs that some tests measure on. Those tests skip if it is missing.
[[nodiscard]] std::string shared_data_folder();
/// The program that this build made.
[[nodiscard]] std::string weft_program();
/// The copyright file of the package.
[[nodiscard]] std::string copyright_file();
/// A library for LD_PRELOAD that fails calls on files (tests/cli/fault_shim.cpp).
[[nodiscard]] std::string fault_shim();
/// A library for LD_PRELOAD that makes of the program a server of its starts
/// (tests/cli/start_server.cpp).
[[nodiscard]] std::string start_server();

}  // namespace weft::test
