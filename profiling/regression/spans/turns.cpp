#include "profiling/regression/spans/turns.h"

#include <cerrno>
#include <sys/socket.h>
#include <unistd.h>

namespace stadion::regression {

void Turns::take() {
  char turn = 0;
  while (!alone_) {
    const ssize_t got = read(socket_, &turn, 1);
    if (got == 1) return;
    if (got == 0 || errno != EINTR) alone_ = true;
  }
}

void Turns::give() {
  const char turn = 't';
  if (!alone_ && send(socket_, &turn, 1, MSG_NOSIGNAL) != 1) alone_ = true;
}

}  // namespace stadion::regression
