#pragma once
/// Smallest sum of squares: Levenberg and Marquardt's method with difference quotients.
///
/// Source   Nocedal & Wright, Numerical Optimization, 2006, ch. 10.3.

#include "engine/maths/eigen.h"

#include <Eigen/Dense>
#include <functional>

namespace stadion {

/// All of one length, whatever the parameters; a value that is not finite makes the trial fail.
using Residuals = std::function<Eigen::VectorXd(const Eigen::VectorXd& parameters)>;

/// From `start`, with steps on the order of `scale` (positive, as long), at most `rounds` of them.
Eigen::VectorXd leastSquares(const Residuals& residuals, Eigen::VectorXd start, const Eigen::VectorXd& scale,
                             int rounds);

}  // namespace stadion
