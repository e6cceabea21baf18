// SPDX-License-Identifier: Apache-2.0
#include <charconv>

#include "runtime/verifier/proof.hpp"
#include "runtime/verifier/tree_reader.hpp"

namespace regulus::verifier {
namespace {

class TreeChecker {
 public:
  TreeChecker(Lines& lines, Question& question, const Variety& variety, const Options& options,
              Verification& counts)
      : lines_(lines),
        question_(question),
        counts_(counts),
        clock_(options, counts),
        branch_(question.closure ? std::make_unique<BranchTree>(question, variety, options, clock_)
                                 : nullptr),
        proofs_(question, variety, options, clock_, counts),
        reader_(lines, question, open_, &proofs_, clock_, branch_.get()) {
    open_.boxes.emplace(0, variety.outer);
  }

  void check() {
    const Shown shown = reader_.read();
    reader_.require_end_word();
    reader_.require_tiling();
    reader_.require_end(shown.leaves);
    require_poses(question_, shown, counts_);
    if (!branch_) return;
    branch_->check(lines_, counts_);
    if (branch_->starts_in_set()) counts_.note.clear();
  }

  Shown check_piece(std::optional<BranchBoxes>& before) {
    Shown shown = reader_.read();
    reader_.require_tiling();
    if (!branch_) return shown;
    branch_->check(lines_, counts_, before ? &*before : nullptr);
    shown.has_met_point |= branch_->starts_in_set();
    before = branch_->take_boxes();
    return shown;
  }

 private:
  Lines& lines_;
  Question& question_;
  Verification& counts_;
  OpenBoxes open_;
  WorkClock clock_;
  const std::unique_ptr<BranchTree> branch_;  ///< of a closure
  LeafProofs proofs_;
  TreeReader reader_;
};

}  // namespace

void check_tree(Lines& lines, Question& question, const Variety& variety, const Options& options,
                Verification& counts) {
  TreeChecker(lines, question, variety, options, counts).check();
}

Shown check_tree_of_piece(Lines& lines, Question& question, const Variety& variety,
                          const Options& options, std::optional<BranchBoxes>& before,
                          Verification& counts) {
  return TreeChecker(lines, question, variety, options, counts).check_piece(before);
}

double read_double(std::string_view text) {
  std::string_view digits = text;
  const bool negative = digits.starts_with('-');
  if (negative) digits.remove_prefix(1);
  const bool hexadecimal = digits.starts_with("0x");
  if (hexadecimal) digits.remove_prefix(2);
  double value = 0;
  const auto format = hexadecimal ? std::chars_format::hex : std::chars_format::general;
  const char* last = digits.data() + digits.size();
  const auto [end, error] = std::from_chars(digits.data(), last, value, format);
  if (digits.starts_with('-') || error != std::errc() || end != last || !(value < kInfinity))
    throw Rejection("'" + std::string(text.substr(0, 40)) + "' is not a number");
  return negative ? -value : value;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(' ', begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

}  // namespace regulus::verifier
