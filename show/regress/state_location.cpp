#include "show/regress/state_location.h"

#include "show/base/temporary_folder.h"
#include "show/recording/state_file.h"
#include "show/regress/regress_child.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <utility>

namespace stadion {
namespace {

constexpr std::size_t kKeptStates = 1024;        ///< frames of a case
constexpr std::size_t kKeptDigits = 8;           ///< of each
constexpr std::size_t kKeptFields = 4;           ///< frames of a case whose fields are kept, beside the first
constexpr std::size_t kMostKeptBytes = 1 << 17;  ///< of all of them

/// `PROGRAM hash SHOW ...`, as the case is played.
std::vector<std::string> hashWords(const regression::SuiteCase& c, const StatePlay& play) {
  std::vector<std::string> words = playWords(play.program, c, play.mode);
  words[1] = "hash";
  const auto leaveOut = [&](const char* option, int count) {
    const auto at = std::ranges::find(words, option);
    if (at != words.end()) words.erase(at, at + count);
  };
  leaveOut("--stereo", 2);
  leaveOut("--pace", 2);
  leaveOut("--json", 1);
  return words;
}

/// Of this many frames from the first one, whatever the case plays.
std::vector<std::string> hashWords(const regression::SuiteCase& c, const StatePlay& play,
                                   std::size_t frames) {
  std::vector<std::string> words = hashWords(c, play);
  if (const auto at = std::ranges::find(words, "--frames"); at != words.end()) words.erase(at, at + 2);
  words.insert(words.end(), {"--frames", std::to_string(frames)});
  return words;
}

/// Every how many frames a history is kept.
std::size_t strideOf(std::size_t frames) {
  return (frames + kKeptStates - 1) / kKeptStates;
}

/// "difference: NODE, FIELD is X here and Y in FILE", without its ends.
std::string differenceIn(const std::string& out, const std::string& file) {
  constexpr std::string_view kStart = "difference: ";
  std::istringstream lines(out);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(kStart)) continue;
    const std::size_t end = line.rfind(" in " + file);
    std::string found = line.substr(kStart.size(), end - kStart.size());
    if (const std::size_t here = found.rfind(" here and "); here != std::string::npos)
      found = found.substr(0, here) + " now, " + found.substr(here + 10) + " before";
    return found;
  }
  return "";
}

/// Without files and lines: a baseline is compared elsewhere, and scripts are edited.
std::string withoutPlaces(const std::string& text) {
  std::string kept;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    kept += (line.starts_with('@') ? line.substr(0, line.find('\t')) : line) + '\n';
  return kept;
}

/// StateFile::fields() of the state after so many frames; empty if the program cannot save it.
std::string fieldsAfter(const regression::SuiteCase& c, const StatePlay& play, std::size_t frames,
                        std::chrono::seconds limit, const std::atomic<bool>& stop) {
  const TemporaryFolder folder;
  const std::string file = folder.path("state");
  std::vector<std::string> save = hashWords(c, play, frames);
  save.insert(save.end(), {"--save-state", file});
  if (runChild(save, limit, stop).status != 0) return "";
  const auto state = StateFile::read(file);
  return state ? state.value().fields() : "";
}

/// After how many frames the fields are kept: after the first one, after all, and between.
std::vector<std::size_t> keptFrames(std::size_t frames) {
  if (frames == 0) return {};
  std::vector<std::size_t> counts{1};
  for (std::size_t part = kKeptFields; part > 0; --part)
    if (const std::size_t count = frames * part / kKeptFields; count > 0) counts.push_back(count);
  return counts;
}

/// The first and the last frame among which the states begin to differ; nothing if no kept one differs.
std::optional<std::pair<std::size_t, std::size_t>> firstDiffering(const std::vector<std::string>& now,
                                                                  const std::string& kept) {
  std::size_t frames = 0;
  std::string digits;
  std::istringstream(kept) >> frames >> digits;
  const std::size_t stride = strideOf(frames);
  for (std::size_t i = 0; stride > 0 && (i + 1) * kKeptDigits <= digits.size(); ++i) {
    const std::size_t last = (i + 1) * stride - 1;
    if (last >= now.size()) return {};
    if (digits.compare(i * kKeptDigits, kKeptDigits, now[last].substr(0, kKeptDigits)) != 0)
      return std::pair(last + 1 - stride, last);
  }
  return {};
}

}  // namespace

std::vector<std::string> stateHistory(const regression::SuiteCase& c, const StatePlay& play,
                                      std::chrono::seconds limit, const std::atomic<bool>& stop) {
  const ChildResult child = runChild(hashWords(c, play), limit, stop);
  std::vector<std::string> history;
  if (child.status != 0) return history;
  std::istringstream lines(child.out);
  std::string frame, hash;
  while (lines >> frame >> hash) history.push_back(hash);
  return history;
}

std::string stateLocation(const regression::SuiteCase& c, const StatePlay& now, const StatePlay& before,
                          std::chrono::seconds limit, const std::atomic<bool>& stop) {
  const auto ours = stateHistory(c, now, limit, stop), theirs = stateHistory(c, before, limit, stop);
  const std::size_t both = std::min(ours.size(), theirs.size());
  const auto [a, b] = std::ranges::mismatch(ours, theirs);
  const auto frame = static_cast<std::size_t>(a - ours.begin());
  if (frame == both)
    return both == 0 || ours.size() == theirs.size() ? "" : fmt::format("one ends after frame {}", both - 1);
  const std::string where = fmt::format("first in frame {}", frame);
  const TemporaryFolder folder;
  const std::string file = folder.path("state");
  std::vector<std::string> save = hashWords(c, before, frame + 1), compare = hashWords(c, now, frame + 1);
  save.insert(save.end(), {"--save-state", file});
  compare.insert(compare.end(), {"--compare-state", file});
  if (runChild(save, limit, stop).status != 0) return where + " (the other build cannot save states)";
  const std::string found = differenceIn(runChild(compare, limit, stop).out, file);
  return found.empty() ? where : where + ": " + found;
}

std::string keptStates(const std::vector<std::string>& history) {
  std::string kept = std::to_string(history.size()) + " ";
  for (std::size_t i = strideOf(history.size()); i > 0 && i <= history.size(); i += strideOf(history.size()))
    kept += history[i - 1].substr(0, kKeptDigits);
  return kept;
}

std::map<std::uint64_t, std::string> keptFields(const regression::SuiteCase& c, const StatePlay& play,
                                                std::size_t frames, std::chrono::seconds limit,
                                                const std::atomic<bool>& stop) {
  std::map<std::uint64_t, std::string> kept;
  std::size_t left = kMostKeptBytes;
  for (const std::size_t count : keptFrames(frames)) {
    if (kept.contains(count - 1)) continue;
    std::string text = withoutPlaces(fieldsAfter(c, play, count, limit, stop));
    if (text.empty() || text.size() > left) break;
    left -= text.size();
    kept[count - 1] = std::move(text);
  }
  return kept;
}

std::string stateLocation(const regression::SuiteCase& c, const StatePlay& now, const KeptStates& before,
                          std::chrono::seconds limit, const std::atomic<bool>& stop) {
  const auto differing = firstDiffering(stateHistory(c, now, limit, stop), before.hashes);
  if (!differing) return "";
  const auto [first, last] = *differing;
  const std::string where = first == last ? fmt::format("first in frame {}", first)
                                          : fmt::format("first in frames {} to {}", first, last);
  for (auto at = before.fields.lower_bound(first); at != before.fields.end(); ++at) {
    const auto frames = static_cast<std::size_t>(at->first) + 1;
    const std::string found = firstDifference(fieldsAfter(c, now, frames, limit, stop), at->second);
    if (found.empty()) continue;
    if (at->first <= last) return fmt::format("first in frame {}: {}", at->first, found);
    return where + fmt::format("; after frame {}: ", at->first) + found;
  }
  return where + "; --against BUILD names node and field";
}

std::string firstDifference(const std::string& now, const std::string& before) {
  const auto d = namedDifference(now, before);
  return d ? fmt::format("{} is {} now, {} before", d->where, d->here, d->there) : "";
}

}  // namespace stadion
