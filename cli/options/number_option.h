#pragma once
/// Checks of numbers on the command line. (CLI11's own let "nan" and "inf" through.)

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

namespace stadion {

/// Accepts finite decimal numbers from `least` to `most`; the message says so.
CLI::Validator numberFrom(double least, double most);
/// Accepts whole decimal numbers from `least` to `most`.
CLI::Validator wholeNumberFrom(std::uint64_t least, std::uint64_t most);

}  // namespace stadion
