// SPDX-License-Identifier: Apache-2.0
// The problem of a search, and its settings.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/interval/interval.hpp"
#include "runtime/kernel/abi.hpp"
#include "runtime/problem/filter.hpp"
#include "runtime/problem/ingredients.hpp"

namespace regulus {

namespace detail::cluster {
class Workers;
}

/// A set of values for every variable of a kernel (motion parameters, then uncertain quantities).
/// The problem is to certify it.
///
/// A range such as ±15·π/180 does not end in doubles, so each variable has two. `outer` contains
/// the true range; claims of freedom are about it. `inner` lies within the true range; witnesses
/// may lie in it. It is nullopt if no double is within the true range (a single irrational value):
/// a witness then covers all of `outer`, which includes the true value. For a ball, `outer` is a
/// box around it and `inner` a box inside it.
struct Problem {
  const regulus_kernel* kernel = nullptr;
  std::vector<Interval> outer;
  std::vector<std::optional<Interval>> inner;
  Interval alpha{0.0};  ///< encloses the threshold α ≥ 0
  /// By variable, not 0: neither the matrix nor a constraint depends on it, so no box is split along
  /// it. Empty: all are split. A mistake in it costs verdicts, and makes none wrong.
  std::vector<std::uint8_t> idle{};
  /// The kernel's A is the user's matrix with rows and columns multiplied by powers of two, and its
  /// determinant is 2^e times the user's. Reported determinants are the user's. The kernel's row
  /// scale has the factor 2^-e if α > 0, so that det J⁻¹ is the user's throughout.
  int determinant_exponent = 0;
  /// Another thread may store here a kernel that computes the same as `kernel`, equal to the bit,
  /// in less time. It is read before each batch of boxes; the batch that is being decided keeps the
  /// kernel that it has. Null: there will be none.
  ///
  /// Requires  regulus::CheckedKernel accepts it, and it has the sizes and lists of `kernel`; both live as
  ///           long as the search.
  const std::atomic<const regulus_kernel*>* faster_kernel = nullptr;

  friend bool operator==(const Problem&, const Problem&) = default;
};

/// The regularity tests for each box, in the order of the name; kAuto is the H-matrix test on
/// natural, then on mean-value bounds of K·A.
enum class Method : std::uint8_t {
  kAuto,
  kReg,
  kRegRohn,
  kKj,
  kKjRohn,
  kJk,
  kJkRohn,
  kKjNumeric,
  kJkNumeric,
  kClosedForm,  ///< the kernel's closed form of the determinant
};

/// The matrix whose regularity a method tests: A, or its product with K, and how that is computed:
/// symbolically, or from the entries of A.
struct ProductForm {
  enum class Side : std::uint8_t { kNone, kLeft, kRight };
  Side side = Side::kNone;
  bool numeric = false;

  friend constexpr bool operator==(const ProductForm&, const ProductForm&) = default;
};

[[nodiscard]] ProductForm form_of(Method method) noexcept;

/// How the determinant of an interval matrix is bounded. kBoth: by expansion, and also by
/// elimination if expansion decides nothing and no stronger test follows.
enum class Determinant : std::uint8_t { kExpansion, kElimination, kBoth };

inline constexpr unsigned kMaxThreads = 1024;

/// kElements: uncertain quantities are kept whole in the matrix elements (the paper's D).
/// kVariables: they are bisected like motion parameters (V).
enum class Uncertainty : std::uint8_t { kElements, kVariables };

/// How the entries of the matrix that a method of the paper uses are enclosed. kNatural: by the
/// rewritten expressions. kDerivatives: by these, by the mean-value form, and by the values at the
/// ends of the ranges of the variables in which an entry is monotone. kAuto bounds them in another
/// way.
enum class Entries : std::uint8_t { kNatural, kDerivatives };

/// Returns the fastest choice on the paper's tables: derivatives for K·A, and for every method if
/// uncertain quantities are split.
[[nodiscard]] Entries fitting_entries(Method method, Uncertainty uncertainty) noexcept;

/// kWidest: largest width. kWeighted: largest width relative to the range of the variable, times its weight. kImpact:
/// largest contribution, roughly, to the failure of the test on the method's matrix.
enum class Bisection : std::uint8_t { kWidest, kWeighted, kImpact };

/// Encloses the determinant with more digits than doubles have, at a point or over a box that is
/// too narrow to split. Several threads may call it at once.
class DeterminantOracle {
 public:
  DeterminantOracle() = default;
  DeterminantOracle(const DeterminantOracle&) = delete;
  DeterminantOracle& operator=(const DeterminantOracle&) = delete;
  virtual ~DeterminantOracle() = default;

  /// Ensures   det A(p) ∈ result for all p in `point`; nullopt if A is not certainly defined all
  ///           over it.
  [[nodiscard]] virtual std::optional<Interval> enclose(
      std::span<const Interval> point) noexcept = 0;
};

/// The determinant as one expression of the variables, evaluated in doubles.
class ClosedForm {
 public:
  ClosedForm() = default;
  ClosedForm(const ClosedForm&) = delete;
  ClosedForm& operator=(const ClosedForm&) = delete;
  virtual ~ClosedForm() = default;

  /// Forms it, or finds that this would take too much. The thread that called the search calls this
  /// once, if the search has become long, while no box is being decided.
  virtual void make() noexcept = 0;

  /// Several threads may call it at once.
  ///
  /// Ensures   det A(p) ∈ result for all p in `box` within the constraints, A of the kernel;
  ///           nullopt if that is not certainly defined all over it, or there is no closed form.
  [[nodiscard]] virtual std::optional<Interval> enclose(
      std::span<const Interval> box) const noexcept = 0;
};

/// The place of a coordinate in the range of its variable. An end need not be a double.
enum class PlaceInRange : std::uint8_t { kInside, kLowerEnd, kUpperEnd };

/// The number numerator/denominator, times pi if `of_pi` is not 0; none if the denominator is 0.
struct ExactNumber {
  std::int32_t numerator = 0, denominator = 0, of_pi = 0;

  friend bool operator==(const ExactNumber&, const ExactNumber&) = default;
};

/// A point whose coordinates are known exactly.
struct ExactPlace {
  /// By variable: encloses the coordinate, within the outer range.
  std::vector<Interval> variables;
  /// By variable: an end of its range, or kInside.
  std::vector<PlaceInRange> places;
  /// By variable, if it is inside its range: its value. None: the double of `variables`.
  std::vector<ExactNumber> numbers;
};

/// A small box that contains a singular point.
struct EnclosedPlace {
  /// By variable. For any values of the variables that are not in `chosen`, each within its interval,
  /// there are values of the chosen ones, within theirs, where A·v = 0 for a v within `null_vector`.
  std::vector<Interval> variables;
  std::vector<std::uint32_t> chosen;  ///< rising
  std::vector<Interval> null_vector;  ///< of the model's A; a component is 1, some may be 0
};

/// Knows the model's expressions themselves, not only their bounds. Only the thread that called the
/// search uses it.
///
/// A search asks about the determinant once, in its conclusion, if three conditions hold: nothing
/// was proved except, perhaps, that at one point the determinant is at most the threshold; no box
/// was certified; memory, the time limit or an interrupt did not end the search. It asks about
/// points at ends of ranges if bounds in doubles do not decide whether the determinant is 0 there.
class AlgebraOracle {
 public:
  enum class Determinant : std::uint8_t {
    kUnknown,
    kVanishes,       ///< proved: det A = 0 wherever A is defined
    kSeemsToVanish,  ///< approximately, at every tested point
  };

  AlgebraOracle() = default;
  AlgebraOracle(const AlgebraOracle&) = delete;
  AlgebraOracle& operator=(const AlgebraOracle&) = delete;
  virtual ~AlgebraOracle() = default;

  /// For square matrices. `point`: a point of the variety, inside the constraints, where A is
  /// certainly defined.
  ///
  /// Ensures   kVanishes only if det A is the zero function of the kernel's variables, by an exact
  ///           identity between the expressions that are its entries.
  [[nodiscard]] virtual Determinant determinant(std::span<const Interval> point) noexcept = 0;

  /// For square matrices. `point` encloses one point: its coordinate is the end of a range itself if
  /// `places` says so, otherwise the double.
  ///
  /// Requires  the matrix, the row scales and the pose are certainly defined all over `point`.
  /// Ensures   true only if |det J⁻¹| ≤ α at that point, if α > 0; det A = 0 there, if α = 0.
  [[nodiscard]] virtual bool is_singular_at(std::span<const Interval> point,
                                            std::span<const PlaceInRange> places) noexcept {
    static_cast<void>(point), static_cast<void>(places);
    return false;
  }

  /// Looks for a singular point, first near the middle of `box`, then elsewhere in the variety.
  ///
  /// Ensures   at the returned point, which lies within all ranges, A has less than full column rank
  ///           if it is defined there, by an exact identity between numbers. It may violate
  ///           constraints.
  [[nodiscard]] virtual std::optional<ExactPlace> find_singular(
      std::span<const Interval> box) noexcept {
    static_cast<void>(box);
    return std::nullopt;
  }

  /// Looks for a small box with a singular point, first near the middle of `box`. It finds none where
  /// the determinant only touches 0.
  ///
  /// Ensures   as EnclosedPlace says, by a test of existence; A is defined and continuous on the box of
  ///           `variables`, which may violate ranges and constraints.
  [[nodiscard]] virtual std::optional<EnclosedPlace> enclose_singular(
      std::span<const Interval> box) noexcept {
    static_cast<void>(box);
    return std::nullopt;
  }
};

struct Settings {
  Method method = Method::kAuto;
  Determinant determinant = Determinant::kBoth;
  Entries entries = Entries::kNatural;
  Bisection bisection = Bisection::kImpact;
  std::vector<double> weights;  ///< of the variables, above 0; empty: 1 each
  Uncertainty uncertainty = Uncertainty::kElements;
  std::uint64_t max_boxes = std::numeric_limits<std::uint64_t>::max();
  double time_limit = std::numeric_limits<double>::infinity();  ///< seconds
  const std::atomic<bool>* interrupt = nullptr;                 ///< true: stop soon
  /// Boxes are not split in a variable narrower than this part of its range; a box that cannot be
  /// split any more is reported as blocking. 0: until no double lies strictly inside.
  double min_relative_width = 0x1p-40;
  /// The number of boxes for the search of a singularity after NO SINGULARITY became impossible.
  std::uint64_t boxes_after_problem = 4096;
  /// Evaluate at most this many boxes at once, 1…8. With 1 the order is the paper's.
  unsigned batch = 8;
  /// The number of threads that decide batches, 1…kMaxThreads; with filters only one. The caller's
  /// thread calls the observer. Only the time of the search depends on this number.
  unsigned threads = 1;
  /// After so many boxes a search is cut into units, each of about so many boxes
  /// (runtime/cluster/unit.hpp). The boxes of a search depend on both numbers. Before its first
  /// unit a search learns how far the costly tests are useful, and gets boxes for many workers. With
  /// small units, eight boxes at once are often not to be had; with large ones, it takes long until
  /// there are units for all workers.
  std::uint64_t boxes_before_units = 1U << 14;
  std::uint64_t boxes_of_unit = 1024;
  /// They decide the units of a search in the place of threads of this process.
  detail::cluster::Workers* workers = nullptr;
  /// Gives every box of the variety its verdict: a box that is not certified is split down to the
  /// minimum width, and then searched for a singularity inside it.
  bool exhaustive = false;
  /// Exhaustive searches: boxes are split to the minimum width even if they could be certified.
  bool split_certified = false;
  /// Gives the observer an enclosure of the determinant over each leaf: of A, or of J⁻¹ if α > 0.
  bool enclose_determinants = false;
  DeterminantOracle* oracle = nullptr;
  /// Method auto uses it for boxes that stay undecided after several splits.
  ClosedForm* closed_form = nullptr;
  AlgebraOracle* algebra = nullptr;
  Ingredients ingredients;
  /// Users' tests; used in this order on boxes that our tests leave undecided (filter.h).
  std::vector<const regulus_filter_interface*> filters;

  friend bool operator==(const Settings&, const Settings&) = default;
};

/// Returns true if the settings differ at most in budgets, in how long searches are shared out, and
/// in oracles.
[[nodiscard]] bool same_but_for_run(const Settings& a, const Settings& b);

/// Returns the fault of the problem or the settings, in words; nullopt if a search is possible.
[[nodiscard]] std::optional<std::string> find_fault(const Problem& problem,
                                                    const Settings& settings);

[[nodiscard]] const char* name(Method method) noexcept;
[[nodiscard]] std::optional<Method> parse_method(std::string_view text) noexcept;

}  // namespace regulus
