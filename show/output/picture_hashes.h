#pragma once
/// `run --hashes`: what every picture of a run was, and when it was shown, without keeping the pictures.
///
///     picture-hashes.txt   FRAME WALL EYE HEX16, a line for each picture: the same in every run of a show
///     swap-times.txt       FRAME NANOSECONDS of the machine's steady clock, a line for each frame
///
/// Two machines of a cluster that is played on one computer show a frame together when no swap time of one
/// machine's frame N + 1 is before another one's of frame N.
///
/// Threads  one at a time.
/// Errors   add() reports what could not be written. All lines of the file are then whole, except for the
///          last.

#include "pipeline/loop/show_stages.h"
#include "pipeline/picture/stereo.h"
#include "show/output/output_folder.h"

#include <chrono>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

/// Lines of picture-hashes.txt.
std::string hashLinesOf(std::uint64_t frame, const std::vector<EyePictures>& walls,
                        const std::vector<std::string>& wallNames);

class PictureHashes {
public:
  static constexpr const char* kHashes = "picture-hashes.txt";
  static constexpr const char* kTimes = "swap-times.txt";

  /// `further`: lines are added to those of the run that this one goes on with; half a line goes.
  PictureHashes(OutputFolder& folder, std::vector<std::string> wallNames, bool further);

  std::optional<Diagnostic> add(std::uint64_t frame, const std::vector<EyePictures>& walls,
                                std::chrono::steady_clock::time_point shown);

private:
  std::optional<Diagnostic> open();

  OutputFolder& folder_;
  std::vector<std::string> wallNames_;
  bool further_;
  std::ofstream hashes_, times_;
};

}  // namespace stadion
