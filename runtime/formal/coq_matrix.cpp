// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_matrix.hpp"

#include "runtime/formal/coq_expression.hpp"
#include "runtime/formal/coq_real.hpp"
#include "runtime/formal/matrix_hints.hpp"

namespace regulus::verifier {
namespace {

constexpr std::size_t kHintsInLine = 5;

std::string list_of(const std::vector<std::string>& items) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i)
    text += (i == 0 ? "" : i % kHintsInLine == 0 ? ";\n     " : "; ") + items[i];
  return '[' + text + ']';
}

std::string list_of_names(const std::vector<std::string>& names) {
  return names.empty() ? "no_names" : '[' + text_of(names, "; ") + ']';
}
std::vector<std::string> lists(const std::vector<std::vector<std::string>>& names) {
  std::vector<std::string> texts;
  for (const auto& some : names) texts.push_back(list_of_names(some));
  return texts;
}

}  // namespace

MatrixWriter::MatrixWriter(const Question& question, const std::vector<std::string>& lines,
                           const WrittenValues& values, RobotOfModel& robot)
    : q_(question),
      robot_(robot),
      matrix_(read_named_matrix(values, robot, question.has_threshold, question.singular)) {
  if (matrix_.rows != q_.rows || matrix_.columns != q_.columns)
    throw Unfinished("the matrix of the model file has another shape than that of the certificate");
  const MatrixHints found = find_matrix_hints(question, lines, robot, matrix_);
  std::vector<std::string> words;
  for (const DefinitionHint& hint : found.definitions)
    words.push_back('(' + (hint.word.empty() ? "unnamed" : hint.word) + ", " +
                    list_of_names(hint.without) + ')');
  if (words.empty()) words.emplace_back("(unnamed, no_names)");
  hints_ = list_of(words) + "\n    " + list_of_rows(lists(found.entries), "     ");
  if (q_.has_threshold)
    hints_ += ' ' + (found.scales.empty() ? "[no_names]" : list_of(lists(found.scales)));
}

/// With scales it is the inverse Jacobian.
const char* MatrixWriter::name() const {
  return matrix_.scales.empty() ? "the_matrix" : "the_inverse_jacobian";
}

std::string MatrixWriter::list_of_rows(const std::vector<std::string>& items,
                                       const std::string& margin) const {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i % matrix_.columns != 0)
      text += "; ";
    else
      text += i == 0 ? "[" : "];\n" + margin + '[';
    text += items[i];
  }
  return '[' + text + "]]";
}

std::string MatrixWriter::definition() const {
  std::vector<std::string> arguments;
  for (const MatrixArgument& argument : matrix_.arguments) arguments.push_back(argument.name);
  std::string text = std::string(
                         "(** The matrix of the model file, with the names that the file gives "
                         "its parts. *)\nDefinition ") +
                     name() + " (" + text_of(arguments, " ") + " : R) : nat -> nat -> R :=\n";
  for (const MatrixName& one : matrix_.names) {
    const int number = robot_.own.graph.nodes()[std::size_t(one.variable)].a;
    text += "  let " + robot_.names[std::size_t(number)] + " := " + one.text + " in\n";
  }
  if (matrix_.scales.empty())
    return text + "  matrix_of\n    " + list_of_rows(matrix_.entry_texts, "     ") + ".\n\n";
  return text + "  scaled\n    [" + text_of(matrix_.scale_texts, ";\n     ") +
         "]\n    (matrix_of\n      " + list_of_rows(matrix_.entry_texts, "       ") + ").\n\n";
}

std::string MatrixWriter::matrix() const {
  std::string text = '(' + std::string(name());
  for (const auto& uncertain : robot_.uncertain) text += ' ' + coq_identifier(uncertain.first);
  for (const std::string& pose : robot_.pose) text += ' ' + coq_argument(pose);
  return text + ')';
}

std::string MatrixWriter::shape() const {
  return std::to_string(matrix_.rows) + ' ' + std::to_string(matrix_.columns);
}

std::string MatrixWriter::naming() const {
  std::string text;
  for (std::size_t i = 0; i < matrix_.arguments.size(); ++i)
    if (matrix_.arguments[i].value != kNoNode && !matrix_.arguments[i].is_number)
      text += "  name_argument " + std::to_string(matrix_.arguments.size() - 1 - i) + " as " +
              matrix_.arguments[i].name + ".\n";
  return text + "  name_lets " + name() + ".\n";
}

std::string MatrixWriter::naming_of_quantities() const {
  std::string text;
  for (const Variable& variable : q_.variables) {
    const bool is_error = variable.kind == VariableKind::kError;
    const std::string name = variable.name.substr(0, variable.name.find(' '));
    text += "  name_quantity F as " +
            (is_error ? coq_identifier(name) + "'error" : robot_.of_certificate.at(name)) + ".\n";
  }
  return text;
}

std::string MatrixWriter::hints() const { return hints_; }

}  // namespace regulus::verifier
