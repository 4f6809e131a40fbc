#pragma once
// The files of shaders/, embedded in the program.

namespace weft::shaders {

extern const char* const kViewerVert;
extern const char* const kPictureFrag;
extern const char* const kMatteFrag;

}  // namespace weft::shaders
