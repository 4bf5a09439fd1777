#include "cli/bench/walls_rounds.h"

#include "engine/base/atomic_file.h"
#include "show/base/temporary_folder.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fmt/format.h>
#include <fstream>
#include <map>

namespace stadion {
namespace {

using Clock = std::chrono::steady_clock;

double minutesSince(Clock::time_point begin) {
  return std::chrono::duration<double, std::ratio<60>>(Clock::now() - begin).count();
}

/// What a run takes on a machine with two processors [s]; only to tell how long to wait.
double guessedSeconds(const bench::WallsCase& c) {
  const double frames = static_cast<double>(c.warm + c.frames);
  if (c.engine == "control" || c.pace != "free") return 0.5 + frames / 30;
  const double whole = c.nodes ? 0.05 : c.scene == "c" ? 0.06 : 0.17;
  return 0.6 + static_cast<double>(c.nodes) * 1e-5 +
         frames * (c.kind == "SUBMIT" ? 0.4 : 1) * whole * static_cast<double>(c.walls) / 4;
}

class Rounds {
public:
  Rounds(const std::vector<bench::WallsCase>& cases, const bench::WallsPrograms& programs,
         const WallsRounds& how)
      : cases_(cases), programs_(programs), how_(how) {}

  std::optional<Diagnostic> readRecord() {
    if (how_.record.empty()) return std::nullopt;
    auto record = bench::readRecord(how_.record, how_.head);
    if (!record) return record.error();
    std::string whole = lineOf(record.value().head) + "\n";  // without half a line at the end
    for (nlohmann::json& row : record.value().rows) {
      whole += row.dump() + "\n";
      ++kept_[row["case"]];
      if (how_.row) how_.row(row);
      outcome_.results.add(std::move(row));
    }
    if (auto wrong = writeFile(how_.record, whole)) return wrong;
    file_.open(how_.record, std::ios::app);
    return std::nullopt;
  }

  void comparePictures() {
    if (programs_.osg.empty()) return;
    for (const std::string& scene : how_.scenes)
      for (const char* kind : {"STRICT", "OPEN", "SUBMIT"}) {
        if (outcome_.results.count("pictures " + scene + " " + kind)) continue;
        std::fprintf(stderr, "pictures of %s, %s\n", scene.c_str(), kind);
        const TemporaryFolder folder;
        take(bench::comparePictures({scene, kind, how_.head.drawnBy}, programs_, folder.path("")), 0);
      }
  }

  void play() {
    double round = 0;
    for (const bench::WallsCase& c : cases_) round += guessedSeconds(c) / 60;
    std::fprintf(stderr, "rounds: %zu, of %zu cases; minutes: about %.0f\n", how_.rounds, cases_.size(),
                 std::min(how_.minutes, static_cast<double>(how_.rounds) * round));
    const Clock::time_point begin = Clock::now();
    for (std::size_t n = 1; n <= how_.rounds; ++n) {
      const Clock::time_point start = Clock::now();
      const bool measured = playOne(n);
      ++outcome_.rounds;
      if (!measured) continue;
      round = std::max(minutesSince(start), 1e-3);
      const double left = static_cast<double>(how_.rounds - n) * round;
      if (n == how_.rounds) return;
      if (minutesSince(begin) + round > how_.minutes) {
        std::fprintf(stderr, "no more rounds: another would not end within %g minutes\n", how_.minutes);
        return;
      }
      std::fprintf(stderr, "round %zu of %zu took %.1f minutes, about %.0f more\n", n, how_.rounds, round,
                   std::min(left, how_.minutes - minutesSince(begin)));
    }
  }

  WallsOutcome take() { return std::move(outcome_); }

private:
  /// Plays all cases once. Every second round has the reverse order, so that no case always follows the same
  /// neighbour.
  bool playOne(std::size_t n) {
    std::vector<const bench::WallsCase*> order;
    for (const bench::WallsCase& c : cases_) order.push_back(&c);
    if (n % 2 == 0) std::ranges::reverse(order);
    bool measured = false;
    for (const bench::WallsCase* c : order) {
      const std::string name = nameOf(*c);
      if (kept_[name] >= n) continue;
      measured = true;
      const Clock::time_point start = Clock::now();
      const bool ok = take(bench::measure(*c, programs_), n);
      std::fprintf(stderr, "  %zu/%zu  %-44s %s (%.1f s)\n", n, how_.rounds, name.c_str(),
                   ok ? told(name).c_str() : "FAILED", 60 * minutesSince(start));
    }
    return measured;
  }

  std::string told(const std::string& name) const {
    const nlohmann::json& row = outcome_.results.rowsOf(name).back();
    return row.contains("fps") ? fmt::format("{:7.2f} fps", row["fps"].get<double>()) : std::string("done");
  }

  bool take(Result<nlohmann::json> row, std::size_t round) {
    if (row && row.value().value("incomplete", 0) != 0) {
      outcome_.failures.push_back(row.value()["case"].get<std::string>() + ": frames with missing views");
      return false;
    }
    if (!row) {
      outcome_.failures.push_back(format(row.error()));
      return false;
    }
    nlohmann::json& json = row.value();
    json["round"] = round;
    if (file_.is_open()) file_ << json.dump() << std::endl;
    if (how_.row) how_.row(json);
    outcome_.results.add(std::move(json));
    return true;
  }

  const std::vector<bench::WallsCase>& cases_;
  const bench::WallsPrograms& programs_;
  const WallsRounds& how_;
  WallsOutcome outcome_;
  std::map<std::string, std::size_t> kept_;  ///< rows of the record, by case
  std::ofstream file_;
};

}  // namespace

Result<WallsOutcome> playRounds(const std::vector<bench::WallsCase>& cases,
                                const bench::WallsPrograms& programs, const WallsRounds& how) {
  Rounds rounds(cases, programs, how);
  if (const auto wrong = rounds.readRecord()) return *wrong;
  if (how.pictures) rounds.comparePictures();
  rounds.play();
  return rounds.take();
}

}  // namespace stadion
