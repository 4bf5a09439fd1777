#include "engine/loudspeakers/loudspeaker_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace stadion {
namespace {

constexpr double kLargestHall = 50;         ///< distance of a believable loudspeaker [m]
constexpr double kSameDirection = 0.99996;  ///< cosine of half a degree
constexpr double kInFront = 0.1;            ///< how far before the ears counts as before them [m]

class LoudspeakerLinter {
public:
  LoudspeakerLinter(const LoudspeakerSet& hall, const std::string& file, Diagnostics& out)
      : hall_(hall), file_(file), out_(out) {}

  void run() {
    bool sound = true;
    for (std::size_t i = 0; i < hall_.all.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) sound = pair(hall_.all[i], hall_.all[j]) && sound;
    for (const Loudspeaker& s : hall_.all) distance(s);
    if (sound) whole();
  }

private:
  SourcePosition placeOf(const Loudspeaker& s) const { return {file_, s.line, s.column}; }
  Vec3 from(const Loudspeaker& s) const { return s.place - hall_.ear; }

  bool pair(const Loudspeaker& s, const Loudspeaker& before) {
    if (s.channel == before.channel) {
      out_.error(
          placeOf(s),
          fmt::format("loudspeakers \"{}\" and \"{}\" have the same channel {}; give one of them another, "
                      "with: channel N",
                      before.name, s.name, s.channel + 1),
          s.excerpt);
      return false;
    }
    if (s.isSubwoofer() || before.isSubwoofer()) return true;  // they have no direction
    const double both = from(s).norm() * from(before).norm();
    if (both > 0 && from(s).dot(from(before)) < kSameDirection * both) return true;
    out_.error(
        placeOf(s),
        fmt::format("loudspeakers \"{}\" and \"{}\" are in the same direction from the visitor; leave one "
                    "out, or measure again",
                    before.name, s.name),
        s.excerpt);
    return false;
  }

  void distance(const Loudspeaker& s) {
    const double d = from(s).norm();
    if (d > kLargestHall)
      out_.warning(
          placeOf(s),
          fmt::format("loudspeaker \"{}\" is {:.0f} m away from the visitor; check the unit of the file",
                      s.name, d),
          s.excerpt);
    else if (!s.isSubwoofer() && d < hall_.reach)
      out_.warning(
          placeOf(s),
          fmt::format("loudspeaker \"{}\" is {:.2f} m away from a visitor that moves by up to {:g} m: its "
                      "direction changes much; move it, or correct: visitor X Y Z within R",
                      s.name, d, hall_.reach),
          s.excerpt);
  }

  void whole() {
    std::vector<const Loudspeaker*> wide;
    for (const Loudspeaker& s : hall_.all)
      if (!s.isSubwoofer()) wide.push_back(&s);
    if (hall_.all.empty()) return;
    const Loudspeaker& first = hall_.all.front();
    if (wide.empty())
      return out_.error(placeOf(first),
                        "there are only subwoofers; add a loudspeaker for what is above their frequency",
                        first.excerpt);
    if (wide.size() > 1 &&
        std::ranges::none_of(wide, [&](const Loudspeaker* s) { return from(*s).y() > kInFront; }))
      out_.warning(placeOf(*wide.front()),
                   "all loudspeakers are behind the visitor or beside; +Y is forward: check their places",
                   wide.front()->excerpt);
  }

  const LoudspeakerSet& hall_;
  const std::string& file_;
  Diagnostics& out_;
};

}  // namespace

void lintLoudspeakers(const LoudspeakerSet& hall, const std::string& file, Diagnostics& out) {
  LoudspeakerLinter(hall, file, out).run();
}

}  // namespace stadion
