#pragma once
/// A rig file for tests of trackers: poses come through at once, without a filter.

#include "engine/input/rig_file.h"

#include <gtest/gtest.h>

#include <string>

namespace stadion {

inline RigFile plainRig(const std::string& lines) {
  Diagnostics findings;
  auto rig = parseRigFile("stadion-rig 1\nfilter 0 0\nease 0\n" + lines, "hall.rig", findings);
  EXPECT_TRUE(rig) << (findings.all().empty() ? "" : findings.all()[0].message);
  return rig ? *rig : standardRig();
}

}  // namespace stadion
