#include "show/measure/soak_record.h"

#include "engine/base/append.h"
#include "engine/base/plain_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <sstream>
#include <sys/file.h>
#include <sys/stat.h>

namespace stadion {
namespace {

using Json = nlohmann::json;

constexpr int kVersion = 2;
constexpr std::size_t kMostRecordBytes = std::size_t{1} << 30U;
/// No frames, bytes or files are more, so their sums do not overflow.
constexpr std::uint64_t kMostNumber = std::uint64_t{1} << 53U;

Json jsonOf(const SoakCounts& c) {
  return {c.frames, c.visits,     c.changes,     c.throws,   c.refused,
          c.killed, c.wrongSteps, c.wrongHashes, c.compared, c.seconds};
}

SoakCounts countsOf(const Json& j) {
  SoakCounts c;
  c.frames = j.at(0);
  c.visits = j.at(1);
  c.changes = j.at(2);
  c.throws = j.at(3);
  c.refused = j.at(4);
  c.killed = j.at(5);
  c.wrongSteps = j.at(6);
  c.wrongHashes = j.at(7);
  c.compared = j.at(8);
  c.seconds = j.at(9);
  return c;
}

/// Whether it is UTF-8: else something is left out, or something else stands there.
bool isText(const Json& words) {
  using What = Json::error_handler_t;
  return words.dump(-1, ' ', true, What::ignore) == words.dump(-1, ' ', true, What::replace);
}

bool isNumber(const Json& j) {
  return j.is_number_unsigned() && j.get<std::uint64_t>() <= kMostNumber;
}

bool areNumbers(const Json& j, std::size_t many) {
  return j.is_array() && j.size() == many && std::all_of(j.begin(), j.end(), isNumber);
}

/// As jsonOf() makes them: whole numbers, and the seconds.
bool areCounts(const Json& j) {
  if (!j.is_array() || j.size() != 10 || !std::all_of(j.begin(), j.end() - 1, isNumber)) return false;
  const Json& seconds = j.back();
  return seconds.is_number() && std::isfinite(seconds.get<double>()) && seconds.get<double>() >= 0;
}

/// What stands at `key`, null if that is not there.
const Json& valueAt(const Json& j, const char* key) {
  static const Json none;
  const auto at = j.find(key);
  return at == j.end() ? none : *at;
}

}  // namespace

std::unique_ptr<SoakRecord> SoakRecord::open(const std::string& file, const std::string& what,
                                             std::function<void(const std::string&)> fault,
                                             Diagnostics& findings) {
  std::unique_ptr<SoakRecord> record(new SoakRecord(file, std::move(fault)));
  if (file.empty()) return record;
  if (!isText(what)) {
    findings.error({}, "--record: it cannot hold a name that is not UTF-8 (" + what + ")");
    return nullptr;
  }
  if (!record->lock(findings) || !record->read(what, findings)) return nullptr;
  return record;
}

/// Opens the file and locks it.
bool SoakRecord::lock(Diagnostics& findings) {
  const auto refuse = [&](const std::string& why) {
    findings.error({}, "--record: " + name_ + why);
    return false;
  };
  constexpr int kHow = O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NONBLOCK | O_NOCTTY;
  file_ = FileDescriptor(::open(name_.c_str(), kHow, 0666));
  struct stat about {};
  if (!file_ || fstat(file_.get(), &about) != 0)
    return refuse(std::string(" cannot be written: ") + std::strerror(errno));
  if (!S_ISREG(about.st_mode)) return refuse(" is no plain file, to which lines could be added");
  if (flock(file_.get(), LOCK_EX | LOCK_NB) == 0) return true;
  if (errno == EWOULDBLOCK)
    return refuse(": another process is writing it; wait for it, or name another file");
  return refuse(std::string(" cannot be locked: ") + std::strerror(errno));
}

/// What is in the file, if that is a record of this soak; an empty one becomes one.
bool SoakRecord::read(const std::string& what, Diagnostics& findings) {
  const std::string none = "is no record of this soak (" + what + ")", other = "; name another file";
  const auto text = readPlainFile(file_.get(), name_, kMostRecordBytes);
  if (!text) {
    findings.add(text.error());
    return false;
  }
  const Json head{{"stadion-soak", kVersion}, {"what", what}};
  if (text.value().empty()) {
    write(head.dump());
    return true;
  }
  std::istringstream in(text.value());
  std::string line;
  std::getline(in, line);
  if (!(Json::parse(line, nullptr, false) == head)) {
    findings.error({name_, 0, 0}, none + other);
    return false;
  }
  for (std::uint32_t number = 2; std::getline(in, line); ++number) {
    const Json j = Json::parse(line, nullptr, false);
    if (j.is_discarded() && !line.ends_with('}')) continue;  // half a line: a run was killed there
    if (const char* why = readLine(j)) {
      findings.error({name_, number, 0}, none + ": this line " + why + other);
      return false;
    }
  }
  write("");  // what a run that was killed has left of a line stays a line of its own
  return true;
}

/// What is wrong with it; null: nothing.
const char* SoakRecord::readLine(const Json& line) {
  if (line.is_discarded()) return "is damaged";
  if (!line.is_object()) return "is neither a sample nor counts nor a history";
  if (line.contains("sample")) return readSample(valueAt(line, "sample"), valueAt(line, "counts"));
  if (line.contains("counts")) {
    const char* why = readCounts(valueAt(line, "process"), valueAt(line, "counts"));
    return !why && line.contains("failed") ? readFailed(valueAt(line, "failed")) : why;
  }
  const Json &show = valueAt(line, "show"), &frame = valueAt(line, "frame"),
             &history = valueAt(line, "history");
  if (!show.is_string() || !isNumber(frame) || !history.is_number_unsigned())
    return "is neither a sample nor counts nor a history";
  const auto before = known(show, frame, history);
  return before && *before != history.get<std::uint64_t>() ? "has another history of a frame than one before"
                                                           : nullptr;
}

const char* SoakRecord::readSample(const Json& s, const Json& c) {
  if (!areNumbers(s, 7) || !areCounts(c)) return "has a sample whose figures cannot be";
  const SoakCounts now = countsOf(c);
  const std::uint64_t process = s.at(0), visit = s.at(1), frame = s.at(2);
  if (frame != now.frames || visit != now.visits) return "has a sample of another frame than its counts are";
  if (const char* why = goOn(process, now)) return why;
  samples_.push_back({s.at(0), visit, frame, s.at(3), s.at(4), s.at(5), s.at(6)});
  return nullptr;
}

const char* SoakRecord::readCounts(const Json& process, const Json& c) {
  if (!isNumber(process) || !areCounts(c)) return "has counts that cannot be";
  return goOn(process, countsOf(c));
}

const char* SoakRecord::readFailed(const Json& failed) {
  if (!failed.is_array()) return "says nothing of what failed";
  for (const Json& what : failed) {
    if (!what.is_string()) return "says nothing of what failed";
    failed_.push_back(what);
  }
  return nullptr;
}

/// The counts of a process are the newest ones, if its turn it is.
const char* SoakRecord::goOn(std::uint64_t process, const SoakCounts& now) {
  if (process > processes_ || process + 1 < processes_) return "is of a process whose turn it is not";
  if (now.frames < counts.frames || now.visits < counts.visits) return "is of before the one before";
  processes_ = static_cast<std::uint32_t>(process) + 1;
  counts = now;
  return nullptr;
}

// With a line left out, those after it would say of the whole what they do not know.
void SoakRecord::write(const std::string& line) {
  if (!file_ || incomplete_) return;
  const int why = appendWhole(file_.get(), line + "\n");
  if (why == 0) return;
  incomplete_ = true;
  fault_(fmt::format("--record: {}: cannot be written: {}; the record ends here, the soak goes on", name_,
                     std::strerror(why)));
}

void SoakRecord::add(SoakSample s) {
  s.process = process_;
  samples_.push_back(s);
  write(Json{{"sample", {s.process, s.visit, s.frame, s.residentBytes, s.heapBytes, s.handles, s.threads}},
             {"counts", jsonOf(counts)}}
            .dump());
}

void SoakRecord::addCounts() {
  write(Json{{"process", process_}, {"counts", jsonOf(counts)}}.dump());
}

void SoakRecord::end(const std::vector<std::string>& failed) {
  for (const std::string& what : failed)
    if (std::ranges::find(failed_, what) == failed_.end()) failed_.push_back(what);
  write(Json{{"process", process_}, {"counts", jsonOf(counts)}, {"failed", failed}}.dump());
}

/// What that frame's history was before; nothing: now it is known.
std::optional<std::uint64_t> SoakRecord::known(const std::string& show, std::uint64_t frame,
                                               std::uint64_t history) {
  auto& all = histories_[show];
  const auto at = std::ranges::lower_bound(all, frame, {}, &std::pair<std::uint64_t, std::uint64_t>::first);
  if (at != all.end() && at->first == frame) return at->second;
  all.emplace(at, frame, history);
  return {};
}

bool SoakRecord::agrees(const std::string& show, std::uint64_t frame, std::uint64_t history) {
  const auto before = known(show, frame, history);
  if (before) {
    ++counts.compared;
    return *before == history;
  }
  write(Json{{"show", show}, {"frame", frame}, {"history", history}}.dump());
  return true;
}

}  // namespace stadion
