// SPDX-License-Identifier: GPL-3.0-or-later
// The description of a kernel in the generated files.
#pragma once

#include <string>
#include <vector>

#include "codegen/kernel/cpp/generate.hpp"
#include "codegen/kernel/formulation/formulation.hpp"
#include "runtime/interval/interval.hpp"

namespace regulus::detail {

/// A motion parameter or an uncertain quantity.
struct SubjectQuantity {
  std::string name;   ///< as in the model; only for comments
  std::string field;  ///< the same as an identifier; empty for uncertain quantities
  std::string unit;   ///< empty: none
  Interval range;     ///< outward
};

struct KernelSubject {
  std::string name;
  std::string name_space;
  std::vector<Isa> isas;  ///< fastest first; the portable one is the last
  std::string command;
  std::string model, motion, source;
  std::string identity;  ///< of the kernel
  int rows = 0;
  int columns = 0;
  int constraints = 0;
  std::vector<SubjectQuantity> parameters;
  std::vector<SubjectQuantity> uncertain;
  double alpha = 0;  ///< rounded up: |det J⁻¹| > alpha implies the model's threshold
};

/// Throws UsageError for invalid names, InputError for ranges without a certain value.
[[nodiscard]] KernelSubject kernel_subject(const Request& request, const Formulation& formulation,
                                           const GenerateOptions& options);

/// Returns "x in [-15, 15] cm", rounded to six digits, for comments.
[[nodiscard]] std::string in_words(const SubjectQuantity& quantity);

/// Returns the first lines of every generated file: licence, command, model, motion, source,
/// identity.
[[nodiscard]] std::string file_head(const KernelSubject& subject);

/// Returns the claim of NO SINGULARITY about a piece, as a comment.
[[nodiscard]] std::string claim_comment(const KernelSubject& subject);

/// Returns bounds of the quantities, one on each line, as the elements of a braced list.
[[nodiscard]] std::string bound_list(const std::vector<SubjectQuantity>& quantities,
                                     double Interval::*bound);

}  // namespace regulus::detail
