#include "app/session/session_parts.h"

#include <filesystem>
#include <utility>

#include "app/project/codec/project_file.h"
#include "app/session/timeline_marks.h"

namespace weft {

Session::Parts::Parts(SessionOptions options, EditorSettings* settings)
    : options_(std::move(options)),
      settings_(settings ? *settings : own_settings_),
      preview_(options_.cache, options_.texture_library),
      document_((std::filesystem::path(options_.state_folder) / "recovery").string(),
                [this] { shelf_.flush(); }, *this, notices_),
      tasks_(document_),
      files_({document_, tasks_, notices_, shelf_, [this] { end_painting(); },
              options_.texture_library}),
      trust_(options_.trust_file, document_, notices_),
      saving_({document_, selection_, files_, trust_, tasks_, notices_, shelf_, settings_,
               [this] { end_painting(); }, options_.state_folder}),
      opening_({document_, files_, tasks_, notices_, settings_, options_.assets,
                options_.state_folder, options_.offer_recovery}),
      plate_(playback_, shutdowns_, options_.plate_budget_bytes),
      screens_(tasks_, notices_, settings_),
      preview_desk_({preview_, document_, selection_, plate_, playback_, shelf_}),
      strip_({document_, selection_, plate_, playback_, preview_desk_}),
      matte_folder_(document_, options_.state_folder),
      propagated_({document_, shelf_, preview_}),
      shown_mattes_({document_, selection_, plate_, playback_, shelf_, propagated_, painting_}),
      target_({document_, selection_, plate_, playback_, shown_mattes_, notices_}),
      kept_mattes_({document_, selection_, matte_folder_, shelf_, propagated_, notices_}),
      changes_({document_, selection_, plate_, target_, kept_mattes_, notices_, shutdowns_,
                [this] { end_stroke(); }}),
      trial_({target_, plate_, changes_, shutdowns_}),
      strokes_({document_, playback_, target_, painting_, kept_mattes_, changes_, notices_}),
      shapes_({document_, selection_, plate_, playback_, preview_, matte_folder_, kept_mattes_,
               tasks_, notices_}),
      matte_export_({document_, selection_, plate_, playback_, preview_, shelf_, matte_folder_,
                     tasks_, notices_, [this] { end_painting(); }}),
      cryptomatte_({document_, selection_, plate_, playback_, tasks_, notices_}),
      form_check_({document_, plate_, preview_desk_, shown_mattes_}),
      textures_({document_, tasks_, notices_, shutdowns_, settings_, options_.texture_library,
                 options_.state_folder}),
      texture_files_(document_, notices_),
      flat_painting_({document_, plate_, shelf_, tasks_, notices_, settings_,
                      options_.paint_programs, [this] { end_painting(); }, options_.program,
                      options_.state_folder}),
      renders_({document_, plate_, trust_, shelf_, tasks_, notices_, settings_,
                [this] { end_painting(); }, options_.program, options_.state_folder}),
      measurement_({document_, selection_, plate_, preview_, notices_, shutdowns_}) {
    screens_.look();
}

Session::Parts::~Parts() {
    measurement_.end();
    tasks_.drop();
}

Plate Session::Parts::plate() const {
    Plate out = document_.project().plate;
    out.path = resolve_path(document_.folder(), out.path);
    return out;
}

// Nothing of the document before is kept: no picture, no unfinished change, no target.
void Session::Parts::document_replaced() {
    preview_desk_.forget();
    painting_.cancel();
    changes_.forget();
    trial_.end();
    textures_.forget();
    shown_mattes_.forget();
    playback_.reset();
    const ProjectPlace left = place_left(settings_, document_.path());
    playback_.mark(left.in, left.out);
    left_at_ = left.frame;
    selection_ = {};
    strip_.forget();
    measurement_.end();
    view_.report = {};
    files_.forget();
    saving_.forget();
    plate_.forget();
    trust_.judge();
}

void Session::Parts::document_changed() {
    preview_desk_.ask();
    plate_.open(plate());
    selection_.follow(document_.project());
    texture_files_.follow();
}

WriteRule Session::Parts::export_rule() const {
    return export_rule_of(document_.resolved(), document_.path());
}

void Session::Parts::close_cleanly() {
    end_painting();
    files_.cancel_collect();
    shelf_.flush();
    tasks_.finish(true);
    document_.clear_recovery();
    document_.flush_recovery();
    show_answers();
}

void Session::Parts::flush() {
    end_painting();
    shelf_.flush();
    tasks_.finish(true);
    document_.flush_recovery();
    show_answers();
}

bool Session::Parts::busy() const {
    return playback_.direction() != 0 || painting_.active() || changes_.busy() || trial_.busy() ||
           textures_.busy() || plate_.opening() || !tasks_.empty() || preview_desk_.pending() ||
           strip_.busy();
}

bool Session::Parts::works_long() const {
    return measurement_.busy() || flat_painting_.busy();
}

std::uint64_t Session::Parts::changes() const {
    return shelf_.changes() + preview_.changes() + renders_.changes() + plate_.changes() +
           propagated_.changes() + texture_files_.changes();
}

// ---- update() --------------------------------------------------------------------------------

void Session::Parts::update(double now_s) {
    advance(now_s);
    show(now_s);
    painting_.shown();
}

// Not of what is only just opened, nor each frame of what is played.
void Session::Parts::remember_place() {
    if (plate_.opening() || playback_.frames().empty() || playback_.direction() != 0) return;
    const int first = playback_.frames().front(), now = playback_.frame();
    weft::remember_place(settings_, document_.path(),
                         {playback_.mark_in(), playback_.mark_out(),
                          now == first ? std::nullopt : std::optional(now)});
}

void Session::Parts::advance(double now_s) {
    enter("files");
    tasks_.finish(false);
    enter("plate");
    shutdowns_.clear_ended();
    if (plate_.take()) {
        const auto left_at = std::exchange(left_at_, std::nullopt);
        if (const auto frame = opening_.take_first_frame())
            (void)playback_.go_to(*frame);
        else if (left_at)
            (void)playback_.go_to(*left_at);
        preview_desk_.ask();
        document_.touch();
    }
    remember_place();
    notices_.set_time(now_s);
    opening_.find_more_recoverable(now_s);
    plate_.advance(now_s);
    enter("mattes");
    advance_mattes();
    textures_.take();
    flat_painting_.watch();
    view_.saved_textures = texture_files_.take();
    if (!view_.saved_textures.empty()) preview_desk_.show_files(texture_files_.version());
    enter("preview");
    if (preview_desk_.pending() && !painting_.active())
        preview_desk_.request(now_s, strip_.requests());
    enter("notices");
    notice_errors();
}

void Session::Parts::advance_mattes() {
    changes_.take();
    trial_.take();
    strokes_.update();
    painting_.update();
    // Results from in-memory mattes may now be filed under the names of their files.
    if (kept_mattes_.were_written()) preview_desk_.ask();
}

void Session::Parts::notice_errors() {
    if (const std::string error = shelf_.take_write_error(); !error.empty())
        notices_.add(NoticeKind::kError, error);
    if (const std::string error = document_.take_recovery_error(); !error.empty())
        notices_.add(NoticeKind::kError, "Cannot write the autosave. " + error);
    std::string now = std::to_string(document_.made()) + " " + std::to_string(document_.redos()) +
                      " " + std::to_string(playback_.frame()) + " " +
                      std::to_string(selection_.region) + " " + std::to_string(selection_.layer);
    for (const RegionId locked : selection_.locked)
        now += " " + std::to_string(locked);
    notices_.keep_refusals_of(now);
    notices_.expire();
}

// ---- the view --------------------------------------------------------------------------------

void Session::Parts::show(double now_s) {
    enter("document");
    view_.now_s = now_s;
    view_.selected = selection_.region;
    view_.solo = selection_.solo;
    view_.locked.assign(selection_.locked.begin(), selection_.locked.end());
    document_.show(view_);
    opening_.show(view_);
    files_.show_collecting(view_);
    enter("plate");
    plate_.update(plate());
    plate_.show_frame(view_);
    show_answers();
    enter("mattes");
    show_mattes();
    enter("preview");
    preview_desk_.read();
    preview_desk_.show(view_);
    form_check_.show(view_);
    measurement_.show(view_);
    enter("strip");
    shapes_.show(view_);
    strip_.update(painting_.active(), view_.strip);
    enter("marks");
    show_marks(plate_.states(), preview_desk_.reading(), view_);
    view_.to_correct = suggested_corrections(view_);
    enter("jobs");
    renders_.watch();
    renders_.show(view_);
    flat_painting_.show(view_);
    preview_.set_render_paused(
        std::any_of(view_.jobs.begin(), view_.jobs.end(),
                    [](const JobView& job) { return job.state == JobState::kPaused; }));
    view_.notices = notices_.all();
}

void Session::Parts::show_answers() {
    plate_.show(view_);
    screens_.show(view_);
    files_.show(view_);
    saving_.show(view_);
    trust_.show(view_);
}

void Session::Parts::show_mattes() {
    view_.painting = painting_.active();
    changes_.show(view_);
    if (document_.is_open()) selection_.keep_layer(document_.project());
    shown_mattes_.show(view_);
    const bool still = preview_desk_.read_frame() == playback_.frame();
    if (document_.is_open() && still && !changes_.busy()) strokes_.prepare(view_);
    trial_.show(view_);
}

}  // namespace weft
