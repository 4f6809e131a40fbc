#include "tests/support/places.h"

namespace weft::test {

std::string source_folder() {
    return WEFT_SOURCE_DIR;
}

std::string shared_data_folder() {
    return WEFT_SHARED_DATA_DIR;
}

std::string weft_program() {
    return WEFT_PROGRAM;
}

std::string copyright_file() {
    return WEFT_COPYRIGHT_FILE;
}

std::string fault_shim() {
    return WEFT_FAULT_SHIM;
}

std::string start_server() {
    return WEFT_START_SERVER;
}

}  // namespace weft::test
