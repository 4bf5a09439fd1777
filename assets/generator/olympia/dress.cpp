#include "assets/generator/olympia/anatomy.h"
#include "assets/generator/olympia/joints.h"

// The surface of trunk and limbs is one; where cloth lies on it, it is raised and painted. Head, hands and
// feet are cast finer, over a small strip that both surfaces have. Below the belt hangs a skirt of its own.

namespace stadion::assets {
namespace {

constexpr double kCoarseStep = 0.0180, kMiddleStep = 0.0112, kFineStep = 0.0092;  // [m]
constexpr double kBelt = joints::kHipHeight + 0.078;
constexpr double kChestHeight = joints::kHipHeight + joints::kWaist.z;

struct Cut {
  double hem;    ///< height of the skirt's lower edge
  double wide;   ///< how far it stands off
  double count;  ///< of pleats
  double deep;   ///< of pleats [m]
};

Cut cutOf(Dress dress) {
  if (dress == Dress::Loincloth) return {0.755, 0.0, 15, 0.0055};
  return {0.665, 0.016, 21, 0.0095};
}

/// How far inside the edge of the cloth on the trunk; negative outside.
double inside(const Look& look, Point p) {
  if (look.dress == Dress::Loincloth || p.z < 0.9) return -1;
  const double x = std::fabs(p.x), shoulder = kChestHeight + joints::kShoulder.z;
  const double armhole = 0.172 + 0.42 * std::max(shoulder - 0.015 - p.z, 0.0) - x;
  double neck =
      kChestHeight + 0.352 + (p.y > 0 ? 1.05 : 0.75) * std::max(x - 0.055, 0.0) + (p.y > 0 ? 0 : 0.03) - p.z;
  double edge = std::min(armhole, neck);
  if (look.dress == Dress::Exomis) edge = std::min(edge, 0.62 * (1.10 + 1.15 * (0.15 - p.x) - p.z));
  return edge;
}

/// Folds of the cloth over the trunk, from -1 to 1: they hang from the shoulders to the belt.
double hang(const Look& look, Point p) {
  const double x =
      look.dress == Dress::Exomis ? p.x + 0.55 * (p.z - 1.25) : p.x * (2.4 - 1.15 * (p.z - 0.07));
  return det::sin(80 * x + (p.y < 0 ? 2 : 0) + 3.6 * noise({5 * p.x, 3 * p.y, 4 * p.z}));
}

/// How far the cloth lies off the skin.
double loose(const Look& look, Point p) {
  const double edge = inside(look, p);
  if (edge <= -0.004) return 0;
  const double free = smoothstep(0, 0.10, edge), over = (p.z - kBelt - 0.050) / 0.030;
  const double tied = smoothstep(kBelt - 0.005, kBelt + 0.04, p.z);  // the belt holds it
  return smoothstep(-0.004, 0.012, edge) * (0.002 + 0.004 * tied) +
         tied * (free * 0.0065 * (1 + hang(look, p)) * smoothstep(1.45, 1.2, p.z) +
                 0.019 * det::exp(-over * over));
}

Rgb linenColour(Rgb cloth, double fold, double open, Point n) {
  return mix(0.80, 1.0, 0.5 + 0.5 * fold) * mix(0.80, 1.0, smoothstep(-0.6, 0.3, n.z)) *
         mix(times({0.66, 0.62, 0.60}, cloth), cloth, smoothstep(0.0, 0.85, open));
}

struct Region {
  Point low, high;
  double step;
  bool holds(Point p, double within) const {
    return p.x > low.x + within && p.x < high.x - within && p.y > low.y + within && p.y < high.y - within &&
           p.z > low.z + within && p.z < high.z - within;
  }
};

std::vector<Region> fineRegions(const std::vector<Pose>& rest) {
  std::vector<Region> all;
  const auto around = [&](Joint joint, const Vec3& local, Point half, double step) {
    const Vec3 m = rest[static_cast<std::size_t>(boneOf(joint))] * local;
    const Point middle{m.x(), m.y(), m.z()};
    all.push_back({middle - half, middle + half, step});
  };
  around(Joint::Head, {0, 0, 0.15}, {0.13, 0.17, 0.17}, kFineStep);
  for (const Joint hand : {Joint::RightHand, Joint::LeftHand})
    around(hand, {0, 0.01, -0.075}, {0.095, 0.085, 0.095}, kMiddleStep);
  for (const Joint foot : {Joint::RightFoot, Joint::LeftFoot})
    around(foot, {0, 0.06, -0.04}, {0.09, 0.17, 0.065}, kMiddleStep);
  return all;
}

class Athlete {
public:
  Athlete(const Look& look) : look_(look), head_(look), rest_(personAtRest()) {
    addTrunk(clay_, look.girth, look.dress != Dress::Loincloth);
    for (const double side : {1.0, -1.0}) addArm(clay_, side, look.girth), addLeg(clay_, side, look.girth);
    const Pose& X_head = rest_[static_cast<std::size_t>(boneOf(Joint::Head))];
    head_.addTo(clay_, boneOf(Joint::Head), X_head);
    neck_ = {X_head.p.x(), X_head.p.y(), X_head.p.z()};
    clay_.relief([this](Point p) { return p.z > neck_.z + 0.05 ? head_.band(p - neck_) : loose(look_, p); });
  }

  void addTo(FigureModel& model) const {
    const auto colour = [](Point, Point) { return Rgb{1, 1, 1}; };  // painted later
    const auto carriers = [this](Point p) { return carriersAt(clay_, p); };
    const std::vector<Region> fine = fineRegions(rest_);
    const Cut cut = cutOf(look_.dress);
    const auto hidden = [cut](Point p) {
      return std::fabs(p.x) < 0.33 && p.z < kBelt - 0.03 && p.z > cut.hem + 0.035;
    };
    const auto refined = [&](Point p) {
      return std::any_of(fine.begin(), fine.end(),
                         [&](const Region& r) { return r.holds(p, 1.2 * kCoarseStep); });
    };
    Part coarse = clay_.cast(kCoarseStep, colour);
    drawToEdge(coarse);
    Part linen = coarse;
    coarse.finish = {"skin", "", 0.52, 0}, linen.finish = {"linen", "", 0.9, 0};
    for (Vertex& v : coarse.vertices) v.colour = bareColour(v.p, v.n);
    for (Vertex& v : linen.vertices) v.colour = clothColour(v.p, v.n);
    const auto cloth = [this](Point p) { return inside(look_, p) > 0; };
    addSurface(model, coarse, carriers, [&](Point p) { return hidden(p) || refined(p) || cloth(p); });
    if (look_.dress != Dress::Loincloth)
      addSurface(model, linen, carriers, [&](Point p) { return hidden(p) || !cloth(p); });
    Part details;
    details.finish = coarse.finish;
    for (const Region& r : fine) add(details, clay_.cast(r.step, r.low, r.high, colour));
    head_.straighten(details, neck_);
    for (Vertex& v : details.vertices) v.colour = bareColour(v.p, v.n);
    addSurface(model, details, carriers);
    addSkirt(model, cut);
  }

private:
  /// Moves vertices near the edge of the cloth onto it, along the surface.
  void drawToEdge(Part& part) const {
    constexpr double h = 1e-4;
    for (Vertex& v : part.vertices) {
      const double edge = inside(look_, v.p);
      if (std::fabs(edge) > 0.6 * kCoarseStep || v.p.z < kBelt) continue;
      Point slope{inside(look_, v.p + Point{h, 0, 0}) - edge, inside(look_, v.p + Point{0, h, 0}) - edge,
                  inside(look_, v.p + Point{0, 0, h}) - edge};
      slope = 1 / h * slope;
      slope = slope - dot(slope, v.n) * v.n;
      const double steep = dot(slope, slope);
      if (steep > 0.05 && std::fabs(edge) / std::sqrt(steep) < 0.55 * kCoarseStep)
        v.p = v.p - (edge / steep) * slope;
    }
  }

  Rgb clothColour(Point p, Point n) const {
    const double open = clay_.open(p, n, 0.022), edge = inside(look_, p);
    const Rgb linen = linenColour(look_.cloth, hang(look_, p), open, n);
    return mix(linenColour(look_.border, 0.5, open, n), linen, smoothstep(0.022, 0.034, edge));
  }

  Rgb bareColour(Point p, Point n) const {
    const double open = clay_.open(p, n, p.z > neck_.z + 0.06 ? 0.006 : 0.022);
    const Rgb skin = skinColour(look_, p, n, open);
    if (p.z > neck_.z + 0.02) return head_.colour(p - neck_, skin);
    const Point nipple{0.098, 0.105, kChestHeight + 0.262};
    const double near = length(Point{std::fabs(p.x), p.y, p.z} - nipple);
    return p.y > 0 && near < 0.03 ? mix(times({0.72, 0.52, 0.48}, skin), skin, smoothstep(0.008, 0.020, near))
                                  : skin;
  }

  void addSkirt(FigureModel& model, const Cut& cut) const {
    Clay clay;
    const double w = cut.wide;
    clay.rods({0.050, -0.006, kBelt - 0.04}, {0.098 + 0.3 * w, -0.002, cut.hem - 0.05}, 0.112, 0.124 + w,
              0.09);
    clay.ball({0, -0.004, kBelt - 0.01}, {0.146 * look_.girth, 0.112 * look_.girth, 0.07}, 0.05);
    clay.balls({0.070, -0.058, 0.885}, {0.092, 0.086, 0.095}, 0.05);
    const auto deep = [=](Point p) { return smoothstep(kBelt - 0.02, cut.hem, p.z); };
    constexpr double step = 0.0155, band = 0.0135;
    const auto belt = [](Point p) { return smoothstep(band + 0.004, band - 0.003, std::fabs(p.z - kBelt)); };
    clay.relief([=](Point p) { return cut.deep * deep(p) * pleatAt(p, cut.count) + 0.007 * belt(p); });
    Part part = clay.cast(step, [](Point, Point) { return Rgb{1, 1, 1}; });
    part.finish = {"linen", "", 0.9, 0};
    const double border = cut.hem + 0.024;
    for (Vertex& v : part.vertices) {
      if (v.p.z < cut.hem) v.p.z = cut.hem;
      for (const double level : {border, kBelt - band, kBelt + band})
        if (std::fabs(v.p.z - level) < 0.5 * step) v.p.z = level;
      const double fold = mix(0.4 * (noise(30 * v.p) - 0.5), pleatAt(v.p, cut.count), deep(v.p));
      const double open = clay.open(v.p, v.n, 0.02);
      if (std::fabs(v.p.z - kBelt) < band + 1e-6)
        v.colour = mix(0.75, 1.0, noise(60 * v.p)) * Rgb{0.44, 0.27, 0.15};
      else
        v.colour = linenColour(v.p.z < border + 1e-6 ? look_.border : look_.cloth, fold, open, v.n);
      // Above the belt it is tucked in.
      if (v.p.z > kBelt + band + 1e-6) v.p.x *= 0.86, v.p.y = 0.84 * v.p.y;
    }
    addSurface(
        model, part, [&](Point p) { return skirtCarriers(p, cut); },
        [&](Point p) { return p.z > kBelt + 0.045 || p.z < cut.hem + 1e-6; });
  }

  /// The legs take the skirt along, each its own side.
  static Carriers skirtCarriers(Point p, const Cut& cut) {
    std::vector<double> shares(static_cast<std::size_t>(boneOf(Joint::LeftFoot)) + 1);
    const double legs = 0.92 * smoothstep(kBelt - 0.03, std::max(cut.hem, 0.70), p.z),
                 right = smoothstep(-0.09, 0.09, p.x);
    shares[static_cast<std::size_t>(boneOf(Joint::Pelvis))] = 1 - legs;
    shares[static_cast<std::size_t>(boneOf(Joint::RightThigh))] = legs * right;
    shares[static_cast<std::size_t>(boneOf(Joint::LeftThigh))] = legs * (1 - right);
    return carriersOf(std::move(shares));
  }

  Look look_;
  HeadClay head_;
  std::vector<Pose> rest_;
  Clay clay_;
  Point neck_{};
};

}  // namespace

void addAthlete(FigureModel& to, const Look& look) {
  Athlete(look).addTo(to);
}

}  // namespace stadion::assets
