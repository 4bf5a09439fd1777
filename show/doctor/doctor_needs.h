#pragma once
/// What must work on this machine, from shows, wall files, cluster files and topics.
///
/// Threads  plain values.
/// Errors   a file that cannot be read, and words that are no topic.

#include "engine/display/wall_file.h"
#include "show/doctor/doctor.h"

#include <deque>
#include <memory>

namespace stadion {

class MachineNeeds {
public:
  /// Null, with the findings, if a word means nothing.
  static std::unique_ptr<MachineNeeds> read(const std::vector<std::string>& words, Diagnostics& findings);

  /// Refers to this object.
  DoctorNeeds needs() const;

private:
  bool add(const std::string& word, Diagnostics& findings);
  bool addShow(const std::string& file, Diagnostics& findings);
  bool addWalls(const std::string& file, Diagnostics& findings);
  bool addCluster(const std::string& file, Diagnostics& findings);

  std::vector<std::string> topics_, interfaces_;
  std::deque<WallFile> walls_;
};

}  // namespace stadion
