// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/bracket_ends.hpp"

#include <algorithm>
#include <utility>

#include "codegen/question/margin/margin_report.hpp"
#include "codegen/question/margin/margin_run.hpp"

namespace regulus::detail {

std::vector<ProofOfEnd> proofs_of_ends(const EndProofs& ends, const std::string& component) {
  std::vector<ProofOfEnd> proofs;
  if (!ends.are_wanted()) return proofs;
  for (const EndProof* end : {&ends.safe(), &ends.singular()})
    proofs.push_back({component, end == &ends.safe(), end->file,
                      end->file.empty() ? end->words : std::string()});
  return proofs;
}

Word word_of(const MarginQuestion& question, const Margin& margin) {
  if (margin.refuted && margin.refuted->value.approx <= question.low.approx) return Word::kRefuted;
  return margin.closed && margin.certified ? Word::kProved : Word::kOpen;
}

void set_ends(MarginAnswer& answer, const Margin& margin) {
  if (margin.certified) answer.safe = margin.certified->value.text;
  if (margin.refuted) answer.refuted = margin.refuted->value.text;
  answer.closed = margin.closed;
}

std::function<void(const MarginStep&)> steps_of(const MarginQuestion& question,
                                                const Services& services) {
  return [&](const MarginStep& step) { services.tell(format_step(question, step)); };
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

}  // namespace regulus::detail
