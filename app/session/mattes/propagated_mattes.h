#pragma once
// The matte of a frame to which a layer is propagated: as it is, or as it was seen last.

#include <atomic>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "app/base/latest_worker.h"
#include "app/mattes/matte_shelf.h"
#include "app/preview/preview.h"
#include "app/session/document/document.h"

namespace weft {

/// What is known of a propagated matte.
struct PropagatedMatte {
    MattePtr matte;        ///< Null: it is being read, or not known.
    bool current = false;  ///< `matte` is of the document as it is, and final.
    bool reached = true;   ///< False: it has not been propagated to the frame yet.
    std::string name;      ///< Of `matte` on the shelf.
    /// As long as this is the key of all else that it depends on, what is painted on it stays
    /// right, whatever is confirmed on its frame. Empty: not known.
    std::string depends_on;
};

/// Belongs to one thread and never blocks it.
class PropagatedMattes {
  public:
    /// The references must stay.
    struct Uses {
        const Document& document;
        MatteShelf& shelf;
        const Preview& preview;
    };
    explicit PropagatedMattes(Uses uses) : use_(uses) {}

    /// Until it is propagated again, it is the newest that was seen there. Mattes are read with
    /// `size`, the plate's.
    [[nodiscard]] PropagatedMatte find(const Region& region, int layer, int frame, Size size);
    /// The file `path`, a ConfirmedEdge's, has the whole matte as its strokes have left it: what a
    /// further stroke goes on from, at whatever time the frame is propagated again. `depends_on`:
    /// of the matte that they were painted on.
    void painted_on(const std::string& path, const std::string& depends_on) {
        if (!depends_on.empty()) painted_on_[path] = depends_on;
    }
    /// The frames to which it is propagated, as far as is known; read in the background.
    [[nodiscard]] std::vector<int> reached(const Region& region, int layer);
    /// Increases when that was read. Thread-safe.
    [[nodiscard]] std::uint64_t changes() const { return changes_.load(); }
    /// Another document was opened.
    void forget();

  private:
    struct Keys {
        std::string all, others;  // others: without what is confirmed on the frame
    };
    struct Seen {
        std::string name, depends_on;
    };
    struct Held {
        std::string name;
        MattePtr matte;
    };
    using Where = std::tuple<RegionId, int, int>;  // region, layer, frame
    [[nodiscard]] const Keys& keys_of(const Region& region, int layer, int frame);
    [[nodiscard]] MattePtr propagated(const std::string& name, const WantedMatte& wanted);
    [[nodiscard]] MattePtr file(const std::string& path, const MatteSelect& select, Size size);

    Uses use_;
    std::uint64_t version_ = 0;  // of the document, of which these are:
    std::map<Where, Keys> keys_;
    std::optional<Project> absolute_;

    std::map<std::string, std::string> painted_on_;  // path → depends_on
    std::map<Where, Seen> seen_;                     // the last current one
    /// By region and layer: the last one is there however many strokes the shelf was given since.
    std::map<std::pair<RegionId, int>, Held> held_;
    std::map<std::string, std::uint64_t> missed_;  // name → matte_version() when it failed

    struct Reached {
        std::string key;
        std::vector<int> frames;
    };
    std::atomic<std::uint64_t> changes_{0};
    LatestWorker<std::pair<std::string, std::uint64_t>, Reached> reader_{[this] { ++changes_; }};
};

}  // namespace weft
