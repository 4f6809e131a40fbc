#pragma once
// A shot cut into tasks for a render farm, so that together they give the bytes of one machine.

#include <string>
#include <vector>

#include "app/render/render_job.h"

namespace weft {

enum class FarmEngine { kOpenJd, kSlurm, kDeadline, kOpenCue, kFlamenco };

struct FarmOptions {
    FarmEngine engine = FarmEngine::kSlurm;
    std::string project_file;  ///< Names the job.
    Project project;           ///< What is rendered, as open_shot() got it.
    std::string folder;        ///< Where the job's files go.
    std::string cache;         ///< Shared by all machines; empty: "cache" in `folder`.
    int chunk = 10;            ///< Frames a task.
    int threads = 0;           ///< Of a task; 0: one a processor.
    std::string library;
    /// What tasks do with frames that are there; kRefuse: as kResume, since a task may run twice.
    ExistingFrames existing = ExistingFrames::kRefuse;
    std::vector<std::string> roots;  ///< Tasks write nowhere else; none: beside the outputs.
    WriteRule rule;                  ///< For the job's files.
};

/// One stage: its tasks may run side by side once the stage before is through.
struct FarmStage {
    JobStage stage = JobStage::kAll;
    std::string name;                 ///< "motion", "analyse", "planes", "frames", "encode"
    std::vector<std::string> frames;  ///< A task's frame list; one empty text: the whole shot.
};

/// Motion of neighbours in parallel; coordinates in order; texture planes; frames in parallel; the
/// movie where there is one. Stages without work are left out.
[[nodiscard]] std::vector<FarmStage> farm_stages(const Shot& shot, int chunk);

/// The project with everything decided that opening a shot decides: absolute paths, the frames, the
/// reference frames. `project` is what `shot` was opened from.
[[nodiscard]] Project frozen_project(const Project& project, const Shot& shot);

/// Writes a snapshot of the project, job.json, which `weft task` reads, and what the engine wants
/// beside it (docs/FARM.md). Returns the paths. Names of files stand in the first two only: no
/// script holds one. Errors: Usage (the folder holds another job), those of writing.
[[nodiscard]] Expected<std::vector<std::string>> write_farm_job(const FarmOptions& options,
                                                                const Shot& shot);

/// Returns true for a job.json that 'weft submit' wrote, of whatever version.
[[nodiscard]] bool is_farm_job(const std::string& path);

/// What one task of a job file is to run.
struct FarmTask {
    Project project;       ///< The snapshot, with the frames of this task.
    std::string settings;  ///< What settings_hash() must give, as when the job was submitted.
    std::string cache, library;
    std::vector<std::string> output_roots;  ///< Nothing is written elsewhere, but the cache.
    JobStage stage = JobStage::kAll;
    ExistingFrames existing = ExistingFrames::kResume;
    int threads = 0;
};
/// Errors: Unreadable (the job, its snapshot, or a snapshot that is not the one that was
/// submitted), Usage (no such stage or task; the message says what there is).
[[nodiscard]] Expected<FarmTask> read_farm_task(const std::string& job, const std::string& stage,
                                                int index);

}  // namespace weft
