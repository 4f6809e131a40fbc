#pragma once
// Textures that the user chooses for regions. Those of the library are copied beside the project,
// so that it does not need the library.

#include <future>
#include <optional>
#include <string>

#include "app/base/editor_settings.h"
#include "app/session/action.h"
#include "app/session/document/document.h"
#include "app/session/document/document_tasks.h"
#include "app/session/document/notices.h"
#include "app/session/document/shutdowns.h"

namespace weft {

/// Belongs to one thread and never blocks it.
class TextureChoices {
  public:
    /// The references must stay.
    struct Uses {
        Document& document;
        DocumentTasks& tasks;
        Notices& notices;
        Shutdowns& shutdowns;
        EditorSettings& settings;  ///< The recent textures.
        std::string library;       ///< Of textures "db:ID"; empty: the user's own.
        std::string state_folder;  ///< See editor_state_folder().
    };
    explicit TextureChoices(Uses uses) : use_(std::move(uses)) {}

    void apply(const std::string& path, RegionId region);
    /// Textures for several regions in one step of the history.
    void apply_all(const ApplyTextures& action);
    /// The larger picture that the region's sample was cut from; its size on the plate stays.
    void use_larger_original(RegionId region);
    /// Scales the region's texture by the known size of its bricks or tiles: `count` of them lie
    /// along a line of the plate, unsqueezed.
    void scale_by_line(Vec2 line, double count, RegionId region);

    /// A texture of the library is being copied.
    [[nodiscard]] bool busy() const { return fetching_.has_value(); }
    /// Applies one that has been copied. Call it in every update.
    void take();
    /// Another document was opened.
    void forget();

  private:
    struct Fetching {
        std::future<Expected<std::string>> path;
        RegionId region = 0;
    };
    void fetch(const std::string& path, RegionId region);
    [[nodiscard]] std::string folder() const;
    [[nodiscard]] const Region* region(RegionId id) const {
        return region_by_id(use_.document.project(), id);
    }

    Uses use_;
    std::optional<Fetching> fetching_;
};

}  // namespace weft
