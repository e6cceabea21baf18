// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/analysis/box_evaluation.hpp"

#include "codegen/kernel/formulation/formulation.hpp"
#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/kernel/pack/select.hpp"
#include "runtime/evaluation/batch.hpp"
#include "runtime/interval/arithmetic.hpp"
#include "runtime/machine/machine_kernel.hpp"
#include "runtime/problem/row_structure.hpp"
#include "runtime/regularity/determinant.hpp"
#include "runtime/regularity/rohn.hpp"

namespace regulus::detail {
namespace {

FormulationOptions all_products() {
  FormulationOptions options;
  options.scaling = false;
  options.counts_occurrences = false;
  return options;
}

std::vector<Interval> entries_of(ConstIntervalMatrix M) {
  std::vector<Interval> entries;
  for (std::size_t e = 0; e < M.size(); ++e) entries.emplace_back(M.lower(e, 0), M.upper(e, 0));
  return entries;
}

class BoxEvaluator {
 public:
  explicit BoxEvaluator(const Request& request)
      : formulation_(formulate(request.model, request.motion, all_products())),
        kernel_(select(lower(formulation_)), best_isa()) {
    const Variety variety = enclose_variety(request.model, request.motion, formulation_.variables);
    problem_.kernel = kernel_.get();
    problem_.outer = variety.outer;
    problem_.inner = variety.inner;
  }

  BoxEvaluation run() {
    result_.rows = static_cast<std::size_t>(formulation_.rows);
    result_.columns = static_cast<std::size_t>(formulation_.columns);
    for (std::size_t v = 0; v < problem_.outer.size(); ++v)
      result_.box.push_back({formulation_.variables[v].name, problem_.outer[v]});
    matrices();
    if (result_.matrix.empty() || result_.rows != result_.columns) return std::move(result_);
    for (const Method method :
         {Method::kReg, Method::kKjNumeric, Method::kKj, Method::kJkNumeric, Method::kJk})
      for (const Entries entries : {Entries::kNatural, Entries::kDerivatives})
        bounds(method, entries);
    return std::move(result_);
  }

 private:
  /// Loads the box into all lanes.
  void load(Batch& batch) const {
    batch.clear();
    batch.load(0, problem_.outer);
    batch.seal(1);
  }

  void matrices() {
    Settings settings;
    settings.method = Method::kKj;
    Batch batch(problem_, settings, find_row_structure(problem_, settings));
    load(batch);
    LaneMask defined = 1;
    const ConstIntervalMatrix M = batch.product({}, defined);
    if (defined == 0) return;
    result_.matrix = entries_of(M);
    if ((batch.preconditioned() & 1) == 0) return;
    const ConstPointMatrix K = batch.preconditioner();
    for (std::size_t e = 0; e < K.size(); ++e) result_.K.push_back(K.at(e, 0));
    LaneMask lanes = 1;
    const ConstIntervalMatrix product = batch.product({ProductForm::Side::kLeft, false}, lanes);
    if (lanes != 0) result_.product = entries_of(product);
    const ConstIntervalMatrix numeric = batch.product({ProductForm::Side::kLeft, true}, lanes);
    if (lanes != 0) result_.numeric = entries_of(numeric);
  }

  void bounds(Method method, Entries entries) {
    Settings settings;
    settings.method = method;
    settings.entries = entries;
    const RowStructure structure = find_row_structure(problem_, settings);
    Batch batch(problem_, settings, structure);
    load(batch);
    LaneMask lanes = 1;
    const ProductForm form = form_of(method);
    const ConstIntervalMatrix M = batch.product(form, lanes);
    if (lanes == 0) return;
    BoxEvaluation::Bound bound{name(method),
                               entries == Entries::kNatural ? "natural" : "derivatives",
                               "",
                               {},
                               std::nullopt};
    if (result_.columns <= kMaxRohn) bound.rohn = (certain_rohn(M, 1) & 1) != 0;
    const LaneMatrix lane = matrix_of_lane(M, 0);
    // det M = det KM / det K.
    const Interval of_K =
        form.side == ProductForm::Side::kNone ? Interval(1.0) : batch.preconditioner_determinant(0);
    const auto add = [&](const char* determinant, const Interval& value) {
      bound.determinant = determinant;
      bound.value = value / of_K;
      result_.bounds.push_back(bound);
    };
    if (result_.columns <= kMaxExpansion) add("expansion", enclose_determinant(lane));
    add("elimination", enclose_determinant_by_elimination(lane));
  }

  const Formulation formulation_;
  const machine::MachineKernel kernel_;
  Problem problem_;
  BoxEvaluation result_;
};

}  // namespace

BoxEvaluation evaluate_box(const Request& request) { return BoxEvaluator(request).run(); }

}  // namespace regulus::detail
