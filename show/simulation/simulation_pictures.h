#pragma once
/// Pictures of a simulated hall: from inside, from above, and the errors.
///
/// inside.png   what the visitor sees all around: azimuth across, elevation down.
/// errors.png   the same directions: green is exact, red an error of a pixel or more, grey too dark to tell.
/// above.png    the lit screens from above, forward is up; each projector has a colour.
///
/// Threads  one at a time.
/// Errors   write() returns the reason if a file cannot be written.

#include "pipeline/picture/picture.h"
#include "show/simulation/hall_simulation.h"

#include <optional>
#include <string>
#include <vector>

namespace stadion {

class SimulationPictures {
public:
  SimulationPictures();

  void add(const SeenPixel& pixel);
  /// Writes the pictures into the folder, which is made if it is not there.
  std::optional<Diagnostic> write(const std::string& folder) const;

private:
  struct Cell {
    Vec3 light = Vec3::Zero();
    double count = 0, error = -1;
  };
  struct Spot {
    Vec3 point;
    std::size_t projector;
  };

  Picture inside() const;
  Picture errors() const;
  Picture above() const;

  std::vector<Cell> cells_;
  std::vector<Spot> spots_;
};

}  // namespace stadion
