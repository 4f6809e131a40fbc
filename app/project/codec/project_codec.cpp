// Parts of the document to and from JSON, as described in docs/FORMATS.md.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/project/codec/json_codec.h"
#include "app/project/codec/project_json.h"
#include "app/project/parameter_entry.h"
#include "engine/core/frame_range.h"

namespace weft::json_codec {
namespace {

/// A nested object of a region or project, with the member that holds it.
template <class Owner>
struct Group {
    std::string_view name;
    const Extras& (*extra)(const Owner&);
    void (*set_extra)(Owner&, Extras);
};
template <class Owner, auto Member>
constexpr Group<Owner> group(std::string_view name) {
    return {name, [](const Owner& owner) -> const Extras& { return (owner.*Member).extra; },
            [](Owner& owner, Extras extra) { (owner.*Member).extra = std::move(extra); }};
}

constexpr std::array kRegionGroups{
    group<Region, &Region::texture>("texture"),     group<Region, &Region::placement>("placement"),
    group<Region, &Region::form>("form"),           group<Region, &Region::motion>("motion"),
    group<Region, &Region::synthesis>("synthesis"), group<Region, &Region::temporal>("temporal"),
    group<Region, &Region::light>("light"),         group<Region, &Region::grade>("grade"),
    group<Region, &Region::layer>("layer"),         group<Region, &Region::finish>("finish"),
    group<Region, &Region::lines>("lines"),
};
constexpr std::array kProjectGroups{
    group<Project, &Project::plate>("plate"),
    group<Project, &Project::color>("color"),
    group<Project, &Project::settings>("settings"),
    group<Project, &Project::output>("output"),
};

template <class Owner>
Status read_one_group(const Json& json, const std::string& path, const Group<Owner>& known,
                      std::span<const Parameter<Owner>> table, Owner& owner) {
    WEFT_TRY(object, ObjectReader::open(json, path));
    WEFT_CHECK_OK(read_parameters(object, table, known.name, owner));
    known.set_extra(owner, object.rest());
    return {};
}

template <class Owner, std::size_t N>
Status read_groups(ObjectReader& object, const std::array<Group<Owner>, N>& groups,
                   std::span<const Parameter<Owner>> table, Owner& owner) {
    for (const Group<Owner>& known : groups)
        if (const Json* json = object.take(known.name))
            WEFT_CHECK_OK(read_one_group(*json, object.path_of(known.name), known, table, owner));
    return {};
}

template <class Owner>
OrderedJson write_one_group(const Group<Owner>& known, std::span<const Parameter<Owner>> table,
                            const Owner& owner) {
    OrderedJson object = OrderedJson::object();
    write_parameters(object, table, known.name, owner);
    write_extras(object, known.extra(owner));
    return object;
}

Expected<std::map<int, std::vector<CorrectionPin>>> read_corrections(const Json& json,
                                                                     const std::string& path) {
    if (!json.is_array())
        return fail_at(path,
                       fmt::format("This is {}, but must be a list of corrections", type_of(json)));
    std::map<int, std::vector<CorrectionPin>> out;
    for (std::size_t i = 0; i < json.size(); ++i) {
        WEFT_TRY(object, ObjectReader::open(json[i], fmt::format("{}[{}]", path, i)));
        WEFT_TRY(frame, object.integer("frame", -kMaxFrameNumber, kMaxFrameNumber));
        const Json* list = object.take("pins");
        if (!list || list->empty()) return fail_at(object.path(), "A correction needs its pins");
        WEFT_TRY(pins, read_pins(*list, object.path_of("pins")));
        if (!out.emplace(static_cast<int>(frame), std::move(pins)).second)
            return fail_at(object.path(), fmt::format("Frame {} has two corrections", frame),
                           "remove one");
    }
    return out;
}

Expected<std::vector<Region>> read_regions(const Json& json, const std::string& path) {
    if (!json.is_array())
        return fail_at(path,
                       fmt::format("This is {}, but must be a list of regions", type_of(json)));
    std::vector<Region> out;
    std::set<RegionId> ids;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const std::string where = fmt::format("{}[{}]", path, i);
        WEFT_TRY(region, read_region(json[i], where));
        if (region.id != 0 && !ids.insert(region.id).second)
            return fail_at(where + ".id", fmt::format("Two regions have the id {}", region.id),
                           "give one of them another");
        out.push_back(std::move(region));
    }
    return out;
}

}  // namespace

Expected<MatteSource> read_matte_source(const Json& json, const std::string& path) {
    WEFT_TRY(object, ObjectReader::open(json, path));
    MatteSource matte;
    WEFT_CHECK_OK(read_parameters(object, matte_parameters(), "matte", matte));
    if (const Json* keyframes = object.take("keyframes")) {
        WEFT_TRY(keys, read_keyframes(*keyframes, object.path_of("keyframes")));
        matte.keyframes = std::move(keys);
    }
    if (const Json* confirmed = object.take("confirmed")) {
        WEFT_TRY(parts, read_confirmed(*confirmed, object.path_of("confirmed")));
        matte.confirmed = std::move(parts);
    }
    if (const Json* shape = object.take("shape")) {
        WEFT_TRY(read, read_keyed_shape(*shape, object.path_of("shape")));
        matte.shape = std::move(read);
    }
    matte.extra = object.rest();
    return matte;
}

Expected<std::vector<MatteSource>> read_holdouts(const Json& json, const std::string& path) {
    if (!json.is_array())
        return fail_at(path,
                       fmt::format("This is {}, but must be a list of mattes", type_of(json)));
    std::vector<MatteSource> out;
    for (std::size_t i = 0; i < json.size(); ++i) {
        WEFT_TRY(matte, read_matte_source(json[i], fmt::format("{}[{}]", path, i)));
        out.push_back(std::move(matte));
    }
    return out;
}

Expected<std::vector<Zone>> read_zones(const Json& json, const std::string& path) {
    constexpr std::size_t kMostZones = 1000;
    if (!json.is_array() || json.size() > kMostZones)
        return fail_at(path, fmt::format("This is {}, but must be a list of at most {} zones",
                                         type_of(json), kMostZones));
    std::vector<Zone> out;
    for (std::size_t i = 0; i < json.size(); ++i) {
        WEFT_TRY(object, ObjectReader::open(json[i], fmt::format("{}[{}]", path, i)));
        Zone zone;
        WEFT_CHECK_OK(read_parameters(object, zone_parameters(), "", zone));
        if (const Json* matte = object.take("matte")) {
            WEFT_TRY(source, read_matte_source(*matte, object.path_of("matte")));
            zone.matte = std::move(source);
        }
        zone.extra = object.rest();
        out.push_back(std::move(zone));
    }
    return out;
}

Expected<std::vector<CorrectionPin>> read_pins(const Json& json, const std::string& path) {
    constexpr std::size_t kMostPins = 1000;
    if (!json.is_array() || json.size() > kMostPins)
        return fail_at(path, fmt::format("This is {}, but must be a list of at most {} pins",
                                         type_of(json), kMostPins));
    std::vector<CorrectionPin> out;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const std::string where = fmt::format("{}[{}]", path, i);
        WEFT_TRY(object, ObjectReader::open(json[i], where));
        const auto point = [&](std::string_view key) -> Expected<PlatePoint> {
            const Json* value = object.take(key);
            const bool fits = value && value->is_array() && value->size() == 2 &&
                              (*value)[0].is_number() && (*value)[1].is_number();
            const PlatePoint p =
                fits ? PlatePoint{(*value)[0].get<double>(), (*value)[1].get<double>()}
                     : PlatePoint{};
            if (!fits || !(std::abs(p.x) <= parameter_entry::kMaxPlatePx) ||
                !(std::abs(p.y) <= parameter_entry::kMaxPlatePx))
                return fail_at(object.path_of(key), "This must be a point of the plate: [x, y]");
            return p;
        };
        WEFT_TRY(from, point("from"));
        WEFT_TRY(to, point("to"));
        WEFT_CHECK_OK(object.expect_no_rest());
        out.push_back({from, to});
    }
    return out;
}

OrderedJson write_pins(const std::vector<CorrectionPin>& pins) {
    OrderedJson list = OrderedJson::array();
    for (const CorrectionPin& pin : pins)
        list.push_back({{"from", {pin.from.x, pin.from.y}}, {"to", {pin.to.x, pin.to.y}}});
    return list;
}

Expected<Region> read_region(const Json& json, const std::string& path) {
    WEFT_TRY(object, ObjectReader::open(json, path));
    Region region;
    if (const Json* id = object.take("id"); id && !id->is_null()) {
        WEFT_TRY(number, object.integer("id", 0, UINT32_MAX - 1));
        region.id = static_cast<RegionId>(number);
    }
    WEFT_CHECK_OK(read_parameters(object, region_parameters(), "", region));
    if (const Json* matte = object.take("matte")) {
        WEFT_TRY(source, read_matte_source(*matte, object.path_of("matte")));
        region.matte = std::move(source);
    }
    if (const Json* holdouts = object.take("holdouts")) {
        WEFT_TRY(sources, read_holdouts(*holdouts, object.path_of("holdouts")));
        region.holdouts = std::move(sources);
    }
    if (const Json* zones = object.take("zones")) {
        WEFT_TRY(read, read_zones(*zones, object.path_of("zones")));
        region.zones = std::move(read);
    }
    if (const Json* corrections = object.take("corrections")) {
        WEFT_TRY(read, read_corrections(*corrections, object.path_of("corrections")));
        region.corrections = std::move(read);
    }
    if (const Json* amendments = object.take("amendments")) {
        WEFT_TRY(read, read_amendments(*amendments, object.path_of("amendments")));
        region.amendments = std::move(read);
    }
    WEFT_CHECK_OK(read_groups(object, kRegionGroups, region_parameters(), region));
    region.extra = object.rest();
    return region;
}

Expected<Project> read_project(const Json& json) {
    WEFT_TRY(object, ObjectReader::open(json, ""));
    static_cast<void>(object.take("schema"));
    Project project;
    WEFT_CHECK_OK(read_parameters(object, project_parameters(), "", project));
    WEFT_CHECK_OK(read_groups(object, kProjectGroups, project_parameters(), project));
    std::int64_t next_id = 1;
    if (object.take("next_region_id")) {
        WEFT_TRY(number, object.integer("next_region_id", 1, UINT32_MAX - 1));
        next_id = number;
    }
    if (const Json* regions = object.take("regions")) {
        WEFT_TRY(list, read_regions(*regions, "regions"));
        for (const Region& region : list)
            next_id = std::max<std::int64_t>(next_id, std::int64_t{region.id} + 1);
        for (Region& region : list) {
            if (region.id == 0) region.id = static_cast<RegionId>(next_id++);
            project.regions.emplace_back(std::move(region));
        }
    }
    project.next_region_id = static_cast<RegionId>(next_id);
    project.extra = object.rest();
    return project;
}

OrderedJson write_project(const Project& project) {
    OrderedJson object = OrderedJson::object();
    object["schema"] = fmt::format("{}/{}", kProjectSchemaName, kProjectSchemaVersion);
    write_parameters(object, project_parameters(), "", project);
    for (const Group<Project>& known : kProjectGroups)
        object[std::string(known.name)] = write_one_group(known, project_parameters(), project);
    object["next_region_id"] = project.next_region_id;
    OrderedJson& regions = object["regions"] = OrderedJson::array();
    for (const Leaf<Region>& region : project.regions)
        regions.push_back(write_region(*region));
    write_extras(object, project.extra);
    return object;
}

Status read_group(const Json& json, const std::string& path, std::string_view group,
                  Region& region) {
    for (const Group<Region>& known : kRegionGroups)
        if (known.name == group)
            return read_one_group(json, path, known, region_parameters(), region);
    return fail_at(path, "Unknown group");
}

Status read_group(const Json& json, const std::string& path, std::string_view group,
                  Project& project) {
    for (const Group<Project>& known : kProjectGroups)
        if (known.name == group)
            return read_one_group(json, path, known, project_parameters(), project);
    return fail_at(path, "Unknown group");
}

OrderedJson write_matte_source(const MatteSource& matte) {
    OrderedJson object = OrderedJson::object();
    write_parameters(object, matte_parameters(), "matte", matte);
    if (!matte.keyframes.empty()) object["keyframes"] = write_keyframes(matte.keyframes);
    if (!matte.confirmed.empty()) object["confirmed"] = write_confirmed(matte.confirmed);
    if (!matte.shape.empty()) object["shape"] = write_keyed_shape(matte.shape);
    write_extras(object, matte.extra);
    return object;
}

OrderedJson write_holdouts(const std::vector<MatteSource>& holdouts) {
    OrderedJson list = OrderedJson::array();
    for (const MatteSource& holdout : holdouts)
        list.push_back(write_matte_source(holdout));
    return list;
}

OrderedJson write_zones(const std::vector<Zone>& zones) {
    OrderedJson list = OrderedJson::array();
    for (const Zone& zone : zones) {
        OrderedJson object = OrderedJson::object();
        write_parameters(object, zone_parameters(), "", zone);
        object["matte"] = write_matte_source(zone.matte);
        write_extras(object, zone.extra);
        list.push_back(std::move(object));
    }
    return list;
}

OrderedJson write_region(const Region& region) {
    OrderedJson object = OrderedJson::object();
    object["id"] = region.id;
    write_parameters(object, region_parameters(), "", region);
    object["matte"] = write_matte_source(*region.matte);
    if (!region.holdouts->empty()) object["holdouts"] = write_holdouts(*region.holdouts);
    if (!region.zones->empty()) object["zones"] = write_zones(*region.zones);
    if (!region.amendments->empty()) object["amendments"] = write_amendments(*region.amendments);
    for (const auto& [frame, pins] : region.corrections)
        object["corrections"].push_back({{"frame", frame}, {"pins", write_pins(pins)}});
    for (const Group<Region>& known : kRegionGroups)
        object[std::string(known.name)] = write_one_group(known, region_parameters(), region);
    write_extras(object, region.extra);
    return object;
}

OrderedJson write_group(std::string_view group, const Region& region) {
    for (const Group<Region>& known : kRegionGroups)
        if (known.name == group) return write_one_group(known, region_parameters(), region);
    return {};
}

OrderedJson write_group(std::string_view group, const Project& project) {
    for (const Group<Project>& known : kProjectGroups)
        if (known.name == group) return write_one_group(known, project_parameters(), project);
    return {};
}

}  // namespace weft::json_codec
