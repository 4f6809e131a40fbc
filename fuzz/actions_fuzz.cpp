// Action files, applied to a small project.
#include "app/project/codec/edit_json.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, unsigned long size) {
    const auto edits = weft::edits_from_json(
        {reinterpret_cast<const char*>(data), static_cast<std::size_t>(size)});
    if (!edits) return 0;
    weft::Project project;
    weft::Region wall;
    wall.id = 1;
    wall.name = "wall";
    project.regions.emplace_back(wall);
    project.next_region_id = 2;
    static_cast<void>(weft::apply_edits(project, *edits));
    static_cast<void>(weft::edits_to_json(*edits));
    return 0;
}
