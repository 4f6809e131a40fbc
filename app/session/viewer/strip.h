#pragma once
// The strip of small results: builds its cards and the actions of choosing them.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/base/latest_worker.h"
#include "app/preview/preview.h"
#include "app/session/action.h"

namespace weft {

/// Everything that the cards of a strip depend on.
struct StripQuery {
    std::uint64_t document = 0;  ///< Version of the document; identifies the project.
    StripKind kind = StripKind::kNone;
    bool over_time = false;
    std::vector<std::string> textures;
    RegionId region = 0;
    int frame = 0;            ///< The current frame; 0 for kinds that show other frames.
    std::vector<int> frames;  ///< Frames shown instead.
    bool operator==(const StripQuery&) const = default;

    /// Returns true for a sheet of settings by frames.
    [[nodiscard]] bool is_sheet() const { return over_time && compares_settings(kind); }
};

struct StripCards {
    StripQuery question;
    std::vector<CardRequest> requests;
    /// The action of choosing each card; nothing for the current setting.
    std::vector<std::optional<Action>> choices;
    int columns = 0;  ///< As StripView::columns.
};

/// The project and region of a query.
struct StripSubject {
    Project project;     ///< As in PreviewRequest.
    bool shown = false;  ///< The region is shown, even if `project` cannot render it yet.
    std::string folder;  ///< Folder of the document, for textures with relative paths.
};

/// Builds the cards; takes some milliseconds per card.
[[nodiscard]] StripCards make_strip_cards(const StripQuery& question, const StripSubject& subject);

/// Four representative frames: 1, 10, 20 and 40 where they exist, or evenly over `first` … `last`
/// (indices, inclusive) if `marked`.
[[nodiscard]] std::vector<int> strip_frames(const std::vector<int>& frames, int first, int last,
                                            bool marked);
/// The frames of a contact sheet, evenly over the range.
[[nodiscard]] std::vector<int> sheet_frames(const std::vector<int>& frames, int first, int last);

/// Builds the cards in the background; the newest query wins. Belongs to one thread.
class Strip {
  public:
    /// Sets what is shown.
    void show(StripKind kind, std::vector<std::string> textures, bool over_time);
    [[nodiscard]] StripKind kind() const { return kind_; }
    [[nodiscard]] bool over_time() const { return over_time_; }
    [[nodiscard]] const std::vector<std::string>& textures() const { return textures_; }

    /// Returns true if this was the last query.
    [[nodiscard]] bool asked(const StripQuery& question) const { return asked_ == question; }
    /// Requests the cards; repeating a request does nothing.
    void ask(const StripQuery& question, StripSubject subject);
    /// Collects finished cards. Returns true if they changed.
    bool update();
    /// Clears the cards. Returns true if there were any.
    bool clear();
    /// The cards of the current kind; null until they are ready.
    [[nodiscard]] std::shared_ptr<const StripCards> cards() const;
    /// Returns true while cards are being built.
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
