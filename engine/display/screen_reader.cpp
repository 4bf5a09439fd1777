#include "engine/display/hall_statements.h"

#include "engine/display/wall_words.h"
#include "engine/maths/angles.h"

#include <algorithm>
#include <array>
#include <span>

namespace stadion {
namespace {

constexpr double kMostRadius = 1000, kLeastRadius = 0.05;  ///< [m]

class ScreenReader {
public:
  ScreenReader(StatementReader& in, LengthReader& lengths, Screen& screen)
      : in_(in), lengths_(lengths), screen_(screen) {}

  bool run() {
    static constexpr std::string_view kKinds[] = {"plane", "cylinder", "sphere", "mesh"};
    const auto kind = in_.choice("the kind of screen", kKinds);
    if (!kind) return false;
    if (*kind == 0) return plane();
    if (*kind == 1) return cylinder();
    return *kind == 2 ? sphere() : mesh();
  }

private:
  using Field = StatementField<ScreenReader>;
  static const Field kPlane[3], kCylinder[4], kSphere[5], kMesh[1];

  /// Reads the fields of a kind of screen. All but the last `optional` must be there.
  bool fields(std::span<const Field> known, const char* what, std::size_t optional = 0) {
    known_ = known;
    given_ = {};
    if (!in_.fields(*this, known, what)) return false;
    for (std::size_t i = 0; i + optional < known.size(); ++i)
      if (!given_[i]) {
        in_.errorAtEnd(fmt::format("screen \"{}\" has no {}; add: {}", screen_.name, known[i].name,
                                   exampleOf(known[i].name)));
        return false;
      }
    return true;
  }

  static std::string exampleOf(std::string_view field) {
    static constexpr std::array<std::array<std::string_view, 2>, 6> kWords{{{"radius", "R"},
                                                                            {"azimuth", "LEFT RIGHT"},
                                                                            {"height", "BOTTOM TOP"},
                                                                            {"elevation", "LOWEST HIGHEST"},
                                                                            {"file", "FILE.obj"},
                                                                            {"tilt", "DEGREES"}}};
    for (const auto& [name, words] : kWords)
      if (name == field) return fmt::format("{} {}", name, words);
    return fmt::format("{} X Y Z", field);
  }

  /// Marks the field whose name was the word `key`.
  bool got(std::string_view key, bool good) {
    for (std::size_t i = 0; i < known_.size(); ++i)
      if (key == known_[i].name) given_[i] = true;
    return good;
  }

  bool plane() {
    screen_.surface = Wall{};
    if (!fields(kPlane, "a plane screen")) return false;
    std::get<Wall>(screen_.surface).name = screen_.name;
    return true;
  }
  bool cylinder() {
    screen_.surface = CylinderScreen{};
    return fields(kCylinder, "a cylinder screen");
  }
  bool sphere() {
    screen_.surface = SphereScreen{};
    return fields(kSphere, "a sphere screen", 1);
  }
  bool mesh() {
    screen_.surface = MeshScreen{};
    return fields(kMesh, "a mesh screen");
  }

  bool corner(const char* name, Vec3 Wall::*place) {
    return got(name, lengths_.point(name, std::get<Wall>(screen_.surface).*place));
  }
  bool lowerLeft() { return corner("lower-left", &Wall::lowerLeft); }
  bool lowerRight() { return corner("lower-right", &Wall::lowerRight); }
  bool upperLeft() { return corner("upper-left", &Wall::upperLeft); }

  CylinderScreen* asCylinder() { return std::get_if<CylinderScreen>(&screen_.surface); }
  SphereScreen& asSphere() { return std::get<SphereScreen>(screen_.surface); }

  bool centre() {
    return got("centre", lengths_.point("centre", asCylinder() ? asCylinder()->centre : asSphere().centre));
  }
  bool radius() {
    const auto r = lengths_.length("the radius", kLeastRadius, kMostRadius);
    if (r) (asCylinder() ? asCylinder()->radius : asSphere().radius) = *r;
    return got("radius", r.has_value());
  }
  bool azimuth() {
    const auto left = in_.number("the azimuth of the left edge", -720, 720, " degrees");
    const auto right = left ? in_.number("the azimuth of the right edge", -720, 720, " degrees") : left;
    if (!right) return false;
    if (*right <= *left || *right > *left + 360) {
      in_.error(in_.last(), fmt::format("the right edge must be above {} degrees and at most {}, not {}: "
                                        "azimuth grows to the right",
                                        *left, *left + 360, *right));
      return false;
    }
    (asCylinder() ? asCylinder()->left : asSphere().left) = *left * kDegree;
    (asCylinder() ? asCylinder()->right : asSphere().right) = *right * kDegree;
    return got("azimuth", true);
  }
  bool height() {
    const auto bottom = lengths_.length("the height of the lower edge", -kMostRadius, kMostRadius);
    const auto top =
        bottom ? lengths_.length("the height of the upper edge", -kMostRadius, kMostRadius) : bottom;
    if (!top) return false;
    if (*top <= *bottom) {
      in_.error(in_.last(), "the upper edge must be above the lower one; write: height BOTTOM TOP");
      return false;
    }
    asCylinder()->bottom = *bottom;
    asCylinder()->top = *top;
    return got("height", true);
  }
  bool elevation() {
    const auto lowest = in_.number("the lowest elevation", -90, 90, " degrees");
    const auto highest = lowest ? in_.number("the highest elevation", -90, 90, " degrees") : lowest;
    if (!highest) return false;
    if (*highest <= *lowest) {
      in_.error(in_.last(),
                "the highest elevation must be above the lowest; write: elevation LOWEST HIGHEST");
      return false;
    }
    asSphere().lowest = *lowest * kDegree;
    asSphere().highest = *highest * kDegree;
    return got("elevation", true);
  }
  bool tilt() {
    const auto degrees = in_.number("the tilt", -180, 180, " degrees");
    if (degrees) asSphere().tilt = *degrees * kDegree;
    return got("tilt", degrees.has_value());
  }
  bool file() {
    return got("file", readFileName(in_, "the file of the mesh", {".obj", ".pfm"},
                                    std::get<MeshScreen>(screen_.surface).file));
  }

  StatementReader& in_;
  LengthReader& lengths_;
  Screen& screen_;
  std::span<const Field> known_;
  std::array<bool, 5> given_{};
};

constexpr ScreenReader::Field ScreenReader::kPlane[3] = {{"lower-left", &ScreenReader::lowerLeft},
                                                         {"lower-right", &ScreenReader::lowerRight},
                                                         {"upper-left", &ScreenReader::upperLeft}};
constexpr ScreenReader::Field ScreenReader::kCylinder[4] = {{"centre", &ScreenReader::centre},
                                                            {"radius", &ScreenReader::radius},
                                                            {"azimuth", &ScreenReader::azimuth},
                                                            {"height", &ScreenReader::height}};
constexpr ScreenReader::Field ScreenReader::kSphere[5] = {{"centre", &ScreenReader::centre},
                                                          {"radius", &ScreenReader::radius},
                                                          {"azimuth", &ScreenReader::azimuth},
                                                          {"elevation", &ScreenReader::elevation},
                                                          {"tilt", &ScreenReader::tilt}};
constexpr ScreenReader::Field ScreenReader::kMesh[1] = {{"file", &ScreenReader::file}};

}  // namespace

bool readScreen(StatementReader& in, LengthReader& lengths, Screen& screen) {
  return ScreenReader(in, lengths, screen).run();
}

}  // namespace stadion
