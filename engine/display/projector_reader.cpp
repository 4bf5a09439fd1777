#include "engine/display/hall_statements.h"

#include "engine/display/lens_turn.h"
#include "engine/display/wall_words.h"
#include "engine/maths/angles.h"

#include <algorithm>
#include <array>

namespace stadion {
namespace {

constexpr std::uint64_t kMostPixels = 16384;  ///< of a side
constexpr std::uint64_t kMostCard = 63;       ///< a larger number is a mistake in the file

class ProjectorReader {
public:
  ProjectorReader(StatementReader& in, LengthReader& lengths, WallEntry& entry)
      : in_(in), lengths_(lengths), entry_(entry), projector_(entry.projector.emplace()) {}

  std::optional<NamedScreen> run() {
    if (!in_.fields(*this, kFields, "a projector")) return std::nullopt;
    if (screen_.name.empty()) return missing("has no screen; add: screen NAME"), std::nullopt;
    if (!image() || !light()) return std::nullopt;
    return screen_;
  }

private:
  static const StatementField<ProjectorReader> kFields[24];

  /// What the line says about its image.
  struct Given {
    bool at = false, lookAt = false, turn = false, roll = false, throwRatio = false, shift = false,
         pixelAspect = false, fisheye = false, pins = false, warp = false, edge = false;
  };

  bool missing(std::string_view what) {
    in_.errorAtEnd(fmt::format("projector \"{}\" {}", entry_.wall.name, what));
    return false;
  }

  // The fields.

  bool screen() {
    const auto name = in_.name("the screen's name", "a screen");
    if (!name) return false;
    screen_ = {*name, in_.place(in_.last())};
    return true;
  }
  bool pixels() { return readPixelSize(in_, entry_.pixels); }
  bool card() { return readCard(in_, entry_.card); }
  bool eye() {
    static constexpr std::string_view kEyeWords[] = {"left", "right", "both"};
    const auto which = in_.choice("an eye", kEyeWords);
    if (which && *which < kEyes.size()) projector_.eye = kEyes[*which];
    return which.has_value();
  }
  bool at() { return given_.at = lengths_.point("the lens", at_); }
  bool lookAt() {
    aim_ = in_.last();
    return given_.lookAt = lengths_.point("look-at", lookedAt_);
  }
  bool turn() {
    const auto yaw = in_.number("the turn to the right", -360, 360, " degrees");
    const auto pitch = yaw ? in_.number("the turn up", -90, 90, " degrees") : yaw;
    if (!pitch) return false;
    turn_.yaw = *yaw * kDegree;
    turn_.pitch = *pitch * kDegree;
    return given_.turn = true;
  }
  bool roll() {
    const auto degrees = in_.number("the roll", -360, 360, " degrees");
    if (degrees) turn_.roll = *degrees * kDegree;
    return given_.roll = degrees.has_value();
  }
  bool throwRatio() {
    const auto ratio = in_.number("the throw ratio", 0.05, 100);
    if (ratio) lens_.throwRatio = *ratio;
    return given_.throwRatio = ratio.has_value();
  }
  bool pixelAspect() {
    const auto aspect = in_.number("the height of a pixel's light by its width", 0.01, 100);
    if (aspect) lens_.pixelAspect = *aspect;
    return given_.pixelAspect = aspect.has_value();
  }
  bool shift() {
    const auto right = in_.number("the shift to the right", -10, 10);
    const auto up = right ? in_.number("the shift up", -10, 10) : right;
    if (up) lens_.shift = Vec2(*right, *up);
    return given_.shift = up.has_value();
  }
  bool fisheye() {
    const auto degrees = in_.number("the angle of the fisheye", 1, 360, " degrees");
    if (degrees) fisheye_ = *degrees * kDegree;
    return given_.fisheye = degrees.has_value();
  }
  bool pins() {
    const Word key = in_.last();
    constexpr const char* kPinNames[] = {"upper left", "upper right", "lower right", "lower left"};
    for (std::size_t i = 0; i < 4; ++i)
      for (int axis = 0; axis < 2; ++axis) {
        const auto value =
            in_.number(fmt::format("{} of the {} pin", axis == 0 ? "x" : "y", kPinNames[i]), -10, 10);
        if (!value) return false;
        pins_.pins[i][axis] = *value;
      }
    if (squareToQuad(pins_.pins)) return given_.pins = true;
    in_.error(key, "the pins make no picture; give the places of the screen's upper left, upper right, lower "
                   "right and lower left corner, as shares of the output from its upper left corner (0 0  1 "
                   "0  1 1  0 1 fills the output)");
    return false;
  }
  bool warp() { return given_.warp = readFileName(in_, "the file of the warp", {".pfm"}, measured_.file); }
  bool displayGamma() {
    if (in_.more() && in_.peek()->text == "srgb") {
      in_.word("a curve");
      projector_.light.gamma.fill(0);
      return true;
    }
    return channels("the display gamma", 0.5, 6, true, projector_.light.gamma);
  }
  bool white() { return channels("white", 0.001, 1000, false, projector_.light.white); }
  bool black() {
    black_ = in_.last();
    const auto light = in_.number("the light of black", 0, 1000);
    if (light) projector_.light.black = *light;
    return light.has_value();
  }
  bool noBlend() {
    projector_.blend.computed = false;
    return true;
  }
  bool edge(PictureEdge which) {
    const auto share = in_.number(fmt::format("the {} edge", edgeName(which)), 0, kMostEdge);
    if (share) projector_.blend.edges[static_cast<std::size_t>(which)] = *share;
    return given_.edge = share.has_value();
  }
  bool edgeLeft() { return edge(PictureEdge::Left); }
  bool edgeRight() { return edge(PictureEdge::Right); }
  bool edgeTop() { return edge(PictureEdge::Top); }
  bool edgeBottom() { return edge(PictureEdge::Bottom); }
  bool lut() {
    return readFileName(in_, "the file of the colour table", {".cube"}, projector_.lut.emplace().file);
  }
  bool mask() { return readFileName(in_, "the file of the mask", {".png"}, projector_.blend.mask); }

  bool numberFollows() const {
    return in_.more() && std::string_view("0123456789+-.").find(in_.peek()->text[0]) != std::string::npos;
  }
  /// Three numbers; or one for all, if `one` allows it.
  bool channels(std::string_view what, double lo, double hi, bool one, std::array<double, 3>& target) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (i == 1 && one && !numberFollows()) {
        target.fill(target[0]);
        return true;
      }
      constexpr const char* kChannels[] = {"red", "green", "blue"};
      const auto value =
          in_.number(i > 0 || !one ? fmt::format("{} of {}", what, kChannels[i]) : what, lo, hi);
      if (!value) return false;
      target[i] = *value;
    }
    return true;
  }

  // What goes together.

  bool image() {
    const Given& g = given_;
    if (g.at + g.pins + g.warp > 1)
      return missing("has more than one image; keep one of: at with a lens, pins, warp");
    if (!g.at && (g.lookAt || g.turn || g.roll || g.throwRatio || g.shift || g.pixelAspect || g.fisheye))
      return missing("has a lens but no place; add: at X Y Z");
    if (g.pins)
      projector_.image = pins_;
    else if (g.warp)
      projector_.image = measured_;
    else if (g.at)
      return lens();
    else
      return missing("has no image; add: at X Y Z  look-at X Y Z  throw RATIO, or pins with four places, or "
                     "warp FILE.pfm");
    return true;
  }

  bool lens() {
    const Given& g = given_;
    if (g.lookAt == g.turn)
      return missing(g.turn ? "has look-at and turn; keep one of them"
                            : "looks nowhere; add: look-at X Y Z, or turn YAW PITCH");
    if (g.throwRatio == g.fisheye)
      return missing(g.fisheye ? "has throw and fisheye; keep one of them"
                               : "has no lens; add: throw RATIO, or fisheye DEGREES");
    if (g.shift && g.fisheye) return missing("has a fisheye with a shift; leave shift out");
    if (g.edge && g.fisheye) return missing("has a fisheye with edges; leave them out: its picture is round");
    if (g.pixelAspect && g.fisheye)
      return missing("has a fisheye with a pixel-aspect; leave pixel-aspect out");
    if (g.lookAt) {
      if ((lookedAt_ - at_).norm() < 1e-6) {
        in_.error(aim_, "look-at is the place of the lens; give the point at which the lens points");
        return false;
      }
      const LensTurn aim = turnTowards(lookedAt_ - at_);
      turn_.yaw = aim.yaw;
      turn_.pitch = aim.pitch;
    }
    const Pose X_RP{at_, rotationOf(turn_)};
    lens_.X_RP = X_RP;
    if (g.fisheye)
      projector_.image = FisheyeImage{X_RP, fisheye_};
    else
      projector_.image = lens_;
    return true;
  }

  bool light() {
    const double least = *std::ranges::min_element(projector_.light.white);
    if (projector_.light.black < least) return true;
    in_.error(black_, fmt::format("the light of black must be below that of white ({})", least));
    return false;
  }

  StatementReader& in_;
  LengthReader& lengths_;
  WallEntry& entry_;
  Projector& projector_;
  NamedScreen screen_;
  Given given_;
  Vec3 at_ = Vec3::Zero(), lookedAt_ = Vec3::Zero();
  LensTurn turn_;
  LensImage lens_;
  double fisheye_ = 0;
  PinnedImage pins_;
  MeasuredImage measured_;
  Word aim_, black_;
};

using ProjectorField = StatementField<ProjectorReader>;
constexpr ProjectorField ProjectorReader::kFields[24] = {{"screen", &ProjectorReader::screen},
                                                         {"pixels", &ProjectorReader::pixels},
                                                         {"eye", &ProjectorReader::eye},
                                                         {"card", &ProjectorReader::card},
                                                         {"at", &ProjectorReader::at},
                                                         {"look-at", &ProjectorReader::lookAt},
                                                         {"turn", &ProjectorReader::turn},
                                                         {"roll", &ProjectorReader::roll},
                                                         {"throw", &ProjectorReader::throwRatio},
                                                         {"shift", &ProjectorReader::shift},
                                                         {"pixel-aspect", &ProjectorReader::pixelAspect},
                                                         {"fisheye", &ProjectorReader::fisheye},
                                                         {"pins", &ProjectorReader::pins},
                                                         {"warp", &ProjectorReader::warp},
                                                         {"display-gamma", &ProjectorReader::displayGamma},
                                                         {"white", &ProjectorReader::white},
                                                         {"black", &ProjectorReader::black},
                                                         {"no-blend", &ProjectorReader::noBlend},
                                                         {"edge-left", &ProjectorReader::edgeLeft},
                                                         {"edge-right", &ProjectorReader::edgeRight},
                                                         {"edge-top", &ProjectorReader::edgeTop},
                                                         {"edge-bottom", &ProjectorReader::edgeBottom},
                                                         {"mask", &ProjectorReader::mask},
                                                         {"lut", &ProjectorReader::lut}};

class PanoramaReader {
public:
  PanoramaReader(StatementReader& in, LengthReader& lengths, WallEntry& entry)
      : in_(in), lengths_(lengths), entry_(entry), panorama_(entry.panorama.emplace()) {}

  bool run() {
    static constexpr std::string_view kKinds[] = {panoramaKindName(PanoramaKind::DomeMaster),
                                                  panoramaKindName(PanoramaKind::Equirectangular),
                                                  panoramaKindName(PanoramaKind::Cube)};
    const auto kind = in_.choice("a kind of panorama", kKinds);
    if (!kind) return false;
    panorama_.kind = static_cast<PanoramaKind>(*kind);
    panorama_.across = panorama_.kind == PanoramaKind::DomeMaster ? kPi : 2 * kPi;
    panorama_.upright = kPi;
    if (!in_.fields(*this, kFields, "a panorama")) return false;
    if (!panorama_.at || panorama_.eye == PanoramaEye::Middle) return true;
    in_.errorAtEnd(fmt::format("panorama \"{}\" has at and eye; keep one of them", entry_.wall.name));
    return false;
  }

private:
  static const StatementField<PanoramaReader> kFields[7];

  bool pixels() { return readPixelSize(in_, entry_.pixels); }
  bool card() { return readCard(in_, entry_.card); }
  bool fieldOfView() {
    if (panorama_.kind == PanoramaKind::Cube) {
      in_.error(in_.last(), "a cube always shows all directions; leave field-of-view out");
      return false;
    }
    const auto across = in_.number("the field of view", 1, 360, " degrees");
    if (across) panorama_.across = *across * kDegree;
    if (!across || panorama_.kind == PanoramaKind::DomeMaster) return across.has_value();
    const auto upright = in_.number("the upright field of view", 1, 180, " degrees");
    if (upright) panorama_.upright = *upright * kDegree;
    return upright.has_value();
  }
  bool at() { return lengths_.point("the place from which it is seen", panorama_.at.emplace()); }
  bool eye() {
    static constexpr std::string_view kEyeWords[] = {"middle", "left", "right"};
    const auto which = in_.choice("an eye", kEyeWords);
    if (which) panorama_.eye = static_cast<PanoramaEye>(*which);
    return which.has_value();
  }
  bool turn() { return angle("the turn to the right", 360, panorama_.turn); }
  bool tilt() { return angle("the tilt", 180, panorama_.tilt); }
  bool angle(std::string_view what, double most, double& target) {
    const auto degrees = in_.number(what, -most, most, " degrees");
    if (degrees) target = *degrees * kDegree;
    return degrees.has_value();
  }

  StatementReader& in_;
  LengthReader& lengths_;
  WallEntry& entry_;
  Panorama& panorama_;
};

constexpr StatementField<PanoramaReader> PanoramaReader::kFields[7] = {
    {"pixels", &PanoramaReader::pixels},
    {"card", &PanoramaReader::card},
    {"field-of-view", &PanoramaReader::fieldOfView},
    {"at", &PanoramaReader::at},
    {"eye", &PanoramaReader::eye},
    {"turn", &PanoramaReader::turn},
    {"tilt", &PanoramaReader::tilt}};

}  // namespace

bool readPanorama(StatementReader& in, LengthReader& lengths, WallEntry& entry) {
  return PanoramaReader(in, lengths, entry).run();
}

std::optional<NamedScreen> readProjector(StatementReader& in, LengthReader& lengths, WallEntry& entry) {
  return ProjectorReader(in, lengths, entry).run();
}

bool readPixelSize(StatementReader& in, PixelSize& target) {
  const Word* w = in.word("the width in pixels");
  const Word* h = w ? in.word("the height in pixels") : nullptr;
  if (!h) return false;
  const auto width = in.countIn(*w, "the width in pixels", 1, kMostPixels);
  const auto height = in.countIn(*h, "the height in pixels", 1, kMostPixels);
  if (!width || !height) return false;
  target = {static_cast<std::uint32_t>(*width), static_cast<std::uint32_t>(*height)};
  return true;
}

bool readCard(StatementReader& in, std::optional<std::uint32_t>& target) {
  const Word* number = in.word("the number of the graphics card");
  const auto card =
      number ? in.countIn(*number, "the number of the graphics card", 0, kMostCard) : std::nullopt;
  if (card) target = static_cast<std::uint32_t>(*card);
  return card.has_value();
}

}  // namespace stadion
