/// `stadion doctor`: what this machine lacks for shows, and the commands that mend it.

#include "show/doctor/doctor.h"
#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/options/command_options.h"
#include "cli/terminal.h"
#include "show/doctor/doctor_needs.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

namespace stadion {
namespace {

struct DoctorOptions {
  std::vector<std::string> wanted;
  bool json = false;
};

int examineMachine(const DoctorOptions& o) {
  Diagnostics findings;
  const auto wanted = MachineNeeds::read(o.wanted, findings);
  printFindings(findings);
  if (!wanted) return kBadInput;
  if (const auto lack = lackOfAddressSpace()) return printError(*lack, kBadInput);
  const std::vector<DoctorFinding> found = examine(probesOfThisMachine(), wanted->needs());
  std::fputs((o.json ? toJson(found) : toText(found)).c_str(), stdout);
  return canWork(found) ? kOk : kCheckFailed;
}

constexpr const char* kDoctorFooter =
    R"(Each line says whether a topic works, is limited, or is missing; below it, what cannot work without it (so:) and a
command that mends it (do:). Nothing is changed. Topics:

  programs      stadion-import and stadion-wall       drawing   the software rasteriser
  gpu           a graphics processor for EGL          displays  a window system, its monitors
  swap-groups   of the display driver                 sound     an output
  quad-buffer   a back buffer for each eye
  video         ffmpeg                                measuring valgrind
  realtime      the right to real-time priority       network   interfaces for clusters and trackers
  clock         a clock that is read quickly
  measurements  stadion-measure and stadion-bench
  tests, peers, fuzzing  the Debian packages of ./stadion test, setup peers and fuzz

--for WHAT asks whether something can work here. Exit code 0: it can; 1: it cannot.

  SHOW.evs      programs, drawing, and sound if the show has sounds
  FILE.walls    programs, drawing, displays, and the monitors and X screens that the file names;
                also the name of a room, such as cave4
  FILE.cluster  programs, network, and the interface that the file names
  cluster       programs, network
  a topic       that topic

  ./stadion doctor
  ./stadion doctor --for walls/cave4.walls --for sound
  ./stadion doctor --for hall.cluster --json)";

}  // namespace

void addDoctorCommand(CLI::App& app, int& code) {
  auto o = std::make_shared<DoctorOptions>();
  CLI::App* command =
      app.add_subcommand("doctor", "Say what this machine lacks for shows, with the commands that mend it");
  CommandOptions options(*command);
  options.add("--for", o->wanted);
  options.add("--json", o->json);
  command->footer(kDoctorFooter);
  command->callback([o, &code] { code = examineMachine(*o); });
}

}  // namespace stadion
