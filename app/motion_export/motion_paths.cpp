#include "app/motion_export/motion_paths.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "app/render/existing_frames.h"
#include "engine/core/input_file.h"
#include "engine/core/setting.h"
#include "engine/media/atomic_file.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// Letters of other alphabets are bytes above 127.
std::string folder_name(const std::string& region) {
    std::string out;
    for (const char c : region) {
        const auto code = static_cast<unsigned char>(c);
        const bool plain = code > 127 || std::isalnum(code) || c == '-' || c == '_';
        out += plain ? c : '_';
    }
    return out.empty() ? "region" : out;
}

bool is_there(const std::string& path) {
    std::error_code ignored;
    return fs::exists(fs::symlink_status(path, ignored));
}

bool is_manifest(const std::string& path) {
    const auto text = read_file(path, "The manifest");
    if (!text) return false;
    const auto json = nlohmann::json::parse(*text, nullptr, false);
    return json.is_object() && json.value("schema", nlohmann::json()) == "weft.motion/1";
}

std::vector<std::string> texts_of(const MotionPaths& paths) {
    std::vector<std::string> out;
    for (const std::string* file : {&paths.nuke, &paths.after_effects, &paths.blender, &paths.track,
                                    &paths.nuke_shapes, &paths.blender_shapes, &paths.mlt_shapes,
                                    &paths.mesh_obj, &paths.mesh_pc2, &paths.mesh_usd})
        if (!file->empty()) out.push_back(*file);
    return out;
}

std::vector<std::string> patterns_of(const MotionPaths& paths) {
    std::vector<std::string> out;
    for (const std::string* pattern : {&paths.st_map, &paths.stabilize})
        if (!pattern->empty()) out.push_back(*pattern);
    for (const auto& [convention, pattern] : paths.vectors)
        out.push_back(pattern);
    return out;
}

Error already_there(const std::string& path) {
    return {ErrorCode::kUsage,
            path + " exists already.",
            "Resume or overwrite" + by({{setting::kResume}, {setting::kOverwrite}}) +
                ", or use another folder.",
            {}};
}

Error not_of_an_export(const std::string& path, const std::string& manifest) {
    return {ErrorCode::kUsage,
            path + " exists already, and " + manifest + " is not that of a motion export.",
            "Use another folder, or overwrite" + by({{setting::kOverwrite}}) + ".",
            {}};
}

}  // namespace

const char* name_of(StConvention convention) {
    switch (convention) {
        case StConvention::kFusion:
            return "fusion";
        case StConvention::kBlender:
            return "blender";
        case StConvention::kNuke:
            break;
    }
    return "nuke";
}

const char* name_of(MotionConvention convention) {
    switch (convention) {
        case MotionConvention::kBlender:
            return "blender";
        case MotionConvention::kMoonray:
            return "moonray";
        case MotionConvention::kFlame:
            return "flame";
        case MotionConvention::kArnold:
            return "arnold";
        case MotionConvention::kNuke:
        case MotionConvention::kFiles:
            break;
    }
    return "nuke";
}

std::vector<MotionPaths> motion_paths(const MotionJobSpec& spec,
                                      const std::vector<MotionRegion>& regions) {
    std::vector<MotionPaths> out;
    std::set<std::string> taken;
    for (const MotionRegion& region : regions) {
        const std::string wanted = folder_name(region.name);
        std::string folder = wanted;
        for (int number = 2; !taken.insert(folder).second; ++number)
            folder = wanted + "_" + std::to_string(number);
        MotionPaths paths;
        paths.folder = folder;
        if (spec.what.st_maps && spec.st == StConvention::kNuke) {
            paths.st_map = folder + "/st/####.exr";
        } else if (spec.what.st_maps) {
            paths.st_map = folder + "/st_match_move/####.exr";
            paths.stabilize = folder + "/st_stabilize/####.exr";
        }
        for (const MotionConvention convention : spec.vectors)
            if (spec.what.vectors)
                paths.vectors.emplace_back(
                    convention, folder + "/vectors_" + name_of(convention) + "/####.exr");
        if (spec.what.corner_pins) {
            paths.nuke = folder + "/corner_pin.nk";
            paths.after_effects = folder + "/corner_pin_after_effects.txt";
            paths.blender = folder + "/corner_pin_blender.py";
            paths.track = folder + "/track.json";
        }
        if (spec.what.shapes) {
            paths.nuke_shapes = folder + "/roto_nuke.py";
            paths.blender_shapes = folder + "/roto_blender.py";
            paths.mlt_shapes = folder + "/roto_mlt.json";
        }
        if (spec.what.mesh) {
            paths.mesh_obj = folder + "/mesh.obj";
            paths.mesh_pc2 = folder + "/mesh.pc2";
            paths.mesh_usd = folder + "/mesh.usda";
        }
        out.push_back(std::move(paths));
    }
    return out;
}

Expected<SequencePattern> motion_pattern(const std::string& folder, const std::string& relative) {
    return SequencePattern::parse((fs::path(folder) / relative).string());
}

Status check_motion_files(const MotionJobSpec& spec, const MotionPlan& motion,
                          const std::vector<MotionPaths>& paths, const WriteRule& rule) {
    const std::string manifest = (fs::path(spec.folder) / kMotionManifest).string();
    std::vector<std::string> pictures, texts{manifest};
    for (const MotionPaths& region : paths) {
        for (const std::string& relative : patterns_of(region)) {
            WEFT_TRY(pattern, motion_pattern(spec.folder, relative));
            for (const int frame : motion.frames)
                pictures.push_back(pattern.path_for(frame));
        }
        for (const std::string& relative : texts_of(region))
            texts.push_back((fs::path(spec.folder) / relative).string());
    }
    const bool resumes = spec.existing == ExistingFrames::kResume;
    const bool known = resumes && is_manifest(manifest);
    WriteRule replace = rule;
    replace.existing = Existing::kReplace;
    for (const auto* files : {&texts, &pictures}) {
        for (const std::string& path : *files) {
            if (rule.fence) WEFT_CHECK_OK(rule.fence->check(path, real_path(path)));
            if (spec.existing == ExistingFrames::kOverwrite || !is_there(path)) continue;
            if (!resumes) return tl::unexpected(already_there(path));
            if (files == &texts && !known) return tl::unexpected(not_of_an_export(path, manifest));
            if (files == &pictures && !is_frame_of_weft(path))
                return tl::unexpected(not_of_weft(path));
        }
    }
    return check_output(manifest, replace);
}

}  // namespace weft
