#include "assets/generator/craft/models.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

// An icosahedron stands on one corner. Each side is divided into a triangular grid. Its lines pass through
// the thirds of the edges, where the truncation cuts, and the grid is pushed out to the sphere. The seam
// between two hexagons runs along the middle third of an edge: there the first row of the grid is split once
// more.

namespace stadion::assets {
namespace {

constexpr double kRadius = 0.11;  // [m]
constexpr int kGrid = 9;          // divisible by 3
constexpr double kSeam = 0.13;    // width of half a seam, in grid steps
enum : std::uint32_t { White, Black, Seam };

using Weights = std::array<double, 3>;  // barycentric, in grid steps: they sum to kGrid

Point onUnitSphere(Point p) {
  return (1 / std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z)) * p;
}

std::array<Point, 12> icosahedron() {
  // Two rings of five around the axis, at heights -+1/sqrt(5), radius 2/sqrt(5), turned by 36 degrees.
  const double s5 = std::sqrt(5.0), h = 1 / s5, r = 2 / s5;
  const double c72 = (s5 - 1) / 4, s72 = std::sqrt(10 + 2 * s5) / 4;
  const double c36 = (s5 + 1) / 4, s36 = std::sqrt(10 - 2 * s5) / 4;
  return {{{0, 0, -1},
           {0, r, -h},
           {-r * s72, r * c72, -h},
           {-r * s36, -r * c36, -h},
           {r * s36, -r * c36, -h},
           {r * s72, r * c72, -h},
           {-r * s36, r * c36, h},
           {-r * s72, -r * c72, h},
           {0, -r, h},
           {r * s72, -r * c72, h},
           {r * s36, r * c36, h},
           {0, 0, 1}}};
}

class Ball {
public:
  Ball() : corners_(icosahedron()) {
    model_.name = "football";
    model_.paints = {{"white", {238, 238, 232}, "", 45},
                     {"black", {28, 28, 32}, "", 45},
                     {"seam", {150, 150, 148}, "", 10}};
    for (int i = 0; i < 5; ++i) {
      const int j = (i + 1) % 5;
      side(0, 1 + j, 1 + i);
      side(1 + i, 1 + j, 6 + i);
      side(6 + i, 1 + j, 6 + j);
      side(6 + i, 6 + j, 11);
    }
  }
  Model take() { return std::move(model_); }

private:
  std::uint32_t vertex(const std::array<int, 3>& side, const Weights& w) {
    Point p{0, 0, 0};
    for (int k = 0; k < 3; ++k) p = p + w[k] * corners_[side[k]];
    p = kRadius * onUnitSphere(p);
    // Neighbouring sides add up in another order: a rounded key finds the common points.
    const auto key = std::make_tuple(std::lround(p.x * 1e7), std::lround(p.y * 1e7), std::lround(p.z * 1e7));
    const auto [at, fresh] = known_.emplace(key, static_cast<std::uint32_t>(model_.points.size()));
    if (fresh) model_.points.push_back({p.x, p.y, p.z + kRadius});
    return at->second;
  }

  void side(int a, int b, int c) {
    const std::array<int, 3> corners{a, b, c};
    for (int i = 0; i < kGrid; ++i) {
      for (int j = 0; i + j < kGrid; ++j) {
        const double u = i, v = j, w = kGrid - i - j;
        cell(corners, {Weights{u, v, w}, Weights{u + 1, v, w - 1}, Weights{u, v + 1, w - 1}});
        if (i + j + 2 <= kGrid)
          cell(corners, {Weights{u + 1, v, w - 1}, Weights{u + 1, v + 1, w - 2}, Weights{u, v + 1, w - 1}});
      }
    }
  }

  static bool onSeam(const Weights& w, int k) {
    return w[k] == 0 && w[(k + 1) % 3] >= kGrid / 3.0 && w[(k + 2) % 3] >= kGrid / 3.0;
  }

  // One triangle of the grid: a fan over its corners and the points that the seams put on its sides.
  void cell(const std::array<int, 3>& side, const std::array<Weights, 3>& corner) {
    Weights middle{};
    for (int k = 0; k < 3; ++k) middle[k] = (corner[0][k] + corner[1][k] + corner[2][k]) / 3;
    const bool black = std::max({middle[0], middle[1], middle[2]}) > 2 * kGrid / 3.0;
    std::vector<Weights> outline;
    for (int n = 0; n < 3; ++n) {
      const Weights &from = corner[n], &to = corner[(n + 1) % 3];
      outline.push_back(from);
      for (int k = 0; k < 3; ++k) {
        if (onSeam(from, k) && to[k] == 1) outline.push_back(blend(from, to, kSeam));
        if (onSeam(to, k) && from[k] == 1) outline.push_back(blend(to, from, kSeam));
      }
    }
    // The fan starts behind a seam point, so that the cut between seam and panel is one of its edges.
    const auto start =
        std::find_if(outline.begin(), outline.end(), [](const Weights& w) { return cut(w) >= 0; });
    if (start != outline.end()) std::rotate(outline.begin(), start, outline.end());
    for (std::size_t n = 1; n + 1 < outline.size(); ++n) {
      const std::array<Weights, 3> t{outline[0], outline[n], outline[n + 1]};
      emit(side, t, black ? Black : inSeam(t) ? Seam : White);
    }
  }

  static Weights blend(const Weights& a, const Weights& b, double s) {
    Weights w;
    for (int k = 0; k < 3; ++k) w[k] = a[k] + s * (b[k] - a[k]);
    return w;
  }

  // Which weight says that the point lies on the border of a seam, or -1.
  static int cut(const Weights& w) {
    for (int k = 0; k < 3; ++k)
      if (w[k] == kSeam) return k;
    return -1;
  }

  static bool inSeam(const std::array<Weights, 3>& t) {
    for (int k = 0; k < 3; ++k)
      if (std::all_of(t.begin(), t.end(), [k](const Weights& w) { return w[k] <= kSeam; })) return true;
    return false;
  }

  void emit(const std::array<int, 3>& side, const std::array<Weights, 3>& t, std::uint32_t paint) {
    model_.triangles.push_back({{vertex(side, t[0]), vertex(side, t[1]), vertex(side, t[2])}, paint});
  }

  std::array<Point, 12> corners_;
  Model model_;
  std::map<std::tuple<long, long, long>, std::uint32_t> known_;
};

}  // namespace

Model football() {
  return Ball().take();
}

}  // namespace stadion::assets
