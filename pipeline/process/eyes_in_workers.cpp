#include "pipeline/process/eyes_in_workers.h"

#include "engine/base/run_stopped.h"
#include "pipeline/draw_list/list_filling.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

namespace stadion {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kWorthAPlace = 0.004;  // [s]; who is faster is done before others are in its way

void takeSeen(const std::vector<DrawItem>& from, std::uint32_t eye, std::vector<DrawItem>& to) {
  to.clear();
  for (const DrawItem& item : from) {
    if (!(item.eyes >> eye & 1)) continue;
    to.push_back(item);
    to.back().eyes = DrawItem::kLeftEye;  // the only one
  }
}

/// What one eye draws of the list.
void takeEye(const DrawList& from, std::uint32_t eye, DrawList& to) {
  to.ticket = from.ticket, to.wall = from.wall;
  to.origin = from.origin, to.viewer = from.viewer;
  to.eyes[0] = from.eyes[eye], to.eyeCount = std::min(from.eyeCount, 1u);
  to.sky = from.sky, to.lights = from.lights, to.shadows = from.shadows;
  takeSeen(from.opaque, eye, to.opaque), takeSeen(from.transparent, eye, to.transparent);
}

/// A thread that does one thing after the other for one other thread, which goes on meanwhile.
class Beside {
public:
  Beside() : thread_([this] { serve(); }) {}
  ~Beside() {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }
  void begin(const std::function<void()>& work) {
    const std::lock_guard lock(mutex_);
    work_ = &work;
    changed_.notify_all();
  }
  /// Waits until it is done; throws what it threw.
  void end() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !work_; });
    if (const std::exception_ptr thrown = std::exchange(thrown_, nullptr)) std::rethrow_exception(thrown);
  }

private:
  void serve() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [&] { return work_ || ended_; });
      if (!work_) return;
      lock.unlock();
      std::exception_ptr thrown;
      try {
        (*work_)();
      } catch (...) {
        thrown = std::current_exception();
      }
      lock.lock();
      thrown_ = thrown, work_ = nullptr;
      changed_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  const std::function<void()>* work_ = nullptr;
  std::exception_ptr thrown_;
  bool ended_ = false;
  std::thread thread_;  // last: it uses the others
};

}  // namespace

struct EyesInWorkers::Wall {
  std::size_t first = 0;  ///< the left or only eye's number among all eyes; the right one's is the next
  std::uint32_t eyes = 1;
  std::array<DrawList, 2> lists;
  std::array<double, 2> took{};   ///< the last frame [s]
  std::array<bool, 2> bound{};    ///< to one processor
  std::unique_ptr<Beside> right;  ///< draws the right eye

  /// Does it for both eyes at once, and waits.
  template <class Work>
  void both(const Work& work) {
    if (eyes == 1) return work(0);
    const std::function<void()> second = [&work] { work(1); };
    right->begin(second);
    std::exception_ptr thrown;
    try {
      work(0);
    } catch (...) {
      thrown = std::current_exception();
    }
    right->end();
    if (thrown) std::rethrow_exception(thrown);
  }
};

EyesInWorkers::EyesInWorkers(DrawingInWorkersParts parts, const std::vector<std::uint32_t>& eyes)
    : processors_(processorsOfThisThread()), places_(processors_),
      bindsProcesses_(parts.rasteriserThreads == 0 && parts.processors.empty()) {
  DrawingInWorkersParts each = parts;
  each.walls.clear(), each.names.clear(), each.processors.clear();
  for (std::size_t i = 0; i < parts.walls.size(); ++i) {
    auto wall = std::make_unique<Wall>();
    wall->first = each.walls.size(), wall->eyes = eyes[i];
    for (std::uint32_t eye = 0; eye < wall->eyes; ++eye) {
      each.walls.push_back(parts.walls[i]);
      if (i < parts.processors.size()) each.processors.push_back(parts.processors[i]);
      each.names.push_back(wall->eyes == 1 ? parts.names[i]
                                           : parts.names[i] + (eye == 0 ? ", left eye" : ", right eye"));
    }
    if (wall->eyes == 2) wall->right = std::make_unique<Beside>();
    walls_.push_back(std::move(wall));
  }
  eyes_ = std::make_unique<DrawingInWorkers>(std::move(each));
}

EyesInWorkers::~EyesInWorkers() = default;

Failure EyesInWorkers::open(std::size_t wall) {
  Wall& w = *walls_[wall];
  std::array<Failure, 2> failures;
  w.both([&](std::uint32_t eye) { failures[eye] = eyes_->open(w.first + eye); });
  return failures[0] ? std::move(failures[0]) : std::move(failures[1]);
}

Failure EyesInWorkers::warmUp(std::size_t wall, const DrawList& list) {
  Wall& w = *walls_[wall];
  std::array<Failure, 2> failures;
  w.both([&](std::uint32_t eye) {
    takeEye(list, eye, w.lists[eye]);
    failures[eye] = eyes_->warmUp(w.first + eye, w.lists[eye]);
  });
  return failures[0] ? std::move(failures[0]) : std::move(failures[1]);
}

DrawOutcome EyesInWorkers::drawEye(Wall& wall, std::uint32_t eye, bool read) {
  const bool placed = bindsProcesses_ && wall.took[eye] > kWorthAPlace;
  std::optional<worker::ProcessorPlaces::Place> place;
  if (placed) place.emplace(places_, wall.took[eye]);
  ProcessorSet own;
  if (placed) own.add(place->processor());
  const int pid = eyes_->pid(wall.first + eye);
  if ((placed || wall.bound[eye]) && pid > 0) (placed ? own : processors_).bindThread(pid);
  wall.bound[eye] = placed;
  const auto began = Clock::now();
  DrawOutcome outcome = eyes_->draw(wall.first + eye, wall.lists[eye], read);
  wall.took[eye] = std::chrono::duration<double>(Clock::now() - began).count();
  return outcome;
}

DrawOutcome EyesInWorkers::draw(std::size_t wall, const DrawList& list, bool read) {
  if (list.filling && !list.filling->isWhole()) return {{}, false};
  Wall& w = *walls_[wall];
  std::array<DrawOutcome, 2> outcomes;
  w.both([&](std::uint32_t eye) {
    takeEye(list, eye, w.lists[eye]);
    outcomes[eye] = drawEye(w, eye, read);
  });
  DrawOutcome& left = outcomes[0];
  if (!left.failure) left.failure = std::move(outcomes[1].failure);
  left.drawn = left.drawn && outcomes[1].drawn;  // never one eye only
  return std::move(left);
}

Failure EyesInWorkers::read(std::size_t wall, std::uint32_t eye, std::span<std::uint8_t> rgba) {
  return eyes_->read(walls_[wall]->first + eye, 0, rgba);
}

int EyesInWorkers::pid(std::size_t wall, std::uint32_t eye) const {
  return eyes_->pid(walls_[wall]->first + eye);
}

void EyesInWorkers::close(std::size_t wall) {
  const Wall& w = *walls_[wall];
  for (std::uint32_t eye = 0; eye < w.eyes; ++eye) eyes_->close(w.first + eye);
}

std::array<DrawTotals, 2> EyesInWorkers::totals(std::size_t wall) const {
  const Wall& w = *walls_[wall];
  std::array<DrawTotals, 2> totals{};
  for (std::uint32_t eye = 0; eye < w.eyes; ++eye) totals[eye] = eyes_->totals(w.first + eye)[0];
  return totals;
}

std::string EyesInWorkers::glDescription(std::size_t wall) const {
  return eyes_->glDescription(walls_[wall]->first);
}

}  // namespace stadion
