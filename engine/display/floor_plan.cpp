#include "engine/display/output_reader.h"
#include "engine/display/wall_lint.h"
#include "engine/loudspeakers/loudspeaker_text.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace stadion {
namespace {

constexpr double kAspect = 0.5;  ///< a letter is about half as wide as it is high

/// A sheet of letters; (0, 0) is its top left corner.
class Sheet {
public:
  Sheet(int columns, int rows)
      : columns_(columns),
        lines_(static_cast<std::size_t>(rows), std::string(static_cast<std::size_t>(columns), ' ')) {}

  void put(int column, int row, char c) {
    if (column < 0 || row < 0 || column >= columns_ || row >= static_cast<int>(lines_.size())) return;
    lines_[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = c;
  }

  char at(int column, int row) const {
    if (column < 0 || row < 0 || column >= columns_ || row >= static_cast<int>(lines_.size())) return ' ';
    return lines_[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
  }

  std::string text() const {
    std::string all;
    for (std::string line : lines_) {
      line.erase(line.find_last_not_of(' ') + 1);
      all += line + '\n';
    }
    return all;
  }

private:
  int columns_;
  std::vector<std::string> lines_;
};

/// From rig space to the sheet.
struct Scale {
  Aabb bounds;
  double lettersPerMetre = 1;
  int column(double x) const {
    return 1 + static_cast<int>(std::lround((x - bounds.lo.x()) * lettersPerMetre));
  }
  int row(double y) const {
    return static_cast<int>(std::lround((bounds.hi.y() - y) * lettersPerMetre * kAspect));
  }
};

void line(Sheet& sheet, const Scale& scale, const Vec3& a, const Vec3& b, char c) {
  const int steps = 1 + 2 * std::max(std::abs(scale.column(b.x()) - scale.column(a.x())),
                                     std::abs(scale.row(b.y()) - scale.row(a.y())));
  for (int i = 0; i <= steps; ++i) {
    const Vec3 p = a + (b - a) * (static_cast<double>(i) / steps);
    sheet.put(scale.column(p.x()), scale.row(p.y()), c);
  }
}

/// Horizontal walls hide nothing: they are drawn first, dotted.
bool isLevel(const Wall& wall) {
  return std::fabs(basis(wall).normal.z()) > 0.99;
}

std::string facing(const Wall& wall) {
  const Vec3 n = basis(wall).normal;
  int axis = 0;
  n.cwiseAbs().maxCoeff(&axis);
  static constexpr const char* kTowards[3][2] = {{"left", "right"}, {"back", "forward"}, {"down", "up"}};
  return fmt::format("faces {}", kTowards[axis][n[axis] > 0]);
}

/// A line of the plan.
struct PlanLine {
  Vec3 a, b;
};

void addOutline(const Wall& w, std::vector<PlanLine>& lines) {
  const Vec3 corners[] = {w.lowerLeft, w.lowerRight, w.upperRight(), w.upperLeft};
  for (std::size_t k = 0; k < 4; ++k) lines.push_back({corners[k], corners[(k + 1) % 4]});
}

void addArc(const Vec3& centre, double radius, double left, double right, std::vector<PlanLine>& lines) {
  constexpr int kParts = 64;
  const auto at = [&](int i) -> Vec3 {
    const auto [sine, cosine] = det::sincos(left + (right - left) * i / kParts);
    return centre + radius * Vec3(sine, cosine, 0);
  };
  for (int i = 0; i < kParts; ++i) lines.push_back({at(i), at(i + 1)});
}

/// The edges that only one triangle has.
void addOutline(const MeshScreen& mesh, std::vector<PlanLine>& lines) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++uses[std::minmax(t[k], t[(k + 1) % 3])];
  for (const auto& [edge, count] : uses)
    if (count == 1) lines.push_back({mesh.points[edge.first], mesh.points[edge.second]});
}

/// Draws the plan: first the lines, which set its scale, then numbers on them.
class Plan {
public:
  Plan(const WallFile& hall, std::uint32_t columns) : hall_(hall), sheet_(0, 0) {
    collect();
    Scale& scale = scale_;
    scale.bounds.include(hall.visitor.eye);
    for (const auto* lines : {&dotted_, &solid_})
      for (const PlanLine& l : *lines) {
        scale.bounds.include(l.a);
        scale.bounds.include(l.b);
      }
    for (const WallEntry& e : hall.walls)
      if (!e.isFlat()) scale.bounds.include(placeOf(e));
    if (dotted_.empty() && solid_.empty())  // panoramas alone
      for (const double side : {-1.0, 1.0}) scale.bounds.include(hall.visitor.eye + Vec3(side, side, 0));
    const Vec3 extent = scale.bounds.hi - scale.bounds.lo;
    width_ = static_cast<int>(std::clamp(columns, 20u, 200u));
    scale.lettersPerMetre = (width_ - 3) / std::max({extent.x(), extent.y(), 1e-3});
    sheet_ = Sheet(width_, scale.row(scale.bounds.lo.y()) + 1);
  }

  std::string text() {
    for (const PlanLine& l : dotted_) line(sheet_, scale_, l.a, l.b, '.');
    for (const PlanLine& l : solid_) line(sheet_, scale_, l.a, l.b, '#');
    const Vec3& eye = hall_.visitor.eye;
    sheet_.put(scale_.column(eye.x()), scale_.row(eye.y()), '@');
    for (std::size_t i = 0; i < hall_.walls.size(); ++i) number(i);
    std::string text = sheet_.text() + legend();
    for (std::size_t i = 0; i < hall_.walls.size(); ++i) text += listed(i);
    const std::string loudspeakers = listLoudspeakers(hall_.loudspeakers);
    return loudspeakers.empty() ? text : text + '\n' + loudspeakers;
  }

private:
  void collect() {
    for (const WallEntry& e : hall_.walls)
      if (e.isFlat()) addOutline(e.wall, isLevel(e.wall) ? dotted_ : solid_);
    for (const Screen& s : hall_.screens) {
      if (const auto* wall = std::get_if<Wall>(&s.surface))
        addOutline(*wall, isLevel(*wall) ? dotted_ : solid_);
      else if (const auto* c = std::get_if<CylinderScreen>(&s.surface))
        addArc(c->centre, c->radius, c->left, c->right, solid_);
      else if (const auto* ball = std::get_if<SphereScreen>(&s.surface))
        addArc(ball->centre, ball->radius, 0, 2 * kPi, solid_);
      else
        addOutline(std::get<MeshScreen>(s.surface), solid_);
    }
  }

  /// Where the projector's light comes from, or the middle of what it lights; from where a panorama is seen.
  Vec3 placeOf(const WallEntry& e) const {
    if (e.panorama) return e.panorama->at.value_or(hall_.visitor.eye);
    const Projector& p = *e.projector;
    if (const auto* lens = std::get_if<LensImage>(&p.image)) return lens->X_RP.p;
    if (const auto* fisheye = std::get_if<FisheyeImage>(&p.image)) return fisheye->X_RP.p;
    return e.wall.centre();
  }

  static char sign(std::size_t i) {
    constexpr std::string_view kSigns = "123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
    return i < kSigns.size() ? kSigns[i] : '*';
  }

  void number(std::size_t i) {
    const WallEntry& e = hall_.walls[i];
    const Vec3 c = e.isFlat() ? e.wall.centre() : placeOf(e);
    // Floor and ceiling share their middle with the visitor and with each other.
    int aside = !e.isFlat() || !isLevel(e.wall) ? 0 : c.z() < hall_.visitor.eye.z() ? -4 : 4;
    // Projectors hang in pairs, and panoramas are seen from the visitor's place.
    while (!e.isFlat() && aside < 8 && taken(scale_.column(c.x()) + aside, scale_.row(c.y()))) ++aside;
    sheet_.put(scale_.column(c.x()) + aside, scale_.row(c.y()), sign(i));
  }

  bool taken(int column, int row) const {
    const char c = sheet_.at(column, row);
    return c != ' ' && c != '#' && c != '.';
  }

  std::string legend() const {
    const int metre = std::max(1, static_cast<int>(std::lround(scale_.lettersPerMetre)));
    const bool fits = metre <= width_ - 10;
    const auto bar = [](int letters) { return std::string(static_cast<std::size_t>(letters), '-'); };
    const Vec3& eye = hall_.visitor.eye;
    return fmt::format("\n |{}| {} m   @ eye at {:.4g} {:.4g} {:.4g}   up the page is forward (+Y)\n\n",
                       bar(fits ? metre : std::max(1, metre / 10)), fits ? "1" : "0.1", eye.x(), eye.y(),
                       eye.z());
  }

  std::string listed(std::size_t i) const {
    const WallEntry& e = hall_.walls[i];
    const Wall& w = e.wall;
    const WallBasis b = basis(w);
    std::string text = fmt::format(" {} {:<12} ", sign(i), w.name);
    if (e.projector) {
      const Vec3 place = placeOf(e);
      text += fmt::format("lights {:.2f} x {:.2f} m of {}{}, {} x {} pixels, at {:.2f} {:.2f} {:.2f}\n",
                          b.width, b.height, hall_.screens[e.projector->screen].name,
                          e.projector->eye ? fmt::format(" for the {} eye", eyeName(*e.projector->eye)) : "",
                          e.pixels.width, e.pixels.height, place.x(), place.y(), place.z());
    } else if (e.panorama) {
      text += panoramaText(e);
    } else {
      text += fmt::format("{:.2f} x {:.2f} m, {}, middle at {:.2f} {:.2f} {:.2f}\n", b.width, b.height,
                          facing(w), w.centre().x(), w.centre().y(), w.centre().z());
    }
    if (e.output) text += fmt::format("   shown on{}\n", formatOutput(*e.output));
    return text;
  }

  static std::string panoramaText(const WallEntry& e) {
    const Panorama& p = *e.panorama;
    std::string text = "shows all directions as a cube";
    if (p.kind == PanoramaKind::DomeMaster)
      text = fmt::format("shows {:.4g} degrees as a dome master", p.across / kDegree);
    if (p.kind == PanoramaKind::Equirectangular)
      text = fmt::format("shows {:.4g} x {:.4g} degrees equirectangularly", p.across / kDegree,
                         p.upright / kDegree);
    text += fmt::format(", {} x {} pixels, from ", p.width, p.height);
    constexpr const char* kFrom[] = {"the head", "the left eye", "the right eye"};
    text += p.at ? fmt::format("{:.2f} {:.2f} {:.2f}", p.at->x(), p.at->y(), p.at->z())
                 : kFrom[static_cast<std::size_t>(p.eye)];
    return text + '\n';
  }

  const WallFile& hall_;
  std::vector<PlanLine> dotted_;  ///< of what is level: it hides nothing
  std::vector<PlanLine> solid_;
  Scale scale_;
  int width_ = 0;
  Sheet sheet_;
};

}  // namespace

std::string floorPlan(const WallFile& walls, std::uint32_t columns) {
  return Plan(walls, columns).text();
}

}  // namespace stadion
