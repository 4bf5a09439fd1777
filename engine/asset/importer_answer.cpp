#include "engine/asset/importer_answer.h"

#include <algorithm>

namespace stadion {
namespace {

// Memory grows as the bytes arrive: a false size costs none.
Transfer readBytes(const BringBytes& bring, std::vector<std::uint8_t>& bytes, std::uint64_t size) {
  constexpr std::uint64_t kPiece = 4u << 20;
  while (bytes.size() < size) {
    const std::size_t have = bytes.size();
    bytes.resize(have + std::min(kPiece, size - have));
    if (const Transfer t = bring(bytes.data() + have, bytes.size() - have); t != Transfer::Done) return t;
  }
  return Transfer::Done;
}

// Keeps only lines of printable text, since the program may send anything.
void clean(std::string& text) {
  for (char& c : text) {
    const auto u = static_cast<unsigned char>(c);
    if (c != '\n' && (u < 0x20 || u == 0x7f)) c = '?';
  }
}

}  // namespace

Transfer readAnswer(const BringBytes& bring, ImporterAnswer& answer) {
  AnswerHead head{};
  if (const Transfer t = bring(&head, sizeof head); t != Transfer::Done) return t;
  if (head.magic != kAnswerMagic || head.version != kImportVersion || head.textBytes > kLongestText ||
      head.meshBytes > kLongestAnswer)
    return Transfer::Nonsense;
  answer.status = head.status;
  answer.text.resize(head.textBytes);
  if (const Transfer t = bring(answer.text.data(), head.textBytes); t != Transfer::Done) return t;
  clean(answer.text);
  return readBytes(bring, answer.mesh, head.meshBytes);
}

}  // namespace stadion
