#pragma once
// An OpenColorIO view on the GPU: the shader that applies it, and its lookup tables.

#include <memory>
#include <string>
#include <vector>

#include "engine/color/screen_view.h"

namespace weft {

/// Needs a current OpenGL 3.3 context during its lifetime; a second context that shares its objects
/// may use it too. Belongs to one thread.
class GlScreen {
  public:
    GlScreen() = default;
    ~GlScreen();
    GlScreen(const GlScreen&) = delete;
    GlScreen& operator=(const GlScreen&) = delete;

    /// Builds the program and tables if the view has changed; null: none. Returns the driver's
    /// error message once, otherwise an empty string.
    [[nodiscard]] std::string prepare(const std::shared_ptr<const ScreenView>& view);
    /// 0 without a view, or if the driver rejects it.
    [[nodiscard]] unsigned program() const { return program_; }
    /// Binds the tables to texture units from 2 on, for the program in use.
    void bind() const;

  private:
    void clear();
    struct Table {
        unsigned id = 0, target = 0;
    };
    std::shared_ptr<const ScreenView> view_;
    std::vector<Table> tables_;
    unsigned program_ = 0;
};

}  // namespace weft
