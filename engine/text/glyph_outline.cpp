#include "engine/text/glyph_outline.h"

#include "engine/maths/angles.h"
#include "engine/maths/functions.h"
#include "engine/text/glyphs.h"

#include <charconv>
#include <cmath>

namespace stadion {
namespace {

constexpr double kHalf = kStrokeWidth / 2;
constexpr double kHalfDot = 8.5;
constexpr double kChord = 10;        // [degrees]
constexpr double kSteep = 0.65;      // straight ends that rise by less of their length are cut square
constexpr double kLeastMitre = 0.4;  // sharper corners are cut short

/// The middle of a stroke.
struct Line {
  std::vector<GlyphPoint> points;
  bool closed = false, arcFirst = false, arcLast = false;

  void add(GlyphPoint p, bool onArc) {
    if (!points.empty() && std::fabs(points.back().x - p.x) + std::fabs(points.back().y - p.y) < 1e-3) return;
    points.push_back(p);
    if (points.size() == 2) arcFirst = onArc;
    arcLast = onArc;
  }
};

GlyphPoint direction(GlyphPoint from, GlyphPoint to) {
  const double x = to.x - from.x, y = to.y - from.y, length = std::sqrt(x * x + y * y);
  return {x / length, y / length};
}

/// From the middle to the left rail, at an end of a stroke that goes along d.
GlyphPoint endCut(GlyphPoint d, bool arc) {
  if (!arc && std::fabs(d.y) >= kSteep) return {-kHalf / d.y, 0};
  return {-kHalf * d.y, kHalf * d.x};
}

/// The same at a corner.
GlyphPoint mitre(GlyphPoint d, GlyphPoint e) {
  GlyphPoint m{-d.y - e.y, d.x + e.x};
  const double length = std::max(std::sqrt(m.x * m.x + m.y * m.y), 1e-6);
  m = {m.x / length, m.y / length};
  const double along = kHalf / std::max(-m.x * d.y + m.y * d.x, kLeastMitre);
  return {m.x * along, m.y * along};
}

Band widened(Line line) {
  if (line.closed && line.points.size() > 2) {
    const GlyphPoint a = line.points.front(), b = line.points.back();
    if (std::fabs(a.x - b.x) + std::fabs(a.y - b.y) < 1e-3) line.points.pop_back();
  }
  Band band;
  band.closed = line.closed;
  const auto& p = line.points;
  const std::size_t n = p.size();
  for (std::size_t i = 0; n > 1 && i < n; ++i) {
    const bool first = i == 0 && !line.closed, last = i + 1 == n && !line.closed;
    const GlyphPoint d = first ? direction(p[0], p[1]) : direction(p[(i + n - 1) % n], p[i]);
    const GlyphPoint e = last ? d : direction(p[i], p[(i + 1) % n]);
    const GlyphPoint o = first ? endCut(e, line.arcFirst) : last ? endCut(d, line.arcLast) : mitre(d, e);
    band.left.push_back({p[i].x + o.x, p[i].y + o.y});
    band.right.push_back({p[i].x - o.x, p[i].y - o.y});
  }
  return band;
}

class PathReader {
public:
  explicit PathReader(std::string_view path) : rest_(path) {}

  std::vector<Band> read() {
    while (!rest_.empty()) {
      const char command = rest_.front();
      rest_.remove_prefix(1);
      switch (command) {
      case 'M':
        end();
        line_.add(point(), false);
        break;
      case 'L': line_.add(point(), false); break;
      case 'A': arc(); break;
      case 'Z':
        line_.closed = true;
        end();
        break;
      case 'D':
        end();
        dot(point());
        break;
      default: end(); break;  // ;
      }
    }
    end();
    return std::move(bands_);
  }

private:
  double number() {
    while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
    double x = 0;
    const auto [next, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), x);
    static_cast<void>(error);
    rest_.remove_prefix(static_cast<std::size_t>(next - rest_.data()));
    return x;
  }
  GlyphPoint point() {
    const double x = number(), y = number();
    return {x, y};
  }
  void arc() {
    const GlyphPoint centre = point(), radius = point();
    const double from = number(), turn = number() - from;
    const int chords = static_cast<int>(std::ceil(std::fabs(turn) / kChord));
    for (int i = 0; i <= chords; ++i) {
      const double angle = (from + turn * i / chords) * kDegree;
      line_.add({centre.x + radius.x * det::cos(angle), centre.y + radius.y * det::sin(angle)}, true);
    }
  }
  void dot(GlyphPoint p) {
    bands_.push_back({{{p.x - kHalfDot, p.y - kHalfDot}, {p.x - kHalfDot, p.y + kHalfDot}},
                      {{p.x + kHalfDot, p.y - kHalfDot}, {p.x + kHalfDot, p.y + kHalfDot}},
                      false});
  }
  void end() {
    if (line_.points.size() > 1) bands_.push_back(widened(std::move(line_)));
    line_ = {};
  }

  std::string_view rest_;
  Line line_;
  std::vector<Band> bands_;
};

}  // namespace

std::vector<Band> bandsOf(std::string_view path) {
  return PathReader(path).read();
}

}  // namespace stadion
