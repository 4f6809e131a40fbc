#include "app/exchange/motion_schema.h"

#include <nlohmann/json.hpp>

namespace weft {
namespace {

using SchemaJson = nlohmann::ordered_json;

SchemaJson of_type(const char* type, const char* description) {
    return {{"type", type}, {"description", description}};
}

SchemaJson names_of_conventions(std::initializer_list<const char*> names) {
    SchemaJson out{{"enum", SchemaJson::array()}};
    for (const char* name : names)
        out["enum"].push_back(name);
    return out;
}

SchemaJson corner_pin_schema() {
    return {
        {"type", "object"},
        {"properties",
         {{"nuke", of_type("string", "A CornerPin2D node")},
          {"after_effects", of_type("string", "Keyframe data of the effect Corner Pin")},
          {"blender", of_type("string", "A Python script")},
          {"weft", of_type("string", "weft.track/1")},
          {"corners_px",
           {{"type", "array"},
            {"items", {{"type", "number"}}},
            {"minItems", 8},
            {"maxItems", 8},
            {"description",
             "x and y on the reference frame: top left, top right, bottom right, bottom left, "
             "y downwards"}}},
          {"on_form", of_type("boolean",
                              "The corners are a rectangle on the plane that the form is, not "
                              "in the picture")},
          {"off_plane_px",
           {{"type", "object"},
            {"description", "How far the surface is off a plane's motion, over all frames"},
            {"properties", {{"median", {{"type", "number"}}}, {"p90", {{"type", "number"}}}}}}}}}};
}

SchemaJson roto_schema() {
    return {{"type", "object"},
            {"properties",
             {{"nuke", of_type("string", "A Python script that builds Roto nodes")},
              {"blender", of_type("string", "A Python script that adds a mask")},
              {"mlt", of_type("string", "Properties of MLT's filter rotoscoping")},
              {"shapes",
               {{"type", "array"},
                {"items",
                 {{"type", "object"},
                  {"properties",
                   {{"name", {{"type", "string"}}},
                    {"hole", of_type("boolean", "It is taken off of what is around it")},
                    {"first", of_type("integer", "The first frame on which it is seen")},
                    {"last", {{"type", "integer"}}},
                    {"points", {{"type", "integer"}}}}}}}}},
              {"off_matte_px",
               {{"type", "object"},
                {"description", "How far the matte's outlines are from the shapes, on average"},
                {"properties",
                 {{"mean", {{"type", "number"}}}, {"worst_frame", {{"type", "number"}}}}}}}}}};
}

SchemaJson mesh_schema() {
    return {{"type", "object"},
            {"properties",
             {{"obj", of_type("string", "The mesh on the reference frame, with UVs")},
              {"pc2", of_type("string", "A point cache with a sample for each frame")},
              {"usd", of_type("string", "The same as USD, as text")},
              {"corners", {{"type", "integer"}}},
              {"faces", {{"type", "integer"}}},
              {"depth", of_type("boolean", "z is known; it is 0 otherwise")}}}};
}

SchemaJson motion_region_schema() {
    const SchemaJson maps{
        {"type", "object"},
        {"properties",
         {{"convention", names_of_conventions({"nuke", "fusion", "blender"})},
          {"match_move", of_type("string", "Pattern of the maps by pixels of the frames")},
          {"stabilize",
           of_type("string", "Pattern of the maps by pixels of the reference frame")}}}};
    const SchemaJson vectors{
        {"type", "array"},
        {"items",
         {{"type", "object"},
          {"properties",
           {{"convention", names_of_conventions({"nuke", "blender", "moonray", "flame", "arnold"})},
            {"path", of_type("string", "Pattern")}}}}}};
    return {{"type", "object"},
            {"required", {"name", "folder", "reference_frame"}},
            {"properties",
             {{"name", {{"type", "string"}}},
              {"folder", {{"type", "string"}}},
              {"reference_frame", {{"type", "integer"}}},
              {"st_maps", maps},
              {"vectors", vectors},
              {"corner_pin", corner_pin_schema()},
              {"roto", roto_schema()},
              {"mesh", mesh_schema()}}}};
}

}  // namespace

std::string motion_schema_text() {
    SchemaJson out{
        {"$schema", "https://json-schema.org/draft/2020-12/schema"},
        {"title", "Weft motion export"},
        {"type", "object"},
        {"required", {"schema", "complete", "frames", "size", "fps", "regions"}},
        {"properties",
         {{"schema", {{"const", "weft.motion/1"}}},
          {"complete", of_type("boolean",
                               "All files are there; false while they are written, and "
                               "after an error")},
          {"frames", of_type("string", "Frame list")},
          {"frame_count", {{"type", "integer"}}},
          {"size",
           {{"type", "array"}, {"items", {{"type", "integer"}}}, {"minItems", 2}, {"maxItems", 2}}},
          {"fps", {{"type", "number"}}},
          {"regions", {{"type", "array"}, {"items", motion_region_schema()}}},
          {"path", of_type("string",
                           "The folder; in the answer of 'weft motion' only, as are the "
                           "keys below")},
          {"pictures_written", {{"type", "integer"}}},
          {"pictures_kept", of_type("integer", "Kept of an earlier run")},
          {"warnings", {{"type", "array"}, {"items", {{"type", "string"}}}}},
          {"exit_code", {{"type", "integer"}}}}}};
    return out.dump(2) + "\n";
}

}  // namespace weft
