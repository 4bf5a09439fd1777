#include "pipeline/process/per_view_process_renderer.h"

#include "engine/base/run_stopped.h"
#include "pipeline/draw_list/list_filling.h"

#include <algorithm>
#include <array>
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

constexpr double kWorthAPlace = 0.004;  // [s]; a faster wall is done before others disturb it

void takeSeen(const std::vector<DrawItem>& from, std::uint32_t view, std::vector<DrawItem>& to) {
  to.clear();
  for (const DrawItem& item : from) {
    if (!(item.views >> view & 1)) continue;
    to.push_back(item);
    to.back().views = 1;  // the only one
  }
}

/// What one view draws of the list.
void takeView(const DrawList& from, std::uint32_t view, DrawList& to) {
  to.ticket = from.ticket;
  to.wall = from.wall;
  to.origin = from.origin;
  to.viewer = from.viewer;
  to.views[0] = from.views[view];
  to.viewCount = std::min(from.viewCount, 1u);
  to.sky = from.sky;
  to.lights = from.lights;
  to.shadows = from.shadows;
  takeSeen(from.opaque, view, to.opaque);
  takeSeen(from.transparent, view, to.transparent);
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
      thrown_ = thrown;
      work_ = nullptr;
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

/// A wall's view.
struct PerViewProcessRenderer::View {
  std::size_t number = 0;  ///< among all views
  DrawList list{};
  double took = 0;     ///< the last frame [s]
  bool bound = false;  ///< to one processor
};

struct PerViewProcessRenderer::Wall {
  std::vector<View> views;
  std::vector<std::unique_ptr<Beside>> others;  ///< draw the second view and those after it

  /// Does it for all views at once, and waits.
  template <class Work>
  void all(const Work& work) {
    std::array<std::function<void()>, DrawList::kMostViews> rest;
    for (std::uint32_t i = 0; i < others.size(); ++i) {
      rest[i] = [&work, i] { work(i + 1); };
      others[i]->begin(rest[i]);
    }
    std::exception_ptr thrown;
    const auto guarded = [&thrown](const auto& what) {
      try {
        what();
      } catch (...) {
        thrown = std::current_exception();
      }
    };
    guarded([&] { work(0); });
    for (const auto& other : others) guarded([&] { other->end(); });
    if (thrown) std::rethrow_exception(thrown);
  }
};

namespace {

using Failures = std::array<Failure, DrawList::kMostViews>;

Failure firstOf(Failures& failures) {
  for (Failure& f : failures)
    if (f) return std::move(f);
  return kNoFailure;
}

std::string nameOf(const std::string& wall, std::size_t view, std::size_t views) {
  if (views == 1) return wall;
  if (views == 2) return wall + (view == 0 ? ", left eye" : ", right eye");
  return wall + ", view " + std::to_string(view + 1);
}

}  // namespace

PerViewProcessRenderer::PerViewProcessRenderer(PerWallProcessParts parts,
                                               const std::vector<std::uint32_t>& views)
    : processors_(processorsOfThisThread()), places_(processors_),
      bindsProcesses_(parts.rasteriserThreads == 0 && parts.processors.empty()) {
  PerWallProcessParts each = parts;
  each.walls.clear();
  each.names.clear();
  each.processors.clear();
  for (std::size_t i = 0; i < parts.walls.size(); ++i) {
    auto wall = std::make_unique<Wall>();
    for (std::uint32_t view = 0; view < views[i]; ++view) {
      wall->views.push_back({each.walls.size()});
      each.walls.push_back(parts.walls[i]);
      if (i < parts.processors.size()) each.processors.push_back(parts.processors[i]);
      each.names.push_back(nameOf(parts.names[i], view, views[i]));
      if (view > 0) wall->others.push_back(std::make_unique<Beside>());
    }
    walls_.push_back(std::move(wall));
  }
  views_ = std::make_unique<PerWallProcessRenderer>(std::move(each));
}

PerViewProcessRenderer::~PerViewProcessRenderer() = default;

Failure PerViewProcessRenderer::open(std::size_t wall) {
  Wall& w = *walls_[wall];
  Failures failures;
  w.all([&](std::uint32_t view) { failures[view] = views_->open(w.views[view].number); });
  return firstOf(failures);
}

Failure PerViewProcessRenderer::warmUp(std::size_t wall, const DrawList& list) {
  Wall& w = *walls_[wall];
  Failures failures;
  w.all([&](std::uint32_t view) {
    takeView(list, view, w.views[view].list);
    failures[view] = views_->warmUp(w.views[view].number, w.views[view].list);
  });
  return firstOf(failures);
}

DrawOutcome PerViewProcessRenderer::drawView(View& view, bool read) {
  const bool placed = bindsProcesses_ && view.took > kWorthAPlace;
  std::optional<wall_process::ProcessorPlaces::Place> place;
  if (placed) place.emplace(places_, view.took);
  ProcessorSet own;
  if (placed) own.add(place->processor());
  const int pid = views_->pid(view.number);
  if ((placed || view.bound) && pid > 0) (placed ? own : processors_).bindThread(pid);
  view.bound = placed;
  const auto began = Clock::now();
  DrawOutcome outcome = views_->draw(view.number, view.list, read);
  view.took = std::chrono::duration<double>(Clock::now() - began).count();
  return outcome;
}

DrawOutcome PerViewProcessRenderer::draw(std::size_t wall, const DrawList& list, bool read) {
  if (list.filling && !list.filling->isWhole()) return {{}, false};
  Wall& w = *walls_[wall];
  std::array<DrawOutcome, DrawList::kMostViews> outcomes;
  w.all([&](std::uint32_t view) {
    takeView(list, view, w.views[view].list);
    outcomes[view] = drawView(w.views[view], read);
  });
  DrawOutcome all;
  for (DrawOutcome& one : outcomes) {
    if (!all.failure) all.failure = std::move(one.failure);
    all.drawn = all.drawn && one.drawn;  // never some views only
  }
  return all;
}

Failure PerViewProcessRenderer::read(std::size_t wall, std::uint32_t view, std::span<std::uint8_t> rgba) {
  return views_->read(walls_[wall]->views[view].number, 0, rgba);
}

int PerViewProcessRenderer::pid(std::size_t wall, std::uint32_t view) const {
  return views_->pid(walls_[wall]->views[view].number);
}

void PerViewProcessRenderer::close(std::size_t wall) {
  for (const View& view : walls_[wall]->views) views_->close(view.number);
}

ViewTotals PerViewProcessRenderer::totals(std::size_t wall) const {
  ViewTotals totals{};
  const std::vector<View>& views = walls_[wall]->views;
  for (std::size_t view = 0; view < views.size(); ++view)
    totals[view] = views_->totals(views[view].number)[0];
  return totals;
}

std::string PerViewProcessRenderer::drawnBy(std::size_t wall) const {
  return views_->drawnBy(walls_[wall]->views.front().number);
}

}  // namespace stadion
