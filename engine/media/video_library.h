#pragma once
// Internal: one place for what must be done before OpenCV touches a movie.

namespace weft {

/// Keeps OpenCV and FFmpeg from writing to stderr: what went wrong is said by our errors. Called
/// before every use; acts once.
void silence_video_library();

}  // namespace weft
