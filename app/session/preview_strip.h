#pragma once
// A row of small results side by side: several frames of a shot, or one frame with several textures
// or settings.

#include <future>
#include <string>
#include <vector>

#include "app/session/preview.h"

namespace weft {

struct StripCard {
    std::string label;
    int frame = 0;
    PicturePtr picture;  ///< Null while it is being made.
    std::string error;   ///< Why it cannot be.
};

/// Makes the cards one after the other with a preview of its own. Belongs to one thread, which it
/// never keeps waiting.
class PreviewStrip {
  public:
    struct Wish {
        std::string label;
        Project project;  ///< As in PreviewRequest.
        int frame = 0;
    };

    explicit PreviewStrip(AnalysisCacheOptions cache);
    /// Replaces what was wanted before; cards whose pixels stay the same are kept.
    void want(std::vector<Wish> wishes);
    /// Takes in what is done. `may_begin`: nothing more urgent is being worked on.
    void update(bool may_begin);
    [[nodiscard]] const std::vector<StripCard>& cards() const { return cards_; }
    [[nodiscard]] bool busy() const;
    [[nodiscard]] std::uint64_t news() const { return preview_.news(); }

  private:
    void take();
    static constexpr int kLongest_px = 480;

    Preview preview_;
    std::vector<Wish> wishes_;
    std::vector<std::string> keys_;  // of the wishes' pixels
    std::vector<StripCard> cards_;
    int at_ = -1;             // the card under way
    bool requested_ = false;  // … and the preview knows of it
    PreviewReading reading_;
    std::future<PicturePtr> shrinking_;
    std::string shrinking_key_;
};

}  // namespace weft
