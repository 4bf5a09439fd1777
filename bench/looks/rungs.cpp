#include "bench/looks/rungs.h"

namespace stadion::bench {

std::span<const NamedRung> allRungs() {
  static constexpr NamedRung kRungs[] = {{"8", PictureRung{.samples = 8}},
                                         {"4", PictureRung{}},
                                         {"4-nearest", PictureRung{.nearestLevel = true}},
                                         {"4-coarse", PictureRung{.coarse = true}},
                                         {"2", PictureRung{.samples = 2}},
                                         {"1", PictureRung{.samples = 1}},
                                         {"plain", PictureRung{.look = Look::Plain}},
                                         {"opengl"}};
  return kRungs;
}

}  // namespace stadion::bench
