#pragma once
/// Lets two runs alternate frame by frame, so that other load of the machine in a millisecond affects both
/// alike. Each has one end of a socket; a run that has read a byte from it may continue.
///
/// Ownership  borrows the descriptor.
/// Threads    one at a time.
/// Errors     if the other run has ended, or never started, it does not wait.

namespace stadion::regression {

class Turns {
public:
  explicit Turns(int socket) : socket_(socket) {}
  /// Waits until it is our turn.
  void take();
  /// Gives the turn to the other run.
  void give();

private:
  int socket_;
  bool alone_ = false;
};

}  // namespace stadion::regression
