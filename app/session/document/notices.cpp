#include "app/session/document/notices.h"

#include <utility>

namespace weft {

void Notices::add(NoticeKind kind, std::string text) {
    std::erase_if(all_, [&](const Notice& n) { return n.text == text; });
    all_.push_back({++last_, kind, std::move(text), now_s_});
    constexpr std::size_t kMost = 5;
    if (all_.size() > kMost) all_.erase(all_.begin());
}

void Notices::refuse(std::string text) {
    add(NoticeKind::kWarning, std::move(text));
    all_.back().refusal = true;
}

void Notices::keep_refusals_of(const std::string& now) {
    for (Notice& notice : all_)
        if (notice.refusal && notice.holds_in.empty()) notice.holds_in = now;
    std::erase_if(all_, [&](const Notice& n) { return n.refusal && n.holds_in != now; });
}

void Notices::dismiss(int notice) {
    std::erase_if(all_, [&](const Notice& n) { return n.id == notice; });
}

void Notices::expire() {
    constexpr double kToastSeconds = 6;
    std::erase_if(all_, [&](const Notice& n) {
        return n.kind != NoticeKind::kError && now_s_ - n.at_s > kToastSeconds;
    });
}

}  // namespace weft
