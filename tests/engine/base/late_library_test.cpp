/// Libraries that are loaded when they are needed.

#include "engine/base/late_library.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stadion {
namespace {

const LateLibrary lateMaths("libm.so.6", "libc6"), lateNothing("libnothing.so.9", "libnothing9");
const LateFunction<double(double)> lateRoot(lateMaths, "sqrt");
const LateFunction<int(int)> lateUnknown(lateMaths, "stadionHasNoSuchFunction");

TEST(LateLibrary, CallsItsFunctions) {
  EXPECT_FALSE(lateMaths.load());
  EXPECT_EQ(lateRoot(2.25), 1.5);
  EXPECT_EQ(lateRoot(9.0), 3.0);
  EXPECT_EQ(lateUnknown.address(), nullptr);
}

TEST(LateLibrary, OneThatIsMissingIsNamedWithItsPackage) {
  const auto missing = lateNothing.load();
  ASSERT_TRUE(missing);
  EXPECT_EQ(missing->message, "libnothing.so.9 is missing: apt-get install libnothing9");
}

}  // namespace
}  // namespace stadion
