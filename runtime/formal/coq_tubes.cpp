// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_tubes.hpp"

#include <span>
#include <vector>

#include "runtime/formal/coq_question.hpp"
#include "runtime/proof/format.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {
namespace {

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

/// Returns the text of a leaf.
std::string leaf_of(std::string_view word, Words numbers, const Question& question,
                    const VariablesOfCoq& variables) {
  if (word == format::kOutsideLeaf && numbers.empty()) return "Excluded";
  if (question.paves && word == format::kUndecidedLeaf && numbers.empty()) return "NoTube";
  const bool is_about_forces = question.paves && question.quantity && word != format::kTubeLeaf;
  if (word == format::kTubeLeaf || (is_about_forces && format::has_tube(word)))
    return tube(numbers, variables.places, variables.count, question.closure->names.size());
  throw Rejection("there is no rule '" + std::string(word) + "'");
}

void print(const TreeOfBoxes& boxes, std::size_t number, std::string& text) {
  const BoxOfTree& box = boxes[number];
  if (box.lower == 0) {
    text += box.tube;
    return;
  }
  text += "Cut " + std::to_string(box.variable) + ' ' + box.place;
  for (const std::size_t part : {box.lower, box.lower + 1}) {
    text += "\n  (";
    print(boxes, part, text);
    text += ")";
  }
}

}  // namespace

TreesOfTubes read_trees_of_tubes(Lines& lines, const Question& question,
                                 const VariablesOfCoq& variables, std::size_t pieces) {
  const TubeOfLeaf leaf = [&](std::string_view word, Words numbers) {
    return leaf_of(word, numbers, question, variables);
  };
  TreesOfTubes trees;
  if (pieces == 0) {
    trees.push_back(read_tree_of_boxes(lines, variables, leaf));
  } else if (!lines.next()) {
    throw Rejection("the file ends before the line 'tree'");
  }
  while (trees.size() < pieces) {
    if (lines.text() != "tree") throw Rejection("expected the line 'tree' of a piece");
    trees.push_back(read_tree_of_boxes(lines, variables, leaf));
  }
  require_end_of_trees(lines);
  return trees;
}

std::string coq_tubes(const TreesOfTubes& trees, bool has_pieces) {
  std::vector<CoqItem> items;
  for (const TreeOfBoxes& tree : trees) {
    CoqItem& item = items.emplace_back();
    if (has_pieces) item.comment = "piece " + std::to_string(items.size());
    print(tree, 0, item.text);
  }
  return "\n(** Where the set is cut, and the tubes over its parts. They are hints: Coq checks "
         "them. *)\nDefinition the_tubes : " +
         (has_pieces ? "list tubes := (\n  " + coq_list(items, "   ") + ")%float.\n"
                     : "tubes := (\n  " + items.at(0).text + ")%float.\n");
}

}  // namespace regulus::verifier
