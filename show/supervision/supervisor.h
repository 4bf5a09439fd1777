#pragma once
/// Supervises a process that plays a show.
///
/// If the player crashes, or shows no frame for too long, the supervisor replaces it. The next player
/// continues from the last snapshot and catches up to the show time that would be now.

#include "pipeline/supervision/hang_watch.h"
#include "pipeline/supervision/recovery.h"
#include "show/base/reporter.h"
#include "show/supervision/supervision_settings.h"

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <termios.h>
#include <vector>

namespace stadion {

class Journal;

class Supervisor {
public:
  /// Makes the words of a player's command line. The player finds its SharedProgress under the descriptor,
  /// and ends with this process.
  using PlayerWords = std::function<std::vector<std::string>(int descriptor)>;

  /// Null, with the reason reported as a fault, if there is no shared memory or the journal cannot be
  /// written. The reporter must outlive it.
  static std::unique_ptr<Supervisor> create(const SupervisionSettings& settings, const PlayerWords& words,
                                            Reporter& reporter);
  ~Supervisor();

  /// Plays until the show ends or is given up, or until `stop` is true. Returns the status that the last
  /// player ended with.
  int play(const std::atomic<bool>& stop);

private:
  /// The terminal as it was. A player that is killed does not restore it.
  class Terminal {
  public:
    Terminal();
    void restore() const;

  private:
    termios was_{};
    bool isThere_;
  };
  struct End {
    int status = 0;        ///< exit status; 128 + signal
    Nanoseconds hung = 0;  ///< for so long no picture came, and the player was killed
  };

  explicit Supervisor(Reporter& reporter) : reporter_(reporter) {}
  std::optional<End> playOnce(const std::atomic<bool>& stop);
  bool isDeath(const End& end, bool stopped) const;
  std::string howOf(const End& end) const;
  void tellService(const HangWatch& watch);
  bool pauseFor(std::chrono::milliseconds time, const std::atomic<bool>& stop);
  void say(const std::string& line);

  Reporter& reporter_;
  std::unique_ptr<SharedProgress> progress_;
  std::unique_ptr<Journal> journal_;
  std::unique_ptr<ServiceNotifier> service_;  ///< null: no service manager asks
  std::uint64_t told_ = 0;                    ///< frames that the service manager has been told of
  Nanoseconds hangs_ = 0;
  std::vector<std::string> words_;
  Terminal terminal_;
  Recovery recovery_;
  Nanoseconds gone_ = 0;  ///< when the player before this one showed its last frame
};

}  // namespace stadion
