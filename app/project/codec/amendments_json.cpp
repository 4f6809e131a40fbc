// Locked and regenerated patches to and from JSON: {"kind": "keep", "runs": [[x, y, count, from_x,
// from_y, sample, orientation], …]}; the last two are optional and default to 0.
#include <fmt/format.h>

#include "app/project/codec/json_codec.h"

namespace weft::json_codec {
namespace {

constexpr std::int64_t kMostTexels = 1 << 20;
constexpr std::size_t kMostRuns = 1 << 20, kMostAmendments = 1000;

Expected<TexelRun> read_run(const Json& json, const std::string& path) {
    constexpr std::size_t kLeast = 5, kMost = 7;
    if (!json.is_array() || json.size() < kLeast || json.size() > kMost)
        return fail_at(path,
                       "This must be a run: [x, y, count, from_x, from_y, sample, orientation]");
    int numbers[kMost] = {};
    for (std::size_t i = 0; i < json.size(); ++i) {
        if (!json[i].is_number_integer() || json[i].get<std::int64_t>() < -kMostTexels ||
            json[i].get<std::int64_t>() > kMostTexels)
            return fail_at(
                path, fmt::format("Number {} of this run is not a whole number within {}", i + 1,
                                  kMostTexels));
        numbers[i] = json[i].get<int>();
    }
    const TexelRun run{numbers[0], numbers[1], numbers[2], numbers[3],
                       numbers[4], numbers[5], numbers[6]};
    constexpr int kLongest = 16384, kOrientations = 8, kSamples = 64;
    if (run.count < 1 || run.count > kLongest || run.sample < 0 || run.sample >= kSamples ||
        run.orientation < 0 || run.orientation >= kOrientations ||
        (run.orientation != 0 && run.count != 1))
        return fail_at(path, "This run has a length, sample or orientation that cannot be");
    return run;
}

}  // namespace

Expected<std::vector<PlaneAmendment>> read_amendments(const Json& json, const std::string& path) {
    if (!json.is_array() || json.size() > kMostAmendments)
        return fail_at(path, fmt::format("This is {}, but must be a list of at most {} amendments",
                                         type_of(json), kMostAmendments));
    std::vector<PlaneAmendment> out;
    for (std::size_t i = 0; i < json.size(); ++i) {
        WEFT_TRY(object, ObjectReader::open(json[i], fmt::format("{}[{}]", path, i)));
        PlaneAmendment amendment;
        WEFT_TRY(kind, object.text("kind"));
        if (kind != "keep" && kind != "again")
            return fail_at(object.path_of("kind"), "This must be keep or again");
        if (kind == "again") amendment.kind = PlaneAmendment::Kind::kAgain;
        if (object.take("seed")) {
            WEFT_TRY(seed, object.integer("seed", 0, UINT32_MAX));
            amendment.seed = static_cast<std::uint32_t>(seed);
        }
        const Json* runs = object.take("runs");
        if (!runs || !runs->is_array() || runs->empty() || runs->size() > kMostRuns)
            return fail_at(object.path(), "An amendment needs its runs of texels");
        for (std::size_t k = 0; k < runs->size(); ++k) {
            WEFT_TRY(run, read_run((*runs)[k], fmt::format("{}[{}]", object.path_of("runs"), k)));
            amendment.runs.push_back(run);
        }
        WEFT_CHECK_OK(object.expect_no_rest());
        out.push_back(std::move(amendment));
    }
    return out;
}

OrderedJson write_amendments(const std::vector<PlaneAmendment>& amendments) {
    OrderedJson list = OrderedJson::array();
    for (const PlaneAmendment& amendment : amendments) {
        const bool again = amendment.kind == PlaneAmendment::Kind::kAgain;
        OrderedJson one{{"kind", again ? "again" : "keep"}};
        if (amendment.seed != 0) one["seed"] = amendment.seed;
        OrderedJson& runs = one["runs"] = OrderedJson::array();
        for (const TexelRun& r : amendment.runs) {
            OrderedJson run{r.x, r.y, r.count, r.from_x, r.from_y};
            if (r.sample != 0 || r.orientation != 0) {
                run.push_back(r.sample);
                run.push_back(r.orientation);
            }
            runs.push_back(std::move(run));
        }
        list.push_back(std::move(one));
    }
    return list;
}

}  // namespace weft::json_codec
