#include "app/editor/editor_app.h"

#include <time.h>

#include <algorithm>
#include <filesystem>

#include "app/base/trust.h"
#include "engine/core/stopwatch.h"
#include "texture_db/library/library.h"

namespace weft {
namespace {

SessionOptions session_options(const EditorOptions& options) {
    SessionOptions out;
    out.program = options.program;
    out.assets = options.assets;
    out.texture_library = options.texture_library;
    out.state_folder = editor_state_folder();
    out.trust_file = TrustList::of_user().file();
    // What a script shows does not depend on what is installed.
    out.paint_programs = options.script.empty() ? installed_paint_programs()
                                                : std::vector{paint_program_of("krita")};
    out.offer_recovery = options.script.empty();
    return out;
}

double thread_cpu_ms() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

bool watchdog_wanted() {
#ifndef NDEBUG
    return true;
#else
    return std::getenv("WEFT_WATCHDOG") != nullptr;
#endif
}

}  // namespace

EditorApp::EditorApp(const EditorOptions& options)
    : options_(options), settings_path_(editor_settings_path()), clock_(watchdog_wanted()) {
    settings_ = load_editor_settings(settings_path_);
    if (options_.light) settings_.dark = false;
    saved_settings_ = settings_;
    session_ = std::make_unique<Session>(session_options(options_), &settings_);
    shell_ = std::make_unique<Shell>(settings_, pictures_);
    pictures_.on_problem = [this](std::string words) {
        session_->notify(NoticeKind::kWarning, std::move(words));
    };
    session_->set_clock(&clock_);
    shell_->set_clock(&clock_);
    shell_->textures().open_library(options_.texture_library.empty() ? default_library_path()
                                                                     : options_.texture_library);
    shell_->act_now = [this](const std::vector<Action>& all) { session_->act_now(all); };
    shell_->job_log = [this](int id) { return session_->job_log(id); };
    shell_->notify = [this](NoticeKind kind, std::string text) {
        session_->notify(kind, std::move(text));
    };
    shell_->dismiss_notice = [this](int id) { session_->dismiss(id); };
}

EditorApp::~EditorApp() = default;

Status EditorApp::start() {
    WEFT_CHECK_OK(pictures_.make_shaders());
    if (options_.paused) session_->act(PauseAnalysis{true});
    if (options_.demo) session_->act(OpenDemo{});
    if (!options_.project.empty()) session_->act(OpenAny{options_.project});
    return {};
}

bool EditorApp::update_look(double monitor_scale) {
    const double scale = options_.ui_scale > 0    ? options_.ui_scale
                         : settings_.ui_scale > 0 ? settings_.ui_scale
                                                  : monitor_scale;
    if (scale == scale_ && dark_ == settings_.dark && grey_ == settings_.grey_surround)
        return false;
    const bool fonts = scale != scale_;
    scale_ = scale;
    dark_ = settings_.dark;
    grey_ = settings_.grey_surround;
    shell_->set_look(dark_, grey_, static_cast<float>(std::clamp(scale, 0.75, 4.0)));
    return fonts;
}

void EditorApp::frame(double now_s) {
    const auto start = Clock::now();
    const double cpu_start_ms = thread_cpu_ms();
    clock_.enter("pictures");
    pictures_.begin_frame();
    clock_.enter("folders");
    std::vector<std::string> folders = settings_.texture_folders;
    for (const char* own : {"textures", "demo/textures"}) {
        const std::string path = (std::filesystem::path(options_.assets) / own).string();
        folders.push_back(path);
    }
    shell_->textures().scan(std::move(folders));
    session_->update(now_s);
    clock_.enter("ImGui");
    ImGui::NewFrame();
    const std::vector<Action> actions = shell_->draw(session_->view());
    clock_.enter("ImGui");
    ImGui::Render();
    clock_.enter("actions");
    for (const Action& action : actions)
        session_->act(action);
    clock_.enter("settings");
    // Settings are small: compare and write them every 2 s.
    if (now_s - settings_checked_s_ > 2) {
        settings_checked_s_ = now_s;
        if (!(settings_ == saved_settings_) && options_.script.empty()) {
            saved_settings_ = settings_;
            if (const Status saved = save_editor_settings(settings_path_, settings_); !saved)
                session_->notify(NoticeKind::kWarning, saved.error().text());
        }
    }
    times_.last_ms = 1000.0 * seconds_since(start);
    times_.worst_ms = std::max(times_.worst_ms, times_.last_ms);
    times_.sum_ms += times_.last_ms;
    const double cpu_ms = thread_cpu_ms() - cpu_start_ms;
    times_.cpu_worst_ms = std::max(times_.cpu_worst_ms, cpu_ms);
    times_.cpu_sum_ms += cpu_ms;
    ++times_.frames;
}

void EditorApp::watch() const {
    constexpr double kLongest = 30;
    if (!clock_.on() || clock_.wall_ms() < kLongest) return;
    std::fprintf(stderr, "weft: %s\n", clock_.text().c_str());
}

bool EditorApp::waits() const {
    return session_->busy() || shell_->waiting() || pictures_.pending();
}

bool EditorApp::works_long() const {
    return session_->works_long();
}

bool EditorApp::idle() const {
    return !waits() && !works_long();
}

std::uint64_t EditorApp::changes() const {
    return session_->changes() + shell_->textures().changes();
}

void EditorApp::close() {
    session_->close_cleanly();
    if (options_.script.empty()) (void)save_editor_settings(settings_path_, settings_);
}

}  // namespace weft
