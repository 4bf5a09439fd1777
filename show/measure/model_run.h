#pragma once
/// Plays a show without drawing it, with one body's model changed, and notes what its bodies did and cost.

#include "dynamics/world/world.h"
#include "show/player/player.h"

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

/// How one body is modelled in a run; the others are as the script says.
struct BodyModel {
  NodeRef body;                      ///< invalid: all as the script says
  std::string shape;                 ///< as the language writes it; empty: as the script says
  std::optional<double> dragArea;    ///< drag area, so that another shape does not change the drag [m2]
  std::vector<std::string> without;  ///< fields that it is not hooked to
  std::uint32_t fineness = 1;        ///< fineness of the whole show's dynamics (World::setStepDivider)
  /// Impact scheme of the whole show's dynamics; empty: as the script says.
  std::optional<ImpactScheme> impacts;
  bool absent = false;  ///< not simulated at all: what the show costs without it
};

/// A field that a body is hooked to when it is first seen.
struct HookedField {
  std::string name;       ///< as the script says it
  std::string_view type;  ///< the name of its node type
};

/// A body of a played show: its properties and its motion.
struct PlayedBody {
  std::string name, file;
  std::uint32_t line = 0;
  ShapeKind shape = ShapeKind::Mesh;
  bool chosen = false;   ///< by shape=auto
  double deviation = 0;  ///< deviation of the shape from the model [m]
  std::size_t triangles = 0;
  std::string exact;    ///< box or convex, if its model is just that to rounding; else empty
  double dragArea = 0;  ///< [m2]
  std::vector<HookedField> fields;
  NodeRef dynamics;                           ///< the node that moves it
  ImpactScheme::Kind impacts{};               ///< how that node finds impacts
  std::array<std::uint64_t, 7> modes{};       ///< frames in each BodyMode
  std::array<std::uint64_t, 3> flights{};     ///< frames in flight, by FlightClass
  std::uint64_t arcs = 0;                     ///< begun
  std::vector<std::optional<Pose>> places{};  ///< in each frame, of bodies that are watched
};

struct PlayedShow {
  std::uint64_t frames = 0;
  double rate = 60;
  std::map<NodeRef, PlayedBody> bodies;      ///< bodies that a dynamics node moves
  std::map<NodeRef, double> milliseconds{};  ///< total time of each dynamics node
};

/// Plays the show. With a body in `model`, notes that body alone, with its places. Without one, notes all
/// bodies, without places. Null, with the findings, if it cannot be built like that. Findings of files that
/// are loaded go to `report`, if there is one.
std::optional<PlayedShow> playWith(const ShowOptions& show, const BodyModel& model, Diagnostics& findings,
                                   std::function<void(const Diagnostics&)> report = {});

}  // namespace stadion
