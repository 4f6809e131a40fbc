#include "tests/cli/openjd_schema.h"

#include <regex>
#include <set>

namespace weft::test {
namespace {

using Json = nlohmann::json;
using Names = std::set<std::string>;

class Checker {
  public:
    explicit Checker(const Json& job) { template_of(job); }
    std::vector<std::string> wrong;

  private:
    void expect(bool holds, const std::string& where, const std::string& what) {
        if (!holds) wrong.push_back(where + ": " + what);
    }

    // An object with all of `needed` and nothing but `needed` and `allowed`.
    bool object(const Json& json, const std::string& where, const Names& needed,
                const Names& allowed) {
        if (!json.is_object()) {
            expect(false, where, "is no object");
            return false;
        }
        bool whole = true;
        for (const std::string& key : needed) {
            whole = whole && json.contains(key);
            expect(json.contains(key), where, "has no " + key);
        }
        for (const auto& [key, value] : json.items())
            expect(needed.contains(key) || allowed.contains(key), where, "may not have " + key);
        return whole;
    }

    std::string text(const Json& json, const std::string& where, std::size_t most) {
        const std::string value = json.is_string() ? json.get<std::string>() : "";
        expect(!value.empty() && value.size() <= most, where,
               "is no text of 1 to " + std::to_string(most) + " characters");
        for (const char c : value)
            expect(static_cast<unsigned char>(c) >= 32, where, "has control characters");
        return value;
    }

    std::string identifier(const Json& json, const std::string& where) {
        const std::string value = text(json, where, 64);
        expect(std::regex_match(value, std::regex("[A-Za-z_][A-Za-z0-9_]*")), where,
               "is no identifier");
        return value;
    }

    // Every {{…}} names an existing value.
    void format_string(const Json& json, const std::string& where, const Names& known) {
        const std::string value = json.is_string() ? json.get<std::string>() : "";
        expect(json.is_string(), where, "is no text");
        static const std::regex kExpression(R"(\{\{\s*([^}]*?)\s*\}\})");
        for (std::sregex_iterator it(value.begin(), value.end(), kExpression), end; it != end; ++it)
            expect(known.contains((*it)[1].str()), where, "names " + (*it)[1].str());
    }

    void list(const Json& json, const std::string& where, std::size_t most) {
        expect(json.is_array() && !json.empty() && json.size() <= most, where,
               "is no list of 1 to " + std::to_string(most));
    }

    void template_of(const Json& job) {
        if (!object(job, "template", {"specificationVersion", "name", "steps"},
                    {"$schema", "description", "parameterDefinitions", "jobEnvironments"}))
            return;
        expect(job["specificationVersion"] == "jobtemplate-2023-09", "specificationVersion",
               "is another");
        text(job["name"], "name", 128);
        if (job.contains("parameterDefinitions")) {
            list(job["parameterDefinitions"], "parameterDefinitions", 50);
            for (const Json& parameter : job["parameterDefinitions"])
                parameter_of(parameter);
        }
        list(job["steps"], "steps", 100);
        Names before;
        for (const Json& step : job["steps"])
            step_of(step, before);
    }

    void parameter_of(const Json& json) {
        if (!object(json, "parameter", {"name", "type"},
                    {"default", "description", "allowedValues", "minLength", "maxLength",
                     "userInterface", "objectType", "dataFlow"}))
            return;
        const std::string name = identifier(json["name"], "parameter name");
        expect(!parameters_.contains("Param." + name), name, "is there twice");
        parameters_.insert("Param." + name);
        const bool path = json["type"] == "PATH";
        if (path) parameters_.insert("RawParam." + name);
        expect(path || json["type"] == "STRING", name, "is of a type that Weft never uses");
        if (json.contains("default")) text(json["default"], name + " default", 1024);
        if (json.contains("description")) text(json["description"], name + " description", 2048);
        expect(path || !(json.contains("objectType") || json.contains("dataFlow")), name,
               "is no PATH");
        if (json.contains("objectType"))
            expect(Names{"FILE", "DIRECTORY"}.contains(json["objectType"]), name, "objectType");
        if (json.contains("dataFlow"))
            expect(Names{"NONE", "IN", "OUT", "INOUT"}.contains(json["dataFlow"]), name,
                   "dataFlow");
    }

    void step_of(const Json& step, Names& before) {
        if (!object(step, "step", {"name", "script"},
                    {"description", "stepEnvironments", "parameterSpace", "hostRequirements",
                     "dependencies"}))
            return;
        const std::string name = text(step["name"], "step name", 64);
        Names known = parameters_;
        if (step.contains("dependencies")) {
            list(step["dependencies"], name + " dependencies", 10000);
            for (const Json& dependency : step["dependencies"]) {
                // Depends on earlier steps only, so there are no cycles.
                if (object(dependency, name + " dependency", {"dependsOn"}, {}))
                    expect(before.contains(dependency["dependsOn"]), name, "depends on no step");
            }
        }
        if (step.contains("parameterSpace")) space_of(step["parameterSpace"], name, known);
        script_of(step["script"], name, known);
        expect(before.insert(name).second, name, "is there twice");
    }

    void space_of(const Json& space, const std::string& step, Names& known) {
        if (!object(space, step + " parameterSpace", {"taskParameterDefinitions"}, {"combination"}))
            return;
        list(space["taskParameterDefinitions"], step + " task parameters", 16);
        for (const Json& json : space["taskParameterDefinitions"]) {
            if (!object(json, step + " task parameter", {"name", "type", "range"}, {})) continue;
            known.insert("Task.Param." + identifier(json["name"], step + " task parameter"));
            expect(json["type"] == "INT", step, "its task parameter is no INT");
            static const std::regex kRange("(0|[1-9][0-9]{0,6})-(0|[1-9][0-9]{0,6})");
            const std::string range = json["range"].is_string() ? json["range"] : Json("");
            std::smatch ends;
            if (!std::regex_match(range, ends, kRange)) {
                expect(false, step, "its range is no expression");
                continue;
            }
            const int first = std::stoi(ends[1].str()), last = std::stoi(ends[2].str());
            expect(first <= last && last - first < 1024, step,
                   "its range has not 1 to 1024 values");
        }
    }

    void script_of(const Json& script, const std::string& step, const Names& known) {
        if (!object(script, step + " script", {"actions"}, {"embeddedFiles"}) ||
            !object(script["actions"], step + " actions", {"onRun"}, {}))
            return;
        const Json& run = script["actions"]["onRun"];
        if (!object(run, step + " onRun", {"command"}, {"args", "timeout", "cancelation"})) return;
        format_string(run["command"], step + " command", known);
        for (const Json& word : run.value("args", Json::array()))
            format_string(word, step + " args", known);
        if (!run.contains("cancelation")) return;
        const Json& cancel = run["cancelation"];
        if (!object(cancel, step + " cancelation", {"mode"}, {"notifyPeriodInSeconds"})) return;
        expect(Names{"TERMINATE", "NOTIFY_THEN_TERMINATE"}.contains(cancel["mode"]), step, "mode");
        const int period = cancel.value("notifyPeriodInSeconds", 1);
        expect(period >= 1 && period <= 600, step, "notifyPeriodInSeconds is not 1 to 600");
    }

    Names parameters_;
};

}  // namespace

std::vector<std::string> openjd_violations(const Json& job) {
    return Checker(job).wrong;
}

}  // namespace weft::test
