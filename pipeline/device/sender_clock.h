#pragma once
/// Converts the time stamps of a sender's clock to the machine's clock.
///
/// The smallest delay of late counts as zero, so clocks that drift apart are followed.
///
/// A sender's clock may be set while it sends, by NTP or by hand. If it is set forwards, the next stamp shows
/// it. If it is set backwards, stamps get older than the previous ones. A datagram that another one overtook
/// also has an older stamp. One older stamp alone is late. A second one that is newer than the first one
/// shows that the clock was set.
///
/// Units    nanoseconds.
/// Threads  one at a time.

#include "engine/base/time_signature.h"

#include <optional>

namespace stadion {

class SenderClock {
public:
  /// The kind of stamped data.
  enum class Stamped {
    Poses,    ///< sent continuously: the second of two with one stamp is a copy
    Controls  ///< buttons and axes: several may have one stamp, and each may be sent only once
  };
  explicit SenderClock(Stamped what = Stamped::Poses) : what_(what) {}

  struct Reading {
    std::optional<Nanoseconds> ours;   ///< measurement time by the machine's clock; none: it is late
    std::optional<Nanoseconds> set{};  ///< the sender's clock was set by this much, and late ones were not
                                       ///< late
  };
  /// Reads a stamp `sent` (sender's clock) of data that arrived at `arrived` (machine's clock). The machine's
  /// clock never goes back.
  Reading read(Nanoseconds sent, Nanoseconds arrived);

private:
  Reading olderThanLast(Nanoseconds sent, Nanoseconds arrived);
  bool setBackWithinAPeriod(Nanoseconds sent, Nanoseconds arrived) const;
  void begin(Nanoseconds sent, Nanoseconds arrived);

  Stamped what_;
  bool known_ = false;
  Nanoseconds offset_ = 0;              ///< machine's clock minus sender's
  Nanoseconds newest_ = 0, at_ = 0;     ///< the newest stamp, and its arrival
  Nanoseconds since_ = 0, least_ = 0;   ///< the start of the window, and the least offset in it
  std::optional<Nanoseconds> older_{};  ///< the last late stamp
  double period_ = 0;                   ///< between stamps, smoothed
  int repeats_ = 0;                     ///< how often the newest stamp has repeated
};

}  // namespace stadion
