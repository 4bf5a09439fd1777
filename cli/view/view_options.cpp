#include "cli/view/view_options.h"

#include "cli/options/command_options.h"
#include "cli/options/run_options.h"
#include "cli/options/show_options.h"
#include "engine/plain_text/number_text.h"

#include <CLI/CLI.hpp>

#include <tuple>

namespace stadion {

void ViewOptions::addTo(CLI::App& command) {
  SessionSettings& session = run.settings;
  addShowOptions(command, session.show);
  CommandOptions options(command);
  options.add("--windows", windows);
  options.add("--stereo", stereo);
  options.add("--window", window, {.least = 64});
  options.add("--hud", settings.hud);
  options.add("--out", settings.shots);
  options.add("--record-input", session.record.input);
  addOperatorOptions(command, run);
  addLoadOptions(command, run);
  addBlackBoxOption(command, session.record);
  addGuardOption(command, session.play.guard);
  renderer.addTo(command);
  std::string keys = "Keys and mouse:\n";
  for (const std::string& line : viewKeys()) keys += "  " + line + "\n";
  command.footer(
      keys + "\n--out DIR receives screenshots (F12). --stereo pair needs a driver with a buffer for each "
             "eye.\n\nKeyboard, mouse and gamepad stand in for head, wand and joypad, unless --input FILE "
             "plays a recorded\nvisitor. A changed script, sub-scene or model is read again at once: "
             "the visitor stays where he is, the show\nrestarts, with the same sub-scenes loaded. While "
             "the script has errors the old show goes on.\n\nA model file in place of SHOW is shown alone, "
             "in its true "
             "size, before the visitor.\nExamples:  ./stadion view scripts/kick.evs\n           ./stadion "
             "view assets/discus.glb");
}

bool ViewOptions::complete(Diagnostics& findings) {
  SessionSettings& session = settings.session = run.settings;
  settings.stereo = windowStereo(*stereoLayout(stereo));
  session.draw.layout = settings.stereo == WindowStereo::Mono ? StereoLayout::Off : StereoLayout::Pair;
  session.play.windows = true;
  session.play.drawBeginsEarly = run.cullDraw == "overlap";
  settings.oneWindow = windows == "one";
  session.draw.renderer = renderer.settings(findings);
  std::tie(settings.width, settings.height) = *parseSize(window);
  if (session.show.input.empty())
    session.show.input = "none";  // the viewer is the visitor, not the log beside the script
  run.settings.show.input = session.show.input;
  run.completeFiles(findings);
  return session.show.complete(findings) && !findings.hasErrors();
}

}  // namespace stadion
