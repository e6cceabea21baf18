// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_tubes.hpp"

#include <cstdio>
#include <span>
#include <vector>

#include "runtime/formal/coq_question.hpp"
#include "runtime/proof/format.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {
namespace {

std::string coq_double(std::string_view word) {
  const double x = read_double(word);
  char text[40];
  std::snprintf(text, sizeof text, x < 0 ? "(%a)" : "%a", x);
  return text;
}

using Words = std::span<const std::string_view>;

std::string doubles(Words words) {
  std::string text = "[";
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : "; ") + coq_double(words[i]);
  return text + "]";
}

/// The numbers of a place at the numbers of their variables in Coq; the other variables have 0.
std::string at_places(Words words, const std::vector<std::size_t>& places, std::size_t all) {
  std::vector<std::string_view> spread(all, "0x0p+0");
  for (std::size_t k = 0; k < words.size(); ++k) spread[places[k]] = words[k];
  return doubles(spread);
}

/// `numbers`: x0, c, S row by row, r.
std::string tube(Words numbers, const std::vector<std::size_t>& places, std::size_t all,
                 std::size_t n) {
  const std::size_t m = places.size();
  if (numbers.size() != m + 2 * n + n * m) throw Rejection("a tube has another number of numbers");
  std::string rows;
  for (std::size_t i = 0; i < n; ++i)
    rows += (i == 0 ? "" : "; ") + at_places(numbers.subspan(m + n + i * m, m), places, all);
  return "Held (Tube " + at_places(numbers.first(m), places, all) + " " +
         doubles(numbers.subspan(m, n)) + " [" + rows + "] " + doubles(numbers.last(n)) + ")";
}

/// A box: open, cut in two, or a leaf.
struct BoxOfTree {
  std::string text;       ///< empty: the box is open
  std::size_t lower = 0;  ///< the upper part is the next box; 0: a leaf
  std::size_t depth = 0;
};

class TreeOfTubes {
 public:
  TreeOfTubes(Lines& lines, const Question& question, const VariablesOfCoq& variables)
      : lines_(lines), variables_(variables), n_(question.closure->names.size()) {}

  /// Reads on to the line after the tree.
  std::string text() {
    while (next()) {
      const auto words = words_of(lines_.text());
      if (words.size() == 4 && words[0] == "s")
        cut(words);
      else if (words.size() >= 3 && words[0] == "l")
        leaf(words);
      else
        break;
    }
    std::string text;
    print(0, text);
    return text;
  }

 private:
  static constexpr std::size_t kDeepest = 1000;  ///< as the verifier allows

  bool next() {
    if (lines_.next()) return true;
    throw Rejection("the file ends before the line 'end'");
  }

  BoxOfTree& open_box(std::string_view word) {
    const std::size_t number = read_count(word, std::size_t(-1));
    if (number >= nodes_.size() || !nodes_[number].text.empty())
      throw Rejection("box " + std::string(word) + " is not open");
    return nodes_[number];
  }

  void cut(const std::vector<std::string_view>& words) {
    BoxOfTree& node = open_box(words[1]);
    if (node.depth == kDeepest) throw Unfinished("too many splits are above a tube");
    const std::size_t k = read_count(words[2], format::kMostVariables);
    if (k >= variables_.places.size())
      throw Rejection("there is no variable " + std::string(words[2]));
    node.text = "Cut " + std::to_string(variables_.places[k]) + " " + coq_double(words[3]);
    node.lower = nodes_.size();
    const BoxOfTree part{"", 0, node.depth + 1};
    nodes_.push_back(part), nodes_.push_back(part);
  }

  void leaf(const std::vector<std::string_view>& words) {
    BoxOfTree& node = open_box(words[1]);
    if (words[2] == format::kOutsideLeaf && words.size() == 3)
      node.text = "Excluded";
    else if (words[2] == format::kTubeLeaf)
      node.text = tube(Words(words).subspan(3), variables_.places, variables_.count, n_);
    else
      throw Rejection("there is no rule '" + std::string(words[2]) + "'");
  }

  void print(std::size_t number, std::string& text) const {
    const BoxOfTree& node = nodes_[number];
    if (node.text.empty()) throw Rejection("box " + std::to_string(number) + " has no leaf");
    text += node.text;
    if (node.lower == 0) return;
    for (const std::size_t part : {node.lower, node.lower + 1}) {
      text += "\n  (";
      print(part, text);
      text += ")";
    }
  }

  Lines& lines_;
  const VariablesOfCoq& variables_;
  const std::size_t n_;
  std::vector<BoxOfTree> nodes_{1};
};

}  // namespace

std::string coq_tubes(Lines& lines, const Question& question, const VariablesOfCoq& variables,
                      std::size_t pieces) {
  std::vector<CoqItem> trees;
  if (pieces == 0) {
    trees.push_back({"", TreeOfTubes(lines, question, variables).text()});
  } else if (!lines.next()) {
    throw Rejection("the file ends before the line 'tree'");
  }
  while (trees.size() < pieces) {
    if (lines.text() != "tree") throw Rejection("expected the line 'tree' of a piece");
    trees.push_back({"piece " + std::to_string(trees.size() + 1),
                     TreeOfTubes(lines, question, variables).text()});
  }
  if (!lines.text().starts_with("end "))
    throw Rejection("expected 's BOX VARIABLE AT', 'l BOX RULE' or 'end LEAVES'");
  return "\n(** Where the set is cut, and the tubes over its parts. They are hints: Coq checks "
         "them. *)\nDefinition the_tubes : " +
         (pieces == 0 ? "tubes := (\n  " + trees[0].text + ")%float.\n"
                      : "list tubes := (\n  " + coq_list(trees, "   ") + ")%float.\n");
}

}  // namespace regulus::verifier
