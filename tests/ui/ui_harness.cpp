#include "tests/ui/ui_harness.h"

#include <unistd.h>

#include "app/base/background.h"
#include "app/render/render_job.h"
#include "engine/media/frame_writer.h"
#include "ui/canvas/view_map.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;

void make_context(ImVec2 size) {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = size;
    io.DeltaTime = 1.0f / 60.0f;
    const std::pair<ImGuiKey, int> keys[] = {
        {ImGuiKey_Tab, 258},   {ImGuiKey_LeftArrow, 263}, {ImGuiKey_RightArrow, 262},
        {ImGuiKey_Home, 268},  {ImGuiKey_End, 269},       {ImGuiKey_Delete, 261},
        {ImGuiKey_Enter, 257}, {ImGuiKey_Escape, 256},    {ImGuiKey_Backspace, 259},
        {ImGuiKey_A, 65},      {ImGuiKey_Z, 90}};
    for (const auto& [name, key] : keys)
        io.KeyMap[name] = key;
}

void make_fonts() {
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
    ImGui::GetIO().Fonts->SetTexID(reinterpret_cast<ImTextureID>(std::uintptr_t{1}));
}

ImageF3 card(int step) {
    ImageF3 out(96, 64, 0.2f);
    for (int y = 16; y < 48; ++y)
        for (int x = 24 + step; x < 64 + step; ++x) {
            const float v = 0.5f + 0.2f * static_cast<float>((x - step + y) % 7) / 7.0f;
            float* p = out.pixel(x, y);
            p[0] = v;
            p[1] = 0.8f * v;
            p[2] = 0.4f;
        }
    return out;
}

}  // namespace

// ---- panels on a made view -------------------------------------------------------------------

void PanelTest::SetUp() {
    make_context(size);
    shell = std::make_unique<Shell>(settings, pictures);
    shell->set_look(true, false, 1);
    make_fonts();
    robot = std::make_unique<Robot>(*shell, [this] { frame(); });
    view = normal_view();
}

void PanelTest::TearDown() {
    robot.reset();
    shell.reset();
    ImGui::DestroyContext();
}

void PanelTest::frame() {
    pictures.pictures.clear();
    ImGui::NewFrame();
    std::vector<Action> now = shell->draw(view);
    ImGui::Render();
    actions.insert(actions.end(), now.begin(), now.end());
}

SessionView normal_view() {
    SessionView v;
    v.open = true;
    v.title = "Shot";
    v.path = "/shots/shot.weft";
    v.project.name = "Shot";
    for (int k = 1; k <= 2; ++k) {
        Region region;
        region.id = static_cast<RegionId>(k);
        region.name = k == 1 ? "wall" : "cape";
        region.color = k - 1;
        MatteSource matte;
        matte.keyframes[1003] = {"m.png", {}};
        region.matte = matte;
        if (k == 1) region.texture.sample = "/textures/brick.png";
        v.project.regions.emplace_back(region);
    }
    v.project.next_region_id = 3;
    v.selected = 1;
    v.unready[2] = "Choose a texture for it";
    v.plate.state = PlateView::State::kOpen;
    v.plate.size = {320, 180};
    v.plate.space = "srgb";
    v.plate.depth = "8 bit";
    for (int f = 1001; f <= 1010; ++f)
        v.plate.frames.push_back(f);
    v.frame = 1003;
    v.marks.resize(10);
    v.marks[2] = {true, true, false, true, true, 1};
    v.marks[5].confidence = 0.4f;
    v.plate_picture = make_picture(ImageU8x3(320, 180, 90));
    v.result_picture = make_picture(ImageU8x3(320, 180, 120));
    v.result_current = v.result_wanted = true;
    v.history = {"", "Set placement.scale of wall"};
    v.history_position = 1;
    v.undo_label = v.history[1];
    JobView job;
    job.id = 1;
    job.state = JobState::kRunning;
    job.label = "Shot, frames 1001-1010";
    job.output = "/out/####.png";
    job.stage = WorkStage::kRender;
    job.done = 3;
    job.total = 10;
    v.jobs.push_back(job);
    return v;
}

SessionView failing_view() {
    SessionView v = normal_view();
    v.plate.state = PlateView::State::kFailed;
    v.plate.error = "The plate frames/####.png has no files. Check the pattern.";
    v.plate.frames.clear();
    v.plate.size = {};
    v.marks.clear();
    v.plate_picture.reset();
    v.result_picture.reset();
    v.result_current = false;
    v.frame_error = "Frame 1003 is missing in frames/####.png.";
    v.preview.state = PreviewView::State::kFailed;
    v.preview.error = "The texture /textures/brick.png is no picture.";
    v.jobs[0].state = JobState::kFailed;
    v.jobs[0].error = "The disk is full.";
    v.report.state = QualityReport::State::kFailed;
    v.report.error = "There are no frames to measure.";
    v.notices.push_back({1, NoticeKind::kError, "The project could not be saved.", 0});
    v.recovery = RecoveryOffer{"/shots/shot.weft", "21 November at 14:02"};
    v.trust = TrustOffer{"/shots", "/elsewhere/out/####.png"};
    return v;
}

SessionView huge_view() {
    SessionView v = normal_view();
    v.project.regions.clear();
    for (int k = 1; k <= 60; ++k) {
        Region region;
        region.id = static_cast<RegionId>(k);
        region.name =
            "A region with a name that is much too long for its row, number " + std::to_string(k);
        region.texture.sample = "/a/very/long/path/" + std::string(200, 'x') + ".png";
        for (int f = 0; f < 40; ++f)
            region.reference_frames.push_back(1001 + 20 * f);
        v.project.regions.emplace_back(region);
    }
    v.plate.frames.clear();
    for (int f = 1001; f <= 2000; ++f)
        v.plate.frames.push_back(f);
    v.marks.assign(1000, {true, true, false, true, true, 0.5f});
    v.plate.size = {16, 9};
    v.jobs.assign(40, v.jobs[0]);
    for (int k = 0; k < 40; ++k)
        v.jobs[static_cast<std::size_t>(k)].id = k + 1;
    v.history.assign(500, "Set placement.scale of a region whose name is long");
    v.history_position = 250;
    v.report.state = QualityReport::State::kDone;
    for (const int frame : v.plate.frames)
        v.report.rows.push_back({frame, {}, 1, 2, 3, 4});
    for (int k = 0; k < 5; ++k)
        v.notices.push_back({k + 1, NoticeKind::kWarning, std::string(400, 'w'), 0});
    return v;
}

// ---- the real session ------------------------------------------------------------------------

void SessionTest::SetUp() {
    keep_thread_priority();
    make_libraries_deterministic();  // as the program does before all else
    std::string name = (fs::temp_directory_path() / "weft_ui_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder = name;
    fs::create_directory(folder / "frames");
    for (int k = 0; k < 4; ++k) {
        const std::string file = (folder / "frames" / ("000" + std::to_string(k + 1) + ".png"));
        ASSERT_TRUE(write_image(file, card(k), {}, {}));
    }
    ImageF3 tile(96, 96, 0.4f);
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 96; ++x)
            tile.pixel(x, y)[0] = static_cast<float>((x * 7 + y * 13) % 32) / 32.0f;
    ASSERT_TRUE(write_image((folder / "tile.png").string(), tile, {}, {}));
    make_context({1600, 900});
    shell = std::make_unique<Shell>(settings, pictures);
    shell->set_look(true, false, 1);
    make_fonts();
    restart_session();
    shell->act_now = [this](const std::vector<Action>& all) { session->act_now(all); };
    robot = std::make_unique<Robot>(*shell, [this] { frame(); });
}

void SessionTest::restart_session(const std::string& texture_library) {
    session.reset();
    SessionOptions options;
    options.program = "/bin/false";
    options.state_folder = (folder / "state").string();
    options.cache.folder = (folder / "cache").string();
    options.texture_library = texture_library;
    options.trust_file = (folder / "trusted.json").string();
    session = std::make_unique<Session>(options, &settings);
}

void SessionTest::TearDown() {
    robot.reset();
    shell.reset();
    session.reset();
    ImGui::DestroyContext();
    fs::remove_all(folder);
}

void SessionTest::frame() {
    now_s += 1.0 / 60;
    session->update(now_s);
    ImGui::NewFrame();
    const std::vector<Action> actions = shell->draw(session->view());
    ImGui::Render();
    for (const Action& action : actions)
        session->act(action);
}

ImVec2 SessionTest::at(float x, float y) const {
    const DrawnItem* canvas = robot->find("Viewer/Canvas");
    if (!canvas) return {0, 0};
    const ViewerState& s = shell->state().viewer;
    return ViewMap{canvas->min, canvas->max, s.center, s.zoom, s.aspect}.to_screen({x, y});
}

}  // namespace weft::test
