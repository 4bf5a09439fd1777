#pragma once
/// The text of the full look's surface shaders, without the blocks and definitions that shaders.cpp puts before
/// it.

namespace stadion {

extern const char* const kSurfaceVertex;
extern const char* const kSurfaceFragment;

}  // namespace stadion
