#pragma once
/// The same flights in a show: a script with a dynobject for each throw is loaded and played, models
/// imported, as `run` does it. The author's results thus have the same limits as the models themselves.

#include "bench/flight/objects.h"

#include <filesystem>
#include <string>
#include <vector>

namespace stadion::bench {

/// The attributes of a dynobject.
struct ShowRung {
  Thing thing = Thing::Javelin;
  std::string name;
  std::string attributes;  ///< file, mass, flight ..., without its start
  bool limited = true;     ///< false: reported only, without limits
};

class ShowFlights {
public:
  /// Takes javelin and discus from the show "Ancient Olympia".
  static Result<ShowFlights> ofOlympia(const std::filesystem::path& repository);

  /// The rungs: as in that show; with the model from the mesh; by a table; and for a javelin, with only its
  /// mass given.
  std::vector<ShowRung> rungsOf(Thing thing) const;

  /// Plays all throws in one show, at 60 Hz, each with its own wind. The origin of the model starts at the
  /// throw's start.
  Result<std::vector<Trajectory>> fly(const ShowRung& rung, const std::vector<Throw>& throws) const;

private:
  /// A body of that show, without the parts that depend on the rung.
  struct Body {
    std::string model;   ///< file, mass, nose
    std::string matter;  ///< centre and inertia, if stated
    std::string flight;  ///< flight, coefficients
  };
  std::filesystem::path assets_;
  Body javelin_, discus_;
};

}  // namespace stadion::bench
