#pragma once
// The frames that a shot renders, and checks that their files exist.

#include <string>
#include <vector>

#include "app/project/project.h"
#include "engine/media/frame_reader.h"
#include "engine/media/sequence_pattern.h"
#include "engine/pipeline/region_mattes.h"
#include "engine/pipeline/region_plan.h"

namespace weft {

/// The project's frame list, or all frames of the plate. Errors: Usage for an invalid list;
/// MissingFrames when the plate lacks some.
[[nodiscard]] Expected<std::vector<int>> frames_to_render(const Project& project,
                                                          const FrameReader& plate);

/// Checks that the plate has the frames that the region names: references, corrections and painted
/// mattes. Errors: MissingFrames, naming the frame and what the plate has.
[[nodiscard]] Status check_named_frames(const Region& region, const FrameReader& plate);

/// Checks that the plate has every frame of a region's span, and that mattes, holdouts and motion
/// have the files that will be read. Errors: MissingFrames, naming the pattern and the frames.
[[nodiscard]] Status check_files(const Region& region, const RegionPlan& plan, const ShotPlan& shot,
                                 const FrameReader& plate);

/// The run of frames around `reference`, at most `reach` on each side, for which all files exist; a
/// dangling link counts as missing. Ends before a frame of `leave_out`. Errors: of the patterns.
[[nodiscard]] Expected<FrameSpan> run_around(const Region& region, const FrameReader& plate,
                                             int reference, int reach,
                                             const std::vector<int>& leave_out);

/// How far from a region's first reference frame lie those that show its light and form.
inline constexpr int kEvidenceReach = 48;

/// Up to twelve frames for separating a region's paint from light: spread over the run of frames
/// with all files, within 48 of the first reference frame. They do not depend on the rendered
/// frames. Empty if the plate gives no light, or at draft quality. This function and those below
/// stop before a frame of `leave_out`. Errors: those of the patterns.
[[nodiscard]] Expected<std::vector<int>> light_evidence(const Region& region,
                                                        const RegionPlan& plan,
                                                        const ShotPlan& shot,
                                                        const FrameReader& plate,
                                                        const std::vector<int>& leave_out);

/// Up to sixteen frames, likewise, that show what moves over a region's surface. Empty if its
/// highlights are not kept, or it is not followed.
[[nodiscard]] Expected<std::vector<int>> gloss_evidence(const Region& region,
                                                        const RegionPlan& plan,
                                                        const FrameReader& plate,
                                                        const std::vector<int>& leave_out);

/// The frames whose motion is used for motion blur: the reference and some after it if the shutter
/// is measured, one if it is given, none without blur.
[[nodiscard]] Expected<std::vector<int>> shutter_frames(const Region& region,
                                                        const RegionPlan& plan,
                                                        const FrameReader& plate,
                                                        const std::vector<int>& leave_out);

/// The frames whose position pass shows a region's form, the reference frame first: up to twelve,
/// spread over at most 48 frames on each side of it, for which all other files exist. The reference
/// frame alone if the pass is a single file.
[[nodiscard]] Expected<std::vector<int>> form_evidence(const Region& region, const RegionPlan& plan,
                                                       const FrameReader& plate,
                                                       const std::vector<int>& leave_out);

/// The run of frames with all files around a region's reference frame, over which zones may calm
/// its motion; empty without such zones. It does not depend on the frames to render.
[[nodiscard]] Expected<FrameRange> calm_span(const Region& region, const RegionPlan& plan,
                                             const FrameReader& plate,
                                             const std::vector<int>& leave_out);

/// The frames on which focus can be read: those of the plate with all files, for a region with
/// painted mattes up to the first gap. They do not depend on the frames to render.
[[nodiscard]] Expected<std::vector<int>> focus_frames(const Region& region, const RegionPlan& plan,
                                                      const FrameReader& plate,
                                                      const std::vector<int>& leave_out);
/// The frames on which grain is measured: the first reference frame and up to three after it. Empty
/// if grain is off, or there is no later frame.
[[nodiscard]] Expected<std::vector<int>> grain_frames(const Region& region, const RegionPlan& plan,
                                                      const FrameReader& plate,
                                                      const std::vector<int>& leave_out);

/// "4-9,12"; long lists are shortened.
[[nodiscard]] std::string frames_list(const std::vector<int>& frames);
/// "frames 4-9 and 12"; long lists are shortened.
[[nodiscard]] std::string frames_text(const std::vector<int>& frames);

/// The frames of a list such as "1-40,52", or all of `shot` (ascending) if it is empty. Errors:
/// Usage for an invalid list; MissingFrames for frames that the shot does not have.
[[nodiscard]] Expected<std::vector<int>> frames_of_shot(const std::string& list,
                                                        const std::vector<int>& shot);

}  // namespace weft
