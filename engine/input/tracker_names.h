#pragma once
/// Names of the trackers that the engine itself asks for. Scripts and rig files may name any others.

namespace stadion {

inline constexpr const char* kHeadTracker = "head";  ///< the visitor's eyes
inline constexpr const char* kWandTracker = "wand";  ///< the device in the visitor's hand
inline constexpr const char* kOperatorTracker = "operator";  ///< the operator, whose buttons are cues
inline constexpr const char* kFootTracker = "foot";  ///< the visitor's foot, for kicks

}  // namespace stadion
