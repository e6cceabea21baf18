// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/mechanism/determinant_factors.hpp"

#include <algorithm>
#include <bit>
#include <string>
#include <tuple>
#include <utility>

#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/exact/parsed_expression.hpp"
#include "codegen/model/mechanism/half_angles.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;
using GiNaC::matrix;

// Limits of the work, which is done whenever a model is read.
constexpr std::size_t kMostTermsOfMatrix = 100;     ///< of a block's entries, together
constexpr std::size_t kMostTerms = 40;              ///< of a determinant that is factored
constexpr std::size_t kMostTermsOfNumerator = 300;  ///< in tangents of half the angles
constexpr unsigned kMostRows = 8;

/// Rows and columns of a matrix, a bit each.
struct Part {
  unsigned rows, columns;
};

/// True if listing the numbers of the sets one after the other is an odd permutation.
bool is_odd(const std::vector<unsigned>& sets) {
  int exchanges = 0;
  unsigned before = 0;
  for (const unsigned set : sets) {
    for (unsigned rest = set; rest != 0; rest &= rest - 1) {
      const unsigned bit = rest & ~(rest - 1);
      exchanges += std::popcount(before & ~(bit - 1));
    }
    before |= set;
  }
  return exchanges % 2 != 0;
}

std::size_t count_terms(const ex& e) { return GiNaC::is_a<GiNaC::add>(e) ? e.nops() : 1; }

matrix selected(const matrix& A, Part part) {
  matrix result(static_cast<unsigned>(std::popcount(part.rows)),
                static_cast<unsigned>(std::popcount(part.columns)));
  for (unsigned i = 0, to_i = 0; i < A.rows(); ++i) {
    if ((part.rows >> i & 1U) == 0) continue;
    for (unsigned j = 0, to_j = 0; j < A.cols(); ++j)
      if ((part.columns >> j & 1U) != 0) result(to_i, to_j++) = A(i, j);
    ++to_i;
  }
  return result;
}

void negate_first_row(matrix& A) {
  for (unsigned j = 0; j < A.cols(); ++j) A(0, j) = -A(0, j);
}

/// Columns of the part with an entry in one of the rows that is not 0.
unsigned columns_with_entries(const matrix& A, Part part, unsigned rows) {
  unsigned columns = 0;
  for (unsigned i = 0; i < A.rows(); ++i)
    for (unsigned j = 0; j < A.cols(); ++j)
      if ((rows >> i & 1U) != 0 && (part.columns >> j & 1U) != 0 && !A(i, j).is_zero())
        columns |= 1U << j;
  return columns;
}

/// If k rows have entries in k columns only, these make a block, and the others the rest.
void split_into_blocks(const matrix& A, Part part, std::vector<Part>& blocks) {
  for (int k = 1; k < std::popcount(part.rows); ++k)
    for (unsigned rows = 1; rows < part.rows; ++rows) {
      if ((rows & ~part.rows) != 0 || std::popcount(rows) != k) continue;
      const unsigned columns = columns_with_entries(A, part, rows);
      if (std::popcount(columns) != k) continue;
      blocks.push_back({rows, columns});
      return split_into_blocks(A, {part.rows & ~rows, part.columns & ~columns}, blocks);
    }
  blocks.push_back(part);
}

/// The irreducible factors of a polynomial over the rationals, without numbers, each as often as it
/// occurs.
std::vector<ex> irreducible_factors(const ex& polynomial) {
  const ex product = GiNaC::factor(polynomial);
  std::vector<ex> factors;
  const auto add = [&factors](const ex& e) {
    const bool is_power = GiNaC::is_a<GiNaC::power>(e);
    const ex base = is_power ? e.op(0) : e;
    if (GiNaC::is_a<GiNaC::numeric>(base)) return;
    const int times = is_power ? GiNaC::ex_to<GiNaC::numeric>(e.op(1)).to_int() : 1;
    factors.insert(factors.end(), static_cast<std::size_t>(times), base.expand());
  };
  if (GiNaC::is_a<GiNaC::mul>(product))
    for (const ex& e : product) add(e);
  else
    add(product);
  return factors;
}

/// Returns the form times a number: integer coefficients without a common divisor, few of them
/// negative. The sign that GiNaC gives a factor depends on addresses.
ex primitive(const ex& form) {
  if (form.is_zero()) return form;
  const ex one = (form / form.integer_content()).expand(), other = (-one).expand();
  const auto rank = [](const std::string& t) {
    return std::tuple(std::ranges::count(t, '-'), t.starts_with('-'), t);
  };
  return rank(formula_text(other)) < rank(formula_text(one)) ? other : one;
}

bool in_order(const DeterminantFactor& a, const DeterminantFactor& b) {
  return std::pair(a.joints, formula_text(a.value)) < std::pair(b.joints, formula_text(b.value));
}

/// Returns p/q if this is a number, of expanded polynomials without squares of sines.
std::optional<ex> ratio_of(const ex& p, const ex& q) {
  if (q.is_zero()) return std::nullopt;
  const ex ratio = p.integer_content() / q.integer_content();
  for (const ex& k : {ratio, ex(-ratio)})
    if ((p - k * q).expand().is_zero()) return k;
  return std::nullopt;
}

class Factoring {
 public:
  explicit Factoring(const std::vector<PoseParameter>& pose) : angles_(pose) {}

  void factor(DeterminantBlock& block) const {
    const std::optional<ex> determinant = determinant_of(block.entries);
    if (!determinant || determinant->is_zero()) return;
    ex rest = *determinant;
    const std::vector<ex> common = angles_.take_common(rest);
    if (count_terms(rest) > kMostTerms) return;
    for (const std::vector<ex>& of_rest :
         {factors_of(rest), std::vector<ex>{angles_.in_angles(rest)}}) {
      DeterminantBlock found{block.entries, true, 1, {}};
      for (const ex& one : common) add(one, found);
      for (const ex& one : of_rest) add(one, found);
      std::ranges::sort(found.factors, in_order);
      const std::optional<ex> number = number_of(found, *determinant);
      if (!number) continue;
      found.constant *= *number;
      block = std::move(found);
      return;
    }
  }

 private:
  /// In sines and cosines; nullopt if an entry is no polynomial in them, or there are many terms.
  [[nodiscard]] std::optional<ex> determinant_of(const matrix& A) const {
    matrix polynomials(A.rows(), A.cols());
    std::size_t terms = 0;
    for (unsigned i = 0; i < A.rows(); ++i)
      for (unsigned j = 0; j < A.cols(); ++j) {
        const std::optional<ex> entry = angles_.polynomial(A(i, j));
        if (!entry) return std::nullopt;
        polynomials(i, j) = *entry;
        terms += count_terms(*entry);
      }
    if (terms > kMostTermsOfMatrix) return std::nullopt;
    return angles_.without_squares(polynomials.determinant(GiNaC::determinant_algo::laplace));
  }

  /// The rational factors in the tangents of half the angles, as functions of the angles; empty if
  /// they are not found. The product need not be the polynomial: a factor 1 + cos q, for example, has
  /// no zero in t = tan(q/2), and is lost.
  [[nodiscard]] std::vector<ex> factors_of(const ex& polynomial) const {
    const ex numerator = angles_.numerator(polynomial);
    if (count_terms(numerator) > kMostTermsOfNumerator) return {};
    const auto factors = angles_.paired(irreducible_factors(numerator));
    if (!factors) return {};
    std::vector<ex> functions;
    for (const ex& one : *factors)
      functions.push_back(angles_.joints_in(one).empty() ? one : angles_.trigonometric(one));
    return functions;
  }

  /// Adds a function of the angles, times a number.
  void add(const ex& factor, DeterminantBlock& to) const {
    const std::vector<std::size_t> joints = angles_.joints_in(factor);
    if (joints.empty()) {
      to.constant *= factor;
      return;
    }
    const ex value = primitive(factor);
    for (DeterminantFactor& known : to.factors)
      if (known.value.is_equal(value)) {
        ++known.power;
        return;
      }
    to.factors.push_back({value, joints});
  }

  /// Returns the number by which the product of the factors is the polynomial at all poses; nullopt
  /// if it is not.
  [[nodiscard]] std::optional<ex> number_of(const DeterminantBlock& found,
                                            const ex& polynomial) const {
    ex product = found.constant;
    for (const DeterminantFactor& factor : found.factors) {
      const std::optional<ex> form = angles_.polynomial(factor.value);
      if (!form) return std::nullopt;
      for (int k = 0; k < factor.power; ++k) product = angles_.without_squares(product * *form);
    }
    return ratio_of(polynomial, angles_.without_squares(product));
  }

  HalfAngles angles_;
};

/// A factor of many terms is the determinant itself, and has wider bounds than the matrix.
bool is_simple(const DeterminantBlock& block) {
  constexpr std::size_t kMostTermsOfFactor = 12;
  return block.is_factored && std::ranges::all_of(block.factors, [](const DeterminantFactor& f) {
           return count_terms(f.value) <= kMostTermsOfFactor;
         });
}

/// The entries of the diagonal for one block: as many factors as there is room for, each by itself.
std::vector<ex> diagonal_of(const DeterminantBlock& block) {
  const std::size_t room = block.entries.rows();
  std::vector<ex> entries;
  ex rest = block.constant;
  for (const DeterminantFactor& factor : block.factors)
    for (int k = 0; k < factor.power; ++k) {
      if (entries.size() + 1 < room)
        entries.push_back(factor.value);
      else
        rest *= factor.value;
    }
  entries.push_back(rest);
  entries.resize(room, 1);
  return entries;
}

}  // namespace

std::vector<DeterminantBlock> determinant_blocks(const matrix& A,
                                                 const std::vector<PoseParameter>& pose) {
  if (A.rows() != A.cols() || A.rows() > kMostRows) return {};
  const unsigned all = (1U << A.rows()) - 1;
  std::vector<Part> parts;
  split_into_blocks(A, {all, all}, parts);
  std::vector<unsigned> rows, columns;
  for (const Part& part : parts) {
    rows.push_back(part.rows);
    columns.push_back(part.columns);
  }
  const bool is_negative = is_odd(rows) != is_odd(columns);
  const Factoring factoring(pose);
  std::vector<DeterminantBlock> blocks;
  for (const Part& part : parts) {
    blocks.push_back({selected(A, part)});
    if (blocks.size() == 1 && is_negative) negate_first_row(blocks.front().entries);
    try {
      factoring.factor(blocks.back());
    } catch (const ParseRefusal&) {  // too many terms
    }
  }
  return blocks;
}

std::optional<matrix> matrix_of_factors(const std::vector<DeterminantBlock>& blocks) {
  if (blocks.size() < 2 && std::ranges::none_of(blocks, is_simple)) return std::nullopt;
  unsigned order = 0;
  for (const DeterminantBlock& block : blocks) order += block.entries.rows();
  matrix result(order, order);
  unsigned at = 0;
  for (const DeterminantBlock& block : blocks) {
    const unsigned n = block.entries.rows();
    const bool simple = is_simple(block);
    const std::vector<ex> diagonal = simple ? diagonal_of(block) : std::vector<ex>{};
    for (unsigned i = 0; i < n; ++i)
      for (unsigned j = 0; j < n; ++j)
        result(at + i, at + j) = !simple ? block.entries(i, j) : i == j ? diagonal[i] : ex(0);
    at += n;
  }
  return result;
}

}  // namespace regulus::detail
