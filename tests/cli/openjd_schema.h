#pragma once
// The rules of Open Job Description's job template schema, revision 2023-09, for what Weft's
// templates use (github.com/OpenJobDescription/openjd-specifications, "2023-09 Template Schemas").

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace weft::test {

/// The violations of the schema, each as "where: what"; empty if there are none.
std::vector<std::string> openjd_violations(const nlohmann::json& job);

}  // namespace weft::test
