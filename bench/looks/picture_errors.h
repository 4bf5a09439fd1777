#pragma once
/// How far pictures are from the best picture of the same view.
///
/// Units    differences of channels, of 255; alpha does not count.
/// Threads  plain values and functions.

#include "pipeline/picture/picture.h"

#include <array>
#include <cstdint>

namespace stadion::bench {

/// The differences of all channels of any number of pictures. All are 0 before the first picture.
class PictureErrors {
public:
  /// Expects pictures of one size.
  void add(const Picture& picture, const Picture& reference);

  double mean() const;
  /// The least difference that this part of the channels does not exceed.
  int quantile(double part) const;
  int most() const;
  /// Part of the channels that differ by no more than this.
  double within(int difference) const;

private:
  std::array<std::uint64_t, 256> counts_{};  ///< by difference
  std::uint64_t channels_ = 0;
};

/// Two pictures of one view in successive frames.
struct PictureStep {
  const Picture& before;
  const Picture& after;
};

/// Mean difference between the change of a picture and the change of its reference: what flickers although
/// nothing moves so. Expects pictures of one size.
double flicker(const PictureStep& picture, const PictureStep& reference);

}  // namespace stadion::bench
