#pragma once
#include "engine/maths/maths.h"
#include "engine/time_signature.h"
#include <array>
#include <string>
#include <string_view>
#include <vector>
namespace stadion {
struct TrackerSample {
  std::string name;
  Pose X_RT;
  std::uint32_t buttons = 0;
  std::array<float, 8> axes{};
  bool valid = true;
};
struct InputSample {
  Nanoseconds time = 0;
  std::vector<TrackerSample> trackers;
  const TrackerSample* find(std::string_view name) const {
    for (const auto& t : trackers) if (t.name == name) return &t;
    return nullptr;
  }
};
}
