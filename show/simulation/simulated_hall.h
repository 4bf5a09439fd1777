#pragma once
/// All projectors of a hall, and where their light meets.
///
/// Ownership  copies the hall.
/// Threads    const use from any number of threads.

#include "engine/display/wall_file.h"
#include "show/simulation/simulated_projector.h"

#include <array>

#include <memory>

namespace stadion {

/// Light of a projector at a place of its output.
struct LightFrom {
  std::uint32_t entry = 0;
  float x = 0, y = 0;  ///< [pixels]
};

/// A pixel at which the simulator looks.
struct LookedAtPixel {
  std::uint32_t x = 0, y = 0;
  Vec3 point, right, below;  ///< what its centre lights, and one pixel beside and below, in R
  /// Light of other projectors at the pixel and its eight neighbours, row by row: those of cell k are from
  /// first[k] up to first[k + 1].
  std::array<std::uint32_t, 10> first{};
  bool whole = false;  ///< all nine are on the screen
};

struct LookedAtProjector {
  std::size_t entry = 0;
  std::vector<LookedAtPixel> pixels;
  std::vector<LightFrom> others;
};

class SimulatedHall {
public:
  /// Expects projectors with complete screens and warps.
  SimulatedHall(WallFile hall, std::uint32_t every);
  SimulatedHall(const SimulatedHall&) = delete;
  SimulatedHall& operator=(const SimulatedHall&) = delete;

  const WallFile& file() const { return hall_; }
  const SimulatedProjector& projector(std::size_t entry) const { return *projectors_[entry]; }
  const std::vector<LookedAtProjector>& looked() const { return looked_; }
  bool serves(std::size_t entry, Eye eye) const;
  /// Returns the light at a point of a screen, for one eye.
  std::vector<LightFrom> lightAt(std::size_t screen, const Vec3& point, Eye eye) const;
  const SimulatedScreen& screen(std::size_t i) const { return *screens_[i]; }
  const Vec3& white() const { return white_; }  ///< by channel, that of the darkest projector
  double black() const { return black_; }       ///< the brightest sum of blacks

private:
  void look(std::size_t entry, std::uint32_t every);
  void lookAround(std::size_t entry, LookedAtPixel& pixel, std::vector<LightFrom>& others);
  double blackOf(std::size_t entry) const { return projectors_[entry]->lamp().black; }

  WallFile hall_;
  std::vector<std::unique_ptr<SimulatedScreen>> screens_;
  std::vector<std::unique_ptr<SimulatedProjector>> projectors_;  ///< by entry; null: a flat wall
  std::vector<LookedAtProjector> looked_;
  Vec3 white_ = Vec3::Constant(1e300);
  double black_ = 0;
};

}  // namespace stadion
