#include "app/motion_export/motion_mesh.h"

#include <cctype>
#include <filesystem>

#include "engine/media/atomic_file.h"
#include "engine/pipeline/region_mesh.h"

namespace weft {
namespace {

// A prim's name: letters, digits and _ of ASCII only.
std::string mesh_name(const std::string& folder) {
    std::string out = "mesh_";
    for (const char c : folder) {
        const auto code = static_cast<unsigned char>(c);
        out += code < 128 && std::isalnum(code) ? c : '_';
    }
    return out;
}

}  // namespace

Expected<MeshSummary> write_motion_mesh(const MotionFramesInputs& in, const AnalysisStore& store,
                                        double fps) {
    const auto shown = [&](int frame) { return in.shot.plate->shown_frame(frame); };
    std::vector<int> frames;
    for (const int frame : in.motion.frames)
        frames.push_back(shown(frame));
    const int reference = shown(in.region.reference);
    WEFT_TRY(found, region_mesh(in.surface, store, reference, frames));
    SurfaceMesh mesh = found;
    mesh.corners.clear();
    mesh.reference = in.region.reference;
    for (const int frame : in.motion.frames)
        mesh.corners[frame] = found.corners.at(shown(frame));
    mesh.corners[mesh.reference] = found.corners.at(reference);
    const std::string name = mesh_name(in.paths.folder);
    for (const auto& [path, text] :
         {std::pair(in.paths.mesh_obj, mesh_obj(mesh, name)),
          {in.paths.mesh_pc2, mesh_pc2(mesh, in.motion.frames)},
          {in.paths.mesh_usd, mesh_usd(mesh, name, in.motion.frames, fps)}})
        WEFT_CHECK_OK(write_file_atomically((std::filesystem::path(in.spec.folder) / path).string(),
                                            text, in.rule));
    return MeshSummary{mesh.uv.size(), mesh.faces.size(), mesh.depth};
}

}  // namespace weft
