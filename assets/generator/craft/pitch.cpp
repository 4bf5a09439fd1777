#include "assets/generator/craft/models.h"
#include "assets/generator/craft/mosaic.h"

#include <cmath>

namespace stadion::assets {
namespace {

// The laws of the game, in metres. Lines belong to the areas that they bound.
constexpr double kHalfLength = 52.5, kHalfWidth = 34, kLine = 0.12, kBorder = 70;
constexpr double kCircle = 9.15, kSpot = 0.11, kPenaltySpot = 11;
constexpr int kStripes = 20;
constexpr double kTile = 4;  // the grass picture covers 4 x 4 m
enum : std::uint32_t { Light, Dark, Rough, Chalk };

Piece box(double x0, double y0, double x1, double y1) {
  return {spot(x0, y0), spot(x1, y0), spot(x1, y1), spot(x0, y1)};
}

// A frame of lines with given outer edges. The sides may reach beyond the pitch's end line and are cut there.
void paintFrame(Mosaic& field, double x, double y0, double y1) {
  field.paint(box(-x, y0, -x + kLine, y1), Chalk);
  field.paint(box(x - kLine, y0, x, y1), Chalk);
  field.paint(box(-x, y0, x, y0 + kLine), Chalk);
  field.paint(box(-x, y1 - kLine, x, y1), Chalk);
}

struct Direction {
  double c, s;
};

// Directions around the circle in 96 steps: halving a right angle and turning by thirds needs square roots
// only.
std::vector<Direction> circle() {
  const auto half = [](Direction d) { return Direction{std::sqrt((1 + d.c) / 2), std::sqrt((1 - d.c) / 2)}; };
  const Direction thirty{std::sqrt(0.75), 0.5};
  const Direction step = half(half(half(thirty)));  // 3.75 degrees
  std::vector<Direction> all{{1, 0}};
  while (all.size() < 96) {
    const Direction d = all.back();
    all.push_back({d.c * step.c - d.s * step.s, d.s * step.c + d.c * step.s});
  }
  return all;
}

// The part of a circular line with y above (side = 1) or below (-1) `from`; all of it when side is 0.
void paintArc(Mosaic& field, double y, double radius, int side = 0, double from = 0) {
  const std::vector<Direction> round = circle();
  for (std::size_t i = 0; i < round.size(); ++i) {
    const Direction a = round[i], b = round[(i + 1) % round.size()];
    const double lower = y + radius * std::min(a.s, b.s), upper = y + radius * std::max(a.s, b.s);
    if ((side > 0 && lower < from) || (side < 0 && upper > from)) continue;
    const double in = radius - kLine;
    field.paint({spot(in * a.c, y + in * a.s), spot(radius * a.c, y + radius * a.s),
                 spot(radius * b.c, y + radius * b.s), spot(in * b.c, y + in * b.s)},
                Chalk);
  }
}

void paintSpot(Mosaic& field, double y) {
  const std::vector<Direction> round = circle();
  Piece disc;
  for (std::size_t i = 0; i < round.size(); i += 6)
    disc.push_back(spot(kSpot * round[i].c, y + kSpot * round[i].s));
  field.paint(disc, Chalk);
}

void layGrass(Mosaic& field) {
  const double step = 2 * kHalfLength / kStripes;
  const double columns[] = {-kBorder, -kHalfWidth - 2.5, 0, kHalfWidth + 2.5, kBorder};
  for (int c = 0; c < 4; ++c) {
    const double x0 = columns[c], x1 = columns[c + 1];
    for (int i = 0; i < kStripes; ++i) {
      const double y = -kHalfLength + i * step;
      field.lay(box(x0, y, x1, y + step), c == 0 || c == 3 ? Rough : i % 2 == 0 ? Light : Dark);
    }
    field.lay(box(x0, -kBorder, x1, -kHalfLength), Rough);
    field.lay(box(x0, kHalfLength, x1, kBorder), Rough);
  }
}

void paintLines(Mosaic& field) {
  paintFrame(field, kHalfWidth, -kHalfLength, kHalfLength);
  field.paint(box(-kHalfWidth, -kLine / 2, kHalfWidth, kLine / 2), Chalk);
  paintArc(field, 0, kCircle);
  paintSpot(field, 0);
  for (int end : {-1, 1}) {
    const auto ends = [end](double depth) {
      const double a = end * kHalfLength, b = end * (kHalfLength - depth);
      return std::pair(std::min(a, b), std::max(a, b));
    };
    const auto [p0, p1] = ends(16.5);
    paintFrame(field, 20.16, p0, p1);
    const auto [g0, g1] = ends(5.5);
    paintFrame(field, 9.16, g0, g1);
    const double y = end * (kHalfLength - kPenaltySpot);
    paintSpot(field, y);
    paintArc(field, y, kCircle, -end, end * (kHalfLength - 16.5));
  }
}

}  // namespace

Model pitch() {
  Model model;
  model.name = "field";
  model.paints = {{"light grass", {236, 244, 226}, "grass.png", 4},
                  {"dark grass", {186, 204, 178}, "grass.png", 4},
                  {"rough grass", {206, 206, 176}, "grass.png", 4},
                  {"chalk", {240, 242, 236}, "", 4}};
  Mosaic field;
  layGrass(field);
  paintLines(field);
  field.triangulateInto(model);
  for (const Point& p : model.points)
    model.uvs.push_back({static_cast<float>(p.x / kTile), static_cast<float>(p.y / kTile)});
  return model;
}

}  // namespace stadion::assets
