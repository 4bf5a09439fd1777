#include "engine/display/wall_facing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace stadion {
namespace {

constexpr double kClear = 0.01;   ///< so far in front of a wall is certainly in front of it [m]
constexpr int kMostSteps = 4000;  ///< of the search for a point in front of every wall
using WallSet = std::vector<bool>;

struct WallSide {
  Vec3 normal, through;
  double inFront(const Vec3& p) const { return normal.dot(p - through); }
};

class Room {
public:
  explicit Room(const std::vector<WallEntry>& walls) {
    for (const WallEntry& e : walls) {
      const Wall& w = e.wall;
      sides_.push_back({basis(w).normal, w.lowerLeft});
      middle_ += w.centre() / static_cast<double>(walls.size());
      for (const Vec3& corner : {w.lowerLeft, w.lowerRight, w.upperLeft, w.upperRight()})
        corners_.push_back(corner);
    }
  }

  std::size_t size() const { return sides_.size(); }
  double inFront(std::size_t wall, const Vec3& p) const { return sides_[wall].inFront(p); }
  WallSet behind(const Vec3& p, double clear) const {
    WallSet set(size());
    for (std::size_t i = 0; i < size(); ++i) set[i] = sides_[i].inFront(p) < -clear;
    return set;
  }
  const Vec3& middle() const { return middle_; }

  /// All walls lie in one plane.
  bool flat() const {
    return std::ranges::all_of(sides_, [&](const WallSide& side) {
      return std::ranges::all_of(corners_,
                                 [&](const Vec3& c) { return std::fabs(side.inFront(c)) < kClear; });
    });
  }

  /// A point between the corners is in front of every wall once those of `mirrored` are turned round.
  /// Fictitious play: the point goes towards the corner that is best for the walls that it was behind so far.
  bool hasInterior(const WallSet& mirrored) const {
    Vec3 point = middle_, pull = Vec3::Zero();
    for (int step = 1; step <= kMostSteps; ++step) {
      double least = 1e300;
      Vec3 normal;
      for (std::size_t i = 0; i < size(); ++i) {
        const double sign = mirrored[i] ? -1 : 1, clear = sign * sides_[i].inFront(point);
        if (clear < least) {
          least = clear;
          normal = sign * sides_[i].normal;
        }
      }
      if (least > kClear) return true;
      pull += normal;
      const Vec3 best = *std::ranges::max_element(corners_, {}, [&](const Vec3& c) { return pull.dot(c); });
      point += (best - point) / (step + 1);
    }
    return false;
  }

private:
  std::vector<WallSide> sides_;
  std::vector<Vec3> corners_;
  Vec3 middle_ = Vec3::Zero();
};

bool any(const WallSet& set) {
  return std::ranges::find(set, true) != set.end();
}

/// Two edges whose ends are this near, as a part of their length, are meant to meet.
constexpr double kMeantToMeet = 0.15;

bool meet(const Wall& one, const Wall& two) {
  const auto edges = [](const Wall& w) {
    const Vec3 c[] = {w.lowerLeft, w.lowerRight, w.upperRight(), w.upperLeft};
    return std::array<std::pair<Vec3, Vec3>, 4>{{{c[0], c[1]}, {c[1], c[2]}, {c[2], c[3]}, {c[3], c[0]}}};
  };
  for (const auto& [a, b] : edges(one))
    for (const auto& [c, d] : edges(two)) {
      const double apart =
          std::min(std::max((a - c).norm(), (b - d).norm()), std::max((a - d).norm(), (b - c).norm()));
      if (apart <= kMeantToMeet * std::max((b - a).norm(), (d - c).norm())) return true;
    }
  return false;
}

/// The walls in groups that hang together by their edges, as numbers.
std::vector<std::vector<std::size_t>> groupsOf(const std::vector<WallEntry>& walls) {
  std::vector<std::vector<std::size_t>> groups;
  std::vector<bool> taken(walls.size());
  for (std::size_t first = 0; first < walls.size(); ++first) {
    if (taken[first]) continue;
    std::vector<std::size_t> group{first};
    taken[first] = true;
    for (std::size_t at = 0; at < group.size(); ++at)
      for (std::size_t other = first + 1; other < walls.size(); ++other)
        if (!taken[other] && meet(walls[group[at]].wall, walls[other].wall)) {
          taken[other] = true;
          group.push_back(other);
        }
    groups.push_back(std::move(group));
  }
  return groups;
}

/// Marks the walls of a group for which no place is in front of all.
class GroupFacing {
public:
  GroupFacing(const Room& room, const Vec3& standingEye, bool alone)
      : room_(room), fromEye_(room.behind(standingEye, 0)), fromMiddle_(room.behind(room.middle(), kClear)),
        alone_(alone) {}

  std::vector<Facing> facing() const {
    if (!any(fromEye_) || room_.hasInterior(WallSet(room_.size()))) return marked({}, Facing::Room);
    if (room_.flat()) return marked(fromEye_, alone_ ? Facing::Away : Facing::Unsure);
    if (room_.hasInterior(fromEye_)) return marked(fromEye_, Facing::Away);
    const bool tells = any(fromMiddle_);
    if (tells && room_.hasInterior(fromMiddle_)) return marked(fromMiddle_, Facing::Away);
    return marked(tells ? fromMiddle_ : fromEye_, Facing::Unsure);
  }

private:
  std::vector<Facing> marked(const WallSet& set, Facing how) const {
    std::vector<Facing> result(room_.size(), Facing::Room);
    for (std::size_t i = 0; i < set.size(); ++i)
      if (set[i]) result[i] = how;
    return result;
  }

  const Room& room_;
  WallSet fromEye_, fromMiddle_;
  bool alone_;
};

}  // namespace

std::vector<Facing> facingOf(const std::vector<WallEntry>& walls, const Vec3& standingEye) {
  std::vector<Facing> result(walls.size(), Facing::Room);
  const Room all(walls);
  if (!any(all.behind(standingEye, 0)) || all.hasInterior(WallSet(walls.size()))) return result;
  const auto groups = groupsOf(walls);
  for (const std::vector<std::size_t>& group : groups) {
    std::vector<WallEntry> own;
    for (const std::size_t i : group) own.push_back(walls[i]);
    const Room room(own);
    const std::vector<Facing> found = GroupFacing(room, standingEye, groups.size() == 1).facing();
    for (std::size_t k = 0; k < group.size(); ++k) result[group[k]] = found[k];
  }
  return result;
}

}  // namespace stadion
