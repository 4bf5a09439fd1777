#pragma once
/// Two runs that take turns, frame by frame: what else the machine does in a millisecond falls on both alike.
/// The two hold the ends of a socket; whoever has read a byte from it may go on.
///
/// Ownership  borrows the descriptor.
/// Threads    one at a time.
/// Errors     when the other one has ended, or was never there, nobody is waited for.

namespace stadion::regression {

class Turns {
public:
  explicit Turns(int socket) : socket_(socket) {}
  /// Waits until it is our turn.
  void take();
  /// It is the other one's turn.
  void give();

private:
  int socket_;
  bool alone_ = false;
};

}  // namespace stadion::regression
