#include "tests/ui/walk.h"

#include <random>

#include "app/project/codec/project_json.h"
#include "engine/core/hash.h"
#include "engine/media/frame_writer.h"
#include "engine/media/image_files.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;

const ImVec2 kWindows[] = {{1600, 900}, {1280, 720}, {1920, 1080}};

ImageF3 plate_of(Size size, int step) {
    ImageF3 out(size.width, size.height, 0.2f);
    for (int y = size.height / 4; y < 3 * size.height / 4; ++y)
        for (int x = size.width / 4 + step; x < 3 * size.width / 4; ++x) {
            float* p = out.pixel(x, y);
            p[0] = 0.5f + 0.2f * static_cast<float>((x - step + y) % 7) / 7.0f;
            p[1] = 0.4f;
        }
    return out;
}

std::string pixels_of(const std::string& path, Size size) {
    const auto matte = read_matte(path, {}, size);
    EXPECT_TRUE(matte) << matte.error().text();
    if (!matte) return "missing";
    Hasher hasher;
    hasher.bytes(matte->data(),
                 static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
    return hasher.finish().hex();
}

}  // namespace

std::vector<WalkStep> random_walk(unsigned seed, int steps, int frames) {
    using Kind = WalkStep::Kind;
    std::mt19937 random(seed);
    const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    const auto share = [&] { return 0.1f + 0.8f * static_cast<float>(pick(1000)) / 1000; };
    std::vector<WalkStep> out;
    int done = 0;  // steps of the history that may be undone
    for (int k = 0; k < steps; ++k) {
        WalkStep step;
        const int what = pick(100);
        if (what < 45) {
            step.subtract = pick(4) == 0;
            const int points = 2 + pick(4);
            for (int p = 0; p < points; ++p)
                step.line.push_back({share(), share()});
            ++done;
        } else if (what < 58) {
            step.kind = done > 0 ? Kind::kUndo : Kind::kRedo;
            done = std::max(0, done - 1);
        } else if (what < 64) {
            step.kind = Kind::kRedo;
        } else if (what < 78) {
            step.kind = Kind::kFrame;
            step.number = pick(frames);
        } else if (what < 84) {
            step.kind = Kind::kRegion;
            step.number = pick(2);
        } else if (what < 87) {
            step.kind = Kind::kJob;
        } else if (what < 90) {
            step.kind = Kind::kWindow;
            step.number = pick(static_cast<int>(std::size(kWindows)));
        } else if (what < 95) {
            step.kind = Kind::kSetting;
            step.number = 50 + pick(150);
            ++done;
        } else if (what < 98) {
            step.kind = Kind::kRefine;
            step.number = 1 + pick(3);
            ++done;
        } else {
            step.kind = Kind::kReopen;
            done = 0;
        }
        out.push_back(std::move(step));
    }
    return out;
}

void WalkTest::begin(const std::string& name, Size size, int frames) {
    size_ = size;
    const fs::path shot = folder / name;
    fs::create_directories(shot / "frames");
    for (int k = 0; k < frames; ++k) {
        const std::string file = (shot / "frames" / ("000" + std::to_string(k + 1) + ".png"));
        ASSERT_TRUE(write_image(file, plate_of(size, k), {}, {}));
    }
    project_ = (shot / "shot.weft").string();
    restart_session();
    session->act(PauseAnalysis{true});
    session->act(OpenAny{(shot / "frames").string()});
    ASSERT_TRUE(wait([&] { return session->view().plate_picture != nullptr; }));
    ImGui::GetIO().DisplaySize = kWindows[0];
    shell->state().brush.brush.radius_px = 6;
    for (int region = 0; region < 2; ++region) {
        robot->key("Ctrl+Shift+N");
        robot->frames(3);
        session->act(GoToFrame{1});
        settle();
        WalkStep step;
        step.line = {{0.3f, 0.3f + 0.2f * static_cast<float>(region)}, {0.6f, 0.5f}};
        take(step);
        settle();
        for (int frame = 2; frame <= frames; ++frame) {
            session->act(CopyKeyframe{1, frame});
            settle();
        }
    }
    reopen();
}

Vec2 WalkTest::place(Vec2 share) const {
    return {share.x * static_cast<float>(size_.width), share.y * static_cast<float>(size_.height)};
}

void WalkTest::settle() {
    ASSERT_TRUE(wait([&] { return !session->view().matte_busy && !session->view().painting; }));
    session->flush();
    frame();
}

void WalkTest::reopen() {
    session->flush();
    session->act(SaveAs{project_});
    ASSERT_TRUE(
        wait([&] { return session->view().path == project_ && !session->view().modified; }));
    session->close_cleanly();
    restart_session();
    session->act(PauseAnalysis{true});
    session->act(OpenProject{project_});
    ASSERT_TRUE(wait([&] { return session->view().plate_picture != nullptr; }));
    robot->frames(3);
}

void WalkTest::take(const WalkStep& step) {
    using Kind = WalkStep::Kind;
    const SessionView& view = session->view();
    switch (step.kind) {
        case Kind::kStroke: {
            robot->key(step.subtract ? "E" : "B");
            std::vector<ImVec2> line;
            for (const Vec2 share : step.line)
                line.push_back(at(place(share).x, place(share).y));
            return robot->stroke(line);
        }
        case Kind::kUndo:
            robot->key("Ctrl+Z");
            return;
        case Kind::kRedo:
            robot->key("Ctrl+Shift+Z");
            return;
        case Kind::kFrame:
            return session->act(
                GoToFrame{view.plate.frames[static_cast<std::size_t>(step.number)]});
        case Kind::kRegion:
            return session->act(
                SelectRegion{view.project.regions[static_cast<std::size_t>(step.number)]->id});
        case Kind::kJob:
            return session->act(
                SubmitJob{"1-2", (folder / "out" / "####.png").string(), "", true, false});
        case Kind::kWindow:
            ImGui::GetIO().DisplaySize = kWindows[step.number];
            return robot->frames(3);
        case Kind::kSetting:
            return session->act(DoEdit{SetRegionParameter{
                {view.selected, {}}, "placement.scale", static_cast<double>(step.number) / 100}});
        case Kind::kRefine:
            return session->act(GrowMatte{static_cast<float>(step.number)});
        case Kind::kReopen:
            return reopen();
    }
}

void WalkTest::walk(const std::vector<WalkStep>& steps, bool leisurely) {
    for (std::size_t k = 0; k < steps.size(); ++k) {
        SCOPED_TRACE("step " + std::to_string(k));
        take(steps[k]);
        if (HasFatalFailure()) return;
        frame();
        if (leisurely) settle();
    }
    settle();
}

std::string WalkTest::document() {
    Project project = session->view().project;
    std::string mattes;
    for (Leaf<Region>& region : project.regions) {
        MatteSource source = *region->matte;
        for (auto& [number, key] : source.keyframes) {
            mattes += region->name + " " + std::to_string(number) + " " +
                      pixels_of(session->view().path.empty() || key.path.starts_with("/")
                                    ? key.path
                                    : (fs::path(project_).parent_path() / key.path).string(),
                                size_) +
                      "\n";
            key.path.clear();
        }
        region = region.with([&](Region& r) { r.matte = source; });
    }
    project.plate.path.clear();
    project.name.clear();
    const auto text = project_to_json(project);
    EXPECT_TRUE(text);
    return text.value_or("") + "\n" + mattes;
}

}  // namespace weft::test
