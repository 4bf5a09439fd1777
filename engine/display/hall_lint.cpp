#include "engine/display/wall_lint.h"

#include "engine/display/covered_rectangle.h"
#include "engine/display/screen_coverage.h"
#include "engine/loudspeakers/loudspeaker_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace stadion {
namespace {

constexpr int kLookedAt = 48;  ///< pixels of an output, across and down, that are followed to the screen

class HallLinter {
public:
  HallLinter(const WallFile& hall, Diagnostics& out) : hall_(hall), out_(out) {}

  void run() {
    for (std::size_t i = 0; i < hall_.screens.size(); ++i) {
      const Screen& screen = hall_.screens[i];
      if (!isComplete(screen)) continue;
      visitor(screen);
      const std::vector<const WallEntry*> projectors = projectorsOf(i);
      if (projectors.empty()) {
        warning(screen, fmt::format("no projector lights screen \"{}\"; add one, or leave the screen out",
                                    screen.name));
        continue;
      }
      whites(screen, projectors);
      coverage(screen, projectors);
    }
  }

private:
  void warning(const Screen& s, std::string message) {
    out_.warning({hall_.file, s.line, s.column}, std::move(message), s.excerpt);
  }

  std::vector<const WallEntry*> projectorsOf(std::size_t screen) const {
    std::vector<const WallEntry*> all;
    for (const WallEntry& e : hall_.walls)
      if (e.projector && e.projector->screen == screen) all.push_back(&e);
    return all;
  }

  std::string inUnit(const Vec3& p) const {
    const auto number = [&](double metres) {
      const double rounded = std::round(metres / hall_.metresPerUnit * 1e3) / 1e3;
      return rounded == 0 ? 0.0 : rounded;
    };
    return fmt::format("{} {} {}", number(p.x()), number(p.y()), number(p.z()));
  }

  void visitor(const Screen& screen) {
    const Vec3& eye = hall_.visitor.eye;
    const char* where = nullptr;
    if (const auto* wall = std::get_if<Wall>(&screen.surface)) {
      if (basis(*wall).normal.dot(eye - wall->lowerLeft) < kMinEyeDistance) where = "behind";
    } else if (const auto* cylinder = std::get_if<CylinderScreen>(&screen.surface)) {
      if ((eye - cylinder->centre).head<2>().norm() >= cylinder->radius) where = "outside of";
    } else if (const auto* sphere = std::get_if<SphereScreen>(&screen.surface)) {
      if ((eye - sphere->centre).norm() >= sphere->radius) where = "outside of";
    }
    if (where)
      warning(screen,
              fmt::format("the visitor's eye at {} is {} screen \"{}\"; move the screen, or state the "
                          "place of the eye with: visitor X Y Z",
                          inUnit(eye), where, screen.name));
  }

  void whites(const Screen& screen, const std::vector<const WallEntry*>& projectors) {
    for (const WallEntry* e : projectors)
      if (e->projector->light.white != projectors[0]->projector->light.white) {
        warning(screen,
                fmt::format("the projectors \"{}\" and \"{}\" of screen \"{}\" have different whites; "
                            "the darkest white of each channel counts for all",
                            projectors[0]->wall.name, e->wall.name, screen.name));
        return;
      }
  }

  static bool serves(const WallEntry& e, Eye eye) { return !e.projector->eye || *e.projector->eye == eye; }

  void coverage(const Screen& screen, const std::vector<const WallEntry*>& projectors) {
    const ScreenSurface surface(screen);
    const std::vector<Vec3> samples = samplesOf(screen);
    std::array<std::vector<bool>, kEyes.size()> lit;
    lit.fill(std::vector<bool>(samples.size()));
    std::array<bool, kEyes.size()> served{};
    bool whole = true;
    for (const WallEntry* e : projectors) {
      for (const Eye eye : kEyes) served[static_cast<std::size_t>(eye)] |= serves(*e, eye);
      if (!isComplete(*e->projector)) {
        whole = false;
        continue;
      }
      const LightTest test(*e->projector, surface);
      bool any = false;
      for (std::size_t i = 0; i < samples.size(); ++i) {
        if (!test.lights(samples[i])) continue;
        any = true;
        for (const Eye eye : kEyes)
          if (serves(*e, eye)) lit[static_cast<std::size_t>(eye)][i] = true;
      }
      if (!any && !anyPixelLights(*e, surface)) lightsNothing(*e, screen);
    }
    if (!served[0] || !served[1]) return oneEye(screen, served[0] ? Eye::Left : Eye::Right);
    if (whole) dark(screen, samples, lit);
  }

  static bool anyPixelLights(const WallEntry& e, const ScreenSurface& surface) {
    const PixelRays rays(*e.projector, surface);
    for (int row = 0; row <= kLookedAt; ++row)
      for (int column = 0; column <= kLookedAt; ++column)
        if (rays.pointLit(Vec2(column, row) / kLookedAt)) return true;
    return false;
  }

  void lightsNothing(const WallEntry& e, const Screen& screen) {
    const char* mend = std::holds_alternative<MeasuredImage>(e.projector->image)
                           ? "measure its warp again"
                           : "check its place, where it looks, and the unit of the file";
    out_.error(
        {hall_.file, e.line, e.column},
        fmt::format("projector \"{}\" lights no point of screen \"{}\"; {}", e.wall.name, screen.name, mend),
        e.excerpt);
  }

  void oneEye(const Screen& screen, Eye served) {
    const char* other = eyeName(served == Eye::Left ? Eye::Right : Eye::Left);
    warning(screen,
            fmt::format("screen \"{}\" has projectors for the {} eye only; add projectors with eye {}, "
                        "or leave eye out",
                        screen.name, eyeName(served), other));
  }

  void dark(const Screen& screen, const std::vector<Vec3>& samples,
            const std::array<std::vector<bool>, kEyes.size()>& lit) {
    const bool alike = lit[0] == lit[1];
    for (const Eye eye : kEyes) {
      const std::vector<bool>& here = lit[static_cast<std::size_t>(eye)];
      const auto count = std::ranges::count(here, false);
      if (count > 0) {
        const auto first = static_cast<std::size_t>(std::ranges::find(here, false) - here.begin());
        warning(screen,
                fmt::format("no projector{} lights {:.1f} % of screen \"{}\", for example the point {}",
                            alike ? std::string() : fmt::format(" for the {} eye", eyeName(eye)),
                            100.0 * static_cast<double>(count) / static_cast<double>(here.size()),
                            screen.name, inUnit(samples[first])));
      }
      if (alike) return;
    }
  }

  const WallFile& hall_;
  Diagnostics& out_;
};

}  // namespace

void lintHall(const WallFile& hall, Diagnostics& out) {
  HallLinter(hall, out).run();
  lintLoudspeakers(hall.loudspeakers, hall.file, out);
}

}  // namespace stadion
