#include "app/session/document/document_trust.h"

#include "app/base/trust.h"

namespace weft {

void DocumentTrust::judge() {
    untrusted_ = !document_.path().empty() && !TrustList(trust_file_).trusts(document_.path());
    offer_.reset();
    offer();
}

void DocumentTrust::offer() {
    if (!untrusted_) return;
    if (const auto outside = outputs_outside(document_.resolved(), document_.path());
        !outside.empty())
        offer_ = TrustOffer{document_.folder(), outside.front()};
}

void DocumentTrust::answer(bool trust) {
    offer_.reset();
    if (!trust || !untrusted_) return;
    if (const auto added = TrustList(trust_file_).add(document_.folder(), false); !added) {
        notices_.add(NoticeKind::kError, added.error().text());
        return;
    }
    untrusted_ = false;
    notices_.add(NoticeKind::kGood, "Trusted " + document_.folder() + ".");
}

bool DocumentTrust::may_render_to(const Project& chosen) {
    if (!untrusted_) return true;
    const Project own = document_.resolved();
    NamedByUser by_user;
    by_user.frames = chosen.output.path != own.output.path;
    by_user.layers = chosen.output.layers_path != own.output.layers_path;
    by_user.movie = chosen.output.movie != own.output.movie;
    if (check_trust(chosen, document_.path(), by_user, TrustList(trust_file_))) return true;
    offer();
    notices_.add(NoticeKind::kError,
                 "This project writes to " + outputs_outside(chosen, document_.path()).front() +
                     ", outside its folder. Trust its folder, or choose another output.");
    return false;
}

void DocumentTrust::trust_saved() {
    if (untrusted_ || trust_file_.empty() ||
        outputs_outside(document_.resolved(), document_.path()).empty())
        return;
    TrustList list(trust_file_);
    if (list.trusts(document_.path())) return;
    if (const auto added = list.add(document_.folder(), false); !added)
        notices_.add(NoticeKind::kWarning, added.error().text());
}

}  // namespace weft
