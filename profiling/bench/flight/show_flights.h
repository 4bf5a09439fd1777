#pragma once
/// The same flights in a show: a script with a dynobject for each throw is loaded and played, models imported
/// and all, as `run` does it. So what an author gets is held to the same limits as the models by themselves.

#include "profiling/bench/flight/objects.h"

#include <filesystem>
#include <string>
#include <vector>

namespace stadion::bench {

/// What a dynobject says of itself.
struct ShowRung {
  Thing thing = Thing::Javelin;
  std::string name;
  std::string attributes;  ///< file, mass, flight ..., but not where and how it starts
  bool limited = true;     ///< false: only to be seen
};

class ShowFlights {
public:
  /// Takes javelin and discus as the show "Ancient Olympia" declares them.
  static Result<ShowFlights> ofOlympia(const std::filesystem::path& repository);

  /// As that show has it; with the model that follows from the mesh; by a table; and, of a javelin, with
  /// nothing said of its mass but how much it is.
  std::vector<ShowRung> rungsOf(Thing thing) const;

  /// All of them in one show, at 60 Hz, each with a wind of its own. The origin of the model starts where the
  /// throw does.
  Result<std::vector<Trajectory>> fly(const ShowRung& rung, const std::vector<Throw>& throws) const;

private:
  /// A body of that show, without what depends on the rung.
  struct Body {
    std::string model;   ///< file, mass, nose
    std::string matter;  ///< centre and inertia, as far as they are stated
    std::string flight;  ///< flight, coefficients
  };
  std::filesystem::path assets_;
  Body javelin_, discus_;
};

}  // namespace stadion::bench
