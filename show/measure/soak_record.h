#pragma once
/// What a soak has found so far, in a file if one is named: a run with the same file goes on.
///
/// One JSON object a line, added and flushed as it comes, so that whatever ends the run loses a sample at
/// most, and no failure.
///
/// A record is one process's at a time: it holds a lock on the file.
///
/// Threads  App's.
/// Errors   in the findings: the file cannot be written, another process is writing it, or it is no record
///          of the same soak. A line that cannot be written later on (a full disk) is reported once;
///          then the record ends there, whole, and the soak goes on without.

#include "engine/base/diagnostic.h"
#include "pipeline/platform/child_process.h"
#include "profiling/soak/growth.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace stadion {

/// Counts of the whole soak.
struct SoakCounts {
  std::uint64_t frames = 0, visits = 0;
  std::uint64_t changes = 0;      ///< files that were loaded or unloaded
  std::uint64_t throws = 0;       ///< by the visitor
  std::uint64_t refused = 0;      ///< measurements that cannot be
  std::uint64_t killed = 0;       ///< walls' processes
  std::uint64_t wrongSteps = 0;   ///< frames that were not one tick after the one before
  std::uint64_t wrongHashes = 0;  ///< states that differ from what the same frame had before
  std::uint64_t compared = 0;     ///< states that were compared
  double seconds = 0;             ///< duration of the soak so far
};

class SoakRecord {
public:
  /// Opens the record, or begins one. `file`: empty = nothing is written. `what` describes the soak; a record
  /// of another soak is refused. `fault` receives the reason if the record ends early.
  static std::unique_ptr<SoakRecord> open(const std::string& file, const std::string& what,
                                          std::function<void(const std::string&)> fault,
                                          Diagnostics& findings);

  SoakCounts counts;
  const std::vector<SoakSample>& samples() const { return samples_; }
  /// Returns the number of processes that have played.
  std::uint32_t processes() const { return processes_; }
  /// Returns the failures at the end of each run, this one included.
  const std::vector<std::string>& failed() const { return failed_; }
  /// Counts this process.
  void begin() { process_ = processes_++; }
  /// Adds a sample with the present counts.
  void add(SoakSample sample);
  /// Adds the present counts alone.
  void addCounts();
  /// Adds the present counts, and the failures that the counts do not show.
  void end(const std::vector<std::string>& failed);
  /// Returns true if that frame of the show had this history of states before; the first time it is noted.
  bool agrees(const std::string& show, std::uint64_t frame, std::uint64_t history);
  /// Returns true if something could not be written.
  bool incomplete() const { return incomplete_; }

private:
  SoakRecord(std::string name, std::function<void(const std::string&)> fault)
      : name_(std::move(name)), fault_(std::move(fault)) {}
  bool lock(Diagnostics& findings);
  bool read(const std::string& what, Diagnostics& findings);
  const char* readLine(const nlohmann::json& line);
  const char* readSample(const nlohmann::json& sample, const nlohmann::json& counts);
  const char* readCounts(const nlohmann::json& process, const nlohmann::json& counts);
  const char* readFailed(const nlohmann::json& failed);
  const char* goOn(std::uint64_t process, const SoakCounts& now);
  std::optional<std::uint64_t> known(const std::string& show, std::uint64_t frame, std::uint64_t history);
  void write(const std::string& line);

  std::string name_;  ///< empty: nothing is written
  std::function<void(const std::string&)> fault_;
  FileDescriptor file_;
  bool incomplete_ = false;
  std::uint32_t process_ = 0, processes_ = 0;
  std::vector<SoakSample> samples_;
  std::vector<std::string> failed_;
  /// By show, then by frame: flat, so that the soak itself hardly grows.
  std::map<std::string, std::vector<std::pair<std::uint64_t, std::uint64_t>>> histories_;
};

}  // namespace stadion
