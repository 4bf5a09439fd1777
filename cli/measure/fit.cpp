/// `stadion fit OBJECT --reference CSV`: the cheapest flight model that is good enough, and the line to
/// paste.

#include "dynamics/flight/fit.h"
#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/options/command_options.h"
#include "cli/options/command_programs.h"
#include "cli/options/plugin_option.h"
#include "cli/terminal.h"
#include "engine/base/plain_file.h"
#include "show/base/standard_nodes.h"
#include "show/measure/fit_object.h"
#include "show/output/output_names.h"
#include "show/player/player.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <memory>

namespace stadion {
namespace {

struct FitOptions {
  std::string object;
  std::vector<std::string> references, roots, plugins;
  SharedTypes types = standardNodes();
  double landing = 1, attitude = 0;  ///< [%], [degrees]; 0: as it comes
  std::optional<double> mass;
  std::vector<double> wind{0, 0, 0}, inertia, centre;
  double gravity = 9.80665, density = 1.225;
  std::string out;  ///< folder of the table
};

int refuse(const Diagnostic& why) {
  std::fprintf(stderr, "%s\n",
               why.where.file.empty() ? ("stadion: " + why.message).c_str() : format(why).c_str());
  return kBadInput;
}

/// Why this is no flight from a hand to the ground; nullptr if it is one.
const char* faultOf(const Trajectory& flight) {
  constexpr std::size_t kFewestRows = 5;
  const RigidFlight &first = flight.front().at, &last = flight.back().at;
  if (flight.size() < kFewestRows) return "this flight has fewer than five rows: write more of what it did";
  if ((last.p - first.p).head<2>().norm() < 0.1) return "this flight goes nowhere: it ends where it began";
  constexpr double kRounding = 1e-3;  // [m]
  if (last.v.z() >= 0 || last.p.z() > first.p.z() + kRounding)
    return "the last row is no landing: the body rises there, or is higher than where it began; a flight is "
           "recorded to the ground";
  return nullptr;
}

/// As the script gives them to the world: flights of A about the centre of mass.
std::optional<Diagnostic> readFlights(const FitOptions& o, FitTask& task) {
  for (const std::string& file : o.references) {
    const auto text = readPlainFile(file, std::size_t{64} << 20);
    if (!text) return text.error();
    auto flight = readTrajectory(text.value(), file);
    if (!flight) return flight.error();
    if (const char* const fault = faultOf(flight.value())) {
      Diagnostic wrong;
      wrong.where.file = file;
      wrong.message = fault;
      return wrong;
    }
    for (TrajectorySample& s : flight.value()) {
      s.at.q = s.at.q * task.shape.q_NA;
      s.at.w = task.shape.q_NA.conjugate() * s.at.w;
    }
    task.flights.push_back(std::move(flight.value()));
  }
  return std::nullopt;
}

/// Moments about A's axis and across it, of principal moments in the model's coordinates.
FlightBody bodyOf(const MassProperties& mass, const FlightShape& shape) {
  const Mat3 axes = (shape.q_NA.conjugate() * mass.axes).toRotationMatrix();
  const Vec3 i = (axes * mass.inertia.asDiagonal() * axes.transpose()).diagonal();
  const int axis = shape.elongated() ? 0 : 2;
  return {mass.mass, i[axis], 0.5 * (i.sum() - i[axis])};
}

StatedMatter matterOf(const FitOptions& o) {
  StatedMatter m;
  m.mass = o.mass;
  if (!o.centre.empty()) m.centre = Vec3(o.centre[0], o.centre[1], o.centre[2]);
  if (!o.inertia.empty()) m.moments = Vec2(o.inertia[0], o.inertia[1]);
  return m;
}

Result<FitTask> taskOf(const FitOptions& o) {
  if (!o.inertia.empty() && o.inertia[0] > 2 * o.inertia[1])
    return Result<FitTask>::failure(
        "--inertia: no body has such moments: along its axis at most twice that across");
  auto object = readFlownObject(o.object, o.roots, *o.types, matterOf(o));
  if (!object) return object.error();
  const FlownObject& body = object.value();
  FitTask task;
  task.shape = measureShape(body.mesh, body.mass.centre, body.nose);
  task.body = bodyOf(body.mass, task.shape);
  task.air = {Vec3(0, 0, -o.gravity), Vec3(o.wind[0], o.wind[1], o.wind[2]), o.density};
  if (auto wrong = readFlights(o, task)) return *wrong;
  return task;
}

std::string nameOf(FlightKind kind) {
  constexpr const char* names[] = {"ballistic", "bias", "rod", "plate", "ball", "table"};
  return names[static_cast<std::size_t>(kind)];
}

/// What the command line says of the body, as a script says it: the fit holds for that.
std::string matterText(const FitOptions& o, const FlightShape& shape) {
  const auto three = [](const char* name, const Vec3& v) {
    return fmt::format("{}=\"{:.9g}, {:.9g}, {:.9g}\", ", name, v.x(), v.y(), v.z());
  };
  const StatedMatter m = matterOf(o);
  std::string text;
  if (m.mass) text += fmt::format("mass={:.9g}, ", *m.mass);
  if (m.centre) text += three("centre", *m.centre);
  if (m.moments) text += three("inertia", momentsOf(*m.moments, shape));
  return text;
}

/// What a script says to have it.
std::string attributesOf(const FittedRung& rung, const std::string& table) {
  std::string text = "flight=" + nameOf(rung.kind);
  if (rung.kind == FlightKind::Bias) text += fmt::format(", bias=flow, biasrate={:.9g}", rung.bias.rate);
  if (rung.kind == FlightKind::Table)
    text += fmt::format(", flighttable=\"{}\"", std::filesystem::path(table).filename().string());
  const std::vector<double> numbers = coefficientsOf(rung.model);
  if (numbers.empty()) return text;
  text += ", coefficients=\"";
  for (std::size_t i = 0; i < numbers.size(); ++i) text += fmt::format("{}{:.9g}", i ? ", " : "", numbers[i]);
  return text + "\"";
}

bool writeTable(const FittedRung& rung, int axis, const std::string& path) {
  std::error_code exists;
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), exists);
  std::ofstream file(path, std::ios::binary);
  file << flightTableText(rung.rows, rung.area, rung.length, axis);
  file.close();
  if (!file) std::fprintf(stderr, "stadion: cannot write %s\n", path.c_str());
  return static_cast<bool>(file);
}

std::string tableFileOf(const FitOptions& o) {
  const std::size_t colon = o.object.rfind(".evs:");
  const std::string stem = colon != std::string::npos ? o.object.substr(colon + 5)
                                                      : std::filesystem::path(o.object).stem().string();
  return (std::filesystem::path(o.out) / (stem + "-flight.csv")).string();
}

void printRungs(const std::vector<FittedRung>& rungs, bool round) {
  std::printf("  %-11s%12s%18s\n", "flight", "landing", round ? "" : "axis (mean)");
  for (const FittedRung& r : rungs)
    std::printf("  %-11s%10.3f %%%s   %s\n", nameOf(r.kind).c_str(), 100 * r.errors.landing,
                round ? "" : fmt::format("{:14.2f} deg", r.errors.attitude).c_str(),
                r.good ? "within the tolerance" : "");
}

/// How fast the body turns about A's axis and across it, mean of all flights [rad/s].
Vec2 turning(const FitTask& task) {
  const int axis = task.shape.elongated() ? 0 : 2;
  Vec2 sum = Vec2::Zero();
  double rows = 0;
  for (const Trajectory& flight : task.flights)
    for (const TrajectorySample& s : flight) {
      const double along = s.at.w[axis];
      sum += Vec2(std::abs(along), (s.at.w - along * Vec3::Unit(axis)).norm());
      ++rows;
    }
  return sum / rows;
}

/// Where nothing comes near, or the spin is not the body's, the flights may be those of another one.
void tellOfAnotherBody(const FitTask& task, const char* form, double landing) {
  constexpr double kFarOff = 0.05, kSpins = 5;  // [rad/s]
  if (landing > kFarOff)
    std::printf("All land %.0f %% off or more: are these flights of a %s body of %.4g kg, and in this air?\n",
                100 * landing, form, task.body.mass);
  const Vec2 turns = turning(task);
  if (!task.shape.round() && turns.y() > std::max(kSpins, turns.x()))
    std::printf("Are these its flights? In them it turns at %.0f rad/s across %s.\n", turns.y(),
                task.shape.elongated() ? "its long axis, as a flat one may that spins"
                                       : "the axis of its disc, as a long one may that spins");
}

/// The table is no recorded flight and nothing that the body is read from.
bool keepsWhatIsRead(const FitOptions& o) {
  const std::size_t colon = o.object.rfind(".evs:");
  std::vector<NamedFile> files{
      {"OBJECT", colon != std::string::npos ? o.object.substr(0, colon + 4) : o.object, false}};
  for (const std::string& flight : o.references) files.push_back({"--reference", flight, false});
  files.push_back({"--out's " + std::filesystem::path(tableFileOf(o)).filename().string(), tableFileOf(o)});
  Diagnostics findings;
  refuseSameFiles(files, findings);
  printFindings(findings);
  return !findings.hasErrors();
}

int fit(const FitOptions& o) {
  if (!keepsWhatIsRead(o)) return kBadInput;
  auto task = taskOf(o);
  if (!task) return refuse(task.error());
  const FlightShape& shape = task.value().shape;
  const char* form = shape.round() ? "round" : shape.elongated() ? "long" : "flat";
  std::printf("%s: %s, %.4g kg, %zu flight%s; the worst of them, from the cheapest model on\n",
              o.object.c_str(), form, task.value().body.mass, task.value().flights.size(),
              task.value().flights.size() == 1 ? "" : "s");
  const std::vector<FittedRung> rungs =
      fitRungs(task.value(), {o.landing / 100, o.attitude > 0 ? o.attitude : 1e9});
  printRungs(rungs, shape.round());
  const auto good = std::ranges::find_if(rungs, &FittedRung::good);
  const auto nearest = std::ranges::min_element(rungs, {}, [](const FittedRung& r) {
    return std::isfinite(r.errors.landing) ? r.errors.landing : 1e300;
  });
  const FittedRung& chosen = good != rungs.end() ? *good : *nearest;
  const std::string table = tableFileOf(o);
  if (chosen.kind == FlightKind::Table && !writeTable(chosen, shape.elongated() ? 0 : 2, table))
    return kBadInput;
  std::printf("%s\n  %s%s\n",
              good != rungs.end() ? "The cheapest within the tolerance; in the dynobject write"
                                  : "None is within the tolerance; the nearest is",
              matterText(o, shape).c_str(), attributesOf(chosen, table).c_str());
  tellOfAnotherBody(task.value(), form, chosen.errors.landing);
  if (chosen.kind == FlightKind::Table)
    std::printf("The table is in %s; it belongs beside the script, or where its models lie.\n",
                table.c_str());
  return good != rungs.end() ? kOk : kCheckFailed;
}

}  // namespace

void addFitCommand(CLI::App& app, int& code) {
  auto o = std::make_shared<FitOptions>();
  CLI::App* command = addListedCommand(app, "fit");
  CommandOptions options(*command);
  options.add("OBJECT", o->object).required();
  options.add("--reference", o->references).required();
  options.add("--within", o->landing);
  options.add("--attitude", o->attitude);
  options.add("--mass", o->mass);
  options.add("--inertia", o->inertia);
  options.add("--centre", o->centre);
  options.add("--wind", o->wind);
  options.add("--gravity", o->gravity);
  options.add("--density", o->density);
  options.add("--out", o->out);
  options.add("--asset-root", o->roots);
  addPluginOption(*command, o->plugins, o->types);
  command->footer(
      "--within is the allowed distance of the landing, in percent of the range. If a table is chosen, it is "
      "written to\nOBJECT-flight.csv in --out DIR, else in this folder.");
  command->callback([o, &code] { code = fit(*o); });
}

}  // namespace stadion
