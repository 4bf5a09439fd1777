/// Tables of coefficients: read, refused, and turned into air.

#include "dynamics/flight/flight_table.h"
#include "engine/maths/angles.h"

#include <cmath>
#include <gtest/gtest.h>

namespace stadion {
namespace {

const std::string kHead = "# area = 0.04\n# length = 0.2\n# axis = z\nalpha_deg,CD,CL,CM,CQ\n";

std::string reasonFor(const std::string& text, int axis = 2) {
  const auto read = readFlightTable(text, "air.csv", axis);
  return read ? "" : format(read.error());
}

/// A wing whose CD = 0.1 + sin^2 a, CL = sin 2a, CM = 0.1 sin 2a.
std::vector<FlightTableRow> wing(double from, double to, double step) {
  std::vector<FlightTableRow> rows;
  for (double a = from; a <= to + 1e-9; a += step) {
    const double s = std::sin(a * kDegree), l = std::sin(2 * a * kDegree);
    rows.push_back({a * kDegree, .1 + s * s, l, .1 * l, .05});
  }
  return rows;
}

TEST(FlightTable, APlatesForcesAreItsCoefficients) {
  const FlightModel model = tableFrom(wing(0, 90, 5), .04, .2, 2);
  for (const double degrees : {-60.0, -12.0, 0.0, 3.0, 11.0, 47.0, 88.0}) {
    const double a = degrees * kDegree, V = 20, q = .5 * 1.2 * V * V * .04;
    const Vec3 h(std::cos(a), 0, -std::sin(a)), up(std::sin(a), 0, std::cos(a));  // air from below for a > 0
    const Wrench f = aerodynamics(model, 1.2, V * h, Vec3(0, 0, -40));
    const double s = std::sin(a), l = std::sin(2 * a);
    EXPECT_NEAR(-f.force.dot(h), q * (.1 + s * s), 1e-3 * q) << degrees;
    EXPECT_NEAR(f.force.dot(up), q * l, 1e-3 * q) << degrees;
    EXPECT_NEAR(-f.torque.y(), q * .2 * .1 * l, 1e-3 * q * .2) << degrees;  // the leading edge rises
    EXPECT_NEAR(f.torque.x(), 0, 1e-12);
  }
  const Wrench turning = aerodynamics(model, 1.2, Vec3(20, 0, 0), Vec3(3, 0, 0));
  EXPECT_NEAR(turning.torque.x(), -.5 * 1.2 * .04 * .04 * .05 * 20 * 3, 1e-9);
}

TEST(FlightTable, ARodsForcesAreItsCoefficientsAndItsTailTurnsBack) {
  const FlightModel model = tableFrom({{0, .01, 0, 0, 0},
                                       {30 * kDegree, .26, .43, -.05, 0},
                                       {60 * kDegree, .76, .43, -.087, 0},
                                       {90 * kDegree, 1, 0, -.1, 0}},
                                      .05, 2, 0);
  const double q = .5 * 1.2 * 400 * .05;
  const Vec3 h(std::cos(30 * kDegree), 0, -std::sin(30 * kDegree));
  const Wrench f = aerodynamics(model, 1.2, 20 * h, Vec3::Zero());
  EXPECT_NEAR(-f.force.dot(h), q * .26, 1e-3 * q);
  EXPECT_NEAR(f.torque.y(), q * 2 * .05, 1e-3 * q);  // nose down, towards the velocity
  const Wrench back = aerodynamics(model, 1.2, Vec3(-20 * h.x(), 0, 20 * h.z()), Vec3::Zero());
  EXPECT_NEAR(back.torque.y(), q * 2 * .05, 1e-3 * q);
  EXPECT_NEAR(-back.force.dot(Vec3(-h.x(), 0, h.z())), q * .26, 1e-3 * q);
}

TEST(FlightTable, CloseRowsAreReproducedCloselyInBetween) {
  const FlightModel coarse = tableFrom(wing(0, 90, 5), .04, .2, 2),
                    fine = tableFrom(wing(0, 90, .5), .04, .2, 2);
  for (double a = -89; a < 90; a += 1.7) {
    const Vec3 u(20 * std::cos(a * kDegree), 0, -20 * std::sin(a * kDegree));
    const Wrench x = aerodynamics(coarse, 1.2, u, Vec3::Zero()), y = aerodynamics(fine, 1.2, u, Vec3::Zero());
    EXPECT_LE((x.force - y.force).norm(), 2e-3 * (1 + y.force.norm())) << a;
  }
}

TEST(FlightTable, ATextGoesThereAndBack) {
  const std::string text = flightTableText(wing(0, 90, 5), .04, .2, 2);
  const auto read = readFlightTable(text, "air.csv", 0);
  ASSERT_TRUE(read) << format(read.error());
  const Vec3 u(15, 3, -4);
  const Wrench a = aerodynamics(read.value(), 1.2, u, Vec3(1, 2, 3)),
               b = aerodynamics(tableFrom(wing(0, 90, 5), .04, .2, 2), 1.2, u, Vec3(1, 2, 3));
  EXPECT_LE((a.force - b.force).norm(), 1e-6);
  EXPECT_LE((a.torque - b.torque).norm(), 1e-6);
}

TEST(FlightTable, NormalAndAxialCoefficientsMeanTheSame) {
  std::string lift = "alpha_deg,CD,CL,CM\n", normal = "alpha_deg,CN,CA,CM\n";
  for (const FlightTableRow& r : wing(0, 90, 10)) {
    const double s = std::sin(r.alpha), c = std::cos(r.alpha), a = r.alpha / kDegree;
    lift += std::to_string(a) + "," + std::to_string(r.drag) + "," + std::to_string(r.lift) + ",0\n";
    normal += std::to_string(a) + "," + std::to_string(r.lift * c + r.drag * s) + "," +
              std::to_string(r.drag * c - r.lift * s) + ",0\n";
  }
  const auto a = readFlightTable(lift, "a", 2), b = readFlightTable(normal, "b", 2);
  ASSERT_TRUE(a && b);
  const Vec3 u(15, 3, -4);
  EXPECT_LE((aerodynamics(a.value(), 1.2, u, Vec3::Zero()).force -
             aerodynamics(b.value(), 1.2, u, Vec3::Zero()).force)
                .norm(),
            1e-2);
}

TEST(FlightTable, WhatIsWrongIsSaidWithItsPlace) {
  EXPECT_NE(reasonFor(kHead + "0,0,0,0,0\n45,1,x,0,0\n90,1,0,0,0\n")
                .find("air.csv:6:6: error: \"x\" is not a finite number"),
            std::string::npos)
      << reasonFor(kHead + "0,0,0,0,0\n45,1,x,0,0\n90,1,0,0,0\n");
  EXPECT_NE(reasonFor(kHead + "0,0,0,0,0\n45,1,nan,0,0\n90,1,0,0,0\n").find("air.csv:6"), std::string::npos);
  EXPECT_NE(reasonFor(kHead + "0,0,0,0,0\n45,1,0,0\n").find("air.csv:6:8: error: 4 numbers where"),
            std::string::npos);
  EXPECT_NE(reasonFor(kHead + "0,0,0,0,0\n50,1,0,0,0\n40,1,0,0,0\n90,1,0,0,0\n")
                .find("air.csv:7:1: error: alpha_deg must rise"),
            std::string::npos);
  EXPECT_NE(reasonFor(kHead + "0,0,0,0,0\n40,1,0,0,0\n80,1,0,0,0\n")
                .find("air.csv:7:1: error: the last row must be at 90"),
            std::string::npos);
  EXPECT_NE(reasonFor("# area = -2\nalpha_deg,CD,CL,CM\n0,0,0,0\n")
                .find("air.csv:1:10: error: area must be a positive number"),
            std::string::npos);
  EXPECT_NE(reasonFor("# axis = y\nalpha_deg,CD,CL,CM\n0,0,0,0\n").find("air.csv:1:10: error: axis is x"),
            std::string::npos);
  EXPECT_NE(reasonFor("alpha,CD,CL,CM\n0,0,0,0\n").find("the columns must be alpha_deg"), std::string::npos);
  EXPECT_NE(reasonFor("alpha_deg,CD,CD,CM\n").find("a second column \"CD\""), std::string::npos);
  EXPECT_EQ(reasonFor(""), "air.csv:1:1: error: no rows of numbers");
  EXPECT_NE(reasonFor(std::string("\0\n,,\n", 5)).find("error"), std::string::npos);
}

// Excel's "CSV UTF-8" begins so.
TEST(FlightTable, AByteOrderMarkIsNoPartOfTheFirstName) {
  EXPECT_EQ(reasonFor("\xEF\xBB\xBF"
                      "alpha_deg,CD,CL,CM\n0,0,0,0\n45,1,0,0\n90,1,0,0\n"),
            "");
}

TEST(FlightTable, AirThatNoBodyOfThisLengthHasIsRefusedWithTheCell) {
  const auto reason = [](const std::string& text, double length) {
    const auto read = readFlightTable(text, "air.csv", 2, length);
    return read ? "" : format(read.error());
  };
  const std::string end = "45,1,0,0,0\n90,1,0,0,0\n";
  struct Refused {
    std::string text;
    const char* said;
  };
  for (const Refused& c :
       {Refused{kHead + "0,-5,0,0,0\n" + end, "air.csv:5:3: error: CD must be 0 or more, not -5"},
        Refused{kHead + "0,0,1e300,0,0\n" + end,
                "air.csv:5:5: error: CL of 1e+300 makes 4e+298 m2; a body of 0.22 m"},
        Refused{kHead + "0,0,0,-9,0\n" + end,
                "air.csv:5:7: error: CM of -9 makes -0.072 m3; a body of 0.22 m"},
        Refused{kHead + "0,0,0,0,-1\n" + end, "air.csv:5:9: error: CQ must be 0 or more"},
        Refused{"# length = 1e9\nalpha_deg,CD,CL,CM\n0,0,0,0\n45,1,0,0\n90,1,0,0\n",
                "air.csv:1:12: error: length must be at most 1 m for a body of 0.22 m, not \"1e9\""},
        Refused{"# area = 9\nalpha_deg,CD,CL,CM\n0,0,0,0\n45,1,0,0\n90,1,0,0\n", "area must be at most 1 m2"},
        Refused{"# area = 0.04\nalpha_deg,CA,CN,CM\n0,-1,0,0\n45,1,0,0\n90,1,0,0\n",
                "air.csv:3:1: error: CA and CN make a drag of -1"}})
    EXPECT_NE(reason(c.text, 0.22).find(c.said), std::string::npos) << reason(c.text, 0.22);
  EXPECT_EQ(reason(kHead + "0,0.06,0,0,0.05\n45,1,.8,.1,.05\n90,1.14,0,0,.05\n", 0.22), "");
}

}  // namespace
}  // namespace stadion
