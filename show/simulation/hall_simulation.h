#pragma once
/// What a visitor sees in a hall, before its projectors are switched on.
///
/// For a place of the head, the simulator follows the pixels of each projector to the screen and on to the
/// eyes, and compares what arrives with the ideal picture.
///
///   Geometry    views are painted so that each colour tells its direction (structured_light.h). The error is
///               how far a pixel shows a wrong direction, in pixels of the projector.
///   Luminance   views are painted with even light. At a pixel's centre, the simulator adds the light of all
///               projectors that reach it: ideal is an equal share of the hall's white all over. Black is the
///               brightest sum of blacks in the hall. Errors are means over 3 x 3 pixels, as shares of white.
///   Coverage    at points all over the screens: places without light, and places that are too bright because
///               projectors overlap without blending.
///
/// Colour tables count as parts of their displays: both together have the light that the wall file states.
///
/// Limits      a screen does not hide itself from the eye. Flat walls without projectors are not simulated.
/// Frames      R is the rig.
/// Ownership   borrows nothing after run().
/// Threads     one simulation, one thread.

#include "engine/display/wall_file.h"
#include "show/simulation/picture_source.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace stadion {

/// What is wrong in the hall, but not in the wall file from which pictures are drawn.
struct HallFault {
  std::string projector;
  std::optional<Vec3> moved;    ///< the lens is so far from where the file says [m]
  std::optional<double> gamma;  ///< of its display
};

/// A pixel as the first head sees it, while the views show a grid of azimuths and elevations.
struct SeenPixel {
  std::size_t projector = 0;  ///< number of the projector, from 0
  Vec3 point, direction;      ///< on the screen, and from the eye, in R
  Vec3 light;                 ///< of all projectors, as shares of white
  double error = 0;           ///< of geometry [pixels]; negative: too dark to tell
};

struct SimulationSettings {
  std::uint32_t every = 4;  ///< looks at every Nth pixel, across and down
  std::size_t heads = 1;    ///< places of the head; the first is the visitor's usual place
  std::vector<HallFault> faults;
  std::function<void(const std::string&)> progress;  ///< receives a line before each long step
  std::function<void(const SeenPixel&)> seen;        ///< receives pixels for pictures; null: no pictures
};

/// Mean and largest of some numbers.
struct ErrorFigures {
  std::uint64_t count = 0;
  double sum = 0, most = 0;

  void add(double value) {
    ++count;
    sum += value;
    most = value > most ? value : most;
  }
  double mean() const { return count > 0 ? sum / static_cast<double>(count) : 0; }
};

struct ProjectorFigures {
  std::string name;
  ErrorFigures geometry;    ///< [pixels]
  std::uint64_t lost = 0;   ///< pixels that show a wholly wrong direction
  ErrorFigures luminance;   ///< [share of white]
  ErrorFigures alone;       ///< luminance where no other projector gives light
  double steps = 0;         ///< what 8-bit values explain of the largest luminance error
  ErrorFigures sparseness;  ///< angle between pixels, seen from the eye [degrees]
};

/// Two projectors that light the same part of a screen.
struct SeamFigures {
  std::string one, two;
  ErrorFigures geometry, luminance;
};

struct SimulationResult {
  std::vector<ProjectorFigures> projectors;
  std::vector<SeamFigures> seams;
  std::size_t heads = 0;
  std::uint32_t every = 0;
  std::uint64_t screenPoints = 0, uncovered = 0, tooBright = 0;
  std::string suspect;  ///< projector whose error stands out; empty: none does
  std::string reason;   ///< what stands out

  double geometryMost() const;
  double luminanceMost() const;
  /// What 8-bit values explain of the largest luminance error.
  double stepsMost() const;
  double uncoveredShare() const;
};

/// Returns an error if the hall has no projector, or a fault names none or moves one without a lens.
Result<SimulationResult> simulateHall(const WallFile& hall, PictureSource& source,
                                      const SimulationSettings& settings);

/// Places for heads within the visitor's reach, the usual place first.
std::vector<Pose> headsOf(const VisitorPlace& visitor, double eyeSeparation, std::size_t count);

}  // namespace stadion
