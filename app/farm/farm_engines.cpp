#include "app/farm/farm_engines.h"

#include <nlohmann/json.hpp>

#include "engine/core/text.h"

namespace weft {
namespace {

using Json = nlohmann::ordered_json;
using Files = std::vector<std::pair<std::string, std::string>>;

std::string last_index(const FarmStage& stage) {
    return std::to_string(stage.frames.size() - 1);
}

// Most farms allow few characters in job names.
std::string plain(const std::string& name) {
    std::string out;
    for (const char c : name) {
        const bool fits = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') || c == '-' || c == '_';
        out += fits ? c : '_';
    }
    return out.empty() ? "weft" : out.substr(0, 60);
}

std::string dumped(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

// Open Job Description, jobtemplate-2023-09: one step per stage, one task per index.
Files openjd(const FarmJob& job) {
    Json steps = Json::array();
    std::string before;
    for (const FarmStage& stage : job.stages) {
        Json step{{"name", stage.name}};
        if (!before.empty()) step["dependencies"] = Json::array({{{"dependsOn", before}}});
        step["parameterSpace"] = {
            {"taskParameterDefinitions",
             Json::array(
                 {{{"name", "Index"}, {"type", "INT"}, {"range", "0-" + last_index(stage)}}})}};
        step["script"] = {
            {"actions",
             {{"onRun",
               {{"command", "{{Param.Weft}}"},
                {"args",
                 {"task", "{{Param.Job}}", stage.name, "{{Task.Param.Index}}", "--progress",
                  "openjd"}},
                {"cancelation",
                 {{"mode", "NOTIFY_THEN_TERMINATE"}, {"notifyPeriodInSeconds", 10}}}}}}}};
        steps.push_back(std::move(step));
        before = stage.name;
    }
    const Json parameters = Json::array({{{"name", "Weft"},
                                          {"type", "STRING"},
                                          {"default", "weft"},
                                          {"description", "The weft program on the workers"}},
                                         {{"name", "Job"},
                                          {"type", "PATH"},
                                          {"objectType", "FILE"},
                                          {"dataFlow", "IN"},
                                          {"default", job.file}}});
    return {{"template.json", dumped({{"specificationVersion", "jobtemplate-2023-09"},
                                      {"name", plain(job.name)},
                                      {"parameterDefinitions", parameters},
                                      {"steps", steps}})}};
}

// Slurm: a script for each stage and one that submits them in order. Their text does not depend on
// the shot: names are in job.json, in the folder that submit.sh changes to.
Files slurm(const FarmJob& job) {
    Files out;
    std::string submit =
        "#!/bin/sh\n# Submits all stages; prints the id of the last job.\nset -eu\n"
        "cd \"$(dirname \"$0\")\"\nmkdir -p log\nafter=\n";
    for (const FarmStage& stage : job.stages) {
        out.emplace_back(stage.name + ".sh",
                         "#!/bin/sh\n#SBATCH --job-name=weft-" + stage.name +
                             "\n#SBATCH --ntasks=1\n#SBATCH --requeue\n#SBATCH --open-mode=append\n"
                             "#SBATCH --output=log/" +
                             stage.name +
                             "-%a.log\n"
                             "exec \"${WEFT:-weft}\" task job.json " +
                             stage.name + " \"$SLURM_ARRAY_TASK_ID\"\n");
        submit += "after=$(sbatch --parsable ${WEFT_SBATCH:-} --array=0-" + last_index(stage) +
                  " ${after:+--dependency=afterok:$after} " + stage.name + ".sh)\n";
    }
    submit += "echo \"$after\"\n";
    out.emplace_back("submit.sh", submit);
    return out;
}

// Thinkbox Deadline's CommandLine plug-in: an info file and a plug-in file per stage, and a script
// that adds the ids of jobs that a stage depends on.
Files deadline(const FarmJob& job) {
    Files out;
    std::string submit =
        "#!/bin/sh\n# Submits all stages with deadlinecommand.\nset -eu\n"
        "cd \"$(dirname \"$0\")\"\nafter=\n";
    for (const FarmStage& stage : job.stages) {
        out.emplace_back(stage.name + ".job", "Plugin=CommandLine\nName=" + plain(job.name) + " " +
                                                  stage.name + "\nBatchName=" + plain(job.name) +
                                                  "\nFrames=0-" + last_index(stage) +
                                                  "\nChunkSize=1\n");
        out.emplace_back(stage.name + ".plugin",
                         "Executable=weft\nArguments=task \"" + job.file + "\" " + stage.name +
                             " <STARTFRAME>\nShell=default\nShellExecute=False\n"
                             "SingleFramesOnly=True\n");
        submit += "cp " + stage.name +
                  ".job .job\n[ -z \"$after\" ] || echo "
                  "\"JobDependencies=$after\" >> .job\n"
                  "after=$(deadlinecommand .job " +
                  stage.name + ".plugin | sed -n 's/^JobID=//p')\n";
    }
    out.emplace_back("submit.sh", submit + "rm -f .job\necho \"$after\"\n");
    return out;
}

// OpenCue's job specification (cjsl): one layer per stage, one frame per index.
Files opencue(const FarmJob& job) {
    std::string layers, depends, before;
    for (const FarmStage& stage : job.stages) {
        layers += "      <layer name=\"" + stage.name +
                  "\" type=\"Render\">\n        <cmd>weft task '" + xml_text(job.file) + "' " +
                  stage.name + " #IFRAME#</cmd>\n        <range>0-" + last_index(stage) +
                  "</range>\n        <chunk>1</chunk>\n        <services>"
                  "<service>shell</service></services>\n      </layer>\n";
        if (!before.empty()) {
            depends += "    <depend type=\"LAYER_ON_LAYER\" anyframe=\"false\">\n      <depjob>" +
                       plain(job.name) + "</depjob>\n      <deplayer>" + stage.name +
                       "</deplayer>\n      <onjob>" + plain(job.name) +
                       "</onjob>\n      <onlayer>" + before + "</onlayer>\n    </depend>\n";
        }
        before = stage.name;
    }
    return {{"job.xml",
             "<?xml version=\"1.0\"?>\n<!DOCTYPE spec PUBLIC \"SPI Cue  Specification Language\" "
             "\"http://localhost:8080/spcue/dtd/cjsl-1.12.dtd\">\n<spec>\n"
             "  <facility>local</facility>\n  <show>testing</show>\n  <shot>shot</shot>\n"
             "  <user>weft</user>\n  <job name=\"" +
                 plain(job.name) + "\">\n    <paused>False</paused>\n    <layers>\n" + layers +
                 "    </layers>\n  </job>\n  <depends>\n" + depends + "  </depends>\n</spec>\n"}};
}

// Flamenco 3: a job type that reads the stages from the job's settings, and the job to submit.
Files flamenco(const FarmJob& job) {
    static constexpr const char* kType =
        R"(// Job type of Weft: copy it into the Manager's scripts folder.
const JOB_TYPE = {
    label: "Weft",
    settings: [
        { key: "weft", type: "string", required: true, default: "weft" },
        { key: "job", type: "string", required: true, subtype: "file_path" },
        { key: "stages", type: "string", required: true },
    ],
};

function compileJob(job) {
    const stages = JSON.parse(job.settings.stages);
    let before = [];
    for (const stage of stages) {
        const tasks = [];
        for (let index = 0; index < stage.tasks; index++) {
            const task = author.Task(`${stage.name}-${index}`, "misc");
            task.addCommand(author.Command("exec", {
                exe: job.settings.weft,
                args: ["task", job.settings.job, stage.name, String(index)],
            }));
            for (const earlier of before) task.addDependency(earlier);
            job.addTask(task);
            tasks.push(task);
        }
        before = tasks;
    }
}
)";
    Json stages = Json::array();
    for (const FarmStage& stage : job.stages)
        stages.push_back({{"name", stage.name}, {"tasks", stage.frames.size()}});
    const Json posted{
        {"name", plain(job.name)},
        {"type", "weft"},
        {"submitter_platform", "linux"},
        {"priority", 50},
        {"settings", {{"weft", "weft"}, {"job", job.file}, {"stages", stages.dump()}}}};
    return {{"weft.js", kType}, {"flamenco.json", dumped(posted)}};
}

}  // namespace

Files engine_files(FarmEngine engine, const FarmJob& job) {
    switch (engine) {
        case FarmEngine::kOpenJd:
            return openjd(job);
        case FarmEngine::kSlurm:
            return slurm(job);
        case FarmEngine::kDeadline:
            return deadline(job);
        case FarmEngine::kOpenCue:
            return opencue(job);
        case FarmEngine::kFlamenco:
            return flamenco(job);
    }
    return {};
}

}  // namespace weft
