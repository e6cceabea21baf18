// SPDX-License-Identifier: GPL-3.0-or-later
// The quantity that grows in `regulus margin`: a tolerance, the threshold, the size of a box
// variety, the range of one parameter, or the control errors.
#pragma once

#include <ginac/ginac.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "codegen/question/margin/growing_size.hpp"

namespace regulus::detail {

enum class MarginQuantity { kTolerance, kAlpha, kScale, kParameter, kTube };

/// A value with the text that denotes it exactly and that `check` accepts.
struct MarginValue {
  std::string text;
  GiNaC::ex exact;
  double approx = 0;  ///< for planning only
  std::vector<GiNaC::ex> must_be_defined{};
};

/// Returns the decimal that reads back as `value`.
[[nodiscard]] MarginValue decimal_value(double value);

/// Returns the question of regularity about a motion and tolerances that have grown; see
/// question/quantity/bordered.hpp.
using QuestionAbout = std::function<Request(const Request&)>;

/// LO:HI, or LO: if HI must be found.
struct MarginQuestion {
  MarginQuantity quantity = MarginQuantity::kTolerance;
  std::string groups;  ///< of a tolerance; the name of a parameter; those of a tube, or empty
  bool is_two_sided = false;   ///< a parameter grows to [−v, v]; otherwise from its low end to v
  bool beyond_limits = false;  ///< the ranges may leave the limits of the joints
  MarginValue low;
  std::optional<MarginValue> high;
  std::string unit{};          ///< of the values, a label; empty: none, or not known
  std::string limit{};         ///< "force in leg 3 < 20", what must hold; empty: no singularity
  bool has_threshold = false;  ///< |det J⁻¹| is compared with more than 0
  QuestionAbout about{};       ///< that the limit holds; empty: the request itself
  /// What a certificate is about, at a request that has grown; empty: that this is regular.
  std::function<CertifiedMotion(const Request& grown)> certified{};
};

/// Returns the value of a bracket's plan; an end of the question as it was written.
[[nodiscard]] MarginValue value_at(const MarginQuestion& question, double planned);

/// Returns the value at which the kernel is formed. The kernel is the same at all values except 0,
/// where quantities would not be uncertain, so the value is not 0.
[[nodiscard]] MarginValue forming_value(const MarginQuestion& question);

/// Removes the one option with a range: a tolerance or the alpha of `model`, or one of `size`. The
/// others stay as they are. Throws UsageError.
[[nodiscard]] MarginQuestion take_question(ModelOptions& model, const GrowingSize& size);

/// Returns the label of the unit in which the values are; empty if they have none, or not one.
[[nodiscard]] std::string unit_of_values(const Request& request, const MarginQuestion& question);

/// Sets the unit of the values, and reads LO and HI again if they are numbers of degrees: 10deg is 10.
void take_unit(MarginQuestion& question, const Request& request);

/// Returns the request with the quantity at a value.
[[nodiscard]] Request grown(const Request& nominal, const MarginQuestion& question,
                            const MarginValue& value);

/// The ranges of a request as read; scales refer to them.
class MarginRequest {
 public:
  /// Throws    UsageError if the motion or the model cannot grow in that way.
  MarginRequest(Request nominal, const MarginQuestion& question);

  /// Returns the request as read, before anything grows.
  [[nodiscard]] const Request& nominal() const noexcept { return nominal_; }
  /// Returns the question at a value: about the request that has grown.
  [[nodiscard]] Request at(const MarginValue& value) const;
  /// Returns what a certificate at a value is about.
  [[nodiscard]] CertifiedMotion certified_at(const MarginValue& value) const;
  /// Returns the pose parameters whose control errors are variables of the search, at every value.
  [[nodiscard]] std::set<std::string> with_control_errors() const;
  /// Sets ranges and threshold at `value`, for variables that were formed at another value.
  ///
  /// Ensures   the variety of `p` is that of `value`. Its formulation and its kernel do not change:
  ///           no expression in them depends on a tolerance, on the range of a motion parameter, on
  ///           a control error, or on α.
  void replan(PreparedSearch& p, const MarginValue& value) const;

 private:
  [[nodiscard]] Request grown_to(const MarginValue& value) const {
    return grown(nominal_, question_, value);
  }
  void require_growth() const;
  void require_plain_tube() const;
  void require_limits() const;

  Request nominal_;
  MarginQuestion question_;
};

/// Returns the request with the tolerance or the control error that grows at 0. Ranges and threshold are
/// those of the request.
[[nodiscard]] Request before_growth(const Request& nominal, const MarginQuestion& question);
/// True if before_growth() has it at 0: it is no quantity of the request then.
[[nodiscard]] inline bool grows_from_0(const MarginQuestion& question) {
  return question.quantity == MarginQuantity::kTolerance ||
         question.quantity == MarginQuantity::kTube;
}
/// Returns "psi in [-1, v] deg, v grows": the range of a parameter that grows.
[[nodiscard]] std::string describe_growing_range(const Request& nominal,
                                                 const MarginQuestion& question);

/// Returns "tolerance of base,platform", for example.
[[nodiscard]] std::string describe_quantity(const MarginQuestion& question);

}  // namespace regulus::detail
