#include "app/cli/answer.h"

#include <cstdlib>
#include <filesystem>
#include <regex>

#include "app/base/job_messages.h"
#include "app/cli/console.h"
#include "app/project/project.h"
#include "engine/media/atomic_file.h"

namespace weft {
namespace {

using Json = nlohmann::ordered_json;

std::string name_of(ErrorCode code) {
    switch (code) {
        case ErrorCode::kRenderFailed:
            return "render_failed";
        case ErrorCode::kUsage:
            return "usage";
        case ErrorCode::kUnreadable:
            return "unreadable";
        case ErrorCode::kMissingFrames:
            return "missing_frames";
        case ErrorCode::kNoBackend:
            return "no_backend";
        case ErrorCode::kNoSpace:
            return "no_space";
        case ErrorCode::kRefused:
            return "refused";
        case ErrorCode::kDiffers:
            return "differs";
        case ErrorCode::kInterrupted:
            return "interrupted";
        case ErrorCode::kTerminated:
            return "terminated";
    }
    return "render_failed";
}

// The option or the place in a document with which `text` begins, else nothing: "--threads must
// be …", "regions[0].placement.scale: This is …", "regions[0] 'wall': texture: No texture …".
std::string field_at_the_front(const std::string& text) {
    static const std::regex kOption("^(--[a-z][a-z-]*)(?=[ :]|$)");
    static const std::regex kIssue(
        "^(regions\\[[0-9]+\\])(?: '[^']*')?: ([a-z_.\\[\\]0-9]+)(?=:|$)");
    // A file may be called "bad.weft": only what begins like a project's document is a place in it.
    static const std::regex kPlace(
        "^((?:plate|color|settings|output|regions)(?:\\[[0-9]+\\])?"
        "(?:\\.[a-z_]+(?:\\[[0-9]+\\])?)*)(?=:|$)");
    std::smatch found;
    if (std::regex_search(text, found, kOption)) return found[1];
    if (std::regex_search(text, found, kIssue)) return found[1].str() + "." + found[2].str();
    return std::regex_search(text, found, kPlace) ? found[1].str() : std::string();
}

std::string field_of(const Error& error) {
    if (auto field = field_at_the_front(error.message); !field.empty()) return field;
    for (const std::string& context : error.context)
        if (auto field = field_at_the_front(context); !field.empty()) return field;
    return {};
}

Json answer_json(const CommandResult& result, const Error* error, int exit) {
    Json out = result ? result->json : Json::object();
    if (error) out.update(error_json(*error));
    out["exit_code"] = exit;
    return out;
}

// Paths may contain bytes that are not UTF-8; they are replaced.
std::string text_of(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

// A file that cannot be written is not this command's failure: who reads it takes the process for
// one that could not say anything.
void leave_answer(const Json& answer) {
    if (const char* file = std::getenv(kAnswerFileVariable); file && *file)
        static_cast<void>(write_file_atomically(file, text_of(answer), WriteRule::own()));
}

}  // namespace

int conclude(const CommandResult& result) {
    const Error* error = !result ? &result.error() : result->error ? &*result->error : nullptr;
    const int exit = error ? exit_code(error->code) : result->exit;
    const Json answer = answer_json(result, error, exit);
    leave_answer(answer);
    if (json_output()) {
        print(stdout, text_of(answer));
    } else if (result) {
        print(stdout, result->text);
    }
    if (error) report_error(*error);
    return exit;
}

Json error_json(const Error& error) {
    Json out{
        {"code", exit_code(error.code)}, {"name", name_of(error.code)}, {"message", error.text()}};
    if (const std::string field = field_of(error); !field.empty()) out["field"] = field;
    if (!error.remedy.empty()) out["remedy"] = error.remedy;
    return {{"schema", "weft.error/1"}, {"error", out}};
}

std::string absolute_path(const std::string& path) {
    if (path.empty() || names_library_texture(path)) return path;
    std::error_code error;
    const auto absolute = std::filesystem::absolute(path, error);
    return error ? path : absolute.lexically_normal().string();
}

}  // namespace weft
