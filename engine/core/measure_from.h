#pragma once
/// From where a `measure` node measures a throw.

#include <cstdint>

namespace stadion {

enum class MeasureFrom : std::uint8_t { Line, Point };  ///< measure: from

}  // namespace stadion
