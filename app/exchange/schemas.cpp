#include "app/exchange/schemas.h"

#include <nlohmann/json.hpp>
#include <span>

#include "app/exchange/motion_schema.h"
#include "app/project/codec/project_json.h"
#include "app/project/parameters.h"

namespace weft {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson any_of_type(const char* type) {
    return {{"type", type}};
}

OrderedJson numbers(const ParameterInfo& info, std::size_t count) {
    OrderedJson item{{"type", "number"}, {"minimum", info.min}, {"maximum", info.max}};
    OrderedJson out{{"type", "array"}, {"items", std::move(item)}};
    if (count > 0) out["minItems"] = out["maxItems"] = count;
    return out;
}

OrderedJson point() {
    return {{"type", "array"}, {"items", any_of_type("number")}, {"minItems", 2}, {"maxItems", 2}};
}

// Keys over time whose values follow this schema.
OrderedJson keys(OrderedJson value) {
    return {{"type", "array"},
            {"items",
             {{"type", "object"},
              {"required", {"frame", "value"}},
              {"properties",
               {{"frame", any_of_type("integer")},
                {"value", std::move(value)},
                {"interpolation", {{"enum", {"linear", "smooth", "hold"}}}}}}}}};
}

OrderedJson guides(const ParameterInfo& info) {
    return {{"type", "array"},
            {"maxItems", static_cast<std::int64_t>(info.max)},
            {"items",
             {{"type", "object"},
              {"required", {"kind", "numbers"}},
              {"properties",
               {{"kind", {{"enum", info.choices}}},
                {"numbers", {{"type", "array"}, {"items", any_of_type("number")}}}}}}}};
}

OrderedJson lamps() {
    return {{"type", "array"},
            {"items",
             {{"type", "object"},
              {"required", {"kind", "keys"}},
              {"properties",
               {{"kind", {{"enum", {"point", "directional", "gradient"}}}},
                {"keys", keys({{"type", "array"}, {"items", any_of_type("number")}})}}}}}};
}

OrderedJson grid_warp() {
    OrderedJson control{{"type", "object"}, {"required", OrderedJson::array({"at"})}};
    for (const char* key : {"at", "left", "right", "up", "down"})
        control["properties"][key] = point();
    const OrderedJson points{{"type", "array"}, {"items", control}};
    const OrderedJson patches{
        {"type", "integer"}, {"minimum", 1}, {"maximum", GridWarp::kMostPatches}};
    return {
        {"type", "object"},
        {"required", {"columns", "rows", "corners"}},
        {"properties",
         {{"columns", patches},
          {"rows", patches},
          {"corners", {{"type", "array"}, {"items", point()}, {"minItems", 4}, {"maxItems", 4}}},
          {"falloff_px", {{"type", "number"}, {"minimum", 0}, {"maximum", GridWarp::kMostPx}}},
          {"points", points},
          {"keys",
           {{"type", "array"},
            {"items",
             {{"type", "object"},
              {"required", {"frame", "points"}},
              {"properties", {{"frame", any_of_type("integer")}, {"points", points}}}}}}}}}};
}

OrderedJson schema_of(const ParameterInfo& info) {
    OrderedJson out;
    switch (info.kind) {
        case ParameterKind::kFlag:
            out = any_of_type("boolean");
            break;
        case ParameterKind::kInteger:
        case ParameterKind::kNumber:
            out = any_of_type(info.kind == ParameterKind::kInteger ? "integer" : "number");
            out["minimum"] = info.min;
            out["maximum"] = info.max;
            break;
        case ParameterKind::kChoice:
            out["enum"] = info.choices;
            break;
        case ParameterKind::kText:
        case ParameterKind::kPath:
            out = any_of_type("string");
            break;
        case ParameterKind::kPoint:
            out = numbers(info, 2);
            break;
        case ParameterKind::kRgb:
            out = numbers(info, 3);
            break;
        case ParameterKind::kPaths:
            out = {{"type", "array"}, {"items", any_of_type("string")}};
            break;
        case ParameterKind::kCorners:
            out = numbers(info, 8);
            break;
        case ParameterKind::kFrames:
            out = {{"type", "array"}, {"items", any_of_type("integer")}};
            break;
        case ParameterKind::kNames:
            out = {{"type", "array"}, {"items", {{"enum", info.choices}}}};
            break;
        case ParameterKind::kKeys:
            out =
                keys(info.components == 1 ? any_of_type("number") : numbers(info, info.components));
            break;
        case ParameterKind::kLamps:
            out = lamps();
            break;
        case ParameterKind::kGuides:
            out = guides(info);
            break;
        case ParameterKind::kWarp:
            out = grid_warp();
            break;
    }
    out["description"] =
        std::string(info.help) + (info.unit.empty() ? "" : " (" + std::string(info.unit) + ")");
    return out;
}

// The groups of a table become objects; keys without a group are added to `object`.
template <class Owner>
void add_table(OrderedJson& object, std::span<const Parameter<Owner>> table) {
    for (const Parameter<Owner>& parameter : table) {
        OrderedJson* into = &object["properties"];
        if (!parameter.group.empty()) {
            OrderedJson& group = (*into)[std::string(parameter.group)];
            group["type"] = "object";
            into = &group["properties"];
        }
        (*into)[std::string(parameter.key)] = schema_of(parameter);
    }
}

OrderedJson keyed_shape() {
    const OrderedJson row{
        {"type", "array"}, {"items", any_of_type("number")}, {"minItems", 7}, {"maxItems", 7}};
    const OrderedJson key{
        {"type", "object"},
        {"properties",
         {{"frame", any_of_type("integer")}, {"points", {{"type", "array"}, {"items", row}}}}},
        {"required", {"frame", "points"}}};
    return {{"type", "object"},
            {"properties",
             {{"follow", {{"enum", {"none", "position", "position_rotation_scale", "planar"}}}},
              {"track", any_of_type("string")},
              {"keys", {{"type", "array"}, {"items", key}, {"minItems", 1}}}}},
            {"required", {"keys"}}};
}

OrderedJson region_schema() {
    OrderedJson region{{"type", "object"}, {"properties", OrderedJson::object()}};
    region["properties"]["id"] = {{"type", "integer"}, {"minimum", 1}};
    add_table(region, region_parameters());
    OrderedJson matte = region["properties"]["matte"];
    matte["properties"]["keyframes"] = {
        {"type", "array"},
        {"items",
         {{"type", "object"},
          {"properties", {{"frame", any_of_type("integer")}, {"path", any_of_type("string")}}},
          {"required", {"frame", "path"}}}}};
    matte["properties"]["confirmed"] = {{"type", "array"},
                                        {"items",
                                         {{"type", "object"},
                                          {"properties",
                                           {{"frame", {{"type", "integer"}}},
                                            {"path", {{"type", "string"}}},
                                            {"area", {{"type", "string"}}}}},
                                          {"required", {"frame", "path", "area"}}}}};
    matte["properties"]["shape"] = keyed_shape();
    region["properties"]["matte"] = matte;
    region["properties"]["holdouts"] = {{"type", "array"}, {"items", matte}};
    OrderedJson zone{{"type", "object"}, {"properties", OrderedJson::object()}};
    add_table(zone, zone_parameters());
    zone["properties"]["matte"] = matte;
    region["properties"]["zones"] = {{"type", "array"}, {"items", zone}};
    const OrderedJson pin{{"type", "object"},
                          {"properties", {{"from", point()}, {"to", point()}}},
                          {"required", {"from", "to"}}};
    region["properties"]["corrections"] = {
        {"type", "array"},
        {"items",
         {{"type", "object"},
          {"properties",
           {{"frame", any_of_type("integer")}, {"pins", {{"type", "array"}, {"items", pin}}}}}}}};
    const OrderedJson run{
        {"type", "array"}, {"items", any_of_type("integer")}, {"minItems", 5}, {"maxItems", 7}};
    region["properties"]["amendments"] = {{"type", "array"},
                                          {"items",
                                           {{"type", "object"},
                                            {"properties",
                                             {{"kind", {{"enum", {"keep", "again"}}}},
                                              {"seed", any_of_type("integer")},
                                              {"runs", {{"type", "array"}, {"items", run}}}}},
                                            {"required", {"kind", "runs"}}}}};
    return region;
}

OrderedJson headed(const char* title, OrderedJson body) {
    OrderedJson out{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
    out.update(body);
    return out;
}

OrderedJson project_schema() {
    OrderedJson project{
        {"type", "object"}, {"required", {"schema"}}, {"properties", OrderedJson::object()}};
    project["properties"]["schema"] = {
        {"const", std::string(kProjectSchemaName) + "/" + std::to_string(kProjectSchemaVersion)}};
    add_table(project, project_parameters());
    project["properties"]["next_region_id"] = {{"type", "integer"}, {"minimum", 1}};
    project["properties"]["regions"] = {{"type", "array"}, {"items", region_schema()}};
    return headed("A Weft project", std::move(project));
}

OrderedJson actions_schema() {
    const OrderedJson region{{"type", {"integer", "string"}}},
        text = any_of_type("string"), number = any_of_type("integer"),
        object = any_of_type("object"), list = any_of_type("array"), any = OrderedJson::object();
    const std::vector<std::pair<const char*, OrderedJson>> kActions{
        {"set_plate", {{"plate", object}}},
        {"set_output", {{"output", object}}},
        {"set_project_parameter", {{"key", text}, {"value", any}}},
        {"add_region", {{"region", object}, {"index", number}}},
        {"remove_region", {{"region", region}}},
        {"move_region", {{"region", region}, {"index", number}}},
        {"rename_region", {{"region", region}, {"name", text}}},
        {"set_region_parameter", {{"region", region}, {"key", text}, {"value", any}}},
        {"set_matte", {{"region", region}, {"matte", object}}},
        {"set_matte_keyframe", {{"region", region}, {"frame", number}, {"path", text}}},
        {"remove_matte_keyframe", {{"region", region}, {"frame", number}}},
        {"set_holdouts", {{"region", region}, {"holdouts", list}}},
        {"set_zones", {{"region", region}, {"zones", list}}},
        {"set_texture", {{"region", region}, {"texture", object}}},
        {"set_correction", {{"region", region}, {"frame", number}, {"pins", list}}},
        {"set_amendments", {{"region", region}, {"amendments", list}}}};
    OrderedJson kinds = OrderedJson::array();
    for (const auto& [name, keys] : kActions) {
        OrderedJson properties{{"action", {{"const", name}}}};
        OrderedJson required = OrderedJson::array({"action"});
        for (const auto& [key, value] : keys.items()) {
            properties[key] = value;
            if (key != "index" || std::string_view(name) != "add_region") required.push_back(key);
        }
        kinds.push_back({{"type", "object"},
                         {"properties", properties},
                         {"required", required},
                         {"additionalProperties", false}});
    }
    const OrderedJson actions{{"type", "array"}, {"items", {{"oneOf", kinds}}}};
    const OrderedJson whole{
        {"type", "object"},
        {"properties", {{"schema", {{"const", "weft.actions/1"}}}, {"actions", actions}}},
        {"required", {"actions"}}};
    return headed("Actions on a Weft project", {{"oneOf", {actions, whole}}});
}

// An entry of the report's forms.
OrderedJson form_schema() {
    const OrderedJson number = any_of_type("number"), text = any_of_type("string");
    return {{"type", "object"},
            {"properties",
             {{"region", text},
              {"reference_frame", any_of_type("integer")},
              {"source", {{"enum", {"pass", "motion", "lines", "shape", "outline", "flat"}}}},
              {"text", text},
              {"amount", number},
              {"amount_keyed", any_of_type("boolean")},
              {"reason", text},
              {"plane", any_of_type("boolean")},
              {"drawn", text},
              {"frames", any_of_type("integer")},
              {"tilt_deg", number},
              {"tilt_error_deg", number},
              {"fov_deg", number},
              {"fov_error_deg", number},
              {"fov_regions", any_of_type("integer")},
              {"belief", number}}},
            {"required", {"region", "reference_frame", "source", "text", "amount"}}};
}

OrderedJson report_schema() {
    const OrderedJson text = any_of_type("string"), number = any_of_type("number"),
                      texts{{"type", "array"}, {"items", any_of_type("string")}};
    const OrderedJson frame{{"type", "object"},
                            {"properties",
                             {{"frame", any_of_type("integer")},
                              {"path", text},
                              {"seconds", number},
                              {"skipped", any_of_type("boolean")},
                              {"rolled_off_px", any_of_type("integer")},
                              {"nonfinite_px", any_of_type("integer")},
                              {"filled_px", any_of_type("integer")}}},
                            {"required", {"frame", "path", "seconds"}}};
    const OrderedJson texture{{"type", "object"},
                              {"properties",
                               {{"region", text},
                                {"path", text},
                                {"id", text},
                                {"kind", text},
                                {"author", text},
                                {"licence", text}}},
                              {"required", {"path", "id"}}};
    const OrderedJson light{{"type", "object"},
                            {"properties",
                             {{"region", text},
                              {"unsure", number},
                              {"worst", number},
                              {"worst_frame", any_of_type("integer")}}},
                            {"required", {"region", "unsure", "worst", "worst_frame"}}};
    const OrderedJson body{
        {"type", "object"},
        {"properties",
         {{"schema", {{"const", "weft.report/1"}}},
          {"version", text},
          {"backend", {{"type", "object"}, {"properties", {{"name", text}, {"device", text}}}}},
          {"threads", any_of_type("integer")},
          {"size", point()},
          {"spaces", any_of_type("object")},
          {"forms", {{"type", "array"}, {"items", form_schema()}}},
          {"lights", {{"type", "array"}, {"items", light}}},
          {"frames", {{"type", "array"}, {"items", frame}}},
          {"fps", number},
          {"seconds_per_stage", any_of_type("object")},
          {"peak_rss_bytes", any_of_type("integer")},
          {"textures", {{"type", "array"}, {"items", texture}}},
          {"settings", any_of_type("object")},
          {"movie", text},
          {"warnings", texts},
          {"changed_inputs", texts}}},
        {"required", {"version", "backend", "frames", "textures", "settings", "warnings"}}};
    return headed("The report of a Weft render", body);
}

OrderedJson error_schema() {
    const OrderedJson text = any_of_type("string"), code = {{"type", "integer"}, {"minimum", 1}};
    const OrderedJson error{
        {"type", "object"},
        {"properties",
         {{"code", code},
          {"name",
           {{"enum",
             {"render_failed", "usage", "unreadable", "missing_frames", "no_backend", "no_space",
              "refused", "differs", "interrupted", "terminated"}}}},
          {"message", text},
          {"field", text},
          {"remedy", text}}},
        {"required", {"code", "name", "message"}}};
    const OrderedJson body{
        {"type", "object"},
        {"properties",
         {{"schema", {{"const", "weft.error/1"}}}, {"error", error}, {"exit_code", code}}},
        {"required", {"schema", "error", "exit_code"}}};
    return headed("What a failed weft command prints with --json", body);
}

}  // namespace

Expected<std::string> json_schema(const std::string& name) {
    if (name == "project") return project_schema().dump(2) + "\n";
    if (name == "actions") return actions_schema().dump(2) + "\n";
    if (name == "report") return report_schema().dump(2) + "\n";
    if (name == "error") return error_schema().dump(2) + "\n";
    if (name == "motion") return motion_schema_text();
    return fail(ErrorCode::kUsage, "Unknown schema '" + name + "'.",
                "The schemas are project, actions, report, motion and error.");
}

}  // namespace weft
