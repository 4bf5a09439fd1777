#pragma once
/// What the importer program answers, read piece by piece from wherever it comes.
///
/// Threads  pure.
/// Errors   nothing of it is believed: lengths are held against limits before anything is allocated, and
/// memory
///          grows only with bytes that have really come. What the mesh's bytes are worth, decode() says.

#include "engine/asset/importer_protocol.h"

#include <functional>
#include <string>
#include <vector>

namespace stadion {

enum class Transfer { Done, Late, Broken, Nonsense };

struct ImporterAnswer {
  ImportStatus status = ImportStatus::Failed;
  std::string text;                ///< notes, or the reason: printable, but for the ends of its lines
  std::vector<std::uint8_t> mesh;  ///< not checked yet
};

/// Brings exactly so many bytes, or says why it cannot.
using BringBytes = std::function<Transfer(void* to, std::size_t size)>;

/// Reads one answer; unless it is Done, the answer is worth nothing.
Transfer readAnswer(const BringBytes& bring, ImporterAnswer& answer);

}  // namespace stadion
