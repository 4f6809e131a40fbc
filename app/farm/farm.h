#pragma once
// Splits a shot into tasks for a render farm. Together they give the same bytes as a render on one
// machine.

#include <string>
#include <vector>

#include "app/render/render_job.h"

namespace weft {

enum class FarmEngine { kOpenJd, kSlurm, kDeadline, kOpenCue, kFlamenco };

struct FarmOptions {
    FarmEngine engine = FarmEngine::kSlurm;
    std::string project_file;  ///< Project file; names the job.
    Project project;           ///< The project to render, as passed to open_shot().
    std::string folder;        ///< Folder of the job's files.
    std::string cache;         ///< Cache folder shared by all machines; empty: "cache" in `folder`.
    int chunk = 10;            ///< Frames per task.
    int threads = 0;           ///< Threads per task; 0: one per processor.
    std::string library;
    /// How tasks treat existing frames. kRefuse acts as kResume, since a task may run twice.
    ExistingFrames existing = ExistingFrames::kRefuse;
    /// Folders that tasks may write to; empty: those of the outputs.
    std::vector<std::string> roots;
    WriteRule rule;  ///< Write rule of the job's files.
};

/// A stage: its tasks may run in parallel once the previous stage is complete.
struct FarmStage {
    JobStage stage = JobStage::kAll;
    std::string name;  ///< "motion", "analyse", "planes", "frames", "encode"
    /// Frame list of each task; one empty string: the whole shot.
    std::vector<std::string> frames;
};

/// Stages: motion between neighbours in parallel; analysis in order; texture planes; frames in
/// parallel; the movie if requested. Stages without work are omitted.
[[nodiscard]] std::vector<FarmStage> farm_stages(const Shot& shot, int chunk);

/// The project with the choices of open_shot() written into it: absolute paths, frames and
/// reference frames. `project` is what `shot` was opened from.
[[nodiscard]] Project frozen_project(const Project& project, const Shot& shot);

/// Writes a snapshot of the project, job.json (read by `weft task`), and the farm's own files
/// (docs/FARM.md). Returns their paths. File names occur only in the first two, never in scripts.
/// Errors: Usage (the folder holds another job); those of writing.
[[nodiscard]] Expected<std::vector<std::string>> write_farm_job(
    const FarmOptions& options, const std::shared_ptr<const Shot>& shot);

/// Returns true for a job.json of 'weft submit', of any version.
[[nodiscard]] bool is_farm_job(const std::string& path);

/// What a task of a job file runs.
struct FarmTask {
    Project project;             ///< The snapshot, with the frames of this task.
    std::string settings;        ///< Required settings_hash(): that of the submitted job.
    std::string inputs;          ///< Required InputHashes::text() of all frames of the job,
    std::vector<int> inputs_of;  ///< which these are.
    std::string cache, library;
    /// Folders that the task may write to, besides the cache.
    std::vector<std::string> output_roots;
    JobStage stage = JobStage::kAll;
    ExistingFrames existing = ExistingFrames::kResume;
    int threads = 0;
};
/// Reads a task. Errors: Unreadable (the job or its snapshot, or a snapshot that differs from the
/// submitted one); Usage (no such stage or task; the message lists what exists).
[[nodiscard]] Expected<FarmTask> read_farm_task(const std::string& job, const std::string& stage,
                                                int index);

}  // namespace weft
