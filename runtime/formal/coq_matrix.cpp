// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_matrix.hpp"

#include <utility>

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

std::string list_of_rows(const std::vector<std::string>& items, std::size_t columns,
                         const std::string& margin) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i % columns != 0)
      text += "; ";
    else
      text += i == 0 ? "[" : "];\n" + margin + '[';
    text += items[i];
  }
  return '[' + text + "]]";
}

/// With scales it is the inverse Jacobian.
const char* name_of(const NamedMatrix& matrix) {
  return matrix.scales.empty() ? "the_matrix" : "the_inverse_jacobian";
}

std::string definition_of(const NamedMatrix& matrix, const RobotOfModel& robot) {
  std::vector<std::string> arguments;
  for (const MatrixArgument& argument : matrix.arguments) arguments.push_back(argument.name);
  std::string text = std::string(
                         "(** The matrix of the model file, with the names that the file gives "
                         "its parts. *)\nDefinition ") +
                     name_of(matrix) + " (" + text_of(arguments, " ") +
                     " : R) : nat -> nat -> R :=\n";
  for (const MatrixName& one : matrix.names) {
    const int number = robot.own.graph.nodes()[std::size_t(one.variable)].a;
    text += "  let " + robot.names[std::size_t(number)] + " := " + one.text + " in\n";
  }
  if (matrix.scales.empty())
    return text + "  matrix_of\n    " + list_of_rows(matrix.entry_texts, matrix.columns, "     ") +
           ".\n\n";
  return text + "  scaled\n    [" + text_of(matrix.scale_texts, ";\n     ") +
         "]\n    (matrix_of\n      " + list_of_rows(matrix.entry_texts, matrix.columns, "       ") +
         ").\n\n";
}

std::string naming_of(const NamedMatrix& matrix) {
  std::string text;
  for (std::size_t i = 0; i < matrix.arguments.size(); ++i)
    if (matrix.arguments[i].value != kNoNode && !matrix.arguments[i].is_number)
      text += "  name_argument " + std::to_string(matrix.arguments.size() - 1 - i) + " as " +
              matrix.arguments[i].name + ".\n";
  return text + "  name_lets " + name_of(matrix) + ".\n";
}

}  // namespace

WrittenMatrix write_matrix(const Question& question, const WrittenValues& values,
                           RobotOfModel& robot) {
  NamedMatrix matrix = read_named_matrix(values, robot, question.has_threshold, question.singular);
  std::string applied = '(' + std::string(name_of(matrix));
  for (const auto& uncertain : robot.uncertain) applied += ' ' + coq_identifier(uncertain.first);
  for (const std::string& pose : robot.pose) applied += ' ' + coq_argument(pose);
  const std::string definition = definition_of(matrix, robot), naming = naming_of(matrix);
  return {std::move(matrix), "Matrices", definition, applied + ')', naming};
}

MatrixWriter::MatrixWriter(const Question& question, const std::vector<std::string>& lines,
                           RobotOfModel& robot, WrittenMatrix written)
    : q_(question), robot_(robot), written_(std::move(written)) {
  const NamedMatrix& matrix = written_.named;
  if (matrix.rows != q_.rows || matrix.columns != q_.columns)
    throw Unfinished("the matrix of the model file has another shape than that of the certificate");
  const MatrixHints found = find_matrix_hints(question, lines, robot, matrix);
  std::vector<std::string> words;
  for (const DefinitionHint& hint : found.definitions)
    words.push_back('(' + (hint.word.empty() ? "unnamed" : hint.word) + ", " +
                    list_of_names(hint.without) + ')');
  if (words.empty()) words.emplace_back("(unnamed, no_names)");
  hints_ = list_of(words) + "\n    " + list_of_rows(lists(found.entries), matrix.columns, "     ");
  if (q_.has_threshold)
    hints_ += ' ' + (found.scales.empty() ? "[no_names]" : list_of(lists(found.scales)));
}

std::string MatrixWriter::shape() const {
  return std::to_string(written_.named.rows) + ' ' + std::to_string(written_.named.columns);
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

}  // namespace regulus::verifier
