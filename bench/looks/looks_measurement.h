#pragma once
/// Measures the rungs on one wall of a scene: costs in interleaved rounds, then errors.
///
/// Ownership  RungPictures and rungs must outlive it.
/// Threads    the thread of the RungPictures.

#include "bench/looks/looks_results.h"
#include "bench/looks/rung_pictures.h"

#include <functional>
#include <string>
#include <vector>

namespace stadion::bench {

/// Pictures of a wall in the files of a folder, for other programs and for the eye.
struct LooksFiles {
  /// The path of the file with this name; empty: no file is written.
  std::function<std::string(const std::string&)> pathOf;
  bool perceptual = true;  ///< the programs of perceptual_programs.h are started
};

class LooksMeasurement {
public:
  LooksMeasurement(RungPictures& pictures, std::vector<NamedRung> rungs)
      : pictures_(pictures), rungs_(std::move(rungs)) {}

  /// The rows of the rungs for a list of two views, in order.
  Result<std::vector<LooksRow>> measure(const std::string& scene, const std::string& wall,
                                        const DrawList& list, std::size_t rounds, const LooksFiles& files);
  /// Adds the flicker of the left eye over successive lists to rows that measure() has returned.
  std::optional<Diagnostic> measureFlicker(const std::vector<DrawList>& lists, std::vector<LooksRow>& rows);

private:
  Result<std::vector<DrawnViews>> drawRounds(const DrawList& list, std::size_t rounds,
                                             std::vector<LooksRow>& rows);

  RungPictures& pictures_;
  std::vector<NamedRung> rungs_;
};

}  // namespace stadion::bench
