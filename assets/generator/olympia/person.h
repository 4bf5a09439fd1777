#pragma once
/// A figure of few triangles, to be seen from some distance: it stands or sits on the origin and looks +Y.

#include "assets/generator/craft/part.h"

namespace stadion::assets {

enum class Detail { Far, Middle, Near };

struct Person {
  bool standing = false, hat = false, beard = false;
  int raised = 0;  ///< number of raised arms
  Rgb cloth, skin, hair;
  double turn = 0;  ///< 0 to 1, varies between figures
};

/// Returns a random person.
Person somebody(Dice& dice, bool standing);

Part figure(const Person& person, Detail detail);

}  // namespace stadion::assets
