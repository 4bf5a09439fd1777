/// Other programs, run with their streams connected to ours.

#include "pipeline/platform/child_process.h"

#include <csignal>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <thread>
#include <unistd.h>

namespace stadion {
namespace {

using std::chrono::milliseconds;

std::string saidBy(const std::vector<std::string>& words, const std::vector<std::string>& environment = {}) {
  const FileDescriptor out = makeMemoryFile();
  ChildProcess child;
  EXPECT_FALSE(child.start(words, {-1, out.get(), -1}, environment));
  EXPECT_EQ(child.wait(milliseconds(120'000)), 0);
  return contentOf(out);
}

TEST(ChildProcess, ItsEnvironmentIsOursButForWhatIsSaid) {
  setenv("STADION_TEST_KEPT", "ours", 1);
  setenv("STADION_TEST_CHANGED", "ours", 1);
  setenv("STADION_TEST_CHANGED_NOT", "ours", 1);
  EXPECT_EQ(
      saidBy({"sh", "-c", "echo $STADION_TEST_KEPT $STADION_TEST_CHANGED $STADION_TEST_CHANGED_NOT $NEW"},
             {"STADION_TEST_CHANGED=a=b", "NEW=new"}),
      "ours a=b ours new\n");
  EXPECT_STREQ(getenv("STADION_TEST_CHANGED"), "ours");
  for (const char* name : {"STADION_TEST_KEPT", "STADION_TEST_CHANGED", "STADION_TEST_CHANGED_NOT"})
    unsetenv(name);
}

/// A program whose own standard streams are closed gets descriptors in their places.
TEST(ChildProcess, ItsStreamsMayBeWhereTheStandardStreamsAre) {
  const int kept[] = {fcntl(0, F_DUPFD_CLOEXEC, 3), fcntl(1, F_DUPFD_CLOEXEC, 3),
                      fcntl(2, F_DUPFD_CLOEXEC, 3)};
  const FileDescriptor in = makeMemoryFile(), out = makeMemoryFile(), err = makeMemoryFile();
  const std::string said = "what it is told";
  const bool told = pwrite(in.get(), said.data(), said.size(), 0) == std::ssize(said);
  dup2(in.get(), 2), dup2(out.get(), 0), dup2(err.get(), 1);
  ChildProcess child;
  const auto problem = child.start({"sh", "-c", "cat; echo wrong >&2"}, {2, 0, 1});
  const auto status = child.wait(milliseconds(120'000));
  for (int i = 0; i < 3; ++i) kept[i] < 0 ? close(i) : dup2(kept[i], i);
  for (const int fd : kept) close(fd);
  ASSERT_TRUE(told && !problem);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(contentOf(out), said);
  EXPECT_EQ(contentOf(err), "wrong\n");
}

TEST(ChildProcess, WhatItHasStartedIsKilledWithIt) {
  const Pipe pipe = makePipe();
  ChildProcess child;
  ASSERT_FALSE(child.start({"sh", "-c", "sleep 1000 & echo $!; wait"}, {-1, pipe.write.get(), -1}));
  std::string number;
  for (char c = 0; read(pipe.read.get(), &c, 1) == 1 && c != '\n';) number += c;
  const pid_t sleeper = std::stoi(number);
  ASSERT_EQ(::kill(sleeper, 0), 0);
  child.kill();
  EXPECT_EQ(child.wait(milliseconds(120'000)), 128 + SIGKILL);
  // The process that takes in orphans may take a moment; an orphan that is dead and not yet taken in has no
  // memory.
  const auto isGone = [&] {
    const std::string state = saidBy({"sh", "-c", "ps -o stat= -p " + number + " || true"});
    return state.empty() || state.starts_with('Z');
  };
  for (int i = 0; i < 6000 && !isGone(); ++i) std::this_thread::sleep_for(milliseconds(20));
  EXPECT_TRUE(isGone());
}

}  // namespace
}  // namespace stadion
