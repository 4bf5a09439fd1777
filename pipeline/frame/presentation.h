#pragma once
/// The operator's decisions about a frame's pictures. They travel with the frame, so all walls apply them in
/// the same one.
///
/// Threads  a plain value.

namespace stadion {

/// How a frame is shown, decided once for all walls.
struct Presentation {
  bool black = false;
  bool swapEyes = false;
  bool pattern = false;  ///< the test pattern in place of the show; black goes before it
  double eyeSeparation = -1;  ///< [m]; negative: from the wall file

  bool operator==(const Presentation&) const = default;
};

}  // namespace stadion
