#pragma once
// An untrusted project must not write outside its folder.

#include <optional>
#include <string>

#include "app/session/document/document.h"
#include "app/session/document/notices.h"
#include "app/session/session_view.h"

namespace weft {

/// Belongs to one thread.
class DocumentTrust {
  public:
    /// `trust_file`: of the TrustList; empty: no project file is trusted. The references must stay.
    DocumentTrust(std::string trust_file, const Document& document, Notices& notices)
        : trust_file_(std::move(trust_file)), document_(document), notices_(notices) {}

    /// Another document was opened. One that was created here is trusted.
    void judge();
    /// Answers SessionView::trust.
    void answer(bool trust);
    /// `chosen`: the document with the outputs of a render, with absolute paths. Outputs that the
    /// user chose in the editor are allowed; otherwise the trust is offered.
    [[nodiscard]] bool may_render_to(const Project& chosen);
    /// Trusts the folder of a project that was created here and writes outside its folder.
    void trust_saved();
    void show(SessionView& view) const { view.trust = offer_; }

  private:
    void offer();

    const std::string trust_file_;
    const Document& document_;
    Notices& notices_;
    bool untrusted_ = false;  // the document came from an untrusted folder
    std::optional<TrustOffer> offer_;
};

}  // namespace weft
