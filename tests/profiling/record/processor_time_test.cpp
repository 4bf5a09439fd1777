/// Processor time of this process and of what it started.

#include "profiling/record/processor_time.h"

#include <csignal>
#include <ctime>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace stadion {
namespace {

constexpr double kWork = 0.05;  ///< [s]

void work() {
  const std::clock_t begin = std::clock();
  while (static_cast<double>(std::clock() - begin) < kWork * CLOCKS_PER_SEC) {
  }
}

/// A process that works, tells that it has, and waits to be killed. `deep`: its child works in its place.
struct Worker {
  pid_t process = 0;
  explicit Worker(bool deep) {
    int ends[2];
    EXPECT_EQ(pipe(ends), 0);
    process = fork();
    if (process == 0) {
      if (deep && fork() != 0) pause(), _exit(0);
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      work();
      EXPECT_EQ(write(ends[1], "x", 1), 1);
      pause();
      _exit(0);
    }
    char done = 0;
    EXPECT_EQ(read(ends[0], &done, 1), 1);
    close(ends[0]), close(ends[1]);
  }
  void end() const {
    kill(process, SIGKILL);
    waitpid(process, nullptr, 0);
  }
};

TEST(ProgramProcessorTime, WhatThisProcessDoesCounts) {
  const double begin = processorSeconds();
  work();
  EXPECT_GE(processorSeconds() - begin, kWork);
}

TEST(ProgramProcessorTime, AChildCountsWhileItRunsAndAfterItHasEnded) {
  const double begin = processorSeconds();
  const Worker worker(false);
  EXPECT_GE(processorSeconds() - begin, kWork);
  worker.end();
  EXPECT_GE(processorSeconds() - begin, 0.9 * kWork);
}

TEST(ProgramProcessorTime, AChildsChildCounts) {
  const double begin = processorSeconds();
  const Worker worker(true);
  EXPECT_GE(processorSeconds() - begin, kWork);
  worker.end();
}

}  // namespace
}  // namespace stadion
