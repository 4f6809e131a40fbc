#pragma once
// A shot cut into tasks for a render farm, so that together they give the bytes of one machine.

#include <string>
#include <vector>

#include "app/session/render_job.h"

namespace weft {

enum class FarmEngine { kOpenJd, kSlurm, kDeadline, kOpenCue, kFlamenco };

struct FarmOptions {
    FarmEngine engine = FarmEngine::kSlurm;
    std::string project;            ///< Absolute path of the project file.
    std::string folder;             ///< Where the job's files go.
    std::string cache;              ///< Shared by all machines; empty: "cache" in `folder`.
    int chunk = 10;                 ///< Frames a task.
    int threads = 0;                ///< Of a task; 0: one a processor.
    std::vector<std::string> maps;  ///< Of --map, for the machines.
    std::string library;
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

/// Writes job.json, which `weft task` reads, and what the engine wants beside it (docs/FARM.md).
/// Returns the paths. Names stand in job.json only: no script holds one. Errors: those of opening
/// the shot and of writing.
[[nodiscard]] Expected<std::vector<std::string>> write_farm_job(const FarmOptions& options,
                                                                const Shot& shot);

/// What one task of a job file is to run.
struct FarmTask {
    std::string project, cache, library, frames;
    std::vector<std::string> maps;
    JobStage stage = JobStage::kAll;
    int threads = 0;
};
/// Errors: Unreadable (the file), Usage (no such stage or task; the message says what there is).
[[nodiscard]] Expected<FarmTask> read_farm_task(const std::string& job, const std::string& stage,
                                                int index);

}  // namespace weft
