#pragma once
/// How near each body of a show comes to its finest model, what that costs, and which models would do.
///
/// The finest model of a body collides as its own mesh. A mesh that is a box or convex within rounding
/// collides as that, an open mesh as its hull, and a body whose true shape the script names as that shape.
/// Impacts are exact, and steps of lasting contact are divided by eight. The same show is played with one body's
/// model changed at a time, and the body's places are compared frame by frame. The contact scheme of the
/// whole show, `impact=`, is such a model too. Fields, masses by density, and the drag area stay what the
/// script says: what a body is not hooked to is no part of any model.
///
/// Errors   of place: how far the node's origin is from where it is with the finest model [m].
/// Costs    processor time a frame. A model's is what the body's dynamics node takes more with it than
///          without the body, the least of the rounds; that of bodies which are only listed is their share of
///          the node's time, by the arcs they begin.

#include "show/measure/model_run.h"

#include <functional>

namespace stadion {

struct FidelityOptions {
  ShowOptions show;
  double tolerance = 1e-3;          ///< [m]
  std::uint64_t most = 8;           ///< bodies that are played with other models: the most expensive
  std::uint64_t rounds = 3;         ///< how often each model but the finest is played, for its cost
  std::string finest;               ///< shape that a body has in truth; empty: its mesh, else its hull
  std::vector<std::string> bodies;  ///< only these are played with other models; empty: the most expensive
  std::function<void(const Diagnostics&)> report{};  ///< receives findings of files that are loaded
};

/// A body played with one model.
struct TriedModel {
  /// Name of the model: what an author would write or do, such as "shape=box", "without air".
  std::string name;
  BodyModel model;
  bool asIs = false, finest = false, simpler = false;
  bool played = false;               ///< false: the model cannot be fitted like that
  double cost = 0;                   ///< [us] a frame
  double noise = 0;                  ///< costs up to this are as good as none [us]
  double error = 0, endError = 0;    ///< greatest, and at the end [m]
  double turned = 0;                 ///< greatest difference in orientation [rad]
  std::optional<double> beyondFrom;  ///< when the error first exceeds the tolerance [s]
};

struct BodyFidelity {
  PlayedBody body;
  double cost = 0;                  ///< [us] a frame, its share as the script says
  std::vector<TriedModel> tried{};  ///< the finest first; empty if it was not among those looked at
};

struct Fidelity {
  std::string show;
  std::uint64_t frames = 0;
  double rate = 60, tolerance = 1e-3;
  std::vector<BodyFidelity> bodies;  ///< the most expensive first

  std::size_t lookedAt() const;
};

/// Calls `progress` with each show that it plays. Returns nothing, with the findings, if the show cannot be
/// played.
std::optional<Fidelity> measureFidelity(const FidelityOptions& options, Diagnostics& findings,
                                        const std::function<void(const std::string&)>& progress);

/// Why the finest model is not to be trusted as the truth; empty if it is.
std::string cautionAbout(const BodyFidelity& body);

/// Models that are simpler than what the script says and stay within the tolerance; if that itself does not,
/// all that do.
std::vector<const TriedModel*> advisable(const BodyFidelity& body);

std::string fidelityTable(const Fidelity& fidelity);
std::string fidelityJson(const Fidelity& fidelity);  ///< one object, on one line

}  // namespace stadion
