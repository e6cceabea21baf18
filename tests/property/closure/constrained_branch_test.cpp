// SPDX-License-Identifier: GPL-3.0-or-later
// Values over a branch within constraints, against closed forms: sin p = ½ sin θ, whose determinant is
// cos p.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "codegen/model/closure_start.hpp"
#include "codegen/model/exact/expression_parser.hpp"
#include "codegen/model/file/model_file.hpp"
#include "codegen/question/bound/bound_question.hpp"
#include "codegen/question/closure/branch_bound.hpp"
#include "codegen/question/closure/branch_load.hpp"
#include "codegen/question/closure/paving_certificate.hpp"
#include "tests/property/closure/checked_closures.hpp"
#include "tests/property/closure/paved_certificates.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;
using verifier::Outcome;

/// `range`: of θ, with 0 in it.
std::string sine(const std::string& range, const std::string& constraint) {
  return "regulus = 1\nname = \"sine\"\n[pose]\nth = \"rad\"\n[closure]\nunknowns = { p = \"rad\" "
         "}\n"
         "equations = [\"sin(p) - 0.5*sin(th)\"]\nstart = { th = 0, p = 0 }\n"
         "[actuators]\nerror = 0.01\nforce = [-0.5, 0.5]\n[load.w]\nmoment = [[-0.1, 0.55]]\n"
         "[motion.m]\nth = " +
         range + "\nconstraints = [\"" + constraint + "\"]\n";
}

double determinant(double theta) { return std::sqrt(1 - std::pow(std::sin(theta) / 2, 2)); }

Request request_of(const std::string& text, double tolerance = 0) {
  ModelOptions options;
  options.motion = "m";
  if (tolerance > 0) options.tubes = {fmt::format("th={}", tolerance)};
  return read_request(text, options);
}

struct BoundWithProofs {
  ComponentBound bound;
  verifier::Verification safe, singular;
};

BoundWithProofs bounded(const std::string& text, const QuantityOptions& words,
                        double tolerance = 0) {
  const TemporaryDirectory directory;
  const Request request = request_of(text, tolerance);
  BoundSettings settings;
  settings.gap = 0.01;
  settings.search = usual_options();
  settings.search.max_boxes = 20000;
  settings.over_branch = bounds_over_branch();
  settings.certificate = (directory.path() / "c").string();
  const Bound all = bound_quantity(request, quantity_of(request.model, words), settings,
                                   [](const ComponentBound&) {});
  const auto read = [](const std::string& file) {
    std::ostringstream certificate;
    certificate << std::ifstream(file).rdbuf();
    return verified(certificate.str());
  };
  const ComponentBound& one = all.components.at(0);
  return {one, read(one.proofs.safe_file()), read(one.proofs.singular_file())};
}

void expect_bracket(const BoundWithProofs& found, double truth) {
  ASSERT_TRUE(found.bound.proved && found.bound.attained) << found.bound.reason;
  EXPECT_TRUE(found.bound.is_closed);
  EXPECT_LE(std::min(found.bound.proved->approx, found.bound.attained->approx), truth);
  EXPECT_GE(std::max(found.bound.proved->approx, found.bound.attained->approx), truth);
  EXPECT_EQ(found.safe.outcome, Outcome::kVerified) << describe(found.safe);
  EXPECT_EQ(found.safe.note, "");
  EXPECT_EQ(found.singular.outcome, Outcome::kVerified) << describe(found.singular);
}

TEST(ABoundWithinConstraints, IsThatOfThePlacesWhichMeetThem) {
  QuantityOptions words;
  words.quantity = "determinant";
  expect_bracket(bounded(sine("[-2, 2]", "th^2 - 0.09"), words), determinant(0.3));
  expect_bracket(bounded(sine("[-1, 2]", "th - 1"), words), determinant(1));
  words.quantity = "sigma-min";
  expect_bracket(bounded(sine("[-1, 2]", "th - 1"), words), determinant(1));
}

TEST(ABoundWithinConstraints, GoesOnBeyondAPartThatTheyExclude) {
  QuantityOptions words;
  words.quantity = "determinant";
  // Without θ in (0.5, 1.5) the place 2 is left, which only excluded places join with the start.
  expect_bracket(bounded(sine("[-0.1, 2]", "0.25 - (th - 1)^2"), words), determinant(1.5));
  words.quantity = "sigma-min";
  expect_bracket(bounded(sine("[-0.1, 2]", "0.25 - (th - 1)^2"), words), determinant(1.5));
}

TEST(ABoundWithinConstraints, CountsAFiniteErrorOnlyThere) {
  QuantityOptions words;
  words.quantity = "error";
  words.is_finite = true;
  words.freedom = "p";
  // The error is the largest at θ = 0.
  expect_bracket(bounded(sine("[-2, 2]", "th - 1"), words, 0.01), std::asin(0.5 * std::sin(0.01)));
}

TEST(ALoadWithinConstraints, IsHeldAtThePlacesWhichMeetThem) {
  const auto load_at = [](const std::string& constraint) {
    PreparedBranchLoad prepared =
        prepare_branch_load(request_of(sine("[-2, 2]", constraint)), 0, "w", usual_options(), {});
    BranchLoadResult result = check_branch_load(prepared, {});
    const std::string certificate =
        written([&](const std::string& path) { return certify_load(path, prepared, result, {}); });
    const verifier::Verification v = verified(certificate);
    EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
    return result.verdict;
  };
  EXPECT_EQ(load_at("th^2 - 1"), FeasibilityVerdict::kFeasible);
  EXPECT_EQ(load_at("0.25 - (th - 1)^2"), FeasibilityVerdict::kFeasible);
}

TEST(AThresholdWithinConstraints, IsComparedAtThePlacesWhichMeetThem) {
  for (const auto& [constraint, least] :
       {std::pair<std::string, double>("th^2 - 1", determinant(1)),
        std::pair<std::string, double>("0.25 - (th - 1)^2", determinant(1.5))}) {
    for (const double part : {0.99, 1.01}) {
      const std::string text =
          sine("[-1.5, 1.5]", constraint) + fmt::format("alpha = {:.17g}\n", part * least);
      const CheckedClosure checked = check_closure_text(text, usual_options());
      EXPECT_EQ(checked.verdict(), part < 1 ? Verdict::kNoSingularity : Verdict::kSingularity);
      EXPECT_EQ(check_result(checked.prepared, checked.found).occupancy, Occupancy::kInhabited);
      const verifier::Verification v = verified(certified_closure(checked), text);
      EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
    }
  }
}

TEST(AThresholdWithinConstraints, IsPavedThere) {
  const std::string text = sine("[-0.1, 2]", "0.25 - (th - 1)^2") + "alpha = 0.9\n";
  PreparedClosure prepared = prepare_closure(request_of(text), 0, usual_options(), {});
  const ClosureFinding found = pave_closure(prepared, usual_options(), 0x1p-8, {}, {});
  const std::string certificate =
      written([&](const std::string& path) { return certify_paving(path, prepared, found, {}); });
  const verifier::Verification v = verified(certificate, text);
  EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
}

/// Parts of a leaf have tubes of their own within that of the leaf.
TEST(ABoundOfWideLeaves, IsVerified) {
  QuantityOptions words;
  words.quantity = "determinant";
  const BoundWithProofs found = bounded(
      "regulus = 1\nname = \"wide\"\n[pose]\nq = \"rad\"\n[closure]\nunknowns = { p = \"rad\" }\n"
      "equations = [\"cos(q) + cos(p) + cos(q)*cos(p)\"]\nstart = { q = 1.2, p = 1.84 }\n"
      "radius = { p = 0.05 }\n[motion.m]\nq = [1.2, 1.7]\n",
      words);
  const double cosine = -std::cos(1.7) / (1 + std::cos(1.7));
  expect_bracket(found, std::sqrt(1 - cosine * cosine) * (1 + std::cos(1.7)));
}

/// A bound that only an excluded part keeps is not proved, and one of a place that is left is not passed.
TEST(ABoundWithinConstraints, IsNotProvedWhereAPlaceIsLeft) {
  const std::string text = sine("[-1.5, 1.5]", "th^2 - 1") + "alpha = 0.9\n";
  const std::string proof = certified_closure(check_closure_text(text, usual_options()));
  ASSERT_EQ(verified(proof).outcome, Outcome::kVerified);
  const std::string wider = replaced(proof, "constraint th^2 - 1", "constraint th^2 - 4");
  EXPECT_EQ(verified(wider).outcome, Outcome::kRejected) << describe(verified(wider));
}

TEST(AStart, ThatAConstraintExcludesIsRefused) {
  for (const char* constraint : {"0.25 - th^2", "1 - th"}) {
    try {
      const Model model = parse_model(sine("[-2, 2]", constraint), "model.toml");
      static_cast<void>(start_within_constraints(model, model.motions.front()));
      ADD_FAILURE() << constraint;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("does not contain the start of [closure]"));
      EXPECT_THAT(error.what(), HasSubstr("constraint"));
    }
  }
}

TEST(AStart, ThatMeetsTheConstraintsIsAPose) {
  const std::string text = sine("[-2, 2]", "th - 5");
  const CheckedClosure checked = check_closure_text(text, usual_options());
  EXPECT_EQ(checked.verdict(), Verdict::kNoSingularity);
  EXPECT_EQ(check_result(checked.prepared, checked.found).occupancy, Occupancy::kInhabited);
  const verifier::Verification v = verified(certified_closure(checked), text);
  EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  EXPECT_EQ(v.note, "");
}

}  // namespace
}  // namespace regulus::detail::test
