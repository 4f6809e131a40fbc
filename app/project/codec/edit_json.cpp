// A reader and a writer for each edit, found by its name.
#include "app/project/codec/edit_json.h"

#include <fmt/format.h>

#include <array>

#include "app/project/codec/json_codec.h"
#include "engine/core/frame_range.h"

namespace weft {
namespace {

using namespace json_codec;

constexpr std::int64_t kMaxIndex = 1'000'000;

// ---- fields shared by several edits -----------------------------------------------------------

Expected<RegionRef> read_region_ref(ObjectReader& object) {
    const Json* json = object.take("region");
    if (json && json->is_string()) return RegionRef{0, json->get<std::string>()};
    WEFT_TRY(id, object.integer("region", 1, UINT32_MAX - 1));
    return RegionRef{static_cast<RegionId>(id), {}};
}
OrderedJson write_region_ref(const RegionRef& ref) {
    return ref.id != 0 ? OrderedJson(ref.id) : OrderedJson(ref.name);
}

Expected<int> read_frame(ObjectReader& object) {
    WEFT_TRY(frame, object.integer("frame", -kMaxFrameNumber, kMaxFrameNumber));
    return static_cast<int>(frame);
}

/// Errors: Unreadable when the key is missing.
Expected<const Json*> required(ObjectReader& object, std::string_view key) {
    const Json* json = object.take(key);
    if (!json) return fail_at(object.path_of(key), "This key is missing", "add it");
    return json;
}

Expected<ParameterValue> read_parameter_value(ObjectReader& object) {
    WEFT_TRY(json, required(object, "value"));
    return read_value(*json, object.path_of("value"));
}

// ---- a reader and a writer for each edit
// ---------------------------------------------------------

Status read(ObjectReader& object, SetPlate& edit) {
    WEFT_TRY(json, required(object, "plate"));
    Project project;
    WEFT_CHECK_OK(read_group(*json, object.path_of("plate"), "plate", project));
    edit.plate = std::move(project.plate);
    return {};
}
void write(OrderedJson& object, const SetPlate& edit) {
    Project project;
    project.plate = edit.plate;
    object["plate"] = write_group("plate", project);
}

Status read(ObjectReader& object, SetOutput& edit) {
    WEFT_TRY(json, required(object, "output"));
    Project project;
    WEFT_CHECK_OK(read_group(*json, object.path_of("output"), "output", project));
    edit.output = std::move(project.output);
    return {};
}
void write(OrderedJson& object, const SetOutput& edit) {
    Project project;
    project.output = edit.output;
    object["output"] = write_group("output", project);
}

Status read(ObjectReader& object, SetProjectParameter& edit) {
    WEFT_TRY(key, object.text("key"));
    WEFT_TRY(value, read_parameter_value(object));
    edit = {std::move(key), std::move(value)};
    return {};
}
void write(OrderedJson& object, const SetProjectParameter& edit) {
    object["key"] = edit.key;
    object["value"] = write_value(ParameterInfo{}, edit.value);
}

Status read(ObjectReader& object, AddRegion& edit) {
    WEFT_TRY(json, required(object, "region"));
    WEFT_TRY(region, read_region(*json, object.path_of("region")));
    edit.region = std::move(region);
    if (object.take("index")) {
        WEFT_TRY(index, object.integer("index", 0, kMaxIndex));
        edit.index = static_cast<int>(index);
    }
    return {};
}
void write(OrderedJson& object, const AddRegion& edit) {
    object["region"] = write_region(edit.region);
    if (edit.index) object["index"] = *edit.index;
}

Status read(ObjectReader& object, RemoveRegion& edit) {
    WEFT_TRY(region, read_region_ref(object));
    edit.region = std::move(region);
    return {};
}
void write(OrderedJson& object, const RemoveRegion& edit) {
    object["region"] = write_region_ref(edit.region);
}

Status read(ObjectReader& object, MoveRegion& edit) {
    WEFT_TRY(region, read_region_ref(object));
    WEFT_TRY(index, object.integer("index", 0, kMaxIndex));
    edit = {std::move(region), static_cast<int>(index)};
    return {};
}
void write(OrderedJson& object, const MoveRegion& edit) {
    object["region"] = write_region_ref(edit.region);
    object["index"] = edit.index;
}

Status read(ObjectReader& object, RenameRegion& edit) {
    WEFT_TRY(region, read_region_ref(object));
    WEFT_TRY(name, object.text("name"));
    edit = {std::move(region), std::move(name)};
    return {};
}
void write(OrderedJson& object, const RenameRegion& edit) {
    object["region"] = write_region_ref(edit.region);
    object["name"] = edit.name;
}

Status read(ObjectReader& object, SetRegionParameter& edit) {
    WEFT_TRY(region, read_region_ref(object));
    WEFT_TRY(key, object.text("key"));
    WEFT_TRY(value, read_parameter_value(object));
    edit = {std::move(region), std::move(key), std::move(value)};
    return {};
}
void write(OrderedJson& object, const SetRegionParameter& edit) {
    object["region"] = write_region_ref(edit.region);
    object["key"] = edit.key;
    object["value"] = write_value(ParameterInfo{}, edit.value);
}

Status read(ObjectReader& object, SetMatte& edit) {
    WEFT_TRY(region, read_region_ref(object));
    WEFT_TRY(json, required(object, "matte"));
    WEFT_TRY(matte, read_matte_source(*json, object.path_of("matte")));
    edit = {std::move(region), std::move(matte)};
    return {};
}
void write(OrderedJson& object, const SetMatte& edit) {
    object["region"] = write_region_ref(edit.region);
    object["matte"] = write_matte_source(edit.matte);
}

Status read(ObjectReader& object, SetMatteKeyframe& edit) {
    WEFT_TRY(region, read_region_ref(object));
    WEFT_TRY(frame, read_frame(object));
    WEFT_TRY(path, object.text("path"));
    edit = {std::move(region), frame, std::move(path)};
    return {};
}
void write(OrderedJson& object, const SetMatteKeyframe& edit) {
    object["region"] = write_region_ref(edit.region);
    object["frame"] = edit.frame;
    object["path"] = edit.path;
}

Status read(ObjectReader& object, RemoveMatteKeyframe& edit) {
    WEFT_TRY(region, read_region_ref(object));
    WEFT_TRY(frame, read_frame(object));
    edit = {std::move(region), frame};
    return {};
}
void write(OrderedJson& object, const RemoveMatteKeyframe& edit) {
    object["region"] = write_region_ref(edit.region);
    object["frame"] = edit.frame;
}

Status read(ObjectReader& object, SetHoldouts& edit) {
    WEFT_TRY(region, read_region_ref(object));
    WEFT_TRY(json, required(object, "holdouts"));
    WEFT_TRY(holdouts, read_holdouts(*json, object.path_of("holdouts")));
    edit = {std::move(region), std::move(holdouts)};
    return {};
}
Status read(ObjectReader& object, SetAmendments& edit) {
    WEFT_TRY(region, read_region_ref(object));
    WEFT_TRY(json, required(object, "amendments"));
    WEFT_TRY(amendments, read_amendments(*json, object.path_of("amendments")));
    edit = {std::move(region), std::move(amendments)};
    return {};
}
void write(OrderedJson& object, const SetAmendments& edit) {
    object["region"] = write_region_ref(edit.region);
    object["amendments"] = write_amendments(edit.amendments);
}

void write(OrderedJson& object, const SetHoldouts& edit) {
    object["region"] = write_region_ref(edit.region);
    object["holdouts"] = write_holdouts(edit.holdouts);
}

Status read(ObjectReader& object, SetZones& edit) {
    WEFT_TRY(region, read_region_ref(object));
    WEFT_TRY(json, required(object, "zones"));
    WEFT_TRY(zones, read_zones(*json, object.path_of("zones")));
    edit = {std::move(region), std::move(zones)};
    return {};
}
void write(OrderedJson& object, const SetZones& edit) {
    object["region"] = write_region_ref(edit.region);
    object["zones"] = write_zones(edit.zones);
}

Status read(ObjectReader& object, SetTexture& edit) {
    WEFT_TRY(region_ref, read_region_ref(object));
    WEFT_TRY(json, required(object, "texture"));
    Region region;
    WEFT_CHECK_OK(read_group(*json, object.path_of("texture"), "texture", region));
    edit = {std::move(region_ref), std::move(region.texture)};
    return {};
}
void write(OrderedJson& object, const SetTexture& edit) {
    Region region;
    region.texture = edit.texture;
    object["region"] = write_region_ref(edit.region);
    object["texture"] = write_group("texture", region);
}

Status read(ObjectReader& object, SetCorrection& edit) {
    WEFT_TRY(region, read_region_ref(object));
    WEFT_TRY(frame, read_frame(object));
    WEFT_TRY(json, required(object, "pins"));
    WEFT_TRY(pins, read_pins(*json, object.path_of("pins")));
    edit = {std::move(region), frame, std::move(pins)};
    return {};
}
void write(OrderedJson& object, const SetCorrection& edit) {
    object["region"] = write_region_ref(edit.region);
    object["frame"] = edit.frame;
    object["pins"] = write_pins(edit.pins);
}

// ---- by name ---------------------------------------------------------------------------------

/// In the order of the alternatives of Edit.
constexpr std::array<std::string_view, std::variant_size_v<Edit>> kNames{
    "set_plate",     "set_output",         "set_project_parameter", "add_region",
    "remove_region", "move_region",        "rename_region",         "set_region_parameter",
    "set_matte",     "set_matte_keyframe", "remove_matte_keyframe", "set_holdouts",
    "set_zones",     "set_texture",        "set_correction",        "set_amendments"};

template <std::size_t I = 0>
Expected<Edit> read_named(std::string_view name, ObjectReader& object) {
    if constexpr (I == std::variant_size_v<Edit>) {
        return fail_at(object.path_of("action"),
                       fmt::format("Unknown action '{}'.", name.substr(0, 60)),
                       "'weft schema actions' lists them");
    } else {
        if (name != kNames[I]) return read_named<I + 1>(name, object);
        std::variant_alternative_t<I, Edit> edit;
        WEFT_CHECK_OK(read(object, edit));
        WEFT_CHECK_OK(object.expect_no_rest());
        return Edit(std::move(edit));
    }
}

Expected<Edit> read_edit(const Json& json, const std::string& path) {
    WEFT_TRY(object, ObjectReader::open(json, path));
    WEFT_TRY(name, object.text("action"));
    return read_named(name, object);
}

}  // namespace

Expected<std::vector<Edit>> edits_from_json(std::string_view text) {
    WEFT_TRY(document, parse(text));
    const Json* list = &document;
    std::string path = "actions";
    if (document.is_object()) {
        WEFT_TRY(object, ObjectReader::open(document, ""));
        WEFT_TRY(schema, object.text("schema"));
        if (schema != "weft.actions/1")
            return fail_at("schema",
                           fmt::format("'{}' is not 'weft.actions/1'", schema.substr(0, 60)),
                           "update Weft, or correct the file");
        WEFT_TRY(actions, required(object, "actions"));
        list = actions;
    }
    if (!list->is_array())
        return fail_at(path,
                       fmt::format("This is {}, but must be a list of actions", type_of(*list)));
    std::vector<Edit> out;
    for (std::size_t i = 0; i < list->size(); ++i) {
        WEFT_TRY(edit, read_edit((*list)[i], fmt::format("{}[{}]", path, i)));
        out.push_back(std::move(edit));
    }
    return out;
}

Expected<std::string> edits_to_json(const std::vector<Edit>& edits) {
    OrderedJson list = OrderedJson::array();
    for (const Edit& edit : edits) {
        OrderedJson object{{"action", kNames[edit.index()]}};
        std::visit([&](const auto& e) { write(object, e); }, edit);
        list.push_back(std::move(object));
    }
    return to_text(list);
}

}  // namespace weft
