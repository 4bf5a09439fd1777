#pragma once
/// Takes the picture of one view now and then, out of the pictures that a show draws anyway.
///
/// The show's thread copies few of the picture's pixels and goes on; it never waits. A graphics card whose
/// pictures stay with it is read for that wall and that frame only.
///
/// Threads  ask() and collect() on one thread of the page; wants(), wantsWall() and take() on Draw threads.

#include "pipeline/loop/show_stages.h"

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace stadion {

class ViewTap final : public PictureSink {
public:
  static constexpr std::uint32_t kWidest = 640;  ///< of a copy [pixels]

  struct Copy {
    std::size_t wall = 0, view = 0;
    std::uint64_t frame = 0;
    Picture picture;  ///< each n-th pixel of each n-th row; empty if the wall has no such view
  };

  /// Pictures also go to this sink; null: to none. Call it only while no frame is drawn.
  void passOnTo(PictureSink* sink) { next_ = sink; }

  /// Asks for the next picture of that view. False: the one before has not been collected.
  bool ask(std::size_t wall, std::size_t view);
  /// Swaps the copy that was asked for into `copy`. False: it is not there yet.
  bool collect(Copy& copy);

  bool wants(const TimeSignature& now) const override;
  bool wantsWall(const TimeSignature& now, std::size_t wall) const override;
  Failure take(const TimeSignature& now, const std::vector<EyePictures>& walls) override;

private:
  enum class Step { Idle, Asked, Copied };

  void copyView(const std::vector<EyePictures>& walls, std::uint64_t frame);

  PictureSink* next_ = nullptr;
  std::atomic<Step> step_ = Step::Idle;  ///< says whose copy_ is: the page's, or in Asked the show's
  std::atomic<std::size_t> wall_ = 0;    ///< the wall that was asked for
  Copy copy_;
};

}  // namespace stadion
