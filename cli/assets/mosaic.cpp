#include "cli/assets/mosaic.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace stadion::assets {
namespace {

constexpr double kSteps = 4096;

/// Twice the area of the triangle; positive when c lies to the left of a -> b.
std::int64_t turn(Spot a, Spot b, Spot c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

Spot crossing(Spot p, Spot q, std::int64_t dp, std::int64_t dq) {
  // Always from the same end, so that both neighbours of an edge get the same point.
  if (q < p) std::swap(p, q), std::swap(dp, dq);
  const double s = static_cast<double>(dp) / static_cast<double>(dp - dq);
  return {p.x + std::llround(s * static_cast<double>(q.x - p.x)),
          p.y + std::llround(s * static_cast<double>(q.y - p.y))};
}

Piece tidy(Piece piece) {
  piece.erase(std::unique(piece.begin(), piece.end()), piece.end());
  while (piece.size() > 1 && piece.front() == piece.back()) piece.pop_back();
  std::int64_t area = 0;
  for (std::size_t i = 1; i + 1 < piece.size(); ++i) area += turn(piece[0], piece[i], piece[i + 1]);
  if (area <= 0) piece.clear();
  return piece;
}

/// Splits by the line a -> b into what lies to its left and to its right.
void split(const Piece& piece, Spot a, Spot b, Piece& left, Piece& right) {
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Spot p = piece[i], q = piece[(i + 1) % piece.size()];
    const std::int64_t dp = turn(a, b, p), dq = turn(a, b, q);
    if (dp >= 0) left.push_back(p);
    if (dp <= 0) right.push_back(p);
    if ((dp > 0 && dq < 0) || (dp < 0 && dq > 0)) {
      const Spot c = crossing(p, q, dp, dq);
      left.push_back(c), right.push_back(c);
    }
  }
  left = tidy(std::move(left)), right = tidy(std::move(right));
}

bool apart(const Piece& a, const Piece& b) {
  const auto box = [](const Piece& p) {
    Spot lo = p[0], hi = p[0];
    for (Spot s : p)
      lo = {std::min(lo.x, s.x), std::min(lo.y, s.y)}, hi = {std::max(hi.x, s.x), std::max(hi.y, s.y)};
    return std::pair(lo, hi);
  };
  const auto [alo, ahi] = box(a);
  const auto [blo, bhi] = box(b);
  return ahi.x <= blo.x || bhi.x <= alo.x || ahi.y <= blo.y || bhi.y <= alo.y;
}

bool overlap(Piece piece, const Piece& shape) {
  for (std::size_t i = 0; i < shape.size() && !piece.empty(); ++i) {
    Piece left, right;
    split(piece, shape[i], shape[(i + 1) % shape.size()], left, right);
    piece = std::move(left);
  }
  return !piece.empty();
}

/// Between p and q and no farther from the line than rounding has moved it.
bool onSide(Spot p, Spot q, Spot s) {
  const std::int64_t dx = q.x - p.x, dy = q.y - p.y;
  const std::int64_t along = (s.x - p.x) * dx + (s.y - p.y) * dy, length = dx * dx + dy * dy;
  if (along <= 0 || along >= length) return false;
  const double off = std::fabs(static_cast<double>(turn(p, q, s))) / std::sqrt(static_cast<double>(length));
  return off < 2.0;
}

Piece withNeighboursCorners(const Piece& piece, const std::set<Spot>& corners) {
  Piece out;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Spot p = piece[i], q = piece[(i + 1) % piece.size()];
    out.push_back(p);
    std::vector<Spot> between;
    const std::int64_t lo = std::min(p.x, q.x) - 2, hi = std::max(p.x, q.x) + 2;
    for (auto at = corners.lower_bound({lo, INT64_MIN}); at != corners.end() && at->x <= hi; ++at)
      if (*at != p && *at != q && onSide(p, q, *at)) between.push_back(*at);
    const auto along = [&](Spot s) { return (s.x - p.x) * (q.x - p.x) + (s.y - p.y) * (q.y - p.y); };
    std::sort(between.begin(), between.end(), [&](Spot a, Spot b) { return along(a) < along(b); });
    out.insert(out.end(), between.begin(), between.end());
  }
  return out;
}

double sharpest(Spot a, Spot b, Spot c) {
  const auto length = [](Spot p, Spot q) {
    const auto dx = static_cast<double>(q.x - p.x), dy = static_cast<double>(q.y - p.y);
    return dx * dx + dy * dy;
  };
  return static_cast<double>(turn(a, b, c)) / std::max({length(a, b), length(b, c), length(c, a)});
}

/// Cuts ears off, the best shaped first, and never so that nothing but a line is left.
std::vector<std::array<Spot, 3>> triangulate(Piece rest) {
  std::vector<std::array<Spot, 3>> out;
  while (rest.size() > 3) {
    const std::size_t n = rest.size();
    std::size_t best = n;
    double quality = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Spot a = rest[(i + n - 1) % n], b = rest[i], c = rest[(i + 1) % n];
      const double q = sharpest(a, b, c);
      if (q <= quality) continue;
      Piece left = rest;
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
      if (tidy(left).empty()) continue;
      best = i, quality = q;
    }
    if (best == n) return out;
    out.push_back({rest[(best + n - 1) % n], rest[best], rest[(best + 1) % n]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(best));
  }
  out.push_back({rest[0], rest[1], rest[2]});
  return out;
}

}  // namespace

Spot spot(double x, double y) {
  return {std::llround(x * kSteps), std::llround(y * kSteps)};
}

void Mosaic::paint(const Piece& shape, std::uint32_t paint) {
  std::vector<Tile> next;
  for (Tile& tile : tiles_) {
    if (apart(tile.outline, shape) || !overlap(tile.outline, shape)) {
      next.push_back(std::move(tile));
      continue;
    }
    Piece inside = std::move(tile.outline);
    for (std::size_t i = 0; i < shape.size() && !inside.empty(); ++i) {
      Piece left, right;
      split(inside, shape[i], shape[(i + 1) % shape.size()], left, right);
      if (!right.empty()) next.push_back({std::move(right), tile.paint});
      inside = std::move(left);
    }
    if (!inside.empty()) next.push_back({std::move(inside), paint});
  }
  tiles_ = std::move(next);
}

void Mosaic::triangulateInto(Model& model) const {
  std::set<Spot> corners;
  for (const Tile& tile : tiles_) corners.insert(tile.outline.begin(), tile.outline.end());
  std::map<Spot, std::uint32_t> known;
  const auto vertex = [&](Spot s) {
    const auto [at, fresh] = known.emplace(s, static_cast<std::uint32_t>(model.points.size()));
    if (fresh)
      model.points.push_back({static_cast<double>(s.x) / kSteps, static_cast<double>(s.y) / kSteps, 0});
    return at->second;
  };
  for (const Tile& tile : tiles_)
    for (const auto& t : triangulate(withNeighboursCorners(tile.outline, corners)))
      if (turn(t[0], t[1], t[2]) > 0)
        model.triangles.push_back({{vertex(t[0]), vertex(t[1]), vertex(t[2])}, tile.paint});
}

}  // namespace stadion::assets
