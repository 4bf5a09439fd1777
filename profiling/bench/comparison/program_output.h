#pragma once
/// Runs a program of a comparison and takes what it prints.
///
/// The program starts with all its symbols bound: else the first frame of an engine in shared libraries pays
/// for its linking.
///
/// Errors   what cannot be started, or takes too long and is killed, has said nothing.

#include <chrono>
#include <string>
#include <vector>

namespace stadion::bench {

struct ProgramCall {
  std::vector<std::string> words;          ///< the program first
  std::vector<std::string> environment{};  ///< "NAME=value"; "NAME" alone takes it away
  std::chrono::seconds limit{0};           ///< by the clock; 0: none
};

std::string outputOf(const ProgramCall& call);

}  // namespace stadion::bench
