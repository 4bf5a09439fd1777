#pragma once
/// Checks of numbers on the command line. (CLI11's own let "nan" and "inf" through.)

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace stadion {

/// Accepts finite decimal numbers from `least` to `most`; the message says so.
CLI::Validator numberFrom(double least, double most);
/// Accepts whole decimal numbers from `least` to `most`.
CLI::Validator wholeNumberFrom(std::uint64_t least, std::uint64_t most);

/// A finite decimal number and nothing else; nothing if it is not that.
std::optional<double> parseNumber(const std::string& text);

/// "800x600": two whole numbers and nothing else; nothing if it is not that.
std::optional<std::pair<std::uint32_t, std::uint32_t>> parseSize(const std::string& text);

}  // namespace stadion
