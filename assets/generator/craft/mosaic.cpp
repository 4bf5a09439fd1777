#include "assets/generator/craft/mosaic.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

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

std::int64_t area(const Piece& piece) {
  std::int64_t twice = 0;
  for (std::size_t i = 1; i + 1 < piece.size(); ++i) twice += turn(piece[0], piece[i], piece[i + 1]);
  return twice;
}

/// Which side of the line a -> b: 1 left, -1 right, 0 on it within what rounding may have moved a point.
int sideOf(Spot a, Spot b, Spot p) {
  const std::int64_t dx = b.x - a.x, dy = b.y - a.y, d = turn(a, b, p);
  const double off = static_cast<double>(d) / std::sqrt(static_cast<double>(dx * dx + dy * dy));
  return std::fabs(off) < 3 ? 0 : off > 0 ? 1 : -1;
}

struct Cut {
  Spot from, to, at;  ///< the edge from -> to got the new corner `at`
};

/// Splits by the line a -> b into what lies to its left and to its right.
void split(const Piece& piece, Spot a, Spot b, Piece& left, Piece& right, std::vector<Cut>& cuts) {
  bool anyLeft = false, anyRight = false;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Spot p = piece[i], q = piece[(i + 1) % piece.size()];
    const int sp = sideOf(a, b, p), sq = sideOf(a, b, q);
    anyLeft |= sp > 0, anyRight |= sp < 0;
    if (sp >= 0) left.push_back(p);
    if (sp <= 0) right.push_back(p);
    if (sp * sq >= 0) continue;
    const Spot c = crossing(p, q, turn(a, b, p), turn(a, b, q));
    left.push_back(c), right.push_back(c);
    if (c != p && c != q) cuts.push_back({p, q, c});
  }
  if (!anyLeft) left.clear();
  if (!anyRight && anyLeft) right.clear();  // what is all on the line stays as it is
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
  std::vector<Cut> unused;
  for (std::size_t i = 0; i < shape.size() && !piece.empty(); ++i) {
    Piece left, right;
    split(piece, shape[i], shape[(i + 1) % shape.size()], left, right, unused);
    piece = std::move(left);
  }
  return !piece.empty();
}

double sharpest(Spot a, Spot b, Spot c) {
  const auto length = [](Spot p, Spot q) {
    const auto dx = static_cast<double>(q.x - p.x), dy = static_cast<double>(q.y - p.y);
    return dx * dx + dy * dy;
  };
  return static_cast<double>(turn(a, b, c)) / std::max({length(a, b), length(b, c), length(c, a)});
}

/// True if the corners lie on one line but for what rounding has moved them.
bool onlyALine(const Piece& piece) {
  std::int64_t reach = 0;
  for (const Spot s : piece) reach = std::max(reach, std::abs(s.x - piece[0].x) + std::abs(s.y - piece[0].y));
  return area(piece) <= 8 * reach;
}

/// The corner to cut off next: the best shaped, but never so that nothing but a line is left while that can
/// be helped.
std::size_t bestEar(const Piece& piece) {
  const std::size_t n = piece.size();
  std::size_t best = n;
  std::pair<bool, double> quality{false, 0};
  for (std::size_t i = 0; i < n; ++i) {
    const double shape = sharpest(piece[(i + n - 1) % n], piece[i], piece[(i + 1) % n]);
    if (shape <= 0) continue;
    Piece left = piece;
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
    const std::pair<bool, double> q{!onlyALine(left), shape};
    if (q > quality) best = i, quality = q;
  }
  return best;
}

std::vector<std::array<Spot, 3>> triangulate(Piece rest) {
  std::vector<std::array<Spot, 3>> out;
  while (rest.size() > 3) {
    const std::size_t n = rest.size(), best = bestEar(rest);
    if (best == n) return out;
    out.push_back({rest[(best + n - 1) % n], rest[best], rest[(best + 1) % n]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(best));
  }
  if (rest.size() == 3) out.push_back({rest[0], rest[1], rest[2]});
  return out;
}

}  // namespace

Spot spot(double x, double y) {
  return {std::llround(x * kSteps), std::llround(y * kSteps)};
}

// The tile on the other side of a cut edge gets the new corner as well, so that corners always meet corners.
void Mosaic::insert(Spot from, Spot to, Spot at) {
  for (Tile& tile : tiles_) {
    Piece& outline = tile.outline;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const std::size_t next = (i + 1) % outline.size();
      if (outline[i] != to || outline[next] != from) continue;
      outline.insert(outline.begin() + static_cast<std::ptrdiff_t>(i + 1), at);
      return;
    }
  }
}

void Mosaic::paint(const Piece& shape, std::uint32_t paint) {
  const std::size_t before = tiles_.size();
  for (std::size_t t = 0; t < before; ++t) {
    if (apart(tiles_[t].outline, shape) || !overlap(tiles_[t].outline, shape)) continue;
    Piece inside = std::exchange(tiles_[t].outline, {});
    const std::uint32_t old = tiles_[t].paint;
    for (std::size_t i = 0; i < shape.size() && !inside.empty(); ++i) {
      Piece left, right;
      std::vector<Cut> cuts;
      split(inside, shape[i], shape[(i + 1) % shape.size()], left, right, cuts);
      for (const Cut& cut : cuts) insert(cut.from, cut.to, cut.at);
      if (!right.empty()) tiles_.push_back({std::move(right), old});
      inside = std::move(left);
    }
    tiles_[t] = {std::move(inside), paint};
  }
}

void Mosaic::triangulateInto(Model& model) const {
  std::map<Spot, std::uint32_t> known;
  const auto vertex = [&](Spot s) {
    const auto [at, fresh] = known.emplace(s, static_cast<std::uint32_t>(model.points.size()));
    if (fresh)
      model.points.push_back({static_cast<double>(s.x) / kSteps, static_cast<double>(s.y) / kSteps, 0});
    return at->second;
  };
  for (const Tile& tile : tiles_)
    for (const auto& t : triangulate(tile.outline))
      if (turn(t[0], t[1], t[2]) > 0)
        model.triangles.push_back({{vertex(t[0]), vertex(t[1]), vertex(t[2])}, tile.paint});
}

}  // namespace stadion::assets
