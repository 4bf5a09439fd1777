/// A terminal is given back as it was, however the program ends.

#include "cli/raw_terminal.h"
#include "cli/stop_signal.h"

#include <csignal>
#include <cstdlib>
#include <functional>
#include <gtest/gtest.h>
#include <pty.h>
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
};

void waitForSignals() {
  for (;;) waitFor(1000);
}

TEST(ProgramTerminal, IsGivenBackWhenTheProgramExits) {
  Terminal terminal([] {
    waitFor(300);
    std::exit(7);
  });
  EXPECT_TRUE(terminal.comesToShowKeys(false)) << "it was never taken";
  EXPECT_EQ(terminal.status(), 7);
  EXPECT_TRUE(terminal.showsKeys());
}

TEST(ProgramTerminal, IsGivenBackAfterTheSecondControlC) {
  Terminal terminal([] {
    catchStopSignals();  // a program that takes long to stop
    waitForSignals();
  });
  ASSERT_TRUE(terminal.comesToShowKeys(false));
  waitFor(200);
  terminal.press('\003');
  waitFor(300);
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
