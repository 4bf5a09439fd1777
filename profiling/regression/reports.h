#pragma once
/// The results of a suite, for people and for programs.
///
/// Threads  free functions, any thread.

#include "profiling/regression/spans/result.h"

#include <string>

namespace stadion::regression {

/// Returns a line for each check, worst last, and a summary line.
std::string tableOf(const SuiteResult& result);

/// JUnit's XML: a test case for each check, a suite for each case.
std::string junitOf(const SuiteResult& result);

/// Google Benchmark's layout: "context", and "benchmarks" with an entry for each round of each stage and its
/// median. Hashes and counts are further fields of an entry named after the case. Checks are in "checks", the
/// shows' warnings in "warnings".
std::string benchmarkJsonOf(const SuiteResult& result);

}  // namespace stadion::regression
