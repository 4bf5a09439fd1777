#pragma once
/// A clip at a time of it.
///
/// Formulas  glTF 2.0, appendix C: step, linear (rotations with constant angular velocity, the short way) and
///           cubic Hermite splines. Before the first key and after the last, the value of that key holds.
/// Accuracy  double precision; equal on every machine (engine/maths/functions.h).
/// Threads   pure.

#include "engine/figure/skeleton.h"

#include <span>

namespace stadion {

/// The channel's value at a time of the clip [s]; the first width() numbers count. Rotations are unit
/// quaternions (x, y, z, w).
std::array<double, 4> sampleChannel(const ClipChannel& channel, double time);

/// Puts the bones that the clip moves where they are at `time`. Expects a place for each bone.
void sampleClip(const Clip& clip, double time, std::span<BonePlace> places);

/// What a scale has become since the beginning of its clip, as a factor; 1 if it was nothing there.
double scaleGrowth(double begin, double now);

/// Sets the weights that the clip moves to what they are at `time`. Expects one for each of the skeleton.
void sampleWeights(const Clip& clip, double time, std::span<double> weights);

}  // namespace stadion
