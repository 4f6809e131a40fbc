// An untrusted project must not write outside its folder.
#include <filesystem>

#include "app/base/trust.h"
#include "app/project/codec/project_file.h"
#include "app/session/session.h"

namespace weft {

// A document created here is trusted.
void Session::update_trust(bool from_file) {
    const TrustList list(options_.trust_file);
    untrusted_ = from_file && !list.trusts(path_);
    view_.trust.reset();
    offer_trust();
}

void Session::offer_trust() {
    if (!untrusted_) return;
    if (const auto outside = outputs_outside(resolved(), path_); !outside.empty())
        view_.trust = TrustOffer{project_dir(path_), outside.front()};
}

void Session::answer_trust(bool trust) {
    view_.trust.reset();
    if (!trust || !untrusted_) return;
    if (const auto added = TrustList(options_.trust_file).add(project_dir(path_), false); !added) {
        notify(NoticeKind::kError, added.error().text());
        return;
    }
    untrusted_ = false;
    notify(NoticeKind::kGood, "Trusted " + project_dir(path_) + ".");
}

// Outputs that the user chose in the editor are allowed.
bool Session::may_render_to(const Project& chosen) {
    if (!untrusted_) return true;
    const Project own = resolved();
    NamedByUser by_user;
    by_user.frames = chosen.output.path != own.output.path;
    by_user.layers = chosen.output.layers_path != own.output.layers_path;
    by_user.movie = chosen.output.movie != own.output.movie;
    if (check_trust(chosen, path_, by_user, TrustList(options_.trust_file))) return true;
    offer_trust();
    notify(NoticeKind::kError,
           "This project writes to " + outputs_outside(chosen, path_).front() +
               ", outside its folder. Trust its folder, or choose another output.");
    return false;
}

// Trusts the folder of a project that was created here and writes outside its folder.
void Session::trust_saved() {
    if (untrusted_ || options_.trust_file.empty() || outputs_outside(resolved(), path_).empty())
        return;
    TrustList list(options_.trust_file);
    if (list.trusts(path_)) return;
    if (const auto added = list.add(project_dir(path_), false); !added)
        notify(NoticeKind::kWarning, added.error().text());
}

}  // namespace weft
