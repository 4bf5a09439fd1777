#include "pipeline/sound/speaker_panning.h"

#include "engine/maths/angles.h"
#include "engine/maths/functions.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stadion {
namespace {

constexpr double kFlat = 15 * kDegree;        ///< elevations that differ by less make a ring
constexpr double kSteep = 60 * kDegree;       ///< a ring at a greater elevation has no azimuths
constexpr double kWidestGap = 120 * kDegree;  ///< of a ring, without virtual loudspeakers
constexpr double kEnclosed = 0.25;            ///< least distance of a face of the hull from the ears [1]
constexpr std::size_t kMostVirtual = 12;
constexpr double kClose = 0.25;    ///< nearer sounds come from more and more loudspeakers [m]
constexpr double kOverhead = 0.5;  ///< part of a direction that is level: below that, likewise [1]
constexpr double kMiddle = 0.05;   ///< sine of the azimuth of what is neither left nor right

double levelOf(const Vec3& d) {
  return std::sqrt(d.x() * d.x() + d.y() * d.y());
}

double elevationOf(const Vec3& d) {
  return det::atan2(d.z(), levelOf(d));
}

/// From +Y, to the right.
double azimuthOf(const Vec3& d) {
  return det::atan2(d.x(), d.y());
}

Vec3 atAzimuth(double a) {
  const auto [sine, cosine] = det::sincos(a);
  return Vec3(sine, cosine, 0);
}

/// Radii that differ a little. So no four points of a hull lie in a plane, and its triangles are the only ones.
double radiusOf(std::size_t i) {
  const double golden = 0.6180339887498949 * static_cast<double>(i + 1);
  return 1 + 1e-5 * (golden - std::floor(golden));
}

}  // namespace

SpeakerPanning::SpeakerPanning(const std::vector<Vec3>& directions) : count_(directions.size()) {
  for (const Vec3& d : directions) directions_.push_back(d.normalized());
  const auto [lowest, highest] =
      std::ranges::minmax(directions_, {}, [](const Vec3& d) { return elevationOf(d); });
  const double low = elevationOf(lowest), high = elevationOf(highest);
  ring_ = count_ < 3 || (high - low <= kFlat && std::fabs(low + high) / 2 <= kSteep);
  if (count_ < 2) return;
  if (ring_)
    makeRing();
  else
    makeSphere();
}

void SpeakerPanning::makeRing() {
  std::vector<std::size_t> order(count_);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<double> azimuths;
  for (const Vec3& d : directions_) azimuths.push_back(azimuthOf(d));
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return azimuths[i]; });
  for (Vec3& d : directions_) d = atAzimuth(azimuthOf(d));
  std::vector<std::size_t> around;  // with virtual ones in wide gaps
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::size_t here = order[k], next = order[(k + 1) % order.size()];
    around.push_back(here);
    const double gap = azimuths[next] - azimuths[here] + (k + 1 == order.size() ? 2 * kPi : 0);
    const auto parts = static_cast<int>(std::ceil(gap / kWidestGap - 1e-9));
    for (int i = 1; i < parts; ++i) {
      around.push_back(directions_.size());
      directions_.push_back(atAzimuth(azimuths[here] + gap * i / parts));
    }
  }
  std::vector<std::vector<std::size_t>> neighbours(directions_.size());
  for (std::size_t k = 0; k < around.size(); ++k) {
    const std::size_t a = around[k], b = around[(k + 1) % around.size()];
    Mat3 base = Mat3::Identity();
    base.col(0) = directions_[a];
    base.col(1) = directions_[b];
    if (std::fabs(base.determinant()) > 1e-9) sections_.push_back({{a, b, a}, base.inverse()});
    neighbours[a].push_back(b);
    neighbours[b].push_back(a);
  }
  shareVirtual(neighbours);
}

std::vector<SpeakerPanning::Section> SpeakerPanning::hull() const {
  const std::size_t n = directions_.size();
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < n; ++i) points.push_back(radiusOf(i) * directions_[i]);
  std::vector<Section> faces;
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a + 1; b < n; ++b)
      for (std::size_t c = b + 1; c < n; ++c) {
        const Vec3 normal = (points[b] - points[a]).cross(points[c] - points[a]);
        bool above = false, below = false;
        for (std::size_t i = 0; i < n && !(above && below); ++i) {
          if (i == a || i == b || i == c) continue;
          (normal.dot(points[i] - points[a]) > 0 ? above : below) = true;
        }
        if (!(above && below)) faces.push_back({{a, b, c}, Mat3::Zero()});
      }
  return faces;
}

/// Adds a virtual loudspeaker where the hull is open or wide. False if it is closed.
bool SpeakerPanning::addVirtual(std::vector<Section>& faces) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& d : directions_) middle += d;
  middle /= static_cast<double>(directions_.size());
  double least = kEnclosed;
  Vec3 open = Vec3::Zero();
  for (const Section& f : faces) {
    const Vec3 &a = directions_[f.corner[0]], &b = directions_[f.corner[1]], &c = directions_[f.corner[2]];
    Vec3 normal = (b - a).cross(c - a).normalized();
    if (normal.dot(middle - a) > 0) normal = -normal;
    if (normal.dot(a) >= least - 1e-9) continue;
    least = normal.dot(a);
    open = normal;
  }
  if (open.isZero() || directions_.size() >= count_ + kMostVirtual) return false;
  directions_.push_back(open);
  faces = hull();
  return true;
}

void SpeakerPanning::makeSphere() {
  std::vector<Section> faces = hull();
  while (addVirtual(faces)) {
  }
  std::vector<std::vector<std::size_t>> neighbours(directions_.size());
  for (Section& f : faces) {
    Mat3 base;
    for (int k = 0; k < 3; ++k) base.col(k) = directions_[f.corner[k]];
    if (std::fabs(base.determinant()) < 1e-9) continue;  // a triangle around nothing
    f.inverse = base.inverse();
    sections_.push_back(f);
    for (const std::size_t a : f.corner)
      for (const std::size_t b : f.corner)
        if (a != b && std::ranges::find(neighbours[a], b) == neighbours[a].end()) neighbours[a].push_back(b);
  }
  shareVirtual(neighbours);
}

/// Each virtual one gets the mean of its neighbours, of which some may be virtual: the means settle.
void SpeakerPanning::shareVirtual(const std::vector<std::vector<std::size_t>>& neighbours) {
  constexpr int kRounds = 200;
  const std::size_t virtuals = directions_.size() - count_;
  shares_.assign(virtuals, std::vector<double>(count_, 1.0 / static_cast<double>(count_)));
  for (int round = 0; round < kRounds; ++round)
    for (std::size_t v = 0; v < virtuals; ++v) {
      const std::vector<std::size_t>& around = neighbours[count_ + v];
      std::vector<double> mean(count_, 0);
      for (const std::size_t n : around)
        for (std::size_t s = 0; s < count_; ++s)
          mean[s] += (n < count_ ? (n == s ? 1.0 : 0.0) : shares_[n - count_][s]) /
                     static_cast<double>(around.size());
      if (!around.empty()) shares_[v] = mean;
    }
}

/// Energies of a sound from a unit direction, which add up to 1.
void SpeakerPanning::pan(const Vec3& direction, std::span<double> energies) const {
  const Section* best = nullptr;
  Vec3 gains = Vec3::Zero();
  double least = 0;
  for (const Section& s : sections_) {
    const Vec3 g = s.inverse * direction;
    const double worst = std::min({g[0], g[1], ring_ ? g[1] : g[2]});
    if (best && worst <= least) continue;
    best = &s;
    gains = g;
    least = worst;
  }
  if (ring_) gains[2] = 0;
  gains = gains.cwiseMax(0);
  const double sum = gains.squaredNorm();
  for (int k = 0; k < 3; ++k) {
    const double energy = gains[k] * gains[k] / sum;
    if (energy == 0) continue;
    const std::size_t corner = best->corner[k];
    if (corner < count_)
      energies[corner] += energy;
    else
      for (std::size_t s = 0; s < count_; ++s) energies[s] += energy * shares_[corner - count_][s];
  }
}

void SpeakerPanning::gainsOf(const Vec3& place, std::span<double> gains) const {
  const double distance = place.norm(), level = levelOf(place);
  double directed = std::min(1.0, distance / kClose);
  if (ring_ && distance > 0) directed *= std::min(1.0, level / (kOverhead * distance));
  if (count_ < 2 || directed <= 0) return gainsAround(gains);
  std::ranges::fill(gains, 0.0);
  pan(ring_ ? Vec3(place.x() / level, place.y() / level, 0) : Vec3(place / distance), gains);
  for (double& g : gains) g = std::sqrt(directed * g + (1 - directed) / static_cast<double>(count_));
}

void SpeakerPanning::gainsAround(std::span<double> gains) const {
  std::ranges::fill(gains, 1 / std::sqrt(static_cast<double>(count_)));
}

void SpeakerPanning::gainsOfSide(int side, std::span<double> gains) const {
  double sum = 0;
  for (std::size_t s = 0; s < count_; ++s) {
    const double x = directions_[s].x() * side;
    gains[s] = x > kMiddle ? 1.0 : x >= -kMiddle ? 0.5 : 0.0;  // energies
    sum += gains[s];
  }
  if (sum <= 0) return gainsAround(gains);
  for (double& g : gains) g = std::sqrt(g / sum);
}

}  // namespace stadion
