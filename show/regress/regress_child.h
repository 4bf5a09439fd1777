#pragma once
/// A `stadion` program, ours or another build's, run to play a case of a suite.
///
/// Threads  one at a time.
/// Errors   in the result, as a sentence; Ctrl-C ends the child, and the result says so.

#include "profiling/regression/spans/facts.h"
#include "profiling/regression/suite.h"

#include <atomic>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace stadion {

struct ChildResult {
  int status = -1;       ///< exit status; 128 + signal
  std::string out, err;  ///< output of the program
  std::string fault;     ///< why it did not do what was asked; empty: it did
  bool missing = false;  ///< there is no such program
};

/// Returns the text of `fault` for a child under valgrind.
constexpr const char* kNoValgrind = "there is no valgrind; install it: apt install valgrind";

/// Runs the words to the end, with our environment and `environment` ("NAME=value"); past the limit, or once
/// `stop` is true, it is killed, and what it has started.
ChildResult runChild(const std::vector<std::string>& words, std::chrono::seconds limit,
                     const std::atomic<bool>& stop, const std::vector<std::string>& environment = {});
/// Two at a time, whose standard inputs are the ends of a socket: they take turns, the first one first.
std::pair<ChildResult, ChildResult> runInTurns(const std::vector<std::string>& first,
                                               const std::vector<std::string>& second,
                                               std::chrono::seconds limit, const std::atomic<bool>& stop,
                                               const std::vector<std::string>& environment = {});

/// The content of a file; empty if it cannot be read.
std::string textOf(const std::string& file);

/// Returns the warnings in the output of a program that succeeded, each once.
std::vector<std::string> warningsIn(const std::string& said);

/// `PROGRAM run SHOW ... --json`, as the case has it.
std::vector<std::string> playWords(const std::string& program, const regression::SuiteCase& c,
                                   const std::string& mode);

}  // namespace stadion
