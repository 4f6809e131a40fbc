#include "app/cli/form/form_command.h"

#include "app/render/form_job.h"
#include "engine/core/printable.h"

namespace weft {

CommandResult form_command(const Project& project, const RunOptions& run) {
    JobSpec spec;
    spec.project = project;
    spec.threads = run.threads;
    spec.cache = run.cache;
    WEFT_TRY(found, run_form_job(spec, cancel_on_signals(), progress_printer(run.progress)));
    for (const std::string& note : found.notes)
        print(stderr, "weft: " + note + "\n");
    for (const std::string& warning : found.warnings)
        print_warning(warning);
    Answer answer;
    answer.json = {{"schema", "weft.forms/1"},
                   {"forms", nlohmann::ordered_json::array()},
                   {"warnings", found.warnings}};
    for (const FormReport& form : found.forms) {
        answer.json["forms"].push_back(form_json(form));
        answer.text += printable(form.region) + ": " + form_text(form) + "\n";
    }
    return answer;
}

}  // namespace weft
