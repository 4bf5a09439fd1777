#pragma once
/// The order in which bodies that lean on each other are solved for: neighbours near each other.
///
/// Method   Cuthill and McKee: breadth first from an end, so that a tower is a line whatever its bodies' ids.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace stadion {

/// Two bodies that lean on each other. An index of `bodies` or more stands for something fixed.
using LeaningPair = std::array<std::uint32_t, 2>;

/// The place of each body in that order.
std::vector<std::uint32_t> placesInLine(std::size_t bodies, std::span<const LeaningPair> pairs);

/// Returns roughly how many multiplications a direct solution takes for flat contacts between these pairs.
double workOfLine(std::size_t bodies, std::span<const LeaningPair> pairs);

}  // namespace stadion
