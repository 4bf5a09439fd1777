#include "cli/bench/bench_flight.h"

#include "bench/comparison/work_precision_plot.h"
#include "bench/flight/flight_report.h"
#include "bench/flight/trajectory_plot.h"
#include "cli/exit_code.h"
#include "cli/options/command_options.h"
#include "engine/base/installed_files.h"
#include "show/output/output_folder.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fmt/format.h>
#include <fstream>
#include <memory>

namespace stadion {
namespace {

struct BenchFlightOptions {
  int held = 100, rounds = 1000;
  std::string out;
  bool json = false;
};

using NamedPlot = std::pair<std::string, std::string>;  ///< file name and content

/// One throw of each thing, by all its rungs.
NamedPlot flightsOf(bench::Thing thing, const bench::ReferenceFlight& reference) {
  const bench::ThingFacts& facts = bench::factsOf(thing);
  std::vector<bench::DrawnFlight> flights{{"exact", reference.path}};
  for (const bench::Rung& rung : bench::rungsOf(thing))
    if (rung.name.find("Hz") == std::string::npos)
      flights.push_back({rung.name, rung.fly(reference.release)});
  const std::string title = fmt::format("{}: {} by every rung", facts.name, reference.release.name);
  return {fmt::format("flights-{}.svg", facts.name),
          bench::trajectoryPlot(title, flights, thing == bench::Thing::Ball ? -1 : facts.axis)};
}

std::vector<NamedPlot> picturesOf(const bench::FlightReport& report,
                                  const std::vector<bench::ReferenceFlight>& references) {
  std::vector<NamedPlot> pictures;
  for (const bench::Thing thing : {bench::Thing::Javelin, bench::Thing::Discus, bench::Thing::Ball}) {
    const std::string name = bench::factsOf(thing).name;
    pictures.emplace_back(fmt::format("work-precision-{}.svg", name),
                          bench::workPrecisionPlot(name + ": integrators, exact model",
                                                   report.integrators.measurements(thing)));
    const char* shown = thing == bench::Thing::Javelin  ? "jav_30_34_xwind5"
                        : thing == bench::Thing::Discus ? "disc_25_35_s40_a-10_head5"
                                                        : "ball_25_20_side60";
    for (const bench::ReferenceFlight& r : references)
      if (r.release.name == shown) pictures.push_back(flightsOf(thing, r));
  }
  return pictures;
}

bool writeText(const std::string& path, const std::string& content) {
  std::ofstream file(path, std::ios::binary);
  file << content;
  file.close();
  if (!file) std::fprintf(stderr, "stadion: cannot write %s\n", path.c_str());
  return static_cast<bool>(file);
}

bool writeFiles(OutputFolder& folder, const std::vector<NamedPlot>& files) {
  for (const auto& [name, content] : files) {
    if (const auto wrong = folder.note(name)) {
      std::fprintf(stderr, "stadion: %s\n", wrong->message.c_str());
      return false;
    }
    if (!writeText(folder.pathOf(name), content)) return false;
  }
  return true;
}

int benchFlight(const BenchFlightOptions& o) {
  std::unique_ptr<OutputFolder> out;
  if (!o.out.empty()) {
    auto opened = OutputFolder::open(o.out);
    if (!opened) {
      std::fprintf(stderr, "stadion: %s\n", opened.error().message.c_str());
      return kBadInput;
    }
    out = std::move(opened.value());
    out->clear();
  }
  const auto references = bench::referenceFlights(shareFolder() + "/bench/flight/reference");
  if (!references) {
    std::fprintf(stderr, "stadion: %s\n", format(references.error()).c_str());
    return kInternalFault;
  }
  const auto show = bench::ShowFlights::ofOlympia(shareFolder());
  if (!show) {
    std::fprintf(stderr, "stadion: %s\n", format(show.error()).c_str());
    return kInternalFault;
  }
  const bench::FlightReport report{bench::measureLadder(references.value(), o.held, &show.value()),
                                   bench::measureIntegrators(references.value()),
                                   bench::measureCosts(o.rounds), bench::measurePublishedThrows(),
                                   bench::measureHardCases()};
  std::fputs(bench::textOf(report).c_str(), o.json ? stderr : stdout);
  if (o.json) std::printf("%s\n", bench::jsonOf(report).c_str());
  std::vector<NamedPlot> files = out ? picturesOf(report, references.value()) : std::vector<NamedPlot>();
  files.emplace_back("flight.json", bench::indentedJsonOf(report));
  if (out && !writeFiles(*out, files)) return kBadInput;
  return bench::allMet(report) ? kOk : kCheckFailed;
}

}  // namespace

void addBenchFlight(CLI::App& bench, int& code) {
  auto o = std::make_shared<BenchFlightOptions>();
  CLI::App* command =
      bench.add_subcommand("flight", "How exact and how expensive the flight models and integrators are");
  CommandOptions options(*command);
  options.add("--flights", o->held);
  options.add("--rounds", o->rounds);
  options.add("--json", o->json);
  options.add("--out", o->out);
  command->footer("--out DIR receives flight.json and plots of the flights and of error against cost.");
  command->callback([o, &code] { code = benchFlight(*o); });
}

}  // namespace stadion
