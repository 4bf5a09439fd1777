#include "profiling/plan/schedule.h"

#include "profiling/plan/simulation.h"
#include "profiling/plan/slots.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace stadion::plan {
namespace {

constexpr std::size_t kLists = 2;

/// The frame loop, in a simulation.
class Loop {
public:
  Loop(const std::vector<FrameCost>& costs, const Plan& plan)
      : costs_(costs), plan_(plan), machines_(std::min(plan.machines, plan.walls)),
        simulation_(std::vector<double>(machines_, plan.machine.cores)), walls_(plan.walls),
        arrivedOf_(machines_) {
    for (std::size_t m = 0; m < machines_; ++m) {
      slots_.emplace_back(wallsOf(m), plan.newest);
      for (std::size_t r = 0; r < plan.rasterisers; ++r) rasterisers_.emplace_back();
    }
  }

  Schedule run() {
    nameRows();
    for (std::size_t m = 0; m < machines_; ++m) {
      simulation_.start(plan_.pipelined ? app(m) : sequential(m));
      for (std::size_t r = 0; r < plan_.rasterisers; ++r) simulation_.start(rasterise(m, r));
    }
    if (plan_.pipelined)
      for (std::size_t w = 0; w < plan_.walls; ++w) {
        simulation_.start(cull(w));
        simulation_.start(draw(w));
      }
    simulation_.run();
    for (std::size_t m = 0; m < machines_; ++m) out_.busy.push_back(simulation_.busy(m));
    out_.end = simulation_.now();
    return std::move(out_);
  }

private:
  struct Wall {
    std::size_t emptyLists = kLists;
    std::deque<Ticket> handed;  ///< to Draw
    std::uint64_t culled = 0;   ///< lists that are complete
    bool finished = false;
    std::size_t inWork = 0;  ///< pictures that are not rasterised yet
  };
  struct Picture {
    std::size_t wall;
    std::uint64_t frame;
    double raster, threads;
  };
  struct Rasteriser {
    bool taken = false;  ///< a wall has its turn
    std::deque<Picture> pictures;
  };

  void nameRows() {
    const auto number = [&](const char* what, std::size_t m) {
      return machines_ > 1 ? std::string(what) + " of machine " + std::to_string(m + 1) : std::string(what);
    };
    for (std::size_t m = 0; m < machines_; ++m)
      out_.rows.push_back(number(plan_.pipelined ? "App" : "frame loop", m));
    if (plan_.pipelined)
      for (std::size_t w = 0; w < plan_.walls; ++w) {
        out_.rows.push_back("Cull " + std::to_string(w + 1));
        out_.rows.push_back("Draw " + std::to_string(w + 1));
      }
    for (std::size_t m = 0; m < machines_; ++m)
      for (std::size_t r = 0; r < plan_.rasterisers; ++r)
        out_.rows.push_back(number("rasteriser", m) +
                            (plan_.rasterisers > 1 ? " " + std::to_string(r + 1) : ""));
  }
  std::size_t machineOf(std::size_t wall) const { return wall % machines_; }
  std::size_t rasteriserOf(std::size_t wall) const {
    return machineOf(wall) * plan_.rasterisers + wall / machines_ % plan_.rasterisers;
  }
  std::size_t rowOf(std::size_t wall, bool drawing) const {
    return plan_.pipelined ? machines_ + 2 * wall + (drawing ? 1 : 0) : machineOf(wall);
  }
  std::size_t rowOfRasteriser(std::size_t index) const {
    return machines_ + (plan_.pipelined ? 2 * plan_.walls : 0) + index;
  }

  /// As FrameSlots::mayBegin: the limit of frames in flight, and one more while few walls draw the oldest
  /// one.
  bool mayBegin(std::size_t machine, std::uint64_t serial) const {
    const std::size_t walls = wallsOf(machine), arrived = arrivedOf_[machine];
    const auto processors = static_cast<std::size_t>(std::max(1.0, plan_.machine.cores));
    const bool ending = arrived > 0 && arrived + std::min(walls / 2, processors - 1) >= walls;
    return plan_.mostInFlight == 0 || serial < rounds_ + plan_.mostInFlight + (ending ? 1 : 0);
  }
  std::size_t wallsOf(std::size_t machine) const {
    return (plan_.walls - machine + machines_ - 1) / machines_;
  }

  const FrameCost& costOf(std::uint64_t frame) const { return costs_[frame % costs_.size()]; }
  const WallCost& costOf(std::uint64_t frame, std::size_t wall) const {
    const FrameCost& f = costOf(frame);
    return f.walls[wall % f.walls.size()];
  }
  void note(std::size_t row, Activity what, std::uint64_t frame, double begin) {
    if (simulation_.now() > begin) out_.bars.push_back({row, what, frame, begin, simulation_.now()});
  }

  // Returns the time at which the next frame may begin (pipeline/loop/pacer.h).
  double nextBegin(double& next) const {
    if (plan_.pace == Pace::Free) return 0;
    const double period = 1000 / plan_.rate, now = simulation_.now();
    if (next < 0) next = now;
    double begin = next;
    if (now > next)
      begin = plan_.pace == Pace::Float ? now : next + period * (std::floor((now - next) / period) + 1);
    next = begin + period;
    return begin;
  }

  Process app(std::size_t machine) {
    double next = -1;
    for (std::uint64_t frame = 0; frame < plan_.frames; ++frame) {
      const double begin = nextBegin(next);
      co_await simulation_.sleepUntil(begin);
      co_await simulation_.until([this, machine, frame] {
        return slots_[machine].canWrite() && (plan_.newest || mayBegin(machine, frame));
      });
      const std::size_t slot = slots_[machine].beginWrite();
      const Ticket ticket{frame, simulation_.now()};
      co_await computeApp(machine, frame);
      note(machine, Activity::App, frame, ticket.began);
      slots_[machine].endWrite(slot, ticket);
    }
    slots_[machine].finish();
  }

  Simulation::Wait computeApp(std::size_t machine, std::uint64_t frame) {
    const FrameCost& cost = costOf(frame);
    const double all = cost.app + cost.appHelpers;
    return simulation_.compute(machine, all, cost.app > 0 ? all / cost.app : 1);
  }

  Process cull(std::size_t wall) {
    Slots& slots = slots_[machineOf(wall)];
    Wall& my = walls_[wall];
    for (std::size_t serial = 0;; ++serial) {
      // As in the frame loop, a wall leases a slot only once it has an empty list.
      co_await simulation_.until([&my] { return my.emptyLists > 0; });
      co_await simulation_.until([this, wall, &slots, serial] {
        return slots.canRead(serial) && (!plan_.newest || mayBegin(machineOf(wall), serial));
      });
      const auto lease = slots.lease(serial);
      if (!lease) break;
      --my.emptyLists;
      const double begin = simulation_.now();
      const WallCost& cost = costOf(lease->ticket.frame, wall);
      const double rest = plan_.drawBeginsEarly ? std::min(cost.cullBesideDraw, cost.cull) : 0;
      co_await simulation_.compute(machineOf(wall), cost.cull - rest);
      my.handed.push_back(lease->ticket);
      co_await simulation_.compute(machineOf(wall), rest);
      ++my.culled;
      note(rowOf(wall, false), Activity::Cull, lease->ticket.frame, begin);
      slots.release(lease->slot);
    }
    my.finished = true;
  }

  Process draw(std::size_t wall) {
    Wall& my = walls_[wall];
    Rasteriser& rasteriser = rasterisers_[rasteriserOf(wall)];
    const std::size_t row = rowOf(wall, true);
    for (std::uint64_t drawn = 0;; ++drawn) {
      co_await simulation_.until([&my] { return my.finished || !my.handed.empty(); });
      if (my.handed.empty()) break;
      const Ticket ticket = my.handed.front();
      my.handed.pop_front();

      double begin = simulation_.now();
      if (plan_.takesTurns) {
        co_await simulation_.until([&rasteriser] { return !rasteriser.taken; });
        rasteriser.taken = true;
      }
      note(row, Activity::ForTurn, ticket.frame, begin);
      begin = simulation_.now();
      for (const PictureCost& picture : costOf(ticket.frame, wall).pictures) {
        co_await simulation_.compute(machineOf(wall), picture.calls);
        co_await simulation_.until([&my, drawn] { return my.culled > drawn; });
        note(row, Activity::Calls, ticket.frame, begin);
        send(wall, ticket.frame, picture);
        begin = simulation_.now();
        if (plan_.waitsInTurn) co_await simulation_.until([&my] { return my.inWork == 0; });
        note(row, Activity::ForPixels, ticket.frame, begin);
        begin = simulation_.now();
      }
      rasteriser.taken = false;
      begin = simulation_.now();
      co_await simulation_.until([&my] { return my.inWork == 0; });
      note(row, Activity::ForPixels, ticket.frame, begin);

      begin = simulation_.now();
      const std::uint64_t round = rounds_;
      ++arrivedOf_[machineOf(wall)];
      if (++arrived_ == plan_.walls) {
        co_await simulation_.compute(machineOf(wall), costOf(ticket.frame).swap);
        note(row, Activity::Swap, ticket.frame, begin);
        out_.shown.push_back({ticket.frame, ticket.began, simulation_.now()});
        arrived_ = 0;
        ++rounds_;
        std::ranges::fill(arrivedOf_, 0);
      } else {
        co_await simulation_.until([this, round] { return rounds_ != round; });
        note(row, Activity::ForWalls, ticket.frame, begin);
      }
      ++my.emptyLists;
    }
    ++drawnOut_;
  }

  /// Sends work to the rasteriser.
  void send(std::size_t wall, std::uint64_t frame, const PictureCost& cost) {
    ++walls_[wall].inWork;
    const double threads = cost.atOnce > 1 ? cost.atOnce * plan_.machine.rasterThreads : cost.atOnce;
    rasterisers_[rasteriserOf(wall)].pictures.push_back({wall, frame, cost.raster, std::max(threads, 1e-2)});
  }

  Process rasterise(std::size_t machine, std::size_t which) {
    const std::size_t index = machine * plan_.rasterisers + which;
    Rasteriser& my = rasterisers_[index];
    for (;;) {
      co_await simulation_.until([this, &my] { return !my.pictures.empty() || allDrawn(); });
      if (my.pictures.empty()) break;
      const Picture picture = my.pictures.front();
      my.pictures.pop_front();
      const double begin = simulation_.now();
      co_await simulation_.compute(machine, picture.raster, picture.threads);
      note(rowOfRasteriser(index), Activity::Raster, picture.frame, begin);
      --walls_[picture.wall].inWork;
    }
  }

  bool allDrawn() const { return drawnOut_ == (plan_.pipelined ? plan_.walls : machines_); }

  // Runs one frame after the other, one stage after the other.
  Process sequential(std::size_t machine) {
    double next = -1;
    for (std::uint64_t frame = 0; frame < plan_.frames; ++frame) {
      const double tick = nextBegin(next);
      co_await simulation_.sleepUntil(tick);
      const double began = simulation_.now();
      co_await computeApp(machine, frame);
      note(machine, Activity::App, frame, began);
      for (std::size_t wall = machine; wall < plan_.walls; wall += machines_) {
        const double begin = simulation_.now();
        co_await simulation_.compute(machine, costOf(frame, wall).cull);
        note(machine, Activity::Cull, frame, begin);
      }
      for (std::size_t wall = machine; wall < plan_.walls; wall += machines_) {
        double begin = simulation_.now();
        for (const PictureCost& picture : costOf(frame, wall).pictures) {
          co_await simulation_.compute(machine, picture.calls);
          note(machine, Activity::Calls, frame, begin);
          send(wall, frame, picture);
          begin = simulation_.now();
          if (plan_.waitsInTurn)
            co_await simulation_.until([this, wall] { return walls_[wall].inWork == 0; });
          note(machine, Activity::ForPixels, frame, begin);
          begin = simulation_.now();
        }
        begin = simulation_.now();
        co_await simulation_.until([this, wall] { return walls_[wall].inWork == 0; });
        note(machine, Activity::ForPixels, frame, begin);
      }
      const double begin = simulation_.now();
      const std::uint64_t round = rounds_;
      if (++arrived_ == machines_) {
        co_await simulation_.compute(machine, costOf(frame).swap);
        note(machine, Activity::Swap, frame, begin);
        out_.shown.push_back({frame, began, simulation_.now()});
        arrived_ = 0;
        ++rounds_;
      } else {
        co_await simulation_.until([this, round] { return rounds_ != round; });
        note(machine, Activity::ForWalls, frame, begin);
      }
    }
    ++drawnOut_;
  }

  const std::vector<FrameCost>& costs_;
  const Plan plan_;
  std::size_t machines_;
  Simulation simulation_;
  std::vector<Slots> slots_;  ///< by machine
  std::vector<Rasteriser> rasterisers_;
  std::vector<Wall> walls_;
  std::vector<std::size_t> arrivedOf_;  ///< by machine: walls that have drawn the oldest frame
  std::size_t arrived_ = 0, drawnOut_ = 0;
  std::uint64_t rounds_ = 0;
  Schedule out_;
};

}  // namespace

Schedule scheduleOf(const std::vector<FrameCost>& costs, const Plan& plan) {
  return Loop(costs, plan).run();
}

}  // namespace stadion::plan
