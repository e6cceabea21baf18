// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/bracket_ends.hpp"

namespace regulus {

std::vector<ProofOfEnd> proofs_of_ends(const EndProofs& ends, const std::string& component) {
  std::vector<ProofOfEnd> proofs;
  if (!ends.are_wanted()) return proofs;
  for (const EndProof* end : {&ends.safe(), &ends.singular()})
    proofs.push_back({component, end == &ends.safe(), end->file,
                      end->file.empty() ? end->words : std::string()});
  return proofs;
}

}  // namespace regulus
