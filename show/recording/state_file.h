#pragma once
/// The state of a show after a frame as a file, and where it differs from another run's.
///
/// Threads  App only, between two frames, or after the run.
/// Errors   of files, with their names.

#include "engine/scene/scene.h"
#include "show/recording/named_difference.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace stadion {

/// `files` and `state` are SceneSnapshot::filesOf() and save() of the other scene.
std::optional<SavedStateDifference> savedStateDifference(Scene& scene, std::uint64_t files,
                                                         std::span<const std::uint8_t> state);

/// Writes the scene's state: its bytes, and its fields by name, which other builds can compare too.
std::optional<Diagnostic> saveState(Scene& scene, const std::string& file);

/// What saveState() wrote.
///
/// Errors  a file that is no state, and one that was truncated or damaged since.
class StateFile {
public:
  static Result<StateFile> read(const std::string& file);

  /// Compares the scene with the state. If the frames differ, they are the difference. If scripts or models
  /// differ, fields are compared by name.
  std::optional<SavedStateDifference> differenceFrom(Scene& scene) const;
  /// The fields by name: "@NODE<tab>FILE:LINE", and below it "FIELD<tab>VALUE" a line; fields that are zero
  /// are left out. Empty if the file has none.
  const std::string& fields() const { return fields_; }

private:
  std::uint64_t files_ = 0;
  std::vector<std::uint8_t> state_;
  std::string fields_;
};

}  // namespace stadion
