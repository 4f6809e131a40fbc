#include "app/project/codec/project_json.h"

#include "app/project/codec/json_codec.h"

namespace weft {

Expected<Project> project_from_json(std::string_view text) {
    WEFT_TRY(document, json_codec::parse(text));
    WEFT_CHECK_OK(json_codec::upgrade_to_current(document));
    return json_codec::read_project(document);
}

Expected<std::string> project_to_json(const Project& project) {
    return json_codec::to_text(json_codec::write_project(project));
}

}  // namespace weft
