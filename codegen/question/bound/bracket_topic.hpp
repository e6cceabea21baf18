// SPDX-License-Identifier: GPL-3.0-or-later
// The matrix that the searches of a bracket are about, so that other processes can form it, too.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "codegen/question/margin/prepared_margin.hpp"
#include "codegen/question/quantity/bordered.hpp"

namespace regulus {

/// The kernel that searches need.
enum class TopicKind : std::uint8_t {
  kBracket,           ///< of a bordered matrix
  kExpandedMatrix,    ///< of the matrix itself, with Taylor's expansion (condition_kernel.hpp)
  kMatrixWithSlopes,  ///< the same, with slopes of its entries
};

/// The question of the searches of one bracket, for a process that has the same model and words.
struct BracketTopic {
  std::size_t component = 0;  ///< its number in the quantity
  double reference = 0;       ///< y of question/quantity/bordered.hpp
  double low = 0;             ///< the ends of the bracket
  std::optional<double> high{};
  TopicKind kind = TopicKind::kBracket;  ///< another one: nothing else matters
};

[[nodiscard]] std::string write_topic(const BracketTopic& topic);
/// Accepts any bytes. Throws cluster::MalformedMessage.
[[nodiscard]] BracketTopic read_topic(std::string_view bytes);

/// Returns the question of a bracket of r, whose least value is 0.
[[nodiscard]] MarginQuestion question_of(const Bordered& bordered, MarginValue low,
                                         std::optional<MarginValue> high);
/// Returns the question with the limit as the upper end.
[[nodiscard]] MarginQuestion question_at_limit(const Bordered& bordered);

/// Returns a question about how far something may grow, as one about a component that keeps a limit.
[[nodiscard]] MarginQuestion question_within_limit(MarginQuestion question,
                                                   const Component& component,
                                                   const GiNaC::ex& limit);

/// Forms the matrix of a topic of `regulus bound`. `limit`: of the command line.
///
/// Throws    cluster::MalformedMessage for a component that the quantity does not have; the
///           exceptions of PreparedMargin.
[[nodiscard]] PreparedMargin prepare_topic(const BracketTopic& topic, const Request& request,
                                           const Quantity& quantity,
                                           const std::optional<GiNaC::ex>& limit,
                                           const SearchOptions& search);

/// Forms the matrix of a topic of `regulus margin` within a limit. `question`: of the command line.
///
/// Throws    the same.
[[nodiscard]] PreparedMargin prepare_topic(const BracketTopic& topic, const Request& request,
                                           MarginQuestion question, const Quantity& quantity,
                                           const GiNaC::ex& limit, const SearchOptions& search);

}  // namespace regulus
