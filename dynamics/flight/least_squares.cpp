#include "dynamics/flight/least_squares.h"

#include <limits>

namespace stadion {
namespace {

double sizeOf(const Eigen::VectorXd& residuals) {
  return residuals.allFinite() ? residuals.squaredNorm() : std::numeric_limits<double>::infinity();
}

Eigen::MatrixXd slopes(const Residuals& residuals, const Eigen::VectorXd& at, const Eigen::VectorXd& value,
                       const Eigen::VectorXd& scale) {
  Eigen::MatrixXd j(value.size(), at.size());
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    Eigen::VectorXd beside = at;
    beside[i] += 1e-4 * scale[i];
    const Eigen::VectorXd there = residuals(beside);
    if (there.allFinite())
      j.col(i) = (there - value) / 1e-4;  // per scale
    else
      j.col(i).setZero();
  }
  return j;
}

}  // namespace

Eigen::VectorXd leastSquares(const Residuals& residuals, Eigen::VectorXd at, const Eigen::VectorXd& scale,
                             int rounds) {
  Eigen::VectorXd value = residuals(at);
  double size = sizeOf(value), damping = 1e-3;
  for (int round = 0; round < rounds && std::isfinite(size); ++round) {
    const Eigen::MatrixXd j = slopes(residuals, at, value, scale), square = j.transpose() * j;
    const Eigen::VectorXd downhill = -j.transpose() * value;
    bool better = false;
    while (!better && damping < 1e8) {
      Eigen::MatrixXd damped = square;
      damped.diagonal().array() += damping * (square.diagonal().array() + 1e-12);
      const Eigen::VectorXd trial = at + scale.cwiseProduct(damped.ldlt().solve(downhill));
      const Eigen::VectorXd there = residuals(trial);
      const double trialSize = sizeOf(there);
      better = trialSize < size;
      damping *= better ? 0.2 : 5;
      if (!better) continue;
      const bool done = trialSize > (1 - 1e-7) * size;
      at = trial;
      value = there;
      size = trialSize;
      if (done) return at;
    }
    if (!better) return at;
  }
  return at;
}

}  // namespace stadion
