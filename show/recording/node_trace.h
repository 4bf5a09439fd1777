#pragma once
/// Where a node was in every frame, as a table: for plots, and to see what a body really does.

#include "engine/scene/scene.h"

#include <string>

namespace stadion {

class NodeTrace {
public:
  explicit NodeTrace(std::string name);

  void record(const TimeSignature& now, const Scene& scene);
  /// CSV: time [s], position [m], orientation (quaternion w x y z); of bodies also velocity [m/s], angular
  /// velocity [rad/s] and mode.
  const std::string& table() const { return table_; }
  /// The name as part of a file's name.
  std::string fileName() const;

private:
  std::string name_;
  std::string table_;
};

}  // namespace stadion
