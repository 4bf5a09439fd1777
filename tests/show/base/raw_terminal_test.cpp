/// A terminal is given back as it was, however the program ends.

#include "show/base/raw_terminal.h"
#include "show/base/stop_signal.h"

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <string>
#include <sys/wait.h>
#include <termios.h>
#include <thread>
#include <unistd.h>
#include <utmp.h>

namespace stadion {
namespace {

void waitFor(int milliseconds) {
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

/// A terminal, a shell, and a program in the shell's foreground that takes the terminal.
class Terminal {
public:
  explicit Terminal(const std::function<void()>& program) {
    EXPECT_EQ(openpty(&near_, &far_, nullptr, nullptr, nullptr), 0);
    int told[2];
    EXPECT_EQ(pipe(told), 0);
    shell_ = fork();
    if (shell_ == 0) {
      close(near_);
      login_tty(far_);
      const pid_t child = fork();
      if (child == 0) play(program);
      EXPECT_EQ(write(told[1], &child, sizeof child), ssize_t{sizeof child});
      int status = 0;
      waitpid(child, &status, 0);
      _exit(WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status));
    }
    EXPECT_EQ(read(told[0], &program_, sizeof program_), ssize_t{sizeof program_});
    close(told[0]), close(told[1]);
  }
  ~Terminal() {
    if (!ended_) kill(program_, SIGKILL), status();
    close(near_), close(far_);
  }

  bool showsKeys() const {
    termios now{};
    tcgetattr(far_, &now);
    return (now.c_lflag & (ECHO | ICANON)) == (ECHO | ICANON);
  }
  /// Waits until it shows keys, or no longer does.
  bool comesToShowKeys(bool shows) const {
    for (int i = 0; i < 6000 && showsKeys() != shows; ++i) waitFor(5);
    return showsKeys() == shows;
  }
  /// Waits until the program has written this to the terminal.
  bool says(const std::string& text) {
    pollfd arrived{near_, POLLIN, 0};
    while (said_.find(text) == said_.npos) {
      char part[256];
      const ssize_t n = poll(&arrived, 1, 120'000) == 1 ? read(near_, part, sizeof part) : 0;
      if (n <= 0) return false;
      said_.append(part, static_cast<std::size_t>(n));
    }
    return true;
  }
  void press(char key) const { EXPECT_EQ(write(near_, &key, 1), 1); }
  void send(int signal) const { kill(program_, signal); }
  /// The program's exit status, or 128 + the signal that ended it.
  int status() {
    int status = 0;
    waitpid(shell_, &status, 0);
    ended_ = true;
    return WEXITSTATUS(status);
  }

private:
  static void play(const std::function<void()>& program) {
    setpgid(0, 0);
    std::signal(SIGTTOU, SIG_IGN);
    tcsetpgrp(0, getpid());
    const auto keys = RawTerminal::take(0);
    if (!keys) _exit(99);
    program();
    _exit(98);  // nothing has ended it
  }

  int near_ = -1, far_ = -1;
  pid_t shell_ = -1, program_ = -1;
  bool ended_ = false;
  std::string said_;
};

void say(const char* text) {
  EXPECT_EQ(write(1, text, std::strlen(text)), static_cast<ssize_t>(std::strlen(text)));
}

void waitForSignals() {
  for (;;) waitFor(1000);
}

TEST(ProgramTerminal, IsGivenBackWhenTheProgramExits) {
  Terminal terminal([] {
    for (char key = 0; read(0, &key, 1) != 1;) waitFor(5);
    std::exit(7);
  });
  EXPECT_TRUE(terminal.comesToShowKeys(false)) << "it was never taken";
  terminal.press('x');
  EXPECT_EQ(terminal.status(), 7);
  EXPECT_TRUE(terminal.showsKeys());
}

TEST(ProgramTerminal, IsGivenBackAfterTheSecondControlC) {
  Terminal terminal([] {
    const std::atomic<bool>& asked = catchStopSignals();  // a program that takes long to stop
    say("ready");
    while (!asked) waitFor(5);
    say("asked");
    waitForSignals();
  });
  ASSERT_TRUE(terminal.says("ready"));
  ASSERT_TRUE(terminal.comesToShowKeys(false));
  terminal.press('\003');
  ASSERT_TRUE(terminal.says("asked"));
  waitFor(300);  // two within a tenth of a second are one
  EXPECT_FALSE(terminal.showsKeys()) << "the first one only asks";
  terminal.press('\003');
  EXPECT_EQ(terminal.status(), 130);
  EXPECT_TRUE(terminal.showsKeys());
}

TEST(ProgramTerminal, IsGivenBackByEverySignalThatEndsTheProgram) {
  for (const int signal : {SIGHUP, SIGQUIT, SIGABRT, SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGPIPE}) {
    Terminal terminal(waitForSignals);
    ASSERT_TRUE(terminal.comesToShowKeys(false));
    terminal.send(signal);
    EXPECT_EQ(terminal.status(), 128 + signal);
    EXPECT_TRUE(terminal.showsKeys()) << "signal " << signal;
  }
}

TEST(ProgramTerminal, IsLentOutWhileTheProgramStandsStill) {
  Terminal terminal(waitForSignals);
  ASSERT_TRUE(terminal.comesToShowKeys(false));
  terminal.press('\032');  // Ctrl-Z
  EXPECT_TRUE(terminal.comesToShowKeys(true));
  terminal.send(SIGCONT);
  EXPECT_TRUE(terminal.comesToShowKeys(false));
  terminal.press('\034');  // Ctrl-backslash
  EXPECT_EQ(terminal.status(), 128 + SIGQUIT);
  EXPECT_TRUE(terminal.showsKeys());
}

}  // namespace
}  // namespace stadion
