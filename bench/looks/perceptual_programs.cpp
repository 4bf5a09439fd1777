#include "bench/looks/perceptual_programs.h"

#include "pipeline/platform/child_process.h"

#include <charconv>
#include <chrono>

namespace stadion::bench {
namespace {

/// The number that the program prints first.
std::optional<double> measuredBy(const char* program, const PictureFiles& files) {
  const FileDescriptor out = makeMemoryFile();
  ChildProcess child;
  if (child.start({program, files.reference, files.picture}, {.out = out.get()})) return {};
  if (child.wait(std::chrono::minutes(1)) != 0) return {};
  const std::string said = contentOf(out);
  double value = 0;
  const auto read = std::from_chars(said.data(), said.data() + said.size(), value);
  return read.ec == std::errc() ? std::optional(value) : std::nullopt;
}

}  // namespace

std::optional<double> butteraugliOf(const PictureFiles& files) {
  return measuredBy("butteraugli_main", files);
}

std::optional<double> ssimulacraOf(const PictureFiles& files) {
  return measuredBy("ssimulacra_main", files);
}

}  // namespace stadion::bench
