#pragma once
// What the published schema of Open Job Description's job templates, revision 2023-09, says of what
// Weft's templates may hold (github.com/OpenJobDescription/openjd-specifications, "2023-09 Template
// Schemas").

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace weft::test {

/// What the template does against the schema, each as "where: what"; empty where it keeps to it.
std::vector<std::string> openjd_violations(const nlohmann::json& job);

}  // namespace weft::test
