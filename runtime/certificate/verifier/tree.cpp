// SPDX-License-Identifier: Apache-2.0
// Each box is split or is a leaf, exactly once. A split lies strictly inside its box. At the end no
// box is open. So the leaves tile the box that contains the variety.
#include <array>
#include <charconv>
#include <unordered_map>

#include "runtime/certificate/verifier/proof.hpp"

namespace regulus::verifier {
namespace {

constexpr std::array<std::string_view, 11> kRules = {
    "outside", "h-matrix",    "mean-value", "second-order",   "determinant", "elimination",
    "rohn",    "closed-form", "filter",     "multiprecision", "orthants"};

class TreeChecker {
 public:
  TreeChecker(Lines& lines, Question& q, const Variety& variety, const Options& options,
              Verification& counts)
      : lines_(lines),
        has_constraints_(!q.constraints.empty()),
        counts_(counts),
        clock_(options, counts),
        prover_(q, variety, options, clock_, counts.boxes) {
    open_.emplace(0, variety.outer);
  }

  void check() {
    read_boxes();
    const auto words = words_of(lines_.text());
    if (words.size() != 2 || words[0] != "end")
      throw Rejection("expected 's BOX VARIABLE AT', 'l BOX RULE' or 'end LEAVES'");
    require_tiling();
    if (read_count(words[1], std::size_t(-1)) != counts_.leaves)
      throw Rejection("the line 'end' gives a wrong number of leaves");
    if (lines_.next()) throw Rejection("there is text after the line 'end'");
    require_poses();
  }

  void check_piece() {
    read_boxes();
    require_tiling();
    require_poses();
  }

 private:
  /// Reads splits and leaves up to the first other line.
  void read_boxes() {
    for (;;) {
      clock_.tick();
      if (!lines_.next()) throw Rejection("the file ends before the line 'end' of the tree");
      const auto words = words_of(lines_.text());
      if (words.size() == 4 && words[0] == "s")
        split(words);
      else if (words.size() == 3 && words[0] == "l")
        leaf(words);
      else
        return;
    }
  }

  using Open = std::unordered_map<std::uint64_t, Box>;

  Open::iterator find(std::string_view text) {
    const auto box = open_.find(read_count(text, std::size_t(-1)));
    if (box == open_.end()) throw Rejection("box " + std::string(text) + " is not open");
    return box;
  }

  void split(const std::vector<std::string_view>& words) {
    const auto parent = find(words[1]);
    Box lower = std::move(parent->second);
    open_.erase(parent);
    const std::size_t k = read_count(words[2], format::kMostVariables);
    const double at = read_double(words[3]);
    if (k >= lower.size()) throw Rejection("there is no variable " + std::string(words[2]));
    if (!(lower[k].lo < at && at < lower[k].hi)) throw Rejection("the split is not inside the box");
    if (open_.size() > format::kMostOpen) throw Unfinished("too many boxes are open");
    Box upper = lower;
    lower[k].hi = upper[k].lo = at;
    open_.emplace(next_++, std::move(lower));
    open_.emplace(next_++, std::move(upper));
  }

  void leaf(const std::vector<std::string_view>& words) {
    const auto box = find(words[1]);
    if (std::find(kRules.begin(), kRules.end(), words[2]) == kRules.end())
      throw Rejection("there is no rule '" + std::string(words[2]) + "'");
    const std::string here = "leaf " + std::string(words[1]) + " (" + std::string(words[2]) + "): ";
    ++counts_.leaves;
    try {
      prover_.prove(box->second);
    } catch (const Rejection& why) {
      throw Rejection(here + why.what());
    } catch (const Unfinished& why) {
      throw Unfinished(here + why.what());
    }
    open_.erase(box);
  }

  void require_tiling() const {
    if (!open_.empty())
      throw Rejection(std::to_string(open_.size()) + " boxes have no leaf, for example box " +
                      std::to_string(open_.begin()->first));
  }

  void require_poses() {
    if (!prover_.has_met_variety())
      throw Unfinished("no pose remains: the constraints exclude every pose of the motion");
    if (has_constraints_ && !prover_.has_met_point())
      counts_.note = "no pose was shown to satisfy the constraints: the claim may be about no pose";
  }

  Lines& lines_;
  const bool has_constraints_;
  Verification& counts_;
  WorkClock clock_;
  LeafProver prover_;
  Open open_;
  std::uint64_t next_ = 1;
};

}  // namespace

void check_tree(Lines& lines, Question& question, const Variety& variety, const Options& options,
                Verification& counts) {
  TreeChecker(lines, question, variety, options, counts).check();
}

void check_tree_of_piece(Lines& lines, Question& question, const Variety& variety,
                         const Options& options, Verification& counts) {
  TreeChecker(lines, question, variety, options, counts).check_piece();
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
