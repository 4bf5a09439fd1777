#pragma once
/// Shares of the loudspeakers in a sound from a direction: vector base amplitude panning.
///
/// A direction between loudspeakers is a positive sum of the directions of two (in a ring) or three of them (on
/// a sphere). The factors of that sum are the gains, scaled so that their squares add up to 1: the loudness does
/// not depend on the direction. So a sound in the direction of a loudspeaker comes from it alone, and between two
/// the tangent law holds.
///
/// Loudspeakers at about the same height make a ring, and only the azimuth counts. Others make a sphere, divided
/// into triangles by the convex hull of their directions. A direction that no loudspeakers enclose has virtual
/// ones: what they would play, the neighbours share in equal energies. So every direction is heard, and nothing
/// jumps when a sound goes around the visitor.
///
/// A sound above or below a ring, and one close to the head, comes from all loudspeakers alike.
///
/// Frames   rig space, seen from the ears.
/// Threads  immutable; any thread.
/// Sources  V. Pulkki, "Virtual sound source positioning using vector base amplitude panning", J. Audio Eng.
///          Soc. 45(6), 1997. The virtual loudspeakers are those of ITU-R BS.2127 in spirit, not in numbers.

#include "engine/maths/maths.h"

#include <cstddef>
#include <span>
#include <vector>

namespace stadion {

class SpeakerPanning {
public:
  /// Directions of the loudspeakers, which need not be unit vectors. Expects at least one, none of them zero, and
  /// no two alike.
  explicit SpeakerPanning(const std::vector<Vec3>& directions);

  /// Returns the number of loudspeakers.
  std::size_t size() const { return count_; }
  /// Returns true if only the azimuth counts.
  bool isRing() const { return ring_; }

  /// Gains of a sound at that place, seen from the ears [m]. `gains` has size() elements.
  void gainsOf(const Vec3& place, std::span<double> gains) const;
  /// Gains of a sound from all around.
  void gainsAround(std::span<double> gains) const;
  /// Gains of one side of a stereo sound without a place: the loudspeakers of that side, and those in the middle
  /// at half of their energy. `side`: -1 left, +1 right.
  void gainsOfSide(int side, std::span<double> gains) const;

private:
  /// Two or three loudspeakers that enclose directions.
  struct Section {
    std::size_t corner[3];
    Mat3 inverse;  ///< direction to gains; of a pair, the third gain is always 0
  };

  void makeRing();
  void makeSphere();
  bool addVirtual(std::vector<Section>& faces);
  std::vector<Section> hull() const;
  void shareVirtual(const std::vector<std::vector<std::size_t>>& neighbours);
  void pan(const Vec3& direction, std::span<double> energies) const;

  std::size_t count_;
  bool ring_ = false;
  std::vector<Vec3> directions_;  ///< unit vectors; virtual ones follow the real ones
  std::vector<Section> sections_;
  std::vector<std::vector<double>> shares_;  ///< of each virtual one: the energy that each real one gets
};

}  // namespace stadion
