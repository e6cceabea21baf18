// SPDX-License-Identifier: GPL-3.0-or-later
// The question of a certificate about a closure: its lines, and whether it is that of a model file.
#include <gtest/gtest.h>

#include "runtime/formal/coq_proof.hpp"
#include "tests/support/closure_cases.hpp"

namespace regulus::detail::test {
namespace {

TEST(AForgedClosure, WithAChangedQuestionIsNotVerified) {
  const std::string& text = bar().text;
  const auto changed = [&](const std::string& old, const std::string& by) {
    return verify_text(with_other(text, old, by));
  };
  const std::string phi = text.substr(text.find("unknown phi"), 30);
  EXPECT_TRUE(is(Outcome::kUnfinished, changed("+- 0.01", "+- 3"), "near to exactly one"));
  EXPECT_TRUE(is(Outcome::kUnfinished, changed("+- 0.01", "+- 1e-12"), "near to exactly one"));
  EXPECT_TRUE(is(Outcome::kRejected, changed("+- 0.01", "+- 0"), "not positive"));
  EXPECT_TRUE(is(Outcome::kRejected, changed("+- 0.01", "+- -0.01"), "not positive"));
  EXPECT_TRUE(is(Outcome::kRejected, changed("start 60*", "start 101*"), "range of theta"));
  EXPECT_FALSE(is(Outcome::kVerified, changed("start 60*", "start 30*"), ""));
  EXPECT_FALSE(is(Outcome::kVerified, changed("0.35*cos", "0.3*cos"), ""));
  EXPECT_FALSE(is(Outcome::kVerified, changed("- 0.25*sin(psi)", "+ 0.25*sin(psi)"), ""));
  EXPECT_FALSE(is(Outcome::kVerified, changed("- 0.45", "- 0.46"), ""));
  EXPECT_FALSE(is(Outcome::kVerified, changed("crank = 0.2 +- 0", "crank = 0.2 +- 0.15"), ""));
  EXPECT_TRUE(is(Outcome::kRejected, changed("the 2 equations", "the 3 equations"), "claim"));
}

TEST(AForgedClosure, OfAnotherFormatIsRefused) {
  const auto changed = [&](const std::string& old, const std::string& by) {
    return verify_text(with_other(bar().text, old, by));
  };
  for (const char* const name : {"crank", "theta", "phi", "sin", "2x"})
    EXPECT_TRUE(is(Outcome::kRejected, changed("unknown psi", std::string("unknown ") + name), "'"))
        << name;
  EXPECT_TRUE(is(Outcome::kRejected, changed("alpha 0", "alpha 1"), "the claim is not"));
  EXPECT_TRUE(is(Outcome::kRejected, changed("NO SINGULARITY", "SINGULARITY"), "claim"));
  EXPECT_TRUE(is(Outcome::kRejected, changed("NO SINGULARITY", "FEASIBLE"), "about singularity"));
  EXPECT_TRUE(is(Outcome::kRejected, changed("start 60*pi/180\n", ""), "start"));
  EXPECT_TRUE(is(Outcome::kRejected, changed("start 60*pi/180\n", "start theta\n"), "declared"));
  EXPECT_TRUE(is(Outcome::kRejected, changed("equation x", "entry x"), "equation"));
  EXPECT_TRUE(is(Outcome::kRejected, changed("proof\n", "equation x\nproof\n"), "proof"));
  EXPECT_TRUE(is(Outcome::kRejected, changed("proof\n", "matrix 1 1\nentry x\nproof\n"), "proof"));
  EXPECT_TRUE(is(Outcome::kRejected, changed("proof\n", "scale 1\nscale 1\nproof\n"), "proof"));
  EXPECT_TRUE(is(Outcome::kRejected, changed("proof\n", "constraint phi\nproof\n"), "phi"));
  EXPECT_TRUE(is(Outcome::kRejected, changed("proof\n", "quantity determinant\nproof\n"), "side"));
  EXPECT_TRUE(is(Outcome::kRejected, changed("pose theta", "let y = phi\npose theta"), "phi"));
  EXPECT_TRUE(is(Outcome::kRejected, changed(" tube ", " second-order "), "rule"));
  EXPECT_TRUE(is(Outcome::kRejected, changed(" tube ", " tube 0 "), "numbers"));
  EXPECT_TRUE(is(Outcome::kRejected, changed(" tube ", " outside "), "numbers"));
  EXPECT_TRUE(is(Outcome::kUnfinished,
                 changed("regulus-certificate 1", "regulus-certificate-index 1"), "its path"));
  // Other claims have no such leaf.
  EXPECT_TRUE(is(Outcome::kRejected,
                 verify_text(scalar_question("x") + "proof\nl 0 tube 1 1\nend 1\n"), "expected"));
  EXPECT_TRUE(is(Outcome::kRejected, verify_text(scalar_question("x") + "proof\nl 0 tube\nend 1\n"),
                 "rule"));
}

TEST(AForgedClosure, InPiecesThatAreNoWayIsRefused) {
  const std::string pieces =
      with_other(with_other(bar().text, "pose theta", "piecewise a\npiece 1\npose theta"),
                 "proof\n", "proof\ntree\n");
  EXPECT_TRUE(is(Outcome::kUnfinished, verify_text(pieces), "does not go from 0 to 1"));
}

TEST(AForgedClosure, IsATheoremAboutItsBranchAlone) {
  std::istringstream branch(bar().text), force(bar().text);
  const std::string text = verifier::coq_proof(branch, verifier::CoqStatement::kClaim);
  EXPECT_NE(text.find("Theorem the_claim : one_branch the_closure."), std::string::npos) << text;
  EXPECT_THROW(static_cast<void>(verifier::coq_proof(force, verifier::CoqStatement::kForce)),
               verifier::Unfinished);
}

Verification compared(const std::string& certificate, const std::string& model, bool all = false) {
  verifier::Options options;
  options.model_text = model;
  options.model_name = "bar.toml";
  options.all_overridden = all;
  return verify_text(certificate, options);
}

/// The model file of bar().
std::string bar_file() {
  const std::string& text = bar().text;
  const auto value = [&](const std::string& name) {
    const std::size_t begin = text.find("unknown " + name + " = ") + name.size() + 11;
    return text.substr(begin, text.find(" +-", begin) - begin);
  };
  return "regulus = 1\nname = \"by hand\"\n[pose]\ntheta = \"rad\"\n[geometry]\ncrank = "
         "0.2\n[let]\n"
         "x = \"crank*cos(theta) + 0.35*cos(phi)\"\n[closure]\nunknowns = { phi = \"rad\", psi = "
         "\"rad\" }\nequations = [\"x - 0.45 - 0.25*cos(psi)\", \"crank*sin(theta) + 0.35*sin(phi) "
         "- "
         "0.25*sin(psi)\"]\nstart = { theta = \"60*deg\", phi = " +
         value("phi") + ", psi = " + value("psi") +
         " }\n[closure.range]\nphi = [-4, 4]\n[motion.turn]\ntheta = [\"-100*deg\", \"100*deg\"]\n";
}

/// bar() with a constant crank, for which its tubes have no numbers, and the range of phi.
std::string exact_bar() {
  // An uncertain quantity of no spread is a constant of the file.
  const std::string exact =
      with_other(with_other(bar().text, "uncertain crank = 0.2 +- 0", "constant crank = 0.2"),
                 "every pose and value of the 1 uncertain quantities", "every pose");
  std::string text;
  std::istringstream stream(exact);
  // Its tubes have no number for the crank: x₀, slopes.
  for (std::string line; std::getline(stream, line);) {
    std::vector<std::string> words;
    std::istringstream of_line(line);
    for (std::string word; of_line >> word;) words.push_back(word);
    if (words.size() == 13 && words[2] == "tube")
      for (const int at : {10, 8, 4}) words.erase(words.begin() + at);
    if (words.size() != 10 || words[2] != "tube") {
      text += line + '\n';
      continue;
    }
    for (std::size_t k = 0; k < words.size(); ++k) text += words[k] + (k < 9 ? ' ' : '\n');
  }
  return with_other(text, "proof\n", "defined sqrt(4 + phi)\ndefined sqrt(4 - phi)\nproof\n");
}

TEST(AQuestionAboutAClosure, IsComparedWithAModelFile) {
  const std::string certificate = exact_bar();
  const Verification v = compared(certificate, bar_file());
  EXPECT_TRUE(is(Outcome::kVerified, v, ""));
  EXPECT_GE(v.numbers, 8U);
  const std::string file = bar_file();
  const auto changed = [&](const std::string& old, const std::string& by, bool all = false) {
    return compared(certificate, with_other(file, old, by), all);
  };
  EXPECT_TRUE(is(Outcome::kRejected, changed("0.35*cos", "0.36*cos"), "equations[0]"));
  EXPECT_TRUE(is(Outcome::kRejected, changed("0.35*cos", "0.36*cos", true), "equations[0]"));
  EXPECT_TRUE(
      is(Outcome::kRejected, changed("- 0.25*sin(psi)", "- 0.25*sin(phi)"), "equations[1]"));
  EXPECT_TRUE(is(Outcome::kRejected, changed("60*deg", "61*deg"), "start.theta"));
  EXPECT_TRUE(is(Outcome::kRejected, changed("60*deg", "61*deg", true), "start.theta"));
  EXPECT_TRUE(is(Outcome::kRejected, changed(", phi = ", ", phi = 1"), "start.phi"));
  EXPECT_TRUE(is(Outcome::kRejected,
                 changed("[closure.range]", "[closure.radius]\nphi = 0.02\n[closure.range]"),
                 "radius.phi"));
  EXPECT_TRUE(is(Outcome::kVerified,
                 changed("[closure.range]", "[closure.radius]\nphi = 1e-2\n[closure.range]"), ""));
  EXPECT_TRUE(is(Outcome::kRejected,
                 changed("phi = \"rad\", psi = \"rad\"", "psi = \"rad\", phi = \"rad\""),
                 "unknowns"));
  EXPECT_TRUE(is(Outcome::kRejected, changed("psi = \"rad\"", "psi = \"m\""), "radius.psi"));
  EXPECT_TRUE(is(Outcome::kRejected, changed("psi = \"rad\"", "psi = \"deg\""), "equations[0]"));
  EXPECT_TRUE(is(Outcome::kRejected, changed("\"x - 0.45", "\"0\", \"x - 0.45"), "equations[0]"));
  EXPECT_TRUE(
      is(Outcome::kRejected, changed("0.25*sin(psi)\"]", "0.25*sin(psi)\", \"x - 1\"]"), "fewer"));
  EXPECT_TRUE(is(Outcome::kUnfinished,
                 changed("[closure.range]", "[closure.frames]\na = 1\n[closure.range]"), "frames"));
  EXPECT_TRUE(is(Outcome::kUnfinished, changed("[geometry]", "[matrix]\nrows = [[1]]\n[geometry]"),
                 "twice"));
  EXPECT_TRUE(is(Outcome::kRejected, changed("100*deg\"]", "120*deg\"]"), "motion.turn"));
  EXPECT_TRUE(is(Outcome::kVerified, changed("100*deg\"]", "120*deg\"]", true), ""));
  // A certificate about a matrix is none about a file with a closure.
  EXPECT_FALSE(
      is(Outcome::kVerified,
         compared(scalar_question("x") + kOneLeaf,
                  "regulus = 1\nname = \"m\"\n[pose]\nx = \"m\"\n[matrix]\nrows = [[\"x\"]]\n"
                  "[closure]\nunknowns = { p = \"m\" }\nequations = [\"p - x\"]\nstart = { x = 1, "
                  "p = 1 }\n[motion.only]\nx = [1, 2]\n"),
         ""));
}

TEST(AQuestionAboutAClosure, StatesTheRangesOfTheFile) {
  const std::string certificate = exact_bar(), file = bar_file();
  const auto expect_unfinished = [](const std::string& text, const std::string& model,
                                    const char* why) {
    for (const bool all : {false, true})
      EXPECT_TRUE(is(Outcome::kUnfinished, compared(text, model, all), why)) << model;
  };
  expect_unfinished(with_other(certificate, "defined sqrt(4 + phi)\n", ""), file,
                    "closure.range.phi[0]");
  expect_unfinished(with_other(certificate, "defined sqrt(4 - phi)\n", ""), file,
                    "closure.range.phi[1]");
  expect_unfinished(with_other(certificate, "sqrt(4 - phi)", "sqrt(4 - psi)"), file,
                    "range.phi[1]");
  expect_unfinished(with_other(certificate, "sqrt(4 - phi)", "sqrt(5 - phi)"), file,
                    "range.phi[1]");
  expect_unfinished(certificate, with_other(file, "phi = [-4, 4]", "phi = [-4, 3]"),
                    "range.phi[1]");
  expect_unfinished(certificate, with_other(file, "phi = [-4, 4]", "phi = [-4, 4]\npsi = [-9, 9]"),
                    "range.psi[0]");
  expect_unfinished(certificate, with_other(file, "[closure.range]\nphi = [-4, 4]\n", ""), "line");
  // Two forms of one number.
  EXPECT_TRUE(is(Outcome::kVerified,
                 compared(with_other(certificate, "sqrt(4 - phi)", "sqrt(8/2 - phi)"),
                          with_other(file, "[-4, 4]", "[\"-8/2\", 4]")),
                 ""));
}

/// At the start phi is near the number of its line `unknown`.
TEST(ABranch, ThatLeavesARangeIsNotVerified) {
  const std::string text = exact_bar();
  const std::size_t begin = text.find("unknown phi = ") + 14;
  const std::string start = text.substr(begin, text.find(" +-", begin) - begin);
  for (const char* const end : {"(phi - (%) + 0.02)", "((%) + 0.02 - phi)"}) {
    std::string within = end;
    within.replace(within.find('%'), 1, start);
    EXPECT_FALSE(
        is(Outcome::kVerified, verify_text(with_other(text, "sqrt(4 + phi)", "sqrt" + within)), ""))
        << within;
  }
}

/// The driver is a parameter of the motion, which has a name of its own.
TEST(AQuestionAboutAClosure, MayHaveADriverGivenByAParameter) {
  const auto moved = [](const std::string& theta, const std::string& range) {
    return with_other(bar_file(), "theta = [\"-100*deg\", \"100*deg\"]",
                      "theta = \"" + theta + "\"\nparameters = { T = " + range + " }");
  };
  const std::string certificate =
      with_other(with_other(exact_bar(), "parameter theta in", "parameter T in"),
                 "pose theta = theta", "pose theta = T");
  const std::string range = "[\"-100*deg\", \"100*deg\"]", file = moved("T", range);
  EXPECT_TRUE(is(Outcome::kVerified, compared(certificate, file), ""));
  const auto expect_rejected = [&](const std::string& other, const char* why) {
    for (const bool all : {false, true})
      EXPECT_TRUE(is(Outcome::kRejected, compared(certificate, other, all), why)) << other;
  };
  expect_rejected(with_other(file, "start = { theta = \"60*deg\"", "start = { theta = \"61*deg\""),
                  "start.theta");
  expect_rejected(moved("2*T", range), "theta");
  expect_rejected(moved("-T", range), "theta");
  expect_rejected(moved("60*deg", range), "theta");
  expect_rejected(bar_file(), "");
  EXPECT_TRUE(is(Outcome::kRejected, compared(certificate, moved("T", "[-1, 1]")), "T"));
  // A start that the certificate moves is another branch, or a place where none is known.
  EXPECT_FALSE(is(Outcome::kVerified,
                  compared(with_other(certificate, "start 60*", "start 59*"), file), ""));
  const std::string degrees = with_other(file, "theta = \"rad\"", "theta = \"deg\"");
  EXPECT_FALSE(is(Outcome::kVerified, compared(certificate, degrees), ""));
}

/// A motion by a formula begins at the start, with its parameter at the lower end.
TEST(AQuestionAboutAClosure, MayBeginWhereAFormulaDoes) {
  const auto moved = [](const std::string& theta, const std::string& range) {
    return with_other(bar_file(), "theta = [\"-100*deg\", \"100*deg\"]",
                      "theta = \"" + theta + "\"\nparameters = { T = " + range + " }");
  };
  const std::string head = exact_bar().substr(0, exact_bar().find("proof\n"));
  const auto question = [&head](const std::string& theta, const std::string& range,
                                const std::string& start) {
    const std::size_t line = head.find("parameter theta"), end = head.find('\n', line),
                      begin = head.find("\nstart ") + 1;
    std::string text = head;
    text.replace(begin, text.find('\n', begin) - begin, "start " + start);
    text.replace(line, end - line, "parameter T in " + range);
    return with_other(text, "pose theta = theta", "pose theta = " + theta) + "proof\n";
  };
  const auto answer = [](const std::string& certificate, const std::string& file) {
    return compared(certificate, file).reason;
  };
  const std::string file = moved("pi/3 + T^2", "[0, \"1/2\"]");
  const auto is_compared = [](const std::string& reason) {
    return reason.find("not about") == std::string::npos;
  };
  // Without a proof the file ends too early; whether the question is that of the file is asked before.
  EXPECT_TRUE(is_compared(answer(question("pi/3 + T^2", "0 : 1/2", "0"), file)));
  EXPECT_FALSE(is_compared(answer(question("pi/3 + T^2", "0 : 1/2", "1/2"), file)));
  EXPECT_FALSE(is_compared(answer(question("pi/3 + T^2", "-1/2 : 1/2", "0"), file)));
  EXPECT_FALSE(is_compared(answer(question("pi/3 + T^3", "0 : 1/2", "0"), file)));
  EXPECT_FALSE(
      is_compared(answer(question("1 + T^2", "0 : 1/2", "0"), moved("1 + T^2", "[0, 0.5]"))));
}

}  // namespace
}  // namespace regulus::detail::test
