#pragma once
/// When the frames of a show begin.

namespace stadion {

/// Policies of the frame rate (IRIS Performer's phases).
enum class Pace {
  Free,   ///< as fast as possible
  Lock,   ///< frames begin on ticks of the rate; after a missed tick the loop waits for the next one
  Float,  ///< a frame that missed its tick begins at once, and the ticks move with it
};

}  // namespace stadion
