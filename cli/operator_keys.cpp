#include "cli/operator_keys.h"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cstdio>

namespace stadion {
namespace {

constexpr char kEscape = 27;
constexpr int kLookForEnd = 50;  ///< [ms]

struct Key {
  char key;
  OperatorCommand command;
};

using enum OperatorAction;
const std::array<Key, 15> kKeys{{{'\n', {Start}},
                                 {'\r', {Start}},
                                 {' ', {Pause}},
                                 {'p', {Pause}},
                                 {'.', {Step}},
                                 {'b', {Black}},
                                 {'n', {NextGroup}},
                                 {'x', {SwapEyes}},
                                 {'[', {EyeSeparation, -0.002, true}},
                                 {']', {EyeSeparation, 0.002, true}},
                                 {'f', {FreezeHead}},
                                 {'-', {Volume, -0.05, true}},
                                 {'+', {Volume, 0.05, true}},
                                 {'=', {Volume, 0.05, true}},
                                 {'q', {End}}}};

}  // namespace

std::optional<OperatorCommand> operatorCommandOf(char key) {
  for (const Key& k : kKeys)
    if (k.key == key) return k.command;
  return {};
}

std::string operatorKeysHelp() {
  return "keys: Enter start, space pause, . one frame, b black, n next group, x swap eyes, [ ] eyes closer "
         "or "
         "wider, f freeze head,\n      - + volume, q end, h these lines";
}

struct OperatorKeys::Terminal {
  int file;
  termios before{};
};

std::unique_ptr<OperatorKeys> OperatorKeys::open(int file, OperatorQueue& queue) {
  // From the background, changing the terminal would stop the program.
  if (isatty(file) != 1 || tcgetpgrp(file) != getpgrp()) return nullptr;
  auto terminal = std::make_unique<Terminal>();
  terminal->file = file;
  if (tcgetattr(file, &terminal->before) != 0) return nullptr;
  termios now = terminal->before;
  now.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  now.c_cc[VMIN] = 1, now.c_cc[VTIME] = 0;
  if (tcsetattr(file, TCSANOW, &now) != 0) return nullptr;
  return std::unique_ptr<OperatorKeys>(new OperatorKeys(std::move(terminal), queue));
}

OperatorKeys::OperatorKeys(std::unique_ptr<Terminal> terminal, OperatorQueue& queue)
    : terminal_(std::move(terminal)), queue_(queue), thread_([this] { listen(); }) {}

OperatorKeys::~OperatorKeys() {
  ending_ = true;
  thread_.join();
  tcsetattr(terminal_->file, TCSANOW, &terminal_->before);
}

void OperatorKeys::listen() {
  while (!ending_) {
    pollfd waiting{terminal_->file, POLLIN, 0};
    if (poll(&waiting, 1, kLookForEnd) <= 0) continue;
    char key = 0;
    // A terminal that has gone says so for ever: there will be no more keys.
    if ((waiting.revents & POLLIN) == 0 || read(terminal_->file, &key, 1) != 1) return;
    if (key == kEscape) {  // an arrow or the like: its other characters are no keys of ours
      tcflush(terminal_->file, TCIFLUSH);
      continue;
    }
    if (key == 'h' || key == '?') std::fprintf(stderr, "%s\n", operatorKeysHelp().c_str());
    if (const auto command = operatorCommandOf(key)) queue_.post(*command);
  }
}

}  // namespace stadion
