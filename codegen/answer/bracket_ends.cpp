// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/bracket_ends.hpp"

#include <algorithm>
#include <utility>

namespace regulus {

std::vector<ProofOfEnd> proofs_of_ends(const EndProofs& ends, const std::string& component) {
  std::vector<ProofOfEnd> proofs;
  if (!ends.are_wanted()) return proofs;
  for (const EndProof* end : {&ends.safe(), &ends.singular()})
    proofs.push_back({component, end == &ends.safe(), end->file,
                      end->file.empty() ? end->words : std::string()});
  return proofs;
}

void settle_files(HeldFiles& held, const std::vector<EndProofs*>& ends, Answer& answer) {
  const bool are_placed = answer.write_beside([&held] { held.put_in_place(); });
  for (EndProofs* end : ends) {
    if (!are_placed) end->note_missing_files(answer.lost.back());
    for (std::string& why : end->lost())
      if (std::ranges::find(answer.lost, why) == answer.lost.end())
        answer.lost.push_back(std::move(why));
  }
}

}  // namespace regulus
