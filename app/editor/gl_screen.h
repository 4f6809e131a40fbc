#pragma once
// A view of OpenColorIO on the graphics card: the program that shows pictures through it, and its
// tables.

#include <memory>
#include <string>
#include <vector>

#include "engine/color/screen_view.h"

namespace weft {

/// Needs a current OpenGL 3.3 context for its whole life; a second context that shares its objects
/// may use it too. One thread.
class GlScreen {
  public:
    GlScreen() = default;
    ~GlScreen();
    GlScreen(const GlScreen&) = delete;
    GlScreen& operator=(const GlScreen&) = delete;

    /// Makes the program and the tables of another view than the last one; null: none. The answer:
    /// what the driver says against it, once.
    [[nodiscard]] std::string prepare(const std::shared_ptr<const ScreenView>& view);
    /// 0 while there is no view, or the driver does not take it.
    [[nodiscard]] unsigned program() const { return program_; }
    /// Tables to the texture units from 2 on, for the program in use.
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
