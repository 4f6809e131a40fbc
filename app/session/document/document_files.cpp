#include "app/session/document/document_files.h"

#include <cstdlib>
#include <filesystem>
#include <utility>

#include "app/exchange/collect.h"
#include "app/exchange/relink.h"
#include "app/project/codec/project_file.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

std::string files_text(std::size_t count) {
    return std::to_string(count) + (count == 1 ? " file" : " files");
}

}  // namespace

std::string version_text(int version) {
    const std::string digits = std::to_string(version);
    return "v" + std::string(digits.size() < 3 ? 3 - digits.size() : 0, '0') + digits;
}

void DocumentFiles::collect(const std::string& folder) {
    if (!use_.document.is_open()) return;
    if (collecting_)
        return use_.notices.add(
            NoticeKind::kWarning,
            "Files are still being collected. Wait until they are, or cancel that first.");
    use_.end_stroke();
    const std::string name = use_.document.title();
    const CollectRun run((fs::path(folder) / name).string());
    collecting_ = run;
    use_.tasks.start([this, name, run, project = use_.document.resolved(),
                      path = use_.document.path()]() -> DocumentTasks::Finish {
        use_.shelf.flush();
        WriteLimits limits;
        if (!path.empty()) limits.reads.push_back(path);
        const auto collected =
            collect_project(project, name + ".weft", run.folder, use_.texture_library, limits,
                            run.cancel, [&](const ProgressEvent& event) { run.note(event); });
        return [this, collected, run] {
            collecting_.reset();
            if (run.cancel.cancelled() && !collected)
                return use_.notices.add(
                    NoticeKind::kInfo,
                    "Nothing was collected; the copied files were removed again.");
            if (!collected) return use_.notices.add(NoticeKind::kError, collected.error().text());
            use_.notices.add(NoticeKind::kGood,
                             "Collected the project and " +
                                 files_text(static_cast<std::size_t>(collected->files)) + " in " +
                                 run.folder + ".");
        };
    });
}

void DocumentFiles::cancel_collect() {
    if (collecting_) collecting_->cancel.cancel();
}

void DocumentFiles::look_for_missing() {
    use_.tasks.start_for_document(
        [this, project = use_.document.resolved()]() -> DocumentTasks::Finish {
            use_.shelf.flush();
            return [this, missing = missing_inputs(project)] { missing_ = missing; };
        });
}

// One step of the history for everything that is found.
void DocumentFiles::relink(const std::string& folder) {
    if (!use_.document.is_open()) return;
    use_.end_stroke();
    use_.tasks.start_for_document([this, folder, project = use_.document.resolved(),
                                   state = use_.document.serial()]() -> DocumentTasks::Finish {
        use_.shelf.flush();
        const auto linked = relink_inputs(project, folder, CancelToken());
        return [this, linked, folder, state] {
            if (!linked) return use_.notices.add(NoticeKind::kError, linked.error().text());
            if (state != use_.document.serial())
                return use_.notices.add(
                    NoticeKind::kWarning,
                    "The project was changed meanwhile. Relink its files again.");
            if (linked->found.empty() && linked->missing.empty())
                return use_.notices.add(NoticeKind::kInfo, "No file is missing.");
            if (linked->found.empty())
                return use_.notices.add(
                    NoticeKind::kWarning,
                    "None of the missing files is in " + folder + ". Choose another folder.");
            missing_ = linked->missing;
            use_.document.commit(map_paths(linked->project,
                                           [dir = use_.document.folder()](const std::string& path) {
                                               return relative_to(dir, path);
                                           }),
                                 "Relink " + files_text(linked->found.size()));
            use_.notices.add(
                linked->missing.empty() ? NoticeKind::kGood : NoticeKind::kWarning,
                "Relinked " + files_text(linked->found.size()) +
                    (linked->missing.empty()
                         ? "."
                         : "; " + files_text(linked->missing.size()) + " still missing."));
        };
    });
}

// A saved project renders beside itself under its own name. Shots that were never saved share a
// folder by name: each takes a version that is not there yet.
void DocumentFiles::find_render_folder() {
    const auto folder = [](const fs::path& base, int version) {
        return base.string() + "render_" + version_text(version);
    };
    if (!use_.document.path().empty()) {
        const fs::path own(use_.document.path());
        render_folder_ = folder(own.parent_path() / (own.stem().string() + "_"), 1);
        return;
    }
    // Nothing changes the environment while threads run.
    const char* home = std::getenv("HOME");  // NOLINT(concurrency-mt-unsafe)
    const std::string& given = use_.document.project().name;
    const std::string name = given.empty() ? "Untitled" : given;
    const fs::path base = fs::path(home && *home ? home : "/tmp") / "weft" / name / "";
    render_folder_ = folder(base, 1);
    use_.tasks.start_for_document([this, base, folder]() -> DocumentTasks::Finish {
        int version = 1;
        std::error_code none;
        while (fs::exists(folder(base, version), none))
            ++version;
        return [this, first = folder(base, 1), found = folder(base, version)] {
            // Not if the project was saved or took another name meanwhile.
            if (render_folder_ == first) render_folder_ = found;
        };
    });
}

void DocumentFiles::show(SessionView& view) const {
    view.missing = missing_;
    view.render_folder = render_folder_;
}

void DocumentFiles::show_collecting(SessionView& view) const {
    view.collecting.reset();
    if (collecting_)
        view.collecting =
            CollectView{collecting_->folder, collecting_->done(), collecting_->total()};
}

}  // namespace weft
