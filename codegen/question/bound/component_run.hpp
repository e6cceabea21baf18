// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds one component: what does not depend on whether its poses are a set or a path.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "codegen/question/bound/bound_run.hpp"
#include "codegen/question/engine/search_topic.hpp"
#include "codegen/question/margin/attempts.hpp"
#include "codegen/support/time_budget.hpp"

namespace regulus::detail {

class ComponentRun {
 public:
  /// All but the budget live as long as this.
  ComponentRun(const Request& request, const Component& component, const BoundSettings& settings,
               const TimeBudget& budget);
  ComponentRun(const ComponentRun&) = delete;
  ComponentRun& operator=(const ComponentRun&) = delete;
  virtual ~ComponentRun() = default;

  /// Brackets the component.
  [[nodiscard]] ComponentBound bracket();
  /// Compares it with the limit of the settings.
  [[nodiscard]] ComponentBound compare();

 protected:
  /// What searches of B(r) have shown: B is regular up to one value, and singular at another.
  struct Ends {
    std::optional<MarginValue> certified{}, refuted{};
    std::optional<AttainedPlace> place{};  ///< of the refuted value
    bool is_closed = false;                ///< as narrow as asked
    bool is_empty = false;                 ///< no pose remains
    std::string obstacle{};  ///< why a search was undecided that had boxes and seconds left
  };

  /// Returns the component at some poses.
  [[nodiscard]] virtual std::vector<double> samples() = 0;
  /// Searches until the ends are as near as the gap. A later call has a smaller gap, and the ends of
  /// the call before as those of its question.
  [[nodiscard]] virtual Ends close(const MarginQuestion& question, double gap) = 0;
  /// Adds the work, and writes the proofs, as far as close() has not done it.
  virtual void finish() {}
  /// Searches at one value. Notes the place of a witness, or why nothing is known, and the proofs.
  [[nodiscard]] virtual MarginStep search_at(const MarginQuestion& question,
                                             const MarginValue& value) = 0;

  /// Returns the proofs of this component; `no_safe`, `no_singular`: why an end has none.
  [[nodiscard]] EndProofs proofs(const char* no_safe, const char* no_singular) const;
  [[nodiscard]] bool are_proofs_wanted() const { return !settings_.certificate.empty(); }
  /// Returns what a certificate is about: the model, the quantity and the bound that the range of r
  /// means.
  [[nodiscard]] CertifiedMotion certified(const Request& grown, Bordered bordered) const;
  [[nodiscard]] bool is_interrupted() const {
    return settings_.interrupt != nullptr && *settings_.interrupt;
  }
  [[nodiscard]] const Component& component() const { return result_.component; }
  /// Names the matrix of a bracket for other processes.
  [[nodiscard]] SearchTopic topic_of(const MarginQuestion& question) const;

  const Request& request_;
  const BoundSettings& settings_;
  TimeBudget budget_;
  Bordered bordered_;
  double reference_ = 0;  ///< its shortest decimal is that of bordered_
  ComponentBound result_;

 private:
  [[nodiscard]] MarginQuestion choose_question();
  [[nodiscard]] bool is_zero_where_defined() const;
  [[nodiscard]] bool is_zero_everywhere() const;
  [[nodiscard]] double least_that_counts() const;
  [[nodiscard]] bool is_negligible() const;
  void set_ends(const Ends& ends);
};

}  // namespace regulus::detail
