#include "app/session/session.h"

#include <utility>

#include "app/session/session_parts.h"

namespace weft {

Session::Session(SessionOptions options, EditorSettings* settings)
    : parts_(std::make_unique<Parts>(std::move(options), settings)) {}

Session::~Session() = default;

void Session::act(const Action& action) {
    parts_->act(action);
}

void Session::act_now(const std::vector<Action>& actions) {
    parts_->act_now(actions);
}

void Session::update(double now_s) {
    parts_->update(now_s);
}

const SessionView& Session::view() const {
    return parts_->view();
}

bool Session::busy() const {
    return parts_->busy();
}

bool Session::works_long() const {
    return parts_->works_long();
}

std::uint64_t Session::changes() const {
    return parts_->changes();
}

void Session::dismiss(int notice) {
    parts_->dismiss(notice);
}

void Session::notify(NoticeKind kind, std::string text) {
    parts_->notify(kind, std::move(text));
}

void Session::set_clock(FrameClock* clock) {
    parts_->set_clock(clock);
}

void Session::flush() {
    parts_->flush();
}

std::string Session::job_log(int id) const {
    return parts_->job_log(id);
}

WriteRule Session::export_rule() const {
    return parts_->export_rule();
}

void Session::close_cleanly() {
    parts_->close_cleanly();
}

const SessionOptions& Session::options() const {
    return parts_->options();
}

}  // namespace weft
