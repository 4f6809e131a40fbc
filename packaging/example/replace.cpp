// Renders a project with another texture on its first region: replace PROJECT TEXTURE OUTPUT
#include <cstdio>

#include "app/project/codec/project_file.h"
#include "app/render/render_job.h"

int main(int argc, char** argv) {
    if (argc != 4) {
        std::fprintf(stderr, "usage: replace PROJECT TEXTURE OUTPUT\n");
        return 2;
    }
    auto project = weft::load_project(argv[1]);
    if (project && project->regions.empty())
        project = weft::fail(weft::ErrorCode::kUsage, "The project has no region.");
    if (!project) {
        std::fprintf(stderr, "%s\n", project.error().text().c_str());
        return weft::exit_code(project.error().code);
    }
    weft::JobSpec job;
    job.project = weft::resolve_paths(*project, weft::project_dir(argv[1]));
    job.project.regions[0] = job.project.regions[0].with([&](weft::Region& region) {
        region.texture = {};
        region.texture.sample = argv[2];
    });
    job.project.output.path = argv[3];
    job.existing = weft::ExistingFrames::kResume;
    const auto result = weft::run_job(job, weft::CancelToken(), [](const weft::ProgressEvent& e) {
        std::printf("%s %lld/%lld\n", e.name().c_str(), static_cast<long long>(e.done),
                    static_cast<long long>(e.total));
    });
    if (result) return 0;
    std::fprintf(stderr, "%s\n", result.error().text().c_str());
    return weft::exit_code(result.error().code);
}
