#pragma once
/// Runs a program of a comparison and collects its output.
///
/// The program starts with all its symbols bound. Otherwise the first frame of an engine in shared libraries
/// would pay for its linking.
///
/// Errors   a program that cannot be started, or takes too long and is killed, has no output.

#include <chrono>
#include <string>
#include <vector>

namespace stadion::bench {

struct ProgramCall {
  std::vector<std::string> words;          ///< the program first
  std::vector<std::string> environment{};  ///< "NAME=value"; "NAME" alone removes the variable
  std::chrono::seconds limit{0};           ///< limit of real time; 0: none
};

std::string outputOf(const ProgramCall& call);

}  // namespace stadion::bench
