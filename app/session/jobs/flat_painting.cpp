#include "app/session/jobs/flat_painting.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cctype>
#include <chrono>
#include <filesystem>
#include <utility>

#include "app/base/detached_process.h"
#include "app/base/find_program.h"
#include "app/base/job_messages.h"
#include "app/exchange/flat_picture.h"
#include "app/exchange/move_project.h"
#include "app/jobs/job_answer.h"
#include "app/jobs/job_progress.h"
#include "app/jobs/job_record.h"
#include "app/project/codec/project_file.h"
#include "engine/media/image_files.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// "../wall: left" as a file is called.
std::string file_name_of(const std::string& region) {
    std::string out;
    for (const char c : region)
        out += std::isalnum(static_cast<unsigned char>(c)) || (c & 0x80) ? c : '_';
    return out.empty() ? "region" : out;
}

std::string failure_of(const JobFiles& files) {
    const auto answer = read_answer(files.answer);
    if (answer && !answer->message.empty()) return with_setting_names(answer->message);
    return "The program that gathers the surface ended unexpectedly. Try again.";
}

}  // namespace

struct FlatPainting::Run {
    RegionId region;
    std::string region_name, picture;
    PaintProgram program;
    std::uint64_t document;
    JobFiles files;
    JobProgress progress{files.progress, true};
    JobView view = {};
    Clock::time_point begun = Clock::now();
    pid_t child = -1;  // before it is started
};

FlatPainting::FlatPainting(Uses uses) : use_(std::move(uses)) {}

FlatPainting::~FlatPainting() {
    stop();
}

std::string FlatPainting::new_picture(const Region& region, const PaintProgram& program) const {
    const std::string& project = use_.document.path();
    const fs::path folder = project.empty() ? fs::path(use_.state_folder) / "unsaved" / "flat"
                                            : fs::absolute(use_.document.folder()) /
                                                  (fs::path(project).stem().string() + "_flat");
    const std::string name = file_name_of(region.name);
    std::error_code error;
    for (int version = 1;; ++version) {
        const std::string number = version > 1 ? "_v" + std::to_string(version) : "";
        const fs::path path = folder / (name + number + program.ending);
        if (!fs::exists(path, error)) return path.string();
    }
}

void FlatPainting::paint(const PaintFlat& action) {
    const Region* region = region_by_id(use_.document.project(), action.region);
    if (!region || !use_.plate.reader())
        return use_.notices.add(NoticeKind::kWarning, "Select a region to paint on.");
    const PaintProgram program = paint_program_of(action.command);
    if (find_program(program.command).empty())
        return use_.notices.add(NoticeKind::kError,
                                "There is no program " + program.command +
                                    ". Install it, or choose another one in the settings.");
    if (!region->texture.plane.empty())
        return open_in(program, resolve_path(use_.document.folder(), region->texture.plane));
    if (run_)
        return use_.notices.add(NoticeKind::kWarning, "The surface of " + run_->region_name +
                                                          " is still being gathered.");
    use_.end_painting();
    // Of this window and this run: one that was stopped may still be ending.
    const std::string name = std::to_string(getpid()) + "-" + std::to_string(++runs_);
    run_ = std::make_shared<Run>(
        Run{region->id, region->name, new_picture(*region, program), program, use_.document.id(),
            JobFiles((fs::path(use_.state_folder) / "flat").string(), name)});
    use_.tasks.start([this, of = std::weak_ptr(run_), picture = run_->picture, files = run_->files,
                      project = resolve_paths(use_.document.committed(),
                                              use_.document.folder())]() -> DocumentTasks::Finish {
        std::error_code error;
        files.remove();
        fs::create_directories(fs::path(files.snapshot).parent_path(), error);
        fs::create_directories(fs::path(picture).parent_path(), error);
        // Painted mattes must be on disk before they are read.
        use_.shelf.flush();
        const Status saved = save_project(files.snapshot, project, WriteRule::own());
        return [this, of, saved] {
            if (!run_ || run_ != of.lock()) return;  // stopped meanwhile
            if (saved) return begin(*run_);
            use_.notices.add(NoticeKind::kError, saved.error().text());
            stop();
        };
    });
}

void FlatPainting::begin(Run& run) {
    run.child = start_detached(
        {use_.program, "flatten", run.files.snapshot, "--region", std::to_string(run.region), "-o",
         run.picture, "--progress", "json"},
        {kSettingNamesVariable, std::string(kAnswerFileVariable) + "=" + run.files.answer},
        run.files.progress, run.files.log);
    if (run.child > 0) return;
    use_.notices.add(NoticeKind::kError,
                     "Could not be started: " + use_.program + ". Install Weft again.");
    stop();
}

void FlatPainting::stop() {
    if (!run_) return;
    if (run_->child > 0) {
        kill(run_->child, SIGTERM);
        ending_.push_back({run_->child, run_});
    }
    run_->files.remove();
    run_.reset();
}

void FlatPainting::watch() {
    std::erase_if(ending_, [](const Ending& one) {
        if (waitpid(one.process, nullptr, WNOHANG) != one.process) return false;
        if (one.stopped) one.stopped->files.remove();  // what it said in the end
        return true;
    });
    if (!run_ || run_->child <= 0) return;
    if (run_->document != use_.document.id()) return stop();  // of another shot
    int status = 0;
    const bool over = waitpid(run_->child, &status, WNOHANG) == run_->child;
    const double elapsed_s = std::chrono::duration<double>(Clock::now() - run_->begun).count();
    static_cast<void>(run_->progress.read(run_->view, elapsed_s));
    if (!over) return;
    run_->child = -1;
    const std::shared_ptr<Run> run = std::exchange(run_, nullptr);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        take_back(*run);
    else
        use_.notices.add(NoticeKind::kError, failure_of(run->files));
    run->files.remove();
}

// The picture's size and colours are read in the background; the program starts once the document
// shows it, so that nothing is painted on a picture that the document does not take.
void FlatPainting::take_back(const Run& run) {
    use_.tasks.start_for_document([this, id = run.region, picture = run.picture,
                                   program = run.program,
                                   plate = use_.plate.reader()]() -> DocumentTasks::Finish {
        const auto laid = [&]() -> Expected<std::pair<FlatLayout, std::string>> {
            WEFT_TRY(image, read_image(picture));
            WEFT_TRY(layout, flat_layout_of(image.rgb.size(), plate->size()));
            return std::pair(layout, image.color.space);
        }();
        return [this, id, picture, program, laid] {
            const Region* region = region_by_id(use_.document.project(), id);
            if (!region) return;
            if (!laid)
                return use_.notices.add(NoticeKind::kError, fs::path(picture).filename().string() +
                                                                ": " + laid.error().text());
            const std::string dir = use_.document.folder();
            const bool told = use_.document.project().color.texture_space.empty();
            const Region after =
                with_flat_picture(*region, dir.empty() ? picture : relative_to(dir, picture),
                                  laid->first, told ? std::string() : laid->second);
            use_.document.commit(region_edits(*region, after), "Paint flat: " + region->name);
            open_in(program, picture);
        };
    });
}

void FlatPainting::open_in(const PaintProgram& program, const std::string& picture) {
    const pid_t child =
        start_detached({find_program(program.command), picture}, {}, "/dev/null", "/dev/null");
    const std::string file = fs::path(picture).filename().string();
    if (child <= 0)
        return use_.notices.add(NoticeKind::kError, "Could not be started: " + program.command +
                                                        ". Start it yourself and open " + picture +
                                                        ".");
    ending_.push_back({child, nullptr});
    use_.notices.add(NoticeKind::kGood, "Opened " + file + " in " + program.name +
                                            ". What you save there shows here. Neither crop nor "
                                            "scale it.");
}

void FlatPainting::show(SessionView& view) const {
    view.paint_programs = use_.programs;
    if (const std::string& chosen = use_.settings.paint_program; !chosen.empty()) {
        std::erase_if(view.paint_programs,
                      [&](const PaintProgram& one) { return one.command == chosen; });
        view.paint_programs.insert(view.paint_programs.begin(), paint_program_of(chosen));
    }
    view.flattening.reset();
    if (run_)
        view.flattening = FlattenView{run_->region, run_->view.stage, run_->view.done,
                                      run_->view.total, run_->view.left_s};
}

}  // namespace weft
