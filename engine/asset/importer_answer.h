#pragma once
/// The importer program's answer, read piece by piece from any source.
///
/// Threads  pure.
/// Errors   Nothing in it is trusted: lengths are checked against limits before allocation, and memory grows
///          only with bytes that have arrived. decode() checks the mesh's bytes.

#include "engine/asset/importer_protocol.h"

#include <functional>
#include <string>
#include <vector>

namespace stadion {

enum class Transfer { Done, Late, Broken, Nonsense };

struct ImporterAnswer {
  ImportStatus status = ImportStatus::Failed;
  std::string text;                ///< the inventory, or the reason: printable, but for the ends of its lines
  std::vector<std::uint8_t> mesh;  ///< not checked yet
};

/// Reads exactly so many bytes, or says why it cannot.
using BringBytes = std::function<Transfer(void* to, std::size_t size)>;

/// Reads one answer, which is valid only if the result is Done.
Transfer readAnswer(const BringBytes& bring, ImporterAnswer& answer);

}  // namespace stadion
