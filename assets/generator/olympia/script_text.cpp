#include "assets/generator/olympia/script_text.h"

#include "assets/generator/craft/geometry.h"

#include <cstdio>

namespace stadion::assets {

std::string number(double v, int decimals) {
  char line[64];
  std::snprintf(line, sizeof line, "%.*f", decimals, v);
  std::string out = line;
  if (decimals > 0) {
    while (out.back() == '0') out.pop_back();
    if (out.back() == '.') out.pop_back();
  }
  return out == "-0" ? "0" : out;
}

std::string list(const Vec3& v, int decimals) {
  return number(v.x(), decimals) + "," + number(v.y(), decimals) + "," + number(v.z(), decimals);
}

Vec3 angles(const Quat& q) {
  const Mat3 m = q.toRotationMatrix();
  return 180 / kPi * Vec3(det::atan2(m(2, 1), m(2, 2)), -det::asin(m(2, 0)), det::atan2(m(1, 0), m(0, 0)));
}

std::string placed(const Pose& pose) {
  return "position=\"" + list(pose.p, 3) + "\", orientation=\"" + list(angles(pose.q), 1) + "\"";
}

}  // namespace stadion::assets
