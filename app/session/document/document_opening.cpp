#include "app/session/document/document_opening.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "app/project/codec/project_file.h"
#include "app/session/document/document_saving.h"
#include "app/session/document/recent_projects.h"
#include "engine/core/text.h"
#include "engine/media/plates.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// What a file is named before its frame number: "shot_plate" of "shot_plate.####.exr".
std::string name_of_file(const fs::path& file) {
    std::string name = file.stem().string();
    constexpr std::string_view kNumber = "0123456789#@%";
    if (const std::size_t mark = name.find_first_of("#@%"); mark != std::string::npos) {
        name.erase(mark);
    } else {
        const std::size_t last = name.find_last_not_of(kNumber);
        name.erase(last == std::string::npos ? 0 : last + 1);
    }
    const std::size_t last = name.find_last_not_of("._- ");
    name.erase(last == std::string::npos ? 0 : last + 1);
    return name;
}

// What every shot calls its frames, or the folder of them.
bool is_common(const std::string& name) {
    static const std::set<std::string> kCommon{
        "frames", "frame", "plate", "plates", "images", "image",   "img", "png",
        "exr",    "jpg",   "jpeg",  "rgb",    "beauty", "footage", "seq", "sequence"};
    return kCommon.contains(lower_case(name));
}

// A display name: the first one, from the file upwards, that tells which shot it is: a file's not
// if it is but a letter or two before its number, a folder's not if it is only a number.
std::string shot_name(const std::string& path) {
    const fs::path whole(path);
    const bool folder = fs::is_directory(whole);
    if (!folder && has_movie_extension(path)) return whole.stem().string();
    constexpr std::size_t kLeast = 3;
    const std::string own = name_of_file(whole);
    if (!folder && own.size() >= kLeast && !is_common(own)) return own;
    for (fs::path at = folder ? whole : whole.parent_path(); at.has_relative_path();
         at = at.parent_path()) {
        const std::string name = at.filename().string();
        if (name.find_first_not_of("0123456789") != std::string::npos && !is_common(name))
            return name;
    }
    return whole.filename().string();
}

// Of one image of a sequence `frame` is its number.
Expected<Project> project_for_plate(const std::string& path, std::optional<int>& frame) {
    Project project;
    project.plate.path = path;
    project.name = shot_name(path);
    if (fs::is_directory(path)) {
        WEFT_TRY(sequence, find_sequence(path));
        project.plate.path = sequence.text();
    } else if (!has_movie_extension(path) && fs::exists(path)) {
        // One image of a sequence selects the whole sequence.
        if (auto sequence = find_sequence(fs::path(path).parent_path().string());
            sequence && sequence->frame_of(path)) {
            project.plate.path = sequence->text();
            frame = sequence->frame_of(path);
        }
    }
    return project;
}

}  // namespace

DocumentOpening::DocumentOpening(Uses uses) : use_(std::move(uses)) {
    if (use_.offer_recovery) recoverable_ = find_recoverable(recovery_folder());
}

std::string DocumentOpening::recovery_folder() const {
    return (fs::path(use_.state_folder) / "recovery").string();
}

void DocumentOpening::start(Project project, std::string path) {
    use_.document.start(std::move(project), std::move(path));
    use_.files.look_for_missing();
    use_.files.find_render_folder();
}

void DocumentOpening::open_new() {
    use_.document.clear_recovery();
    start(Project{}, "");
}

void DocumentOpening::close() {
    open_new();
    use_.document.close();
}

void DocumentOpening::open_project(const std::string& path) {
    auto file = read_project(path);
    if (!file) {
        use_.notices.add(NoticeKind::kError, file.error().text());
        return;
    }
    use_.document.clear_recovery();
    start(file->project, fs::absolute(path).string());
    use_.document.set_on_disk(std::move(*file));
    remember_recent(use_.settings, use_.document.path());
}

// Opens a copy, so that the demo itself is never changed.
void DocumentOpening::open_demo() {
    const std::string path = (fs::path(use_.assets) / "demo" / "demo.weft").string();
    auto project = load_project(path);
    if (!project) {
        use_.notices.add(NoticeKind::kError, project.error().text());
        return;
    }
    use_.document.clear_recovery();
    start(resolve_paths(*project, project_dir(fs::absolute(path).string())), "");
}

void DocumentOpening::open_any(const std::string& given) {
    const std::string path = fs::absolute(given).string();
    if (path.ends_with(".weft")) return open_project(path);
    auto project = project_for_plate(path, first_frame_);
    if (!project) {
        use_.notices.add(NoticeKind::kError, project.error().text());
        return;
    }
    if (use_.document.is_open() && use_.document.project().plate.path.empty()) {
        use_.document.edit(SetPlate{project->plate});
        return;
    }
    use_.document.clear_recovery();
    start(std::move(*project), "");
}

// An editor that is being killed may take seconds to go, so another look follows after 1, 2, 4 and
// 8 s.
void DocumentOpening::find_more_recoverable(double now_s) {
    if (first_look_s_ < 0) first_look_s_ = now_s;
    constexpr double kLastLook_s = 8;
    if (!use_.offer_recovery || now_s - first_look_s_ < look_after_s_ ||
        look_after_s_ > kLastLook_s)
        return;
    look_after_s_ *= 2;
    use_.tasks.start([this]() -> DocumentTasks::Finish {
        auto found = find_recoverable(recovery_folder());
        return [this, found = std::move(found)] {
            for (const RecoveredProject& one : found) {
                std::error_code none;
                const bool known = std::any_of(
                    recoverable_.begin(), recoverable_.end(),
                    [&](const RecoveredProject& other) { return other.file == one.file; });
                if (!known && fs::exists(one.file, none)) recoverable_.push_back(one);
            }
        };
    });
}

void DocumentOpening::recover(bool accept) {
    if (recoverable_.empty()) return;
    const RecoveredProject found = recoverable_.front();
    std::error_code error;
    if (accept) {
        const std::string dir = project_dir(found.project_path);
        const Project project =
            map_paths(found.project, [&](const std::string& p) { return relative_to(dir, p); });
        // As it was when it was opened: what others have saved since is merged on saving.
        auto known = found.known;
        if (!known && !found.project_path.empty()) {
            if (auto loaded = read_project(found.project_path)) known = std::move(*loaded);
        }
        start(known ? known->project : Project(), found.project_path);
        use_.document.set_on_disk(std::move(known));
        use_.document.commit(project, "Recover unsaved work");
        use_.files.find_render_folder();  // by the name that came with it
        use_.document.flush_recovery();   // before the old snapshot is deleted
    }
    fs::remove(found.file, error);
    recoverable_.erase(recoverable_.begin());
}

void DocumentOpening::show(SessionView& view) const {
    view.recent = use_.settings.recent;
    view.recovery.reset();
    if (!recoverable_.empty()) view.recovery = {recoverable_[0].project_path, recoverable_[0].when};
}

}  // namespace weft
