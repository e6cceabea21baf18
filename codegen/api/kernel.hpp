// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "codegen/api/question.hpp"
#include "codegen/engine/options.hpp"
#include "runtime/embedded/checker.hpp"

namespace regulus::inline api {

struct KernelOptions {
  Engine engine = Engine::kJit;  ///< kAuto: compiled, and interpreted where there is no compiler
  std::optional<Isa> isa;        ///< nullopt: the best this processor has
  bool use_cache = true;
};

/// The functions of a question, compiled and kept: for programs that check pieces of the motion
/// over and over. It owns what it was compiled to and may be moved.
class Kernel {
 public:
  /// Threads and errors as check().
  explicit Kernel(const Question& question, const KernelOptions& options = {});
  Kernel(Kernel&&) noexcept;
  Kernel& operator=(Kernel&&) noexcept;
  ~Kernel();

  /// The names of the motion parameters, then of the uncertain quantities.
  [[nodiscard]] const std::vector<std::string>& variables() const noexcept;
  /// A range for each variable, rounded outward.
  [[nodiscard]] const std::vector<Interval>& ranges() const noexcept;
  [[nodiscard]] std::size_t motion_parameters() const noexcept;

  /// Decides pieces of the motion: a range for each motion parameter, within `ranges`. A check
  /// neither allocates nor locks; each thread needs a checker of its own. The threshold is that of
  /// the question, rounded up.
  ///
  /// Requires  this kernel outlives the checker; 1 ≤ max_boxes ≤ Checker::kMaxBoxes.
  [[nodiscard]] Checker checker(unsigned max_boxes) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace regulus::inline api
