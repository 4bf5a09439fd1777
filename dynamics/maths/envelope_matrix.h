#pragma once
/// A square matrix that is zero but near its diagonal: row i and column i begin at the same index.
///
/// Method   L U without exchange of rows: for contact problems, which are nearly symmetric and, with a trace
///          of regularisation, positive. Work goes with the sum of the squares of the rows' lengths.

#include <cstddef>
#include <vector>

namespace stadion {

class EnvelopeMatrix {
public:
  /// All zero; row and column i begin at firsts[i] <= i.
  void reset(const std::vector<std::size_t>& firsts);
  /// Expects first(i) <= j <= i, or the same of a column.
  double& at(std::size_t row, std::size_t column) {
    return column <= row ? lower_[begin_[row] + column - first_[row]]
                         : upper_[begin_[column] + row - first_[column]];
  }
  std::size_t first(std::size_t row) const { return first_[row]; }
  std::size_t size() const { return first_.size(); }

  /// False if a pivot is lost. Then it is of no use.
  bool factor();
  void solve(std::vector<double>& x) const;

private:
  std::vector<std::size_t> first_, begin_;
  std::vector<double> lower_,
      upper_;  ///< rows to the diagonal; columns to above it. Factored: L's diagonal is 1
};

}  // namespace stadion
