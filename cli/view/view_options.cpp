#include "cli/view/view_options.h"

#include "cli/options/number_option.h"
#include "cli/options/run_options.h"
#include "cli/options/show_options.h"
#include "engine/plain_text/number_text.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace stadion {

void ViewOptions::addTo(CLI::App& command) {
  SessionSettings& session = run.settings;
  addShowOptions(command, session.show);
  command.get_option("--input")->description(
      "input log to replay (default: none; keyboard, mouse and gamepad stand in for the visitor)");
  command
      .add_option(
          "--windows", windows,
          "one: a window with the room unfolded, front wall in the middle; walls: a window for each wall")
      ->check(CLI::IsMember({"one", "walls"}))
      ->capture_default_str();
  command
      .add_option("--stereo", stereo,
                  "how a window shows both eyes: mono (one eye between them), side-by-side, top-bottom, "
                  "anaglyph (red-cyan "
                  "glasses), interlaced (rows), quad (where the driver has a buffer for each eye)")
      ->check(CLI::IsMember(windowStereoNames()))
      ->capture_default_str();
  command.add_option("--window", window, "WIDTHxHEIGHT of the window at the start")->capture_default_str();
  command.add_flag("--hud", settings.hud, "begin with the frame budget shown (F2)");
  command.add_option("--shots", settings.shots, "folder for screenshots (F12)")->capture_default_str();
  command.add_option(
      "--record-input", session.record.input,
      "write what head, wand and joypad did to this input log; run and hash --input FILE come to "
      "the same state. The log ends where the script is read again");
  addOperatorOptions(command, run);
  addLoadOptions(command, run);
  addBlackBoxOption(command, session.record);
  command
      .add_option(
          "--gl", provider,
          "the driver that draws the walls: osmesa (software), egl, or auto: egl on an accelerated display")
      ->check(CLI::IsMember({"auto", "osmesa", "egl"}))
      ->capture_default_str();
  std::string keys = "Keys and mouse:\n";
  for (const std::string& line : viewKeys()) keys += "  " + line + "\n";
  command.footer(keys +
                 "\nKeyboard, mouse and gamepad stand in for head, wand and joypad, unless --input FILE "
                 "plays a recorded\nvisitor. A changed script or sub-scene is read again at once: the "
                 "visitor stays where he is, the show begins\nanew, with the same sub-scenes loaded. While "
                 "the script has errors the old show goes on.\nExample:  ./stadion view scripts/kick.evs");
}

bool ViewOptions::settle(Diagnostics& findings) {
  SessionSettings& session = settings.session = run.settings;
  settings.stereo = *windowStereo(stereo);
  session.draw.layout = settings.stereo == WindowStereo::Mono ? StereoLayout::Off : StereoLayout::Pair;
  session.play.windows = true;
  session.play.drawBeginsEarly = run.cullDraw == "overlap";
  settings.oneWindow = windows == "one";
  if (provider != "auto")
    settings.provider = provider == "egl" ? GlProviderKind::Egl : GlProviderKind::OsMesa;
  const auto sides = parseSize(window);
  const auto fits = [](std::uint32_t side) { return side >= 64 && side <= 16384; };
  if (sides && fits(sides->first) && fits(sides->second))
    settings.width = sides->first, settings.height = sides->second;
  else
    findings.error({},
                   fmt::format("--window: \"{}\" is not WIDTHxHEIGHT in pixels from 64x64 to 16384x16384, "
                               "such as 1200x800",
                               window));
  if (session.show.input.empty())
    session.show.input = "none";  // the viewer is the visitor, not the log beside the script
  run.settings.show.input = session.show.input;
  run.settleFiles(findings);
  return session.show.settle(findings) && !findings.hasErrors();
}

}  // namespace stadion
