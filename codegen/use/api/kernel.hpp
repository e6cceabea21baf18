// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "codegen/question/engine/options.hpp"
#include "codegen/use/api/question.hpp"
#include "runtime/embedded/checker.hpp"

namespace regulus {

struct KernelOptions {
  Engine engine = Engine::kJit;  ///< kAuto: compiled, or interpreted if there is no compiler
  std::optional<Isa> isa{};      ///< nullopt: the best of this processor
  bool use_cache = true;
};

/// The compiled functions of a question, for programs that check many pieces of the motion. It owns
/// its machine code and may be moved.
class Kernel {
 public:
  /// Threads and errors as check().
  explicit Kernel(const Question& question, const KernelOptions& options = {});
  Kernel(Kernel&&) noexcept;
  Kernel& operator=(Kernel&&) noexcept;
  ~Kernel();

  /// Returns the names of the motion parameters, then of the uncertain quantities.
  [[nodiscard]] const std::vector<std::string>& variables() const noexcept;
  /// Returns a range for each variable, rounded outward.
  [[nodiscard]] const std::vector<Interval>& ranges() const noexcept;
  [[nodiscard]] std::size_t motion_parameters() const noexcept;

  /// Returns a checker, which decides pieces of the motion: a range for each motion parameter,
  /// within `ranges`. A check does not allocate or lock; each thread needs its own checker. The
  /// threshold is that of the question, rounded up.
  ///
  /// Requires  this kernel outlives the checker; 1 ≤ max_boxes ≤ Checker::kMaxBoxes.
  [[nodiscard]] Checker checker(unsigned max_boxes) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace regulus
