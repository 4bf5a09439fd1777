#pragma once
/// Finds where the states of two plays of a case begin to differ: first frame, node, field.
///
/// Threads  one at a time.

#include "profiling/regression/suite.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace stadion {

/// A program, ours or another build's, and the mode in which it plays.
struct StatePlay {
  std::string program, mode;
};

/// The state hash of every frame, as `PROGRAM hash` prints them; empty if it does not.
std::vector<std::string> stateHistory(const regression::SuiteCase& c, const StatePlay& play,
                                      std::chrono::seconds limit, const std::atomic<bool>& stop);

/// "first in frame 41: ball (kick.evs:27), velocity is 0 1 2 now, 0 1 3 before". Without node and field if a
/// program cannot save or compare states; empty if no frame differs.
std::string stateLocation(const regression::SuiteCase& c, const StatePlay& now, const StatePlay& before,
                          std::chrono::seconds limit, const std::atomic<bool>& stop);

/// A history as a baseline keeps it: of at most kKeptStates frames, eight digits of each hash.
std::string keptStates(const std::vector<std::string>& history);
/// The fields of nodes after some frames, by frame, as a baseline keeps them; none of a large scene.
std::map<std::uint64_t, std::string> keptFields(const regression::SuiteCase& c, const StatePlay& play,
                                                std::size_t frames, std::chrono::seconds limit,
                                                const std::atomic<bool>& stop);

/// The states of a case when its baseline was written.
struct KeptStates {
  const std::string& hashes;                           ///< keptStates()
  const std::map<std::uint64_t, std::string>& fields;  ///< keptFields()
};
/// "first in frames 33 to 40; after frame 49: ball (kick.evs:27), velocity is 0 1 2 now, 0 1 3 before".
/// Without node and field if none were kept; empty if no kept frame differs.
std::string stateLocation(const regression::SuiteCase& c, const StatePlay& now, const KeptStates& before,
                          std::chrono::seconds limit, const std::atomic<bool>& stop);

/// The first field that differs between two texts of StateFile::fields(), as in stateLocation(); empty if
/// none does.
std::string firstDifference(const std::string& now, const std::string& before);

}  // namespace stadion
