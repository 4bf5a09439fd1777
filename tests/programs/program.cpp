#include "tests/programs/program.h"

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace stadion {
namespace {

using Clock = std::chrono::steady_clock;

std::vector<char*> pointersTo(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& w : words) pointers.push_back(w.data());
  pointers.push_back(nullptr);
  return pointers;
}

[[noreturn]] void becomeProgram(const ProgramRun& run, std::vector<char*>& words, const std::string& out,
                                const std::string& err) {
  ::setpgid(0, 0);
  for (const auto& [file, to] : {std::pair(out, 1), std::pair(err, 2)}) {
    const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (fd < 0 || ::dup2(fd, to) < 0) ::_exit(126);
  }
  const int none = ::open("/dev/null", O_RDONLY);
  if (none < 0 || ::dup2(none, 0) < 0) ::_exit(126);
  ::putenv(const_cast<char*>("STADION_CALIBRATION=none"));  // this machine may be calibrated
  // Its own last frames stay, too.
  ::putenv(const_cast<char*>("XDG_STATE_HOME=" STADION_BINARY_DIR "/tests/state"));
  for (const std::string& e : run.environment) ::putenv(const_cast<char*>(e.c_str()));
  if (!run.folder.empty() && ::chdir(run.folder.c_str()) != 0) ::_exit(126);
  ::execvp(words[0], words.data());
  ::_exit(127);
}

int statusWithin(pid_t child, const ProgramRun& run, const std::string& out, const std::string& err) {
  const auto start = Clock::now();
  bool signalled = run.signal == 0, ready = !run.signalWhen;
  auto readySince = start;
  for (;;) {
    int status = 0;
    if (::waitpid(child, &status, WNOHANG) == child)
      return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    const auto past = Clock::now() - start;
    if (!ready && run.signalWhen(fileContent(out), fileContent(err))) ready = true, readySince = Clock::now();
    if (!signalled && ready && Clock::now() - readySince >= run.signalAfter) {
      ::kill(-child, run.signal);
      signalled = true;
    }
    if (past > run.limit) ::kill(-child, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(ready ? 2 : 20));
  }
}

}  // namespace

pid_t startProgram(const ProgramRun& run, const std::string& out, const std::string& err) {
  std::vector<std::string> words = run.words;
  std::vector<char*> pointers = pointersTo(words);
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) becomeProgram(run, pointers, out, err);
  ::setpgid(child, child);
  return child;
}

ProgramResult runProgram(const ProgramRun& run) {
  const TestFolder folder;
  const std::string out = folder.path() / "out", err = folder.path() / "err";
  const auto start = Clock::now();
  const pid_t child = startProgram(run, out, err);
  ProgramResult result;
  result.status = statusWithin(child, run, out, err);
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  result.out = fileContent(out), result.err = fileContent(err);
  return result;
}

std::string stadionPath() {
  return STADION_BINARY_DIR "/bin/stadion";
}

ProgramResult stadionProgram(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), stadionPath());
  return runProgram({arguments});
}

std::string testShow(const std::string& name) {
  return STADION_SOURCE_DIR "/tests/corpus/shows/" + name;
}

std::string assetFolder() {
  return STADION_SOURCE_DIR "/assets";
}

TestFolder::TestFolder() {
  std::string pattern = std::filesystem::temp_directory_path() / "stadion-test-XXXXXX";
  if (!::mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder");
  path_ = pattern;
}

TestFolder::~TestFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string TestFolder::write(const std::string& name, const std::string& content) const {
  const std::filesystem::path file = path_ / name;
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << content;
  return file;
}

std::string fileContent(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

bool fullRuns() {
  return std::getenv("STADION_FULL") != nullptr;
}

}  // namespace stadion
