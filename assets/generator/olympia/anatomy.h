#pragma once
/// The bodies of people: of clay on their bones at rest, cast to surfaces that the bones carry.
///
/// Frames   the person's place at rest (skeleton.h).
/// Units    metres. A person is 1.76 m tall, seven and a half heads.

#include "assets/generator/olympia/skeleton.h"

namespace stadion::assets {

enum class Hair { Dark, Fair, Bearded, Grey };

/// What a person wears: a chiton over both shoulders, one over the left one alone, or a loincloth.
enum class Dress { Chiton, Exomis, Loincloth };

struct Look {
  Hair hair = Hair::Dark;
  Dress dress = Dress::Chiton;
  double girth = 1;  ///< of limbs and trunk
  Rgb skin{0.80, 0.58, 0.44}, cloth{0.92, 0.89, 0.81}, border{0.56, 0.20, 0.15};
};

/// Tanned by the sun from above, oiled; darker where it folds.
Rgb skinColour(const Look& look, Point p, Point n, double open);

/// The head in its own frame.
class HeadClay {
public:
  HeadClay(const Look& look);
  /// Adds it to a body's clay, on its bone.
  void addTo(Clay& clay, int bone, const Pose& X) const;
  /// By how much the band around it stands out.
  double band(Point p) const;
  /// Draws vertices near the band's edges onto them; the head's origin is at `neck`.
  void straighten(Part& part, Point neck) const;
  /// Its colour, where its skin has this one.
  Rgb colour(Point p, const Rgb& skin) const;

private:
  void addLocks(int count, bool beard);
  bool near(Point p) const;

  Rgb hair_, band_;
  bool beard_;
  Clay face_;
  std::vector<Point> locks_;
};

/// Adds trunk, arms and legs on their bones. What cloth covers has fewer muscles.
void addTrunk(Clay& clay, double girth, bool covered);
void addArm(Clay& clay, double side, double girth);
void addLeg(Clay& clay, double side, double girth);

/// Adds the part with its vertices' bones to the model. Triangles whose middle `leave` accepts
/// are left out.
void addSurface(FigureModel& to, Part part, const std::function<Carriers(Point)>& carriers,
                const std::function<bool(Point)>& leave = {});

/// A pleat's phase around the axis x = y = 0, from -1 to 1.
double pleatAt(Point p, double count);

/// Adds an athlete's skin and clothes.
void addAthlete(FigureModel& to, const Look& look);

}  // namespace stadion::assets
