#pragma once
/// What a run of `stadion bench walls` here and now is of, for its record.

#include "bench/walls/walls_program.h"
#include "bench/walls/walls_record.h"

namespace stadion {

bench::RecordHead recordHead(const bench::WallsPrograms& programs, const std::string& drawnBy);

}  // namespace stadion
