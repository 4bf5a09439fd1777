#pragma once
/// Who may use which processor now: no more draw at once than there are processors, each on its own, and the
/// dearest goes first. Processes that share one take each other's caches away; two that wake up on the same
/// one leave the other idle; and the dearest would end last, alone.
///
/// Threads  any.

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace stadion::worker {

/// The processors that this process may use, by their numbers.
std::vector<int> ownProcessors();
/// Has the first thread of a process run on these only, if the system lets it.
void bindProcess(int pid, std::span<const int> processors);

class ProcessorPlaces {
public:
  explicit ProcessorPlaces(std::vector<int> processors) : free_(std::move(processors)) {}

  /// Holds a processor until it goes.
  class Place {
  public:
    /// Waits for one. `cost`: what the last time took, in any unit.
    Place(ProcessorPlaces& of, double cost) : of_(of), processor_(of.take(cost)) {}
    ~Place() { of_.giveBack(processor_); }
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;

    int processor() const { return processor_; }

  private:
    ProcessorPlaces& of_;
    int processor_;
  };

private:
  struct Waiting {
    double cost;
    std::optional<int> processor{};
  };

  int take(double cost);
  void giveBack(int processor);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<int> free_;
  std::vector<Waiting*> waiting_;
};

}  // namespace stadion::worker
