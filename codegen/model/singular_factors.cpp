// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/singular_factors.hpp"

#include <algorithm>
#include <bit>
#include <optional>
#include <tuple>

#include "codegen/model/ginac_text.hpp"
#include "codegen/model/half_angles.hpp"
#include "codegen/model/parsed_expression.hpp"

namespace regulus::inline model {
namespace {

using GiNaC::ex;
using GiNaC::matrix;

constexpr std::size_t kMostTerms = 1500;  ///< of a polynomial that is factored
constexpr unsigned kMostRows = 8;

matrix selected(const matrix& A, unsigned rows, unsigned columns) {
  matrix result(static_cast<unsigned>(std::popcount(rows)),
                static_cast<unsigned>(std::popcount(columns)));
  for (unsigned i = 0, to_i = 0; i < A.rows(); ++i) {
    if ((rows >> i & 1U) == 0) continue;
    for (unsigned j = 0, to_j = 0; j < A.cols(); ++j)
      if ((columns >> j & 1U) != 0) result(to_i, to_j++) = A(i, j);
    ++to_i;
  }
  return result;
}

/// Splits a matrix that is block triangular after exchanging rows and columns: the determinant is the
/// product of those of the blocks, but for the sign. Looks for k rows with entries in k columns.
void split_into_blocks(const matrix& A, std::vector<matrix>& blocks) {
  const unsigned n = A.rows(), all = (1U << n) - 1;
  for (int k = 1; k < static_cast<int>(n); ++k)
    for (unsigned rows = 1; rows < all; ++rows) {
      if (std::popcount(rows) != k) continue;
      unsigned columns = 0;
      for (unsigned i = 0; i < n; ++i)
        for (unsigned j = 0; j < n; ++j)
          if ((rows >> i & 1U) != 0 && !A(i, j).is_zero()) columns |= 1U << j;
      if (std::popcount(columns) != k) continue;
      split_into_blocks(selected(A, rows, columns), blocks);
      return split_into_blocks(selected(A, all & ~rows, all & ~columns), blocks);
    }
  blocks.push_back(A);
}

/// The irreducible factors of a polynomial over the rationals, without numbers, each once.
std::vector<ex> irreducible_factors(const ex& polynomial) {
  const ex product = GiNaC::factor(polynomial);
  std::vector<ex> factors;
  const auto add = [&factors](const ex& e) {
    const ex base = GiNaC::is_a<GiNaC::power>(e) ? e.op(0) : e;
    if (!GiNaC::is_a<GiNaC::numeric>(base)) factors.push_back(base.expand());
  };
  if (GiNaC::is_a<GiNaC::mul>(product))
    for (const ex& e : product) add(e);
  else
    add(product);
  return factors;
}

/// The factors of one block's determinant; nullopt if they are not found.
std::optional<std::vector<ex>> factors_of(const matrix& block, const HalfAngles& angles) {
  const ex determinant =
      angles.without_squares(block.determinant(GiNaC::determinant_algo::laplace));
  if (determinant.is_zero() || determinant.nops() > kMostTerms) return std::nullopt;
  const ex numerator = angles.numerator(determinant);
  if (numerator.nops() > kMostTerms) return std::nullopt;
  return angles.paired(irreducible_factors(numerator));
}

/// Usual names, for arms in which the first joints place the wrist.
std::string usual_name(const std::vector<std::size_t>& joints, std::size_t count) {
  if (joints.size() > 1) return count >= 5 ? "shoulder" : "";
  if (joints.empty()) return "";
  return count >= 5 && joints.front() + 2 == count ? "wrist" : "elbow";
}

SingularFactor described(const ex& factor, const HalfAngles& angles, std::size_t joints) {
  const ex form = angles.trigonometric(factor);
  const ex primitive = (form / form.integer_content()).expand();
  const std::string text = formula_text(primitive), opposite = formula_text((-primitive).expand());
  // The sign that GiNaC gives a factor depends on addresses.
  const auto rank = [](const std::string& t) {
    return std::tuple(std::ranges::count(t, '-'), t.starts_with('-'), t);
  };
  return {usual_name(angles.joints_in(factor), joints),
          rank(opposite) < rank(text) ? opposite : text};
}

}  // namespace

std::vector<SingularFactor> singular_factors(const Model& model) try {
  const matrix& J = model.matrix;
  if (model.matrix_kind != MatrixKind::kForward || J.rows() != J.cols() || J.rows() > kMostRows)
    return {};
  const HalfAngles angles(model);
  matrix polynomials(J.rows(), J.cols());
  for (unsigned i = 0; i < J.rows(); ++i)
    for (unsigned j = 0; j < J.cols(); ++j) {
      const std::optional<ex> entry = angles.polynomial(J(i, j));
      if (!entry) return {};
      polynomials(i, j) = *entry;
    }
  std::vector<matrix> blocks;
  split_into_blocks(polynomials, blocks);
  std::vector<SingularFactor> result;
  for (const matrix& block : blocks) {
    const auto factors = factors_of(block, angles);
    if (!factors) return {};
    for (const ex& factor : *factors) {
      SingularFactor next = described(factor, angles, model.pose.size());
      const bool known = std::ranges::any_of(
          result, [&next](const SingularFactor& f) { return f.text == next.text; });
      if (!known && !angles.joints_in(factor).empty()) result.push_back(std::move(next));
    }
  }
  return result;
} catch (const Refusal&) {
  return {};
}

}  // namespace regulus::model
