#pragma once
#include <string>

#include "app/project/project.h"

namespace weft::test {

/// A project in which nothing has its default value.
Project full_project();

/// Its file, with keys that no version knows at every level.
std::string json_with_unknown_keys();

}  // namespace weft::test
