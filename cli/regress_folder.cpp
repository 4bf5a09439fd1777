#include "cli/regress_folder.h"

#include "engine/atomic_file.h"
#include "engine/plain_file.h"
#include "engine/state_hash.h"
#include "profiling/regression/history.h"
#include "profiling/regression/page.h"
#include "profiling/regression/reports.h"

#include <fmt/format.h>

#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sys/file.h>

namespace stadion {
namespace {

constexpr const char *kProgress = "progress.jsonl", *kHistory = "history.jsonl";
constexpr std::size_t kMostBytes = 256 << 20;

std::string textOf(const std::string& file) {
  const Result<std::string> text = readPlainFile(file, kMostBytes);
  return text ? text.value() : std::string();
}

/// A program that is built anew is another one.
void addProgram(const std::string& path, StateHash& hash) {
  std::error_code none;
  hash.add(std::string_view(path));
  hash.add(std::uint64_t{std::filesystem::file_size(path, none)});
  hash.add(
      static_cast<std::int64_t>(std::filesystem::last_write_time(path, none).time_since_epoch().count()));
}

std::string identityOf(const RegressOptions& o, const std::string& suiteText) {
  StateHash hash;
  hash.add(std::string_view(suiteText));
  addProgram(o.program, hash);
  if (!o.against.empty()) addProgram(o.against, hash);
  hash.add(std::string_view(o.baseline));
  for (const std::string& metric : o.compare) hash.add(std::string_view(metric));
  hash.add(o.instructions);
  hash.add(std::uint64_t{o.rounds});
  return fmt::format("{:016x}", hash.value());
}

}  // namespace

bool RegressFolder::open(const RegressOptions& o, const std::string& suiteText) {
  folder_ = o.out;
  std::error_code why;
  std::filesystem::create_directories(folder_, why);
  if (why)
    return std::fprintf(stderr, "stadion: --out %s: %s\n", folder_.c_str(), why.message().c_str()), false;
  if (!lock()) return false;
  const std::string identity = identityOf(o, suiteText);
  if (o.resume) done_ = regression::readProgress(textOf(folder_ + "/" + kProgress), identity);
  if (o.resume && done_.empty()) std::fprintf(stderr, "nothing to resume: the suite begins anew\n");
  if (!write(kProgress, regression::progressHeading(identity))) return false;
  for (const auto& [name, results] : done_)
    if (!note(name, results)) return false;
  return true;
}

bool RegressFolder::lock() {
  lock_ = Descriptor(::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (flock(lock_.get(), LOCK_EX | LOCK_NB) == 0) return true;
  std::fprintf(
      stderr,
      "stadion: --out %s: another regress is writing there; wait until it has ended, or name another "
      "folder\n",
      folder_.c_str());
  return false;
}

bool RegressFolder::note(const std::string& caseName, const std::vector<regression::CaseResult>& results) {
  return append(kProgress, regression::progressLine(caseName, results));
}

bool RegressFolder::finish(const regression::SuiteResult& result) {
  const std::string line = regression::toJsonLine(regression::historyEntryOf(result));
  if (!append(kHistory, line)) return false;
  const auto history = regression::readHistory(textOf(folder_ + "/" + kHistory));
  std::error_code none;
  std::filesystem::remove(folder_ + "/" + kProgress, none);
  return write("report.html", regression::pageOf(result, history)) &&
         write("results.json", regression::benchmarkJsonOf(result) + "\n") &&
         write("junit.xml", regression::junitOf(result));
}

bool RegressFolder::append(const std::string& name, const std::string& text) {
  std::ofstream file(folder_ + "/" + name, std::ios::binary | std::ios::app);
  file << text;
  file.close();
  if (!file) std::fprintf(stderr, "stadion: cannot write %s/%s\n", folder_.c_str(), name.c_str());
  return static_cast<bool>(file);
}

bool RegressFolder::write(const std::string& name, const std::string& text) {
  const auto wrong = writeFile(folder_ + "/" + name, text);
  if (wrong)
    std::fprintf(stderr, "stadion: %s/%s: %s\n", folder_.c_str(), name.c_str(), wrong->message.c_str());
  return !wrong;
}

}  // namespace stadion
