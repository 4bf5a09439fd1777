#include "assets/generator/craft/part.h"

#include <map>

namespace stadion::assets {

void add(Part& to, const Part& from, const Placement& place) {
  const auto first = static_cast<std::uint32_t>(to.vertices.size());
  for (Vertex v : from.vertices) {
    v.p = place.at + turned(times(place.size, v.p), place.yaw);
    const Point inverse{1 / place.size.x, 1 / place.size.y, 1 / place.size.z};
    if (dot(v.n, v.n) > 0) v.n = normalized(turned(times(inverse, v.n), place.yaw));
    to.vertices.push_back(v);
  }
  for (const auto& t : from.triangles) to.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

void addQuad(Part& to, const std::array<Vertex, 4>& corners) {
  const auto first = static_cast<std::uint32_t>(to.vertices.size());
  to.vertices.insert(to.vertices.end(), corners.begin(), corners.end());
  to.triangles.push_back({first, first + 1, first + 2});
  to.triangles.push_back({first, first + 2, first + 3});
}

void dropFlat(Part& part) {
  std::erase_if(part.triangles, [&](const auto& t) {
    const auto& v = part.vertices;
    return length(cross(v[t[1]].p - v[t[0]].p, v[t[2]].p - v[t[0]].p)) < 1e-8;
  });
}

void paint(Part& part, const std::function<Rgb(const Vertex&)>& colour) {
  for (Vertex& v : part.vertices) v.colour = colour(v);
}

void layPicture(Part& part, double metres) {
  std::vector<Vertex> vertices;
  for (auto& t : part.triangles) {
    const Point a = part.vertices[t[0]].p, b = part.vertices[t[1]].p, c = part.vertices[t[2]].p;
    const Point n = cross(b - a, c - a);
    const double x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
    for (auto& corner : t) {
      Vertex v = part.vertices[corner];
      if (z >= x && z >= y)
        v.uv = {v.p.x / metres, v.p.y / metres};
      else if (x >= y)
        v.uv = {v.p.y / metres, v.p.z / metres};
      else
        v.uv = {v.p.x / metres, v.p.z / metres};
      corner = static_cast<std::uint32_t>(vertices.size());
      vertices.push_back(v);
    }
  }
  part.vertices = std::move(vertices);
}

Part box(Point a, Point b) {
  const auto face = [](Part& part, Point p, Point q, Point r, Point s) {
    addQuad(part, {Vertex{p}, Vertex{q}, Vertex{r}, Vertex{s}});
  };
  Part part;
  face(part, {a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z});
  face(part, {a.x, b.y, a.z}, {b.x, b.y, a.z}, {b.x, a.y, a.z}, {a.x, a.y, a.z});
  face(part, {a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, a.y, b.z}, {a.x, a.y, b.z});
  face(part, {b.x, b.y, a.z}, {a.x, b.y, a.z}, {a.x, b.y, b.z}, {b.x, b.y, b.z});
  face(part, {a.x, b.y, a.z}, {a.x, a.y, a.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z});
  face(part, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}, {b.x, a.y, b.z});
  return part;
}

Part lathe(const std::vector<Turning>& outline, int sides) {
  Part part;
  const auto round = static_cast<std::uint32_t>(sides);
  std::vector<std::uint32_t> start;
  for (const Turning& t : outline) {
    start.push_back(static_cast<std::uint32_t>(part.vertices.size()));
    for (std::uint32_t i = 0; i < (t.r > 0 ? round : 1); ++i) {
      const auto [s, c] = det::sincos(2 * kPi * i / sides);
      part.vertices.push_back({{t.r * c, t.r * s, t.z}});
    }
  }
  for (std::size_t k = 0; k + 1 < outline.size(); ++k) {
    for (std::uint32_t i = 0; i < round; ++i) {
      const std::uint32_t j = (i + 1) % round, low = start[k], high = start[k + 1];
      if (outline[k].r > 0 && outline[k + 1].r > 0) {
        part.triangles.push_back({low + i, low + j, high + j});
        part.triangles.push_back({low + i, high + j, high + i});
      } else if (outline[k].r > 0) {
        part.triangles.push_back({low + i, low + j, high});
      } else if (outline[k + 1].r > 0) {
        part.triangles.push_back({low, high + j, high + i});
      }
    }
  }
  return part;
}

Part loft(const std::vector<Slice>& slices, int sides) {
  std::vector<Turning> outline{{0, 0}};
  for (std::size_t i = 0; i < slices.size(); ++i) outline.push_back({1, 0});
  outline.push_back({0, 0});
  Part part = lathe(outline, sides);
  const auto round = static_cast<std::size_t>(sides);
  part.vertices.front().p = slices.front().at;
  part.vertices.back().p = slices.back().at;
  for (std::size_t k = 0; k < slices.size(); ++k)
    for (std::size_t i = 0; i < round; ++i) {
      Point& p = part.vertices[1 + k * round + i].p;
      p = slices[k].at + times({slices[k].rx, slices[k].ry, 0}, p);
    }
  return part;
}

Part limb(Point a, Point b, double ra, double rb, int sides) {
  const double l = length(b - a);
  Part part = lathe({{0, -0.4 * ra}, {ra, 0}, {rb, l}, {0, l + 0.4 * rb}}, sides);
  const Point w = normalized(b - a);
  const Point u = normalized(cross(std::fabs(w.z) < 0.9 ? Point{0, 0, 1} : Point{0, 1, 0}, w)),
              v = cross(w, u);
  for (Vertex& vertex : part.vertices) vertex.p = a + vertex.p.x * u + vertex.p.y * v + vertex.p.z * w;
  return part;
}

Part sphere(int divisions) {
  const double h = 0.52573111211913360603, w = 0.85065080835203993218;
  const Point corners[] = {{-h, w, 0},  {h, w, 0},  {-h, -w, 0}, {h, -w, 0}, {0, -h, w},  {0, h, w},
                           {0, -h, -w}, {0, h, -w}, {w, 0, -h},  {w, 0, h},  {-w, 0, -h}, {-w, 0, h}};
  Part part;
  for (const Point& p : corners) part.vertices.push_back({p, {1, 1, 1}, {}, p});
  part.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int n = 0; n < divisions; ++n) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> halves;
    const auto half = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, fresh] =
          halves.emplace(std::minmax(a, b), static_cast<std::uint32_t>(part.vertices.size()));
      if (fresh) {
        const Point p = normalized(part.vertices[a].p + part.vertices[b].p);
        part.vertices.push_back({p, {1, 1, 1}, {}, p});
      }
      return at->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : part.triangles) {
      const std::uint32_t ab = half(a, b), bc = half(b, c), ca = half(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    part.triangles = std::move(finer);
  }
  return part;
}

Part grid(std::array<double, 2> low, std::array<double, 2> high, int columns, int rows) {
  Part part;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i)
      part.vertices.push_back(
          {{mix(low[0], high[0], double(i) / columns), mix(low[1], high[1], double(j) / rows), 0}});
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const auto a = static_cast<std::uint32_t>(j * (columns + 1) + i);
      const std::uint32_t b = a + 1, c = b + static_cast<std::uint32_t>(columns) + 1, d = c - 1;
      part.triangles.push_back({a, b, c});
      part.triangles.push_back({a, c, d});
    }
  }
  return part;
}

}  // namespace stadion::assets
