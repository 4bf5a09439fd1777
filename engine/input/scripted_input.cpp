#include "engine/input/scripted_input.h"

#include "engine/maths/angles.h"
#include "engine/maths/functions.h"

#include <algorithm>

namespace stadion {

bool ScriptedInput::add(const std::string& tracker, const InputStamp& stamp) {
  if (!stamp.X_RT.finite() || stamp.time < 0) return false;
  const auto known = std::ranges::find(log_.tracks, tracker, &InputTrack::name);
  if (known == log_.tracks.end()) {
    log_.tracks.push_back({tracker, {stamp}});
    return true;
  }
  if (stamp.time <= known->stamps.back().time) return false;
  known->stamps.push_back(stamp);
  return true;
}

ScriptedInput& ScriptedInput::key(const std::string& tracker, double seconds, const Vec3& p_RT,
                                  const Vec3& turn, bool smooth, std::uint32_t buttons) {
  const Vec3 angle = turn * kDegree;
  InputStamp stamp;
  stamp.time = fromSeconds(seconds);
  stamp.X_RT = {p_RT, det::fromEuler(angle.x(), angle.y(), angle.z())};
  stamp.smooth = smooth;
  stamp.buttons = buttons;
  add(tracker, stamp);
  return *this;
}

}  // namespace stadion
