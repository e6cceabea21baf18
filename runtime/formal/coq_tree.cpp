// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_tree.hpp"

#include <cmath>
#include <cstdio>

#include "runtime/proof/format.hpp"
#include "runtime/verifier/question.hpp"

namespace regulus::verifier {
namespace {

class TreeReaderOfCoq {
 public:
  TreeReaderOfCoq(Lines& lines, const VariablesOfCoq& variables, const TubeOfLeaf& tube)
      : lines_(lines), variables_(variables), tube_(tube) {}

  TreeOfBoxes read() {
    while (next()) {
      const auto words = words_of(lines_.text());
      if (words.size() == 4 && words[0] == "s")
        cut(words);
      else if (words.size() >= 3 && words[0] == "l")
        leaf(words);
      else
        break;
    }
    for (std::size_t number = 0; number < boxes_.size(); ++number)
      if (is_open(boxes_[number]))
        throw Rejection("box " + std::to_string(number) + " has no leaf");
    return std::move(boxes_);
  }

 private:
  static constexpr std::size_t kDeepest = 1000;  ///< as the verifier allows

  bool next() {
    if (lines_.next()) return true;
    throw Rejection("the file ends before the line 'end'");
  }

  static bool is_open(const BoxOfTree& box) { return box.lower == 0 && box.word.empty(); }

  BoxOfTree& open_box(std::string_view word) {
    const std::size_t number = read_count(word, std::size_t(-1));
    if (number >= boxes_.size() || !is_open(boxes_[number]))
      throw Rejection("box " + std::string(word) + " is not open");
    return boxes_[number];
  }

  void cut(const std::vector<std::string_view>& words) {
    BoxOfTree& box = open_box(words[1]);
    if (box.depth == kDeepest) throw Unfinished("too many splits are above a leaf");
    const std::size_t k = read_count(words[2], format::kMostVariables);
    if (k >= variables_.places.size())
      throw Rejection("there is no variable " + std::string(words[2]));
    box.variable = variables_.places[k];
    box.place = coq_double(words[3]);
    box.lower = boxes_.size();
    BoxOfTree part;
    part.depth = box.depth + 1;
    boxes_.push_back(part), boxes_.push_back(part);
  }

  void leaf(const std::vector<std::string_view>& words) {
    BoxOfTree& box = open_box(words[1]);
    box.tube = tube_(words[2], std::span(words).subspan(3));
    box.word = words[2];
  }

  Lines& lines_;
  const VariablesOfCoq& variables_;
  const TubeOfLeaf& tube_;
  TreeOfBoxes boxes_{1};
};

}  // namespace

TreeOfBoxes read_tree_of_boxes(Lines& lines, const VariablesOfCoq& variables,
                               const TubeOfLeaf& tube) {
  return TreeReaderOfCoq(lines, variables, tube).read();
}

void require_end_of_trees(Lines& lines) {
  if (!lines.text().starts_with("end "))
    throw Rejection("expected 's BOX VARIABLE AT', 'l BOX RULE' or 'end LEAVES'");
}

std::string coq_double(std::string_view word) {
  const double x = read_double(word);
  char text[40];
  std::snprintf(text, sizeof text, std::signbit(x) ? "(%a)" : "%a", x);
  return text;
}

}  // namespace regulus::verifier
