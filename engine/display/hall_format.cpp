#include "engine/display/hall_reader.h"
#include "engine/display/lens_turn.h"
#include "engine/maths/angles.h"

namespace stadion {
namespace {

std::string pointText(const Vec3& p, double metresPerUnit) {
  return fmt::format("{} {} {}", p.x() / metresPerUnit, p.y() / metresPerUnit, p.z() / metresPerUnit);
}

/// Writes the words of a screen's kind.
struct ScreenText {
  double unit;

  std::string operator()(const Wall& w) const {
    return fmt::format("plane  lower-left {}  lower-right {}  upper-left {}", pointText(w.lowerLeft, unit),
                       pointText(w.lowerRight, unit), pointText(w.upperLeft, unit));
  }
  std::string operator()(const CylinderScreen& s) const {
    return fmt::format("cylinder  centre {}  radius {}  azimuth {} {}  height {} {}",
                       pointText(s.centre, unit), s.radius / unit, s.left / kDegree, s.right / kDegree,
                       s.bottom / unit, s.top / unit);
  }
  std::string operator()(const SphereScreen& s) const {
    return fmt::format("sphere  centre {}  radius {}  azimuth {} {}  elevation {} {}  tilt {}",
                       pointText(s.centre, unit), s.radius / unit, s.left / kDegree, s.right / kDegree,
                       s.lowest / kDegree, s.highest / kDegree, s.tilt / kDegree);
  }
  std::string operator()(const MeshScreen& s) const { return "mesh  file " + s.file; }
};

/// Writes the words of a projector's image.
struct ImageText {
  double unit;

  std::string place(const Pose& X_RP) const {
    const LensTurn turn = turnOf(X_RP.q);
    return fmt::format("at {}  turn {} {}  roll {}", pointText(X_RP.p, unit), turn.yaw / kDegree,
                       turn.pitch / kDegree, turn.roll / kDegree);
  }
  std::string operator()(const LensImage& i) const {
    const std::string text =
        fmt::format("{}  throw {}  shift {} {}", place(i.X_RP), i.throwRatio, i.shift.x(), i.shift.y());
    return i.pixelAspect == 1 ? text : fmt::format("{}  pixel-aspect {}", text, i.pixelAspect);
  }
  std::string operator()(const FisheyeImage& i) const {
    return fmt::format("{}  fisheye {}", place(i.X_RP), i.angle / kDegree);
  }
  std::string operator()(const PinnedImage& i) const {
    std::string text = "pins";
    for (const Vec2& pin : i.pins) text += fmt::format("  {} {}", pin.x(), pin.y());
    return text;
  }
  std::string operator()(const MeasuredImage& i) const { return "warp " + i.file; }
};

std::string lightText(const ProjectorLight& light) {
  std::string text;
  const auto& g = light.gamma;
  if (g[0] > 0) text += fmt::format("  display-gamma {} {} {}", g[0], g[1], g[2]);
  const auto& w = light.white;
  if (w != std::array<double, 3>{1, 1, 1}) text += fmt::format("  white {} {} {}", w[0], w[1], w[2]);
  if (light.black > 0) text += fmt::format("  black {}", light.black);
  return text;
}

}  // namespace

std::string formatScreen(const Screen& screen, double metresPerUnit) {
  return fmt::format("screen {} {}\n", screen.name, std::visit(ScreenText{metresPerUnit}, screen.surface));
}

std::string formatProjector(const WallEntry& entry, const std::string& screen, double metresPerUnit) {
  const Projector& p = *entry.projector;
  std::string text =
      fmt::format("projector {}  screen {}  pixels {} {}", entry.wall.name, screen, p.width, p.height);
  if (p.eye) text += fmt::format("  eye {}", eyeName(*p.eye));
  if (entry.card) text += fmt::format("  card {}", *entry.card);
  text += "  " + std::visit(ImageText{metresPerUnit}, p.image) + lightText(p.light);
  if (!p.blend.computed) text += "  no-blend";
  for (const PictureEdge edge :
       {PictureEdge::Left, PictureEdge::Right, PictureEdge::Top, PictureEdge::Bottom})
    if (const double share = p.blend.edges[static_cast<std::size_t>(edge)]; share > 0)
      text += fmt::format("  edge-{} {}", edgeName(edge), share);
  if (!p.blend.mask.empty()) text += "  mask " + p.blend.mask;
  if (p.lut) text += "  lut " + p.lut->file;
  return text + '\n';
}

std::string formatPanorama(const WallEntry& entry, double metresPerUnit) {
  const Panorama& p = *entry.panorama;
  std::string text = fmt::format("panorama {} {}  pixels {} {}", entry.wall.name, panoramaKindName(p.kind),
                                 p.width, p.height);
  if (p.kind != PanoramaKind::Cube) text += fmt::format("  field-of-view {}", p.across / kDegree);
  if (p.kind == PanoramaKind::Equirectangular) text += fmt::format(" {}", p.upright / kDegree);
  if (p.turn != 0) text += fmt::format("  turn {}", p.turn / kDegree);
  if (p.tilt != 0) text += fmt::format("  tilt {}", p.tilt / kDegree);
  if (p.at) text += "  at " + pointText(*p.at, metresPerUnit);
  if (p.eye != PanoramaEye::Middle) text += p.eye == PanoramaEye::Left ? "  eye left" : "  eye right";
  if (entry.card) text += fmt::format("  card {}", *entry.card);
  return text + '\n';
}

std::string formatControl(const ProjectorControl& control) {
  std::string text = fmt::format("pjlink {}  port {}", control.host, control.port);
  if (!control.passwordFile.empty()) text += "  password " + control.passwordFile;
  return text;
}

std::string formatVisitor(const VisitorPlace& visitor, double metresPerUnit) {
  return fmt::format("visitor {}  within {}\n", pointText(visitor.eye, metresPerUnit),
                     visitor.reach / metresPerUnit);
}

}  // namespace stadion
