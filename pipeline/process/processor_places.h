#pragma once
/// Gives each drawing process a processor of its own. No more of them draw at once than there are processors.
/// The most expensive goes first, because otherwise it would end last and alone. Two processes on one
/// processor would evict each other's caches, and another processor would be idle.
///
/// Threads  any.

#include "pipeline/platform/processor_set.h"

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <optional>
#include <vector>

namespace stadion::wall_process {

class ProcessorPlaces {
public:
  explicit ProcessorPlaces(const ProcessorSet& processors);

  /// Holds a processor until it goes.
  class Place {
  public:
    /// Waits for one. `cost`: what the last time took, in any unit.
    Place(ProcessorPlaces& of, double cost) : of_(of), processor_(of.take(cost)) {}
    ~Place() { of_.giveBack(processor_); }
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;

    std::size_t processor() const { return processor_; }

  private:
    ProcessorPlaces& of_;
    std::size_t processor_;
  };

private:
  struct Waiting {
    double cost;
    std::optional<std::size_t> processor{};
  };

  std::size_t take(double cost);
  void giveBack(std::size_t processor);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::size_t> free_;
  std::vector<Waiting*> waiting_;
};

}  // namespace stadion::wall_process
