#pragma once
/// Names of the trackers that the engine itself asks for. Scripts and rig files may name any others.

namespace stadion {

inline constexpr const char* kHeadTracker = "head";  ///< the visitor's eyes
inline constexpr const char* kWandTracker = "wand";  ///< what the visitor holds
inline constexpr const char* kFootTracker = "foot";  ///< what the visitor kicks with

}  // namespace stadion
