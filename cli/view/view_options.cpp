#include "cli/view/view_options.h"

#include "cli/options/number_option.h"
#include "cli/options/run_options.h"
#include "cli/options/show_options.h"
#include "engine/base/number_text.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace stadion {

std::vector<std::string> viewKeys() {
  return {"F1 H      this help",
          "F2        frame budget: what App, Cull and Draw cost",
          "W S A D   the joypad: forward, back, turn left, right (the show needs a navigator)",
          "arrows    step about in the room; page up, page down: up, down",
          "mouse     move: look about.  Drag: move the hand; with shift: forward and back",
          "wheel     the hand nearer, farther",
          "buttons   left, right, middle: the wand's buttons 1, 2, 3",
          "1 2 3 4   the wand's buttons, too.  Home: stand in the middle again",
          "gamepad   left stick: joypad.  Right stick: look.  A B X Y: buttons 1 to 4",
          "space P   pause, go on.  Enter: start, with --wait",
          ".         a single frame",
          "[ ]       slower, as fast as the clock.  With shift: eyes closer, wider",
          "N         next group: the show from its start",
          "B X F     black walls; swap eyes; freeze the head",
          "- +       the sounds' volume",
          "O         the room from outside; drag with the right button turns it, the wheel goes nearer",
          "F5        read the script again (so does saving it)",
          "F12       screenshot: the window and every wall's pictures",
          "Esc Q     quit"};
}

void ViewOptions::addTo(CLI::App& command) {
  addShowOptions(command, run.show);
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
  command.add_flag("--hud", hud, "begin with the frame budget shown (F2)");
  command.add_option("--shots", shots, "folder for screenshots (F12)")->capture_default_str();
  command.add_option(
      "--record-input", run.recordInput,
      "write what head, wand and joypad did to this input log; run and hash --input FILE come to "
      "the same state. The log ends where the script is read again");
  addOperatorOptions(command, run);
  addLoadOptions(command, run);
  addBlackBoxOption(command, run);
  command
      .add_option(
          "--gl", provider,
          "who draws the walls: osmesa (software), egl, or auto: egl where the display is accelerated")
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
  windowStereo = *stadion::windowStereo(stereo);
  run.layout = windowStereo == WindowStereo::Mono ? StereoLayout::Off : StereoLayout::Pair;
  run.stereo = stereoLayoutName(run.layout);
  run.live = true;
  const auto sides = parseSize(window);
  const auto fits = [](std::uint32_t side) { return side >= 64 && side <= 16384; };
  if (sides && fits(sides->first) && fits(sides->second))
    width = sides->first, height = sides->second;
  else
    findings.error({},
                   fmt::format("--window: \"{}\" is not WIDTHxHEIGHT in pixels from 64x64 to 16384x16384, "
                               "such as 1200x800",
                               window));
  if (run.show.input.empty()) run.show.input = "none";  // who looks on is the visitor, not the log beside it
  run.settleFiles(findings);
  return run.show.settle(findings) && !findings.hasErrors();
}

}  // namespace stadion
