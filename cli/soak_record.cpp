#include "cli/soak_record.h"

#include "engine/plain_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <sstream>

namespace stadion {
namespace {

using Json = nlohmann::json;

constexpr int kVersion = 2;
constexpr std::size_t kMostBytes = std::size_t{1} << 30U;

Json jsonOf(const SoakCounts& c) {
  return {c.frames, c.visits,     c.changes,     c.throws,   c.refused,
          c.killed, c.wrongSteps, c.wrongHashes, c.compared, c.seconds};
}

SoakCounts countsOf(const Json& j) {
  SoakCounts c;
  c.frames = j.at(0), c.visits = j.at(1), c.changes = j.at(2), c.throws = j.at(3), c.refused = j.at(4);
  c.killed = j.at(5), c.wrongSteps = j.at(6), c.wrongHashes = j.at(7), c.compared = j.at(8),
  c.seconds = j.at(9);
  return c;
}

}  // namespace

std::unique_ptr<SoakRecord> SoakRecord::open(const std::string& file, const std::string& what,
                                             Diagnostics& findings) {
  std::unique_ptr<SoakRecord> record(new SoakRecord);
  if (file.empty()) return record;
  std::error_code none;
  const bool goesOn = std::filesystem::exists(file, none) && std::filesystem::file_size(file, none) > 0;
  if (goesOn) {
    const auto text = readPlainFile(file, kMostBytes);
    if (!text) return findings.add(text.error()), nullptr;
    if (!record->read(text.value(), what))
      return findings.error({file, 0, 0}, "is no record of this soak (" + what + "); name another file"),
             nullptr;
  }
  record->file_ = std::fopen(file.c_str(), "ae");
  if (!record->file_)
    return findings.error({}, "--record: " + file + " cannot be written: " + std::strerror(errno)), nullptr;
  // What a run that was killed has left of a line stays a line of its own.
  record->write(goesOn ? "" : Json{{"stadion-soak", kVersion}, {"what", what}}.dump());
  return record;
}

SoakRecord::~SoakRecord() {
  if (file_) std::fclose(file_);
}

bool SoakRecord::read(const std::string& text, const std::string& what) {
  std::istringstream in(text);
  std::string line;
  const auto parsed = [&] { return Json::parse(line, nullptr, false); };
  if (!std::getline(in, line)) return false;
  const Json head = parsed();
  if (!head.is_object() || head.value("stadion-soak", 0) != kVersion || head.value("what", "") != what)
    return false;
  std::uint32_t last = 0;
  while (std::getline(in, line)) try {
      const Json j = Json::parse(line);
      if (j.contains("sample")) {
        const Json& s = j.at("sample");
        samples_.push_back({s.at(0), s.at(1), s.at(2), s.at(3), s.at(4), s.at(5), s.at(6)});
        counts = countsOf(j.at("counts"));
        last = samples_.back().process;
      } else {
        known(j.at("show"), j.at("frame"), j.at("history"));
      }
    } catch (const Json::exception&) {
      continue;  // half a line: the run ended there
    }
  process_ = samples_.empty() ? 0 : last + 1;
  return true;
}

void SoakRecord::write(const std::string& line) {
  if (!file_) return;
  std::fprintf(file_, "%s\n", line.c_str());
  std::fflush(file_);
}

void SoakRecord::add(SoakSample s) {
  s.process = process_;
  samples_.push_back(s);
  write(Json{{"sample", {s.process, s.visit, s.frame, s.residentBytes, s.heapBytes, s.handles, s.threads}},
             {"counts", jsonOf(counts)}}
            .dump());
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
  if (before) return ++counts.compared, *before == history;
  write(Json{{"show", show}, {"frame", frame}, {"history", history}}.dump());
  return true;
}

}  // namespace stadion
