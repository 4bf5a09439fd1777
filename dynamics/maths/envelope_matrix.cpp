#include "dynamics/maths/envelope_matrix.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kLostPivot = 1e-14;  ///< relative to what was on the diagonal

double sumOfProducts(const double* a, const double* b, std::size_t n) {
  double sum[4] = {0, 0, 0, 0};
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4)
    for (std::size_t k = 0; k < 4; ++k) sum[k] += a[i + k] * b[i + k];
  for (; i < n; ++i) sum[0] += a[i] * b[i];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

}  // namespace

void EnvelopeMatrix::reset(const std::vector<std::size_t>& firsts) {
  first_ = firsts;
  begin_.resize(firsts.size());
  std::size_t all = 0;
  for (std::size_t i = 0; i < firsts.size(); ++i) {
    begin_[i] = all;
    all += i - firsts[i] + 1;
  }
  lower_.assign(all, 0);
  upper_.assign(all, 0);
}

/// Doolittle's method. The diagonal is U's and lies with the rows.
bool EnvelopeMatrix::factor() {
  const std::size_t n = size();
  for (std::size_t i = 0; i < n; ++i) {
    double *row = lower_.data() + begin_[i], *column = upper_.data() + begin_[i];
    const std::size_t from = first_[i];
    for (std::size_t j = from; j < i; ++j) {
      const std::size_t start = std::max(from, first_[j]);
      const double *rowOfJ = lower_.data() + begin_[j], *columnOfJ = upper_.data() + begin_[j];
      const std::size_t mine = start - from, theirs = start - first_[j], many = j - start;
      row[j - from] -= sumOfProducts(row + mine, columnOfJ + theirs, many);
      column[j - from] -= sumOfProducts(rowOfJ + theirs, column + mine, many);
      row[j - from] /= rowOfJ[j - first_[j]];
    }
    double& pivot = row[i - from];
    const double before = std::fabs(pivot);
    pivot -= sumOfProducts(row, column, i - from);
    if (!(std::fabs(pivot) > kLostPivot * before)) return false;
  }
  return true;
}

void EnvelopeMatrix::solve(std::vector<double>& x) const {
  const std::size_t n = size();
  for (std::size_t i = 0; i < n; ++i)
    x[i] -= sumOfProducts(lower_.data() + begin_[i], x.data() + first_[i], i - first_[i]);
  for (std::size_t i = n; i-- > 0;) {
    x[i] /= lower_[begin_[i] + i - first_[i]];
    const double* column = upper_.data() + begin_[i];
    for (std::size_t k = first_[i]; k < i; ++k) x[k] -= column[k - first_[i]] * x[i];
  }
}

}  // namespace stadion
