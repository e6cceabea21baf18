// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/infix_reader.hpp"

namespace regulus::verifier {

bool mentions(std::string_view text, std::string_view name) {
  for (std::size_t at = text.find(name); at != std::string_view::npos;
       at = text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    const bool begins = at == 0 || !is_of_name(text[at - 1]);
    if (begins && (end == text.size() || !is_of_name(text[end]))) return true;
  }
  return false;
}

NodeId InfixReader::all() {
  const NodeId result = sum();
  if (at_ != text_.size()) fail("an operator or the end");
  return result;
}

NodeId InfixReader::sum() {
  NodeId left = product();
  for (;;) {
    if (take('+'))
      left = graph_.add(Op::kAdd, left, product());
    else if (take('-'))
      left = graph_.add(Op::kSubtract, left, product());
    else
      return left;
  }
}

NodeId InfixReader::product() {
  NodeId left = factor();
  for (;;) {
    if (take('*'))
      left = graph_.add(Op::kMultiply, left, factor());
    else if (take('/'))
      left = graph_.add(Op::kDivide, left, factor());
    else
      return left;
  }
}

NodeId InfixReader::call(Op function) {
  const NodeId first = sum();
  NodeId second = 0;
  if (operands(function) > 1) {
    expect(',');
    second = sum();
  }
  expect(')');
  return graph_.add(function, first, second);
}

bool InfixReader::take(char c) {
  if (at_ == text_.size() || text_[at_] != c) return false;
  ++at_;
  skip_space();
  return true;
}

void InfixReader::expect(char c) {
  if (!take(c)) fail(std::string(1, c));
}

void InfixReader::skip_space() {
  while (at_ < text_.size() && is_space(text_[at_])) ++at_;
}

void InfixReader::skip_digits() {
  while (at_ < text_.size() && is_digit(text_[at_])) ++at_;
}

bool InfixReader::is_at_number() const {
  return at_ < text_.size() && (is_digit(text_[at_]) || text_[at_] == '.');
}

}  // namespace regulus::verifier
