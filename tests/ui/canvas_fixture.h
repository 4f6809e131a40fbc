#pragma once
// Panels with a tool on the canvas.

#include "tests/ui/ui_harness.h"
#include "ui/canvas/view_map.h"

namespace weft::test {

class CanvasTest : public PanelTest {
  protected:
    /// Where a place of the picture is on the screen; 0, 0 while there is no canvas.
    ImVec2 on(float x, float y) const {
        const DrawnItem* canvas = robot->find("Viewer/Canvas");
        if (!canvas) return {0, 0};
        const ViewerState& s = shell->state().viewer;
        return ViewMap{canvas->min, canvas->max, s.center, s.zoom, s.aspect}.to_screen({x, y});
    }
    /// The edits of a kind that were done.
    template <class T>
    std::vector<T> edits() const {
        std::vector<T> out;
        for (const DoEdit& one : emitted<DoEdit>())
            if (const T* edit = std::get_if<T>(&one.edit)) out.push_back(*edit);
        return out;
    }
    void click_at(ImVec2 at) {
        robot->move(at);
        robot->press();
        robot->release();
        robot->frames();
    }
    /// Opens a workspace with a tool in hand and forgets what that emitted.
    void go(const char* workspace, Tool tool) {
        robot->frames(2);
        ASSERT_TRUE(robot->click(std::string("Top/") + workspace));
        shell->state().tool = tool;
        robot->frames(2);
        clear();
    }
};

}  // namespace weft::test
