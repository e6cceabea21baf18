// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/api/kernel.hpp"

#include "codegen/question/engine/pipeline.hpp"
#include "codegen/use/api/algebra_lock.hpp"

namespace regulus {

using namespace detail;

struct Kernel::Parts {
  PreparedSearch prepared;
  std::vector<std::string> variables;
  std::size_t motion_parameters = 0;

  explicit Parts(PreparedSearch search) : prepared(std::move(search)) {
    for (const VariableLabel& variable : prepared.labels.variables) {
      variables.push_back(variable.name);
      motion_parameters += variable.kind == VariableKind::kMotion ? 1 : 0;
    }
    // The expressions are not needed any more, and only the thread that made them may use them.
    prepared.stages.reset();
  }
};

Kernel::Kernel(const Question& question, const KernelOptions& options) {
  const AlgebraLock lock;
  SearchOptions search;
  search.engine = options.engine;
  search.isa = options.isa;
  search.use_cache = options.use_cache;
  search.boxes_before_compiling = 0;
  parts_ = std::make_unique<Parts>(prepare(question.options(), search));
}

Kernel::Kernel(Kernel&&) noexcept = default;
Kernel& Kernel::operator=(Kernel&&) noexcept = default;
Kernel::~Kernel() = default;

const std::vector<std::string>& Kernel::variables() const noexcept { return parts_->variables; }

const std::vector<Interval>& Kernel::ranges() const noexcept {
  return parts_->prepared.variety.outer;
}

std::size_t Kernel::motion_parameters() const noexcept { return parts_->motion_parameters; }

Checker Kernel::checker(unsigned max_boxes) const {
  const Variety& variety = parts_->prepared.variety;
  return Checker(parts_->prepared.kernel->functions(), variety.outer, max_boxes, variety.alpha.hi);
}

}  // namespace regulus
