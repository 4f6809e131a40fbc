// Random input for a minute: nothing may crash, and the document stays one that can be saved and
// read again.
#include <chrono>
#include <random>
#include <thread>

#include "app/project/codec/project_json.h"
#include "tests/ui/ui_harness.h"

namespace weft::test {
namespace {

class Fuzz : public SessionTest {};

TEST_F(Fuzz, AMinuteOfRandomInput) {
    session->act(OpenAny{(folder / "frames").string()});
    ASSERT_TRUE(wait([&] { return session->view().plate_picture != nullptr; }));
    const unsigned seed = std::random_device{}();
    RecordProperty("seed", static_cast<int>(seed));
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    ImGuiIO& io = ImGui::GetIO();
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    for (int step = 0; std::chrono::steady_clock::now() < end; ++step) {
        switch (pick(8)) {
            case 0:
                io.MousePos = {static_cast<float>(pick(1600)), static_cast<float>(pick(900))};
                break;
            case 1:
                io.MouseDown[pick(3)] = pick(2) == 0;
                break;
            case 2: {
                const auto& all = shell->commands().all();
                const Command& command =
                    all[static_cast<std::size_t>(pick(static_cast<int>(all.size())))];
                if (command.id != "file.quit") robot->key(chord_text(command.key));
                break;
            }
            case 3:
                io.MouseWheel = static_cast<float>(pick(5) - 2);
                break;
            case 4:
                io.AddInputCharacter(static_cast<unsigned>(32 + pick(90)));
                break;
            case 5:
                if (!shell->items().empty()) {
                    const DrawnItem item = shell->items()[static_cast<std::size_t>(
                        pick(static_cast<int>(shell->items().size())))];
                    io.MousePos = {(item.min.x + item.max.x) / 2, (item.min.y + item.max.y) / 2};
                    io.MouseDown[0] = true;
                    frame();
                    io.MouseDown[0] = false;
                }
                break;
            case 6:
                io.KeyAlt = pick(4) == 0;
                io.KeyShift = pick(4) == 0;
                break;
            default:
                io.MousePos = {io.MousePos.x + static_cast<float>(pick(41) - 20),
                               io.MousePos.y + static_cast<float>(pick(41) - 20)};
        }
        frame();
        io.MouseWheel = 0;
        shell->state().leave = false;
        if (step % 500 == 0) {
            const auto text = project_to_json(session->view().project);
            ASSERT_TRUE(text) << text.error().text();
            const auto again = project_from_json(*text);
            ASSERT_TRUE(again) << again.error().text();
            EXPECT_EQ(*again, session->view().project);
        }
    }
}

}  // namespace
}  // namespace weft::test
