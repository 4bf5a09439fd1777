#pragma once
/// A number that a message changes, at once or evenly within some seconds of show time.
///
/// Commands  one with ArgumentKind::Faded: "NUMBER", "NUMBER fade SECONDS".
/// Threads   App only.

#include "engine/core/message.h"

namespace stadion {

class FadedValue {
public:
  explicit FadedValue(double initially) : initially_(initially), from_(initially), to_(initially) {}

  double at(Nanoseconds time) const;
  /// Returns true if it still changes after this time.
  bool fadesAfter(Nanoseconds time) const { return until_ > time; }
  /// Takes the numbers of a message for it, from `when` on; those beyond the limits are replaced by the nearest.
  /// Returns false if the message has no such numbers.
  bool take(const Message& m, Nanoseconds when, double least, double most);
  void reset() { from_ = to_ = initially_, since_ = until_ = 0; }
  /// Returns false if restored numbers cannot be.
  bool isWithin(double least, double most) const;

  template <class Self, class Fields>
  static void fields(Self& v, Fields& f) {
    f("from", v.from_), f("to", v.to_), f("since", v.since_), f("until", v.until_);
  }

private:
  double initially_, from_, to_;
  Nanoseconds since_ = 0, until_ = 0;  ///< of the fade [ns]
};

}  // namespace stadion
