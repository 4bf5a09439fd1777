#include "cli/bench/walls_record_head.h"

#include "engine/core/state_hash.h"
#include "pipeline/platform/machine.h"
#include "pipeline/process/wall_process.h"

#include <chrono>
#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace stadion {
namespace {

std::string contentOf(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

bench::RecordHead recordHead(const bench::WallsPrograms& programs, const std::string& drawnBy) {
  StateHash build;
  for (const std::string& program :
       {programs.stadion, wall_process::wallProgram().string(), programs.osg, programs.floor})
    build.add(program.empty() ? std::string() : contentOf(program));
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  bench::RecordHead head;
  head.build = fmt::format("{:016x}", build.value());
  head.machine = textOf(thisMachine());
  head.drawnBy = drawnBy;
  head.begun = std::chrono::duration_cast<std::chrono::seconds>(now).count();
  return head;
}

}  // namespace stadion
