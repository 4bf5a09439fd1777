#include "cli/regress/regress_folder.h"

#include "engine/core/state_hash.h"
#include "profiling/regression/page.h"
#include "profiling/regression/reports.h"
#include "profiling/regression/statistics/history.h"
#include "show/regress/regress_child.h"

#include <fmt/format.h>

#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sys/file.h>
#include <utility>

namespace stadion {
namespace {

constexpr const char *kProgress = "progress.jsonl", *kHistory = "history.jsonl";
constexpr const char *kPage = "report.html", *kResults = "results.json", *kJunit = "junit.xml";

void printError(const std::string& path, const std::string& why) {
  std::fprintf(stderr, "%s: error: %s\n", path.c_str(), why.c_str());
}

bool endsInHalfALine(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  return file.tellg() > 0 && file.seekg(-1, std::ios::end).get() != '\n';
}

/// A rebuilt program counts as another one.
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
  if (why) {
    std::fprintf(stderr, "stadion: --out %s: %s\n", folder_.c_str(), why.message().c_str());
    return false;
  }
  if (!lock() || !openOutputs()) return false;
  const std::string identity = identityOf(o, suiteText);
  if (o.resume) done_ = regression::readProgress(textOf(pathOf(kProgress)), identity);
  if (o.resume && done_.empty())
    std::fprintf(stderr, "nothing to resume: the suite starts from the beginning\n");
  if (!write(kProgress, regression::progressHeading(identity))) return false;
  for (const auto& [name, results] : done_)
    if (!note(name, results)) return false;
  return true;
}

bool RegressFolder::lock() {
  lock_ = FileDescriptor(::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (flock(lock_.get(), LOCK_EX | LOCK_NB) == 0) return true;
  std::fprintf(
      stderr,
      "stadion: --out %s: another regress is writing there; wait until it has ended, or name another "
      "folder\n",
      folder_.c_str());
  return false;
}

bool RegressFolder::openOutputs() {
  bool well = true;
  for (const char* name : {kPage, kResults, kJunit}) {
    const auto [at, isNew] = outputs_.try_emplace(name, pathOf(name));
    if (const auto& wrong = at->second.error()) {
      printError(wrong->where.file, wrong->message);
      well = false;
    }
  }
  return well && append(kHistory, "");
}

bool RegressFolder::note(const std::string& caseName, const std::vector<regression::CaseResult>& results) {
  return append(kProgress, regression::progressLine(caseName, results));
}

bool RegressFolder::finish(const regression::SuiteResult& result) {
  auto history = regression::readHistory(textOf(pathOf(kHistory)));
  history.push_back(regression::historyEntryOf(result));
  const std::pair<const char*, std::string> all[] = {
      {kPage, regression::pageOf(result, history)},
      {kResults, regression::benchmarkJsonOf(result) + "\n"},
      {kJunit, regression::junitOf(result)},
  };
  bool well = true;
  for (const auto& [name, text] : all) {
    AtomicFile& file = outputs_.at(name);
    file.write(text);
    if (const auto wrong = file.commit()) {
      printError(wrong->where.file, wrong->message);
      well = false;
    }
  }
  return well && append(kHistory, regression::toJsonLine(history.back()));
}

void RegressFolder::forgetProgress() {
  std::error_code none;
  std::filesystem::remove(pathOf(kProgress), none);
}

// What a run that was killed, or a full disk, has left of a line stays alone.
bool RegressFolder::append(const std::string& name, const std::string& text) {
  const std::string path = pathOf(name);
  const bool half = !text.empty() && endsInHalfALine(path);
  std::ofstream file(path, std::ios::binary | std::ios::app);
  file << (half ? "\n" : "") << text;
  file.close();
  if (!file) printError(path, "cannot be written");
  return static_cast<bool>(file);
}

bool RegressFolder::write(const std::string& name, const std::string& text) {
  const auto wrong = writeFile(pathOf(name), text);
  if (wrong) printError(wrong->where.file, wrong->message);
  return !wrong;
}

}  // namespace stadion
