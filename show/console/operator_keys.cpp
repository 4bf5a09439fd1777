#include "show/console/operator_keys.h"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <chrono>

namespace stadion {
namespace {

constexpr char kEscape = 27;
constexpr int kLookForEnd = 50;  ///< [ms]

struct Binding {
  char key;
  OperatorCommand command;
};

using enum OperatorAction;
const std::array<Binding, 18> kKeys{{{'\n', {Start}},
                                     {'\r', {Start}},
                                     {' ', {Pause}},
                                     {'p', {Pause}},
                                     {'.', {Step}},
                                     {'b', {Black}},
                                     {'t', {TestPattern}},
                                     {'n', {NextGroup}},
                                     {'x', {SwapEyes}},
                                     {'[', {EyeSeparation, -0.002, true}},
                                     {']', {EyeSeparation, 0.002, true}},
                                     {'f', {FreezeHead}},
                                     {'-', {Volume, -0.05, true}},
                                     {'+', {Volume, 0.05, true}},
                                     {'=', {Volume, 0.05, true}},
                                     {'k', {Latency, -1, true}},
                                     {'l', {Latency, 1, true}},
                                     {'q', {End}}}};

}  // namespace

std::optional<OperatorCommand> operatorCommandOf(char key) {
  for (const Binding& k : kKeys)
    if (k.key == key) return k.command;
  if (key >= '1' && key <= '9') return OperatorCommand{Cue, key - '0', false};
  return {};
}

std::optional<OperatorCommand> operatorCommandOf(Key key) {
  if (key == Key::Enter) return operatorCommandOf('\n');
  const auto code = static_cast<std::uint32_t>(key);
  if (code < 32 || code >= 127) return {};
  const char c = static_cast<char>(code);
  return operatorCommandOf(c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c);
}

std::string operatorKeysHelp() {
  return "keys: Enter start, space pause, . one frame, b black, t test pattern, n next group, x swap eyes, "
         "[ ] eyes closer or wider,\n      f freeze head, - + volume, k l fewer or more frames under way, 1 to 9 "
         "cues, q end, h these lines";
}

std::unique_ptr<OperatorKeys> OperatorKeys::open(int file, OperatorQueue& queue, Say say) {
  auto terminal = RawTerminal::take(file);
  if (!terminal) return nullptr;
  return std::unique_ptr<OperatorKeys>(new OperatorKeys(std::move(terminal), queue, std::move(say)));
}

OperatorKeys::OperatorKeys(std::unique_ptr<RawTerminal> terminal, OperatorQueue& queue, Say say)
    : terminal_(std::move(terminal)), queue_(queue), say_(std::move(say)), thread_([this] { readKeys(); }) {}

OperatorKeys::~OperatorKeys() {
  ending_ = true;
  thread_.join();
}

void OperatorKeys::readKeys() {
  const std::string lost = "out of memory: the key was not taken";
  while (!ending_) {
    // A process in the background is stopped if it reads the terminal.
    if (!terminal_->inForeground()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(kLookForEnd));
      continue;
    }
    pollfd waiting{terminal_->file(), POLLIN, 0};
    if (poll(&waiting, 1, kLookForEnd) <= 0) continue;
    char key = 0;
    // A closed terminal reports that for ever: no more keys will come.
    if ((waiting.revents & POLLIN) == 0 || read(terminal_->file(), &key, 1) != 1) return;
    if (key == kEscape) {  // an arrow or the like: its other characters are no keys of ours
      tcflush(terminal_->file(), TCIFLUSH);
      continue;
    }
    try {
      if (key == 'h' || key == '?') say_(operatorKeysHelp());
      if (const auto command = operatorCommandOf(key)) queue_.post(*command);
    } catch (const std::bad_alloc&) {
      say_(lost);
    }
  }
}

}  // namespace stadion
