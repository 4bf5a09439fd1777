#pragma once
/// What the operator has decided about a frame's pictures; it travels with the frame, so that all walls obey
/// in the same one.
///
/// Threads  a plain value.

namespace stadion {

/// How a frame is shown, decided once for all walls.
struct Presentation {
  bool black = false;
  bool swapEyes = false;
  double eyeSeparation = -1;  ///< [m]; negative: as the wall file says

  bool operator==(const Presentation&) const = default;
};

}  // namespace stadion
