/// The program of one engine: plays the cases asked for, each in a process of its own with a time limit, and
/// prints one JSON object a line.
///
///   stadion-dyn-ENGINE [NAME] [--engine VARIANT] [--steps N] [--limit SECONDS] [--exact] [--list]
///
/// NAME is part of a case's name; with --exact all of it. --list prints variants and cases instead.

#include "bench/dynamics/cases.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

namespace stadion::bench {
namespace {

struct Request {
  std::string name, variant;
  int steps = 0;  ///< 0: all that the case names
  unsigned limit = 90;
  bool exact = false, list = false;

  bool wants(const std::string& caseName) const {
    return exact ? caseName == name : caseName.find(name) != std::string::npos;
  }
};

void print(const std::string& line) {
  std::fputs((line + "\n").c_str(), stdout);
  std::fflush(stdout);
}

std::string headOf(const Case& c, const std::string& variant, int n) {
  return fmt::format(R"({{"engine":"{}","case":"{}","n":{})", variant, c.name, n);
}

std::string lineOf(const Case& c, const Outcome& out, double ns) {
  std::string line = headOf(c, out.variant, out.n) + fmt::format(R"(,"ns_per_body_frame":{:.1f})", ns);
  if (out.unsupported) line += R"(,"unsupported":true)";
  line += R"(,"m":{)";
  const char* comma = "";
  for (const auto& [name, value] : out.m) {
    line += fmt::format(R"({}"{}":{})", comma, name,
                        std::isfinite(value) ? fmt::format("{:.6g}", value) : "null");
    comma = ",";
  }
  return line + "}}";
}

/// Plays it as often as it wants to be played, or until two seconds are spent.
std::string play(const Case& c, const std::string& variant, int n) {
  std::vector<double> costs;
  Outcome first;
  for (int r = 0; r < c.repetitions; ++r) {
    Outcome out;
    out.variant = variant;
    out.n = n;
    c.play(out);
    costs.push_back(out.nsPerBodyFrame());
    if (r == 0) first = out;
    if (out.cpu > 2 || out.unsupported) break;
  }
  std::sort(costs.begin(), costs.end());
  return lineOf(c, first, costs[costs.size() / 2]);
}

/// Waits for the child's end; it gets a SIGALRM once it has used `limit` seconds of processor time. (Watched
/// from here: a timer armed in the child makes its own clock of processor time coarse on some kernels.)
int waitWithin(pid_t child, unsigned limit) {
  clockid_t clock{};
  const bool watched = clock_getcpuclockid(child, &clock) == 0;
  for (;;) {
    int status = 0;
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) return status;
    if (ended < 0 && errno != EINTR) {
      std::perror("stadion-dyn");
      std::exit(3);
    }
    timespec used{};
    if (watched && clock_gettime(clock, &used) == 0 && used.tv_sec >= static_cast<time_t>(limit))
      kill(child, SIGALRM);
    usleep(5000);
  }
}

void playApart(const Case& c, const std::string& variant, int n, unsigned limit) {
  const pid_t child = fork();
  if (child == 0) {
    alarm(4 * limit);  // by the clock, should it sleep
    // Engines chatter.
    if (!std::freopen("/dev/null", "w", stderr)) _exit(3);
    print(play(c, variant, n));
    _exit(0);
  }
  if (child < 0) {
    std::perror("stadion-dyn");
    std::exit(3);
  }
  const int status = waitWithin(child, limit);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  print(headOf(c, variant, n) + fmt::format(R"(,"crash":{}}})", WIFSIGNALED(status) ? WTERMSIG(status) : -1));
}

bool parse(int argc, char** argv, Request& request) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool more = i + 1 < argc;
    if (word == "--exact")
      request.exact = true;
    else if (word == "--list")
      request.list = true;
    else if (word == "--engine" && more)
      request.variant = argv[++i];
    else if (word == "--steps" && more)
      request.steps = std::atoi(argv[++i]);
    else if (word == "--limit" && more)
      request.limit = static_cast<unsigned>(std::max(1, std::atoi(argv[++i])));
    else if (word.starts_with("--"))
      return false;
    else
      request.name = word;
  }
  return true;
}

void list(const CaseList& cases) {
  for (const std::string& variant : engineVariants()) print(fmt::format(R"({{"engine":"{}"}})", variant));
  for (const Case& c : cases)
    print(fmt::format(R"({{"case":"{}","steps":[{}]}})", c.name, fmt::join(c.steps, ",")));
}

int run(int argc, char** argv) {
  Request request;
  if (!parse(argc, argv, request)) {
    std::fputs("usage: stadion-dyn-ENGINE [NAME] [--engine VARIANT] [--steps N] [--limit SECONDS] [--exact] "
               "[--list]\n",
               stderr);
    return 2;
  }
  const CaseList cases = allCases();
  if (request.list) {
    list(cases);
    return 0;
  }
  for (const std::string& variant : engineVariants()) {
    if (!request.variant.empty() && variant != request.variant) continue;
    for (const Case& c : cases) {
      if (!request.wants(c.name)) continue;
      if (request.steps)
        playApart(c, variant, request.steps, request.limit);
      else
        for (const int n : c.steps) playApart(c, variant, n, request.limit);
    }
  }
  return 0;
}

}  // namespace
}  // namespace stadion::bench

int main(int argc, char** argv) {
  return stadion::bench::run(argc, argv);
}
