#pragma once
// Which frames a shot renders, and whether all their files are there.

#include <string>
#include <vector>

#include "app/project/project.h"
#include "engine/media/frame_reader.h"
#include "engine/media/sequence_pattern.h"
#include "engine/pipeline/region_plan.h"

namespace weft {

/// The project's frames: its list, or all of the plate's. Errors: Usage for a list that cannot be
/// read, MissingFrames when the plate has not all of them.
[[nodiscard]] Expected<std::vector<int>> frames_to_render(const Project& project,
                                                          const FrameReader& plate);

/// Checks that the plate has the region's own frames: references, corrections and painted mattes.
/// Errors: MissingFrames, naming the frame and what the plate has.
[[nodiscard]] Status check_named_frames(const Region& region, const FrameReader& plate);

/// Checks that the plate has every frame of a region's span and that mattes, holdouts and motion
/// have a file for each frame for which they will be read. Errors: MissingFrames naming the pattern
/// and the frames.
[[nodiscard]] Status check_files(const Region& region, const RegionPlan& plan, const ShotPlan& shot,
                                 const FrameReader& plate);

/// The frames from which a region's old texture is told from light, up to twelve: all over the run
/// of frames, within 48 of the first reference frame, for which everything is there. They do not
/// depend on what is rendered. None where the plate gives no light, or in draft quality. This and
/// the two below end before a frame of `leave_out`. Errors: those of the patterns.
[[nodiscard]] Expected<std::vector<int>> light_evidence(const Region& region,
                                                        const RegionPlan& plan,
                                                        const ShotPlan& shot,
                                                        const FrameReader& plate,
                                                        const std::vector<int>& leave_out);

/// The frames whose motion the shutter's blur needs around the reference: the reference and some
/// after it where the shutter is measured, one where it is given; none without blur.
[[nodiscard]] Expected<std::vector<int>> shutter_frames(const Region& region,
                                                        const RegionPlan& plan,
                                                        const FrameReader& plate,
                                                        const std::vector<int>& leave_out);

/// The frames that grain is measured on: the first reference frame and up to three after it. None
/// where it is not wanted, or there is no frame after.
[[nodiscard]] Expected<std::vector<int>> grain_frames(const Region& region, const RegionPlan& plan,
                                                      const FrameReader& plate,
                                                      const std::vector<int>& leave_out);

/// "frames 4-9 and 12"; long lists are cut.
[[nodiscard]] std::string frames_text(const std::vector<int>& frames);

}  // namespace weft
