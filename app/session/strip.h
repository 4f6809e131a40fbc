#pragma once
// The strip of small results: what its cards show, and what choosing one does.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/base/latest_worker.h"
#include "app/preview/preview.h"
#include "app/session/action.h"

namespace weft {

/// What the cards of a strip depend on.
struct StripQuery {
    std::uint64_t document = 0;  ///< Its version: stands for the project.
    StripKind kind = StripKind::kNone;
    bool over_time = false;
    std::vector<std::string> textures;
    RegionId region = 0;
    int frame = 0;            ///< The present one; 0 for kinds that show others.
    std::vector<int> frames;  ///< That are shown instead.
    bool operator==(const StripQuery&) const = default;

    /// Settings against frames.
    [[nodiscard]] bool is_sheet() const { return over_time && compares_settings(kind); }
};

struct StripCards {
    StripQuery question;
    std::vector<CardRequest> requests;
    /// What choosing a card does, one each; nothing for the setting as it is.
    std::vector<std::optional<Action>> choices;
    int columns = 0;  ///< As StripView::columns.
};

/// What a question is about.
struct StripSubject {
    Project project;     ///< As in PreviewRequest.
    bool shown = false;  ///< The artist shows the region, also where the project above cannot yet.
    std::string folder;  ///< Of the document: where textures with relative paths lie.
};

/// Takes some milliseconds a card.
[[nodiscard]] StripCards make_strip_cards(const StripQuery& question, const StripSubject& subject);

/// Four frames that tell how a shot goes: 1, 10, 20 and 40 as far as there are any, or evenly over
/// `first` … `last` (indices, inclusive) where `marked`.
[[nodiscard]] std::vector<int> strip_frames(const std::vector<int>& frames, int first, int last,
                                            bool marked);
/// As many as tell two settings apart, evenly over the range.
[[nodiscard]] std::vector<int> sheet_frames(const std::vector<int>& frames, int first, int last);

/// Works the cards out in the background; the newest question wins. One thread.
class Strip {
  public:
    /// Chooses what is shown.
    void show(StripKind kind, std::vector<std::string> textures, bool over_time);
    [[nodiscard]] StripKind kind() const { return kind_; }
    [[nodiscard]] bool over_time() const { return over_time_; }
    [[nodiscard]] const std::vector<std::string>& textures() const { return textures_; }

    /// Whether this very question was asked last.
    [[nodiscard]] bool asked(const StripQuery& question) const { return asked_ == question; }
    /// Asks for the cards; asking the same again does nothing.
    void ask(const StripQuery& question, StripSubject subject);
    /// Takes in what has been worked out. Whether the cards are others than before.
    bool update();
    /// Nothing can be shown. Whether there were cards.
    bool clear();
    /// The cards for the kind that is shown; null while they are worked out.
    [[nodiscard]] std::shared_ptr<const StripCards> cards() const;
    /// Whether cards are being worked out.
    [[nodiscard]] bool busy() const { return worker_.busy(); }

  private:
    StripKind kind_ = StripKind::kNone;
    bool over_time_ = false;
    std::vector<std::string> textures_;
    std::optional<StripQuery> asked_;
    std::shared_ptr<const StripCards> cards_;
    LatestWorker<StripQuery, StripCards> worker_;
};

}  // namespace weft
