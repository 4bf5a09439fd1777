#include "show/view/view_settings.h"

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
          "B T X F   black walls; test pattern; swap eyes; freeze the head",
          "- +       the sounds' volume",
          "O         the room from outside; drag with the right button turns it, the wheel goes nearer",
          "F5        read the script again (so does saving it)",
          "F12       screenshot: the window and every wall's pictures",
          "Esc Q     quit"};
}

}  // namespace stadion
