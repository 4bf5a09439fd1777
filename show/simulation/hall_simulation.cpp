#include "show/simulation/hall_simulation.h"

#include "engine/maths/angles.h"
#include "engine/maths/eigen.h"
#include "engine/maths/functions.h"
#include "engine/maths/srgb.h"
#include "show/simulation/simulated_hall.h"
#include "show/simulation/structured_light.h"

#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace stadion {
namespace {

constexpr double kPixelsATurn = 32;
constexpr double kCoarse = 0.4;  ///< turns for each unit of a direction: no two are alike
constexpr double kWeak = 0.2;    ///< darker pixels are too coarse to tell directions
constexpr std::size_t kScreenPoints = 20000;
constexpr double kUnlit = 0.5;      ///< a place with less of the white is uncovered
constexpr double kTooBright = 1.5;  ///< a place with more of the white is not blended
constexpr double kLevels[] = {0.05, 0.2, 0.5, 0.8, 1};

/// The pictures of all entries for both eyes.
class HallLight {
public:
  HallLight(const SimulatedHall& hall, std::size_t entries) : hall_(hall), pictures_(entries) {}

  void draw(PictureSource& source, const Pose& X_RH, const PictureSource::Painter& paint) {
    for (std::size_t i = 0; i < pictures_.size(); ++i)
      if (hall_.file().walls[i].projector) pictures_[i] = source.draw(i, X_RH, paint);
  }
  void drawOne(PictureSource& source, std::size_t entry, const Pose& X_RH,
               const PictureSource::Painter& paint) {
    pictures_[entry] = source.draw(entry, X_RH, paint);
  }

  const Picture& picture(std::size_t entry, Eye eye) const {
    const auto& own = pictures_[entry];
    return own.size() > 1 ? own[static_cast<std::size_t>(eye)] : own.front();
  }

  Vec3 pixel(std::size_t entry, Eye eye, std::uint32_t x, std::uint32_t y) const {
    const std::uint8_t* v = picture(entry, eye).at(x, y);
    const SimulatedProjector& p = hall_.projector(entry);
    return {p.light(v[0], 0), p.light(v[1], 1), p.light(v[2], 2)};
  }

  /// Light between pixels.
  Vec3 between(const LightFrom& from, Eye eye) const {
    const SimulatedProjector& p = hall_.projector(from.entry);
    const double x = std::clamp(from.x - 0.5, 0.0, p.width() - 1.0);
    const double y = std::clamp(from.y - 0.5, 0.0, p.height() - 1.0);
    const auto left = static_cast<std::uint32_t>(x), top = static_cast<std::uint32_t>(y);
    const std::uint32_t right = std::min(left + 1, p.width() - 1), bottom = std::min(top + 1, p.height() - 1);
    const double s = x - left, t = y - top;
    return (1 - t) * ((1 - s) * pixel(from.entry, eye, left, top) + s * pixel(from.entry, eye, right, top)) +
           t * ((1 - s) * pixel(from.entry, eye, left, bottom) + s * pixel(from.entry, eye, right, bottom));
  }

  /// What rounding to 8 bits may change at most, of the channel for which that is most [share of white].
  double step(std::size_t entry, Eye eye, std::uint32_t x, std::uint32_t y) const {
    const std::uint8_t* v = picture(entry, eye).at(x, y);
    const SimulatedProjector& p = hall_.projector(entry);
    double most = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto up = static_cast<std::uint8_t>(std::min(v[c] + 1, 255)),
                 down = static_cast<std::uint8_t>(std::max(v[c] - 1, 0));
      most = std::max(most, (p.light(up, c) - p.light(down, c)) / (2.0 * (up - down)) /
                                hall_.white()[static_cast<int>(c)]);
    }
    return most;
  }

private:
  const SimulatedHall& hall_;
  std::vector<std::vector<Picture>> pictures_;
};

class Simulation {
public:
  Simulation(const WallFile& hall, PictureSource& source, const SimulationSettings& settings)
      : settings_(settings), source_(source), hall_(hall, settings.every), light_(hall_, hall.walls.size()) {
    result_.every = settings.every;
    seenErrors_.resize(hall_.looked().size());
    for (const LookedAtProjector& p : hall_.looked())
      result_.projectors.emplace_back().name = hall.walls[p.entry].wall.name;
  }

  SimulationResult run() {
    const WallFile& file = hall_.file();
    const auto heads = headsOf(file.visitor, file.eyeSeparation, settings_.heads);
    for (std::size_t h = 0; h < heads.size(); ++h) {
      for (const double level : kLevels) {
        report(fmt::format("head {} of {}: light of {:.0f} %", h + 1, heads.size(), level * 100));
        luminance(heads[h], level);
        if (h == 0 && level == 1) coverage();
      }
      for (std::size_t i = 0; i < hall_.looked().size(); ++i) {
        report(fmt::format("head {} of {}: directions of \"{}\"", h + 1, heads.size(),
                           result_.projectors[i].name));
        geometry(heads[h], i);
      }
      if (h == 0 && settings_.seen) showPixels(heads[h]);
    }
    result_.heads = heads.size();
    for (auto& [pair, seam] : seams_) result_.seams.push_back(std::move(seam));
    accuse();
    return std::move(result_);
  }

private:
  void report(const std::string& line) const {
    if (settings_.progress) settings_.progress(line);
  }

  SeamFigures& seam(std::size_t a, std::size_t b) {
    const auto pair = std::minmax(a, b);
    SeamFigures& s = seams_[pair];
    if (s.one.empty()) {
      s.one = hall_.file().walls[pair.first].wall.name;
      s.two = hall_.file().walls[pair.second].wall.name;
    }
    return s;
  }

  Vec3 eyeAt(const Pose& X_RH, Eye eye) const { return eyePosition(X_RH, eye, hall_.file().eyeSeparation); }

  // Luminance.

  void luminance(const Pose& X_RH, double level) {
    const auto value = static_cast<std::uint8_t>(std::lround(255 * srgbFromLinear(level)));
    const double painted = linearFromSrgb(value / 255.0);
    light_.draw(source_, X_RH, [&](const SourceView&, Picture& picture) {
      std::ranges::fill(picture.rgba, value);
      for (std::size_t i = 3; i < picture.rgba.size(); i += 4) picture.rgba[i] = 255;
    });
    const Vec3 black = Vec3::Constant(hall_.black()), ideal = black + (hall_.white() - black) * painted;
    for (std::size_t i = 0; i < hall_.looked().size(); ++i)
      for (const Eye eye : kEyes) {
        if (!hall_.serves(hall_.looked()[i].entry, eye)) continue;
        for (const LookedAtPixel& pixel : hall_.looked()[i].pixels)
          if (pixel.whole) luminanceAt(i, pixel, eye, ideal);
      }
  }

  void luminanceAt(std::size_t i, const LookedAtPixel& pixel, Eye eye, const Vec3& ideal) {
    const LookedAtProjector& own = hall_.looked()[i];
    Vec3 sum = Vec3::Zero();
    double steps = light_.step(own.entry, eye, pixel.x, pixel.y);
    for (std::uint32_t cell = 0; cell < 9; ++cell) {
      sum += light_.pixel(own.entry, eye, pixel.x + cell % 3 - 1, pixel.y + cell / 3 - 1);
      for (std::uint32_t k = pixel.first[cell]; k < pixel.first[cell + 1]; ++k) {
        const LightFrom& from = own.others[k];
        if (!hall_.serves(from.entry, eye)) continue;
        sum += light_.between(from, eye);
        if (cell == 4)
          steps += light_.step(
              from.entry, eye,
              std::min(static_cast<std::uint32_t>(from.x), hall_.projector(from.entry).width() - 1),
              std::min(static_cast<std::uint32_t>(from.y), hall_.projector(from.entry).height() - 1));
      }
    }
    const double error = (sum / 9 - ideal).cwiseQuotient(hall_.white()).cwiseAbs().maxCoeff();
    ProjectorFigures& figures = result_.projectors[i];
    if (error > figures.luminance.most) figures.steps = steps;
    figures.luminance.add(error);
    if (pixel.first[0] == pixel.first[9]) figures.alone.add(error);
    for (std::uint32_t k = pixel.first[4]; k < pixel.first[5]; ++k)
      if (hall_.serves(own.others[k].entry, eye)) seam(own.entry, own.others[k].entry).luminance.add(error);
  }

  void coverage() {
    const WallFile& file = hall_.file();
    for (std::size_t s = 0; s < file.screens.size(); ++s) {
      const auto points = hall_.screen(s).points(kScreenPoints);
      for (const Eye eye : kEyes) {
        bool served = false;
        for (const LookedAtProjector& p : hall_.looked())
          served |= file.walls[p.entry].projector->screen == s && hall_.serves(p.entry, eye);
        if (!served) continue;
        for (const Vec3& point : points) {
          Vec3 sum = Vec3::Zero();
          for (const LightFrom& from : hall_.lightAt(s, point, eye)) sum += light_.between(from, eye);
          const double share = sum.cwiseQuotient(hall_.white()).mean();
          ++result_.screenPoints;
          result_.uncovered += share < kUnlit ? 1 : 0;
          result_.tooBright += share > kTooBright ? 1 : 0;
        }
      }
    }
  }

  // Geometry.

  struct Steps {
    Vec3 direction;
    Eigen::Matrix<double, 3, 2> pixel;  ///< change of the direction by one pixel to the right and down
    double size() const { return std::sqrt(pixel.col(0).cross(pixel.col(1)).norm()); }
  };

  static Steps stepsAt(const LookedAtPixel& pixel, const Vec3& eye) {
    Steps s;
    s.direction = (pixel.point - eye).normalized();
    s.pixel.col(0) = (pixel.right - eye).normalized() - s.direction;
    s.pixel.col(1) = (pixel.below - eye).normalized() - s.direction;
    return s;
  }

  double frequencyFor(const LookedAtProjector& p, const Vec3& eye) const {
    std::vector<double> sizes;
    for (const LookedAtPixel& pixel : p.pixels) sizes.push_back(stepsAt(pixel, eye).size());
    if (sizes.empty()) return 1;
    std::ranges::nth_element(sizes, sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2));
    return 1 / (kPixelsATurn * std::max(1e-9, sizes[sizes.size() / 2]));
  }

  void geometry(const Pose& X_RH, std::size_t i) {
    const LookedAtProjector& p = hall_.looked()[i];
    const double fine = frequencyFor(p, X_RH.p);
    std::array<std::vector<Vec3>, kEyes.size()> errors, coarse;
    std::array<std::vector<double>, kEyes.size()> gains;
    for (const Eye eye : kEyes) {
      const auto e = static_cast<std::size_t>(eye);
      errors[e].resize(p.pixels.size());
      coarse[e].resize(p.pixels.size());
      gains[e].assign(p.pixels.size(), HUGE_VAL);
    }
    for (const bool isFine : {false, true})
      for (int axis = 0; axis < 3; ++axis) {
        const DirectionWave wave(colours_, axis, isFine ? fine : kCoarse);
        light_.drawOne(source_, p.entry, X_RH,
                       [&](const SourceView& v, Picture& picture) { wave.paint(v, picture); });
        for (const Eye eye : kEyes) {
          if (!hall_.serves(p.entry, eye)) continue;
          const auto e = static_cast<std::size_t>(eye);
          const Vec3 from = eyeAt(X_RH, eye);
          for (std::size_t k = 0; k < p.pixels.size(); ++k) {
            const LookedAtPixel& pixel = p.pixels[k];
            const auto read =
                wave.read(light_.pixel(p.entry, eye, pixel.x, pixel.y).cwiseQuotient(hall_.white()),
                          (pixel.point - from).normalized());
            (isFine ? errors : coarse)[e][k][axis] = read.error;
            gains[e][k] = std::min(gains[e][k], read.gain);
          }
        }
      }
    for (const Eye eye : kEyes) {
      if (!hall_.serves(p.entry, eye)) continue;
      const auto e = static_cast<std::size_t>(eye);
      const bool shown = eye == shownEye(p.entry);
      if (shown) seenErrors_[i].assign(p.pixels.size(), -1);
      for (std::size_t k = 0; k < p.pixels.size(); ++k) {
        const double found =
            geometryAt(i, p.pixels[k], eyeAt(X_RH, eye), errors[e][k], coarse[e][k], gains[e][k], fine);
        if (shown) seenErrors_[i][k] = found;
      }
    }
  }

  /// Returns the error [pixels]; negative: too dark to tell.
  double geometryAt(std::size_t i, const LookedAtPixel& pixel, const Vec3& eye, Vec3 error,
                    const Vec3& coarse, double gain, double fine) {
    ProjectorFigures& figures = result_.projectors[i];
    const Steps steps = stepsAt(pixel, eye);
    figures.sparseness.add(steps.size() / kDegree);
    if (gain < kWeak) return -1;
    // Beyond half a turn the fine wave is ambiguous; the coarse one is not, and less exact.
    if (coarse.cwiseAbs().maxCoeff() > 0.5 / fine + 0.004 / gain) {
      ++figures.lost;
      error = coarse;
    }
    const Eigen::Matrix2d square = steps.pixel.transpose() * steps.pixel;
    const Vec2 places = square.inverse() * (steps.pixel.transpose() * error);
    if (!places.allFinite()) return -1;
    figures.geometry.add(places.norm());
    const LookedAtProjector& p = hall_.looked()[i];
    for (std::uint32_t k = pixel.first[4]; k < pixel.first[5]; ++k)
      seam(p.entry, p.others[k].entry).geometry.add(places.norm());
    return places.norm();
  }

  // Pictures.

  /// Lines every ten degrees on colours that change with the azimuth.
  static void paintGrid(const SourceView& view, Picture& picture) {
    forEachDirection(
        view, picture.width, picture.height, [&](std::uint32_t x, std::uint32_t y, const Vec3& d) {
          const double azimuth = det::atan2(d.x(), d.y()) / kDegree, elevation = det::asin(d.z()) / kDegree;
          const auto line = [](double degrees) { return std::fabs(std::remainder(degrees, 10)) < 0.25; };
          const bool on = line(azimuth) || line(elevation);
          std::uint8_t* pixel = picture.at(x, y);
          for (int c = 0; c < 3; ++c)
            pixel[c] =
                on ? 255 : static_cast<std::uint8_t>(110 + 60 * det::cos((azimuth + 120 * c) * kDegree));
          pixel[3] = 255;
        });
  }

  Eye shownEye(std::size_t entry) const { return hall_.serves(entry, Eye::Left) ? Eye::Left : Eye::Right; }

  void showPixels(const Pose& X_RH) {
    light_.draw(source_, X_RH, paintGrid);
    for (std::size_t i = 0; i < hall_.looked().size(); ++i) {
      const LookedAtProjector& p = hall_.looked()[i];
      const Eye eye = shownEye(p.entry);
      for (std::size_t k = 0; k < p.pixels.size(); ++k) {
        const LookedAtPixel& pixel = p.pixels[k];
        Vec3 sum = light_.pixel(p.entry, eye, pixel.x, pixel.y);
        for (std::uint32_t o = pixel.first[4]; o < pixel.first[5]; ++o)
          if (hall_.serves(p.others[o].entry, eye)) sum += light_.between(p.others[o], eye);
        settings_.seen({i, pixel.point, (pixel.point - eyeAt(X_RH, eye)).normalized(),
                        sum.cwiseQuotient(hall_.white()), seenErrors_[i][k]});
      }
    }
  }

  // The suspect.

  /// Returns the number of the projector with the largest figure if it is far above the others.
  template <class Figure>
  std::optional<std::size_t> outlier(const Figure& figure, double least) const {
    std::vector<double> all;
    for (const ProjectorFigures& p : result_.projectors) all.push_back(figure(p));
    if (all.empty()) return std::nullopt;
    const auto worst = static_cast<std::size_t>(std::ranges::max_element(all) - all.begin());
    std::vector<double> rest = all;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(worst));
    std::ranges::sort(rest);
    const double usual = rest.empty() ? 0 : rest[rest.size() / 2];
    return all[worst] > least && all[worst] > 3 * usual ? std::optional(worst) : std::nullopt;
  }

  void accuse() {
    const auto named = [&](std::optional<std::size_t> at, const std::string& reason) {
      if (!at) return false;
      result_.suspect = result_.projectors[*at].name;
      result_.reason = reason;
      return true;
    };
    const char* const curve = "its light does not follow the curve that the wall file states";
    // A wrong curve changes the colours that tell directions, and a wrong place does not change light where no
    // other projector reaches. So that light is looked at first.
    if (named(outlier([](const ProjectorFigures& p) { return p.alone.mean(); }, 0.01), curve)) return;
    if (named(outlier([](const ProjectorFigures& p) { return p.geometry.mean(); }, 0.3),
              "its pixels are not where the wall file says"))
      return;
    named(outlier([](const ProjectorFigures& p) { return p.luminance.mean(); }, 0.01), curve);
  }

  const SimulationSettings& settings_;
  PictureSource& source_;
  SimulatedHall hall_;
  HallLight light_;
  PhaseColours colours_;
  SimulationResult result_;
  std::vector<std::vector<double>> seenErrors_;  ///< by projector and pixel, of the last head
  std::map<std::pair<std::size_t, std::size_t>, SeamFigures> seams_;
};

/// Changes the hall as the faults say; an error names what is wrong with them.
std::optional<Diagnostic> spoil(WallFile& hall, const std::vector<HallFault>& faults) {
  const auto problem = [](std::string message) {
    return Diagnostic{Severity::Error, {}, std::move(message), {}};
  };
  for (const HallFault& fault : faults) {
    const auto at = std::ranges::find_if(
        hall.walls, [&](const WallEntry& e) { return e.projector && e.wall.name == fault.projector; });
    if (at == hall.walls.end())
      return problem(fmt::format("there is no projector \"{}\" in the hall", fault.projector));
    Projector& p = *at->projector;
    if (fault.gamma) p.light.gamma.fill(*fault.gamma);
    if (!fault.moved) continue;
    if (auto* lens = std::get_if<LensImage>(&p.image))
      lens->X_RP.p += *fault.moved;
    else if (auto* fisheye = std::get_if<FisheyeImage>(&p.image))
      fisheye->X_RP.p += *fault.moved;
    else
      return problem(fmt::format("projector \"{}\" has no place that could be moved: its image is pinned or "
                                 "measured",
                                 fault.projector));
  }
  return std::nullopt;
}

double halton(std::size_t index, std::size_t base) {
  double result = 0, part = 1;
  for (; index > 0; index /= base) {
    part /= static_cast<double>(base);
    result += part * static_cast<double>(index % base);
  }
  return result;
}

}  // namespace

std::vector<Pose> headsOf(const VisitorPlace& visitor, double eyeSeparation, std::size_t count) {
  std::vector<Pose> heads{{visitor.eye, Quat::Identity()}};
  const double reach = std::max(0.0, visitor.reach - eyeSeparation);
  for (std::size_t i = 1; i < count; ++i) {
    // Evenly in a ball, and turned to all sides.
    const double azimuth = 2 * kPi * halton(i, 2), z = 2 * halton(i, 3) - 1, r = det::cbrt(halton(i, 5));
    const double level = std::sqrt(1 - z * z);
    const Vec3 aside(level * det::sin(azimuth), level * det::cos(azimuth), z);
    heads.push_back(
        {visitor.eye + reach * r * aside, det::expRotation(Vec3(0, 0, kPi * (2 * halton(i, 7) - 1)))});
  }
  return heads;
}

double SimulationResult::geometryMost() const {
  double most = 0;
  for (const ProjectorFigures& p : projectors) most = std::max(most, p.geometry.most);
  return most;
}

double SimulationResult::luminanceMost() const {
  double most = 0;
  for (const ProjectorFigures& p : projectors) most = std::max(most, p.luminance.most);
  return most;
}

double SimulationResult::stepsMost() const {
  const ProjectorFigures* worst = nullptr;
  for (const ProjectorFigures& p : projectors)
    if (!worst || p.luminance.most > worst->luminance.most) worst = &p;
  return worst ? worst->steps : 0;
}

double SimulationResult::uncoveredShare() const {
  return screenPoints > 0 ? static_cast<double>(uncovered) / static_cast<double>(screenPoints) : 0;
}

Result<SimulationResult> simulateHall(const WallFile& hall, PictureSource& source,
                                      const SimulationSettings& settings) {
  const auto isProjector = [](const WallEntry& e) { return e.projector.has_value(); };
  if (std::ranges::none_of(hall.walls, isProjector))
    return Result<SimulationResult>::failure(
        hall.file +
        " has no projector, so there is nothing to simulate: a flat wall shows its picture as it is");
  WallFile real = hall;
  if (auto problem = spoil(real, settings.faults)) return std::move(*problem);
  return Simulation(real, source, settings).run();
}

}  // namespace stadion
