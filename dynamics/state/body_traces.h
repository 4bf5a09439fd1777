#pragma once
/// The paths of bodies within a frame, part by part: for other worlds that follow them, and to find when
/// pairs part.

#include "dynamics/state/contact_events.h"
#include "dynamics/state/world_objects.h"
#include "dynamics/state/world_time.h"

#include <vector>

namespace stadion {

class BodyTraces {
public:
  BodyTraces(const WorldTime& time, const WorldObjects& objects, ContactMemory& memory)
      : time_(time), objects_(objects), memory_(memory) {}

  /// From tau on the body is traced for others (`traced`) or to find when it parts (`awaited`), or not.
  void trace(RigidBody& b, bool traced, bool awaited, double tau);
  /// At tau the body changes at once how it moves: notes its way from then on if one of its pairs may part.
  void expectPartings(RigidBody& b, double tau);
  /// Notes, if the body is traced, that it follows its present arc from tau on.
  void note(RigidBody& b, double tau);
  /// Notes the path of a held body in this part of a frame.
  void noteHeld(RigidBody& b, double tau);
  /// A frame begins, or goes on (`continues`).
  void begin(bool continues);
  /// Lets all bodies stand from t1 on.
  void pause(bool continues);
  void forget(RigidBody& b) { std::erase(list_, &b); }

private:
  void addPart(RigidBody& b, ArcPiece part);
  void find(bool goesOn);

  const WorldTime& time_;
  const WorldObjects& objects_;
  ContactMemory& memory_;
  std::vector<RigidBody*> list_;
  bool stoodStill_ = false;  ///< the last part of the frame was a pause
};

}  // namespace stadion
