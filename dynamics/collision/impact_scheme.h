#pragma once
/// How a world finds the first contact of two sides: `impact=` of a dynamics node.

namespace stadion {

struct ImpactScheme {
  enum class Kind {
    Exact,  ///< roots and steps that cannot pass a contact (touch.h)
    Paper   ///< steps, tests, and a step that is subdivided (stepped_search.h)
  };
  Kind kind = Kind::Exact;
  double tolerance = 1e-3;  ///< Paper: how near sides are brought before they touch [m]
  double step = 1.0 / 60;   ///< Paper: between two tests, on a grid of show time [s]
};

}  // namespace stadion
