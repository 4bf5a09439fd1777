#pragma once
/// How many instructions a frame executes, by callgrind.
///
/// Errors  in `fault`, as a sentence.

#include <atomic>
#include <string>
#include <vector>

namespace stadion {

struct FrameInstructions {
  double each = 0;    ///< of a frame, of all threads, the rasteriser's included
  std::string fault;  ///< empty: all is well
};

/// Of `stadion WORDS...`, which must not say --frames: played twice, so that what is done but once drops out.
FrameInstructions instructionsAFrame(const std::vector<std::string>& words, const std::string& folder,
                                     const std::atomic<bool>& stop);

}  // namespace stadion
