#pragma once
/// The name of this machine's processor.

#include <string>

namespace stadion {

/// "Intel(R) Xeon(R) Processor (family 6, model 167)", as the system names it.
std::string processorName();

}  // namespace stadion
