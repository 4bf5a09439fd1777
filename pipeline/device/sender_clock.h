#pragma once
/// The clock of a sender that stamps its measurements, in terms of the machine's clock.
///
/// The least delay seen lately is taken for none, so clocks that drift apart are followed.
///
/// A sender's clock may be set while it sends, by NTP or by hand. Forwards, the next stamp shows it.
/// Backwards, stamps get older than those before, as does the stamp of a datagram that another one overtook.
/// One older stamp alone is late. A second one that is newer than the first one shows that the clock was set.
///
/// Units    nanoseconds.
/// Threads  one at a time.

#include "engine/base/time_signature.h"

#include <optional>

namespace stadion {

class SenderClock {
public:
  /// What is stamped.
  enum class Stamped {
    Poses,    ///< sent all the time: of two with one stamp, the second one is a copy
    Controls  ///< buttons and axes: several may have one stamp, and what is sent may be sent only once
  };
  explicit SenderClock(Stamped what = Stamped::Poses) : what_(what) {}

  struct Reading {
    std::optional<Nanoseconds> ours;   ///< when it was measured, by the machine's clock; none: it is late
    std::optional<Nanoseconds> set{};  ///< the sender's clock was set by so much, and late ones were not late
  };
  /// Of what was stamped `sent`, by the sender's clock, and has arrived just now, by the machine's. The
  /// machine's clock never goes back.
  Reading read(Nanoseconds sent, Nanoseconds arrived);

private:
  Reading olderThanLast(Nanoseconds sent, Nanoseconds arrived);
  bool setBackWithinAPeriod(Nanoseconds sent, Nanoseconds arrived) const;
  void begin(Nanoseconds sent, Nanoseconds arrived);

  Stamped what_;
  bool known_ = false;
  Nanoseconds offset_ = 0;              ///< machine's clock minus sender's
  Nanoseconds newest_ = 0, at_ = 0;     ///< the newest stamp, and when it came
  Nanoseconds since_ = 0, least_ = 0;   ///< the least offset since then
  std::optional<Nanoseconds> older_{};  ///< the last stamp that was late
  double period_ = 0;                   ///< between stamps, smoothed
  int repeats_ = 0;                     ///< of the newest stamp
};

}  // namespace stadion
