// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates of bounds that somebody has changed: none is verified for a bound that is smaller
// than an attained value.
#include <fmt/format.h>

#include <cmath>

#include "codegen/model/file/model_file.hpp"
#include "codegen/question/bound/bound_run.hpp"
#include "tests/property/certificate/certificate_tampering.hpp"
#include "tests/support/files.hpp"

namespace regulus::detail::test {
namespace {

constexpr const char* kModel = R"toml(regulus = 1
name = "leg"
[pose]
x = "m"
y = "m"
[geometry]
h = { value = 1, tolerance = 0.125, group = "h" }
[matrix]
twist = ["v_x", "v_y"]
rows = [["2 - x", "y"], ["-y", "h"]]
[load.pull]
wrench = [1, [0.25, 0.5]]
[twist.go]
twist = [1, [0, 1]]
[actuators]
error = 0.125
stiffness = 2
[motion.m]
x = [0, 0.5]
y = [-0.5, 0.5]
)toml";

/// The two certificates of a bracket.
struct Proofs {
  std::string safe, singular;
};

Proofs proofs_of(const QuantityOptions& quantity) {
  const TemporaryDirectory directory;
  Request request;
  request.model = parse_model(kModel, "leg.toml");
  request.motion = request.model.motions.front();
  BoundSettings settings;
  settings.search.engine = Engine::kInterpreted;
  settings.search.threads = 1;
  settings.search.time_limit = 60;
  settings.output.quiet = true;
  settings.certificate = (directory.path() / "proof").string();
  const Bound bound = bound_quantity(request, quantity_of(request.model, quantity), settings,
                                     [](const ComponentBound&) {});
  const std::string path = settings.certificate + certificate_suffix(bound.components[0].component);
  return {file_contents(path + ".safe"), file_contents(path + ".singular")};
}

/// The line "bound E".
struct BoundLine {
  std::size_t begin = 0, end = 0;
  double value = 0;
};

double number(const std::string& text) {
  const std::size_t slash = text.find('/');
  return slash == std::string::npos ? std::stod(text)
                                    : std::stod(text) / std::stod(text.substr(slash + 1));
}

std::optional<BoundLine> bound_line(const std::string& text) {
  BoundLine line;
  line.begin = text.find("\nbound ") + 1;
  line.end = text.find('\n', line.begin);
  if (line.begin == 0 || line.end == std::string::npos) return std::nullopt;
  try {
    line.value = number(text.substr(line.begin + 6, line.end - line.begin - 6));
  } catch (const std::exception&) {
    return std::nullopt;
  }
  return line;
}

/// Returns the certificate of another bound, in its line and in its words.
std::string with_bound(const std::string& text, double value) {
  const BoundLine line = *bound_line(text);
  const std::string old = text.substr(line.begin + 6, line.end - line.begin - 6);
  const std::string changed = fmt::format("{}/1000000000", std::llround(value * 1e9));
  const std::string claim = ' ' + old + " at every";
  std::string result = text.substr(0, line.begin) + "bound " + changed + text.substr(line.end);
  return result.replace(result.find(claim), claim.size(), ' ' + changed + " at every");
}

/// Returns the question without its claim and its bound; nullopt if that cannot be read.
std::optional<std::string> rest_of_question(const std::string& text) {
  const auto line = bound_line(text);
  const std::size_t model = text.find("\nmodel "), proof = text.find("\nproof");
  if (!line || model == std::string::npos || proof < line->end) return std::nullopt;
  return text.substr(model, line->begin - model) + text.substr(line->end, proof - line->end);
}

struct Asked {
  QuantityOptions options;
};

void PrintTo(const Asked& asked, std::ostream* out) { *out << asked.options.quantity; }

class BoundTampering : public testing::TestWithParam<Asked> {};

TEST_P(BoundTampering, NeverLeadsToASmallerBoundThatIsVerified) {
  const Proofs proofs = proofs_of(GetParam().options);
  ASSERT_TRUE(bound_line(proofs.safe) && bound_line(proofs.singular));
  ASSERT_EQ(verify_text(proofs.safe, little_effort()).outcome, verifier::Outcome::kVerified);
  const double attained = bound_line(proofs.singular)->value;
  // A larger bound of a least value claims more.
  const double beyond = bound_line(proofs.safe)->value > attained ? -1 : 1;
  RandomSource random(19);
  for (int change = 0; change < 60; ++change) {
    const double value = attained + beyond * std::abs(attained) * (1e-6 + 0.01 * change);
    const std::string changed = with_bound(proofs.safe, value);
    EXPECT_NE(verify_text(changed, little_effort()).outcome, verifier::Outcome::kVerified)
        << changed;
  }
  for (int change = 0; change < 120; ++change) {
    std::string changed = with_one_byte_changed(proofs.safe, random);
    if (change % 2 == 0) changed = with_one_byte_changed(changed, random);
    if (!judge(proofs.safe, changed, random)) continue;
    if (rest_of_question(changed) == rest_of_question(proofs.safe)) {
      EXPECT_LT(beyond * (bound_line(changed)->value - attained), 0) << changed;
    }
  }
}

/// The changes themselves are read: a bound that claims less is verified.
TEST_P(BoundTampering, MayClaimLess) {
  const Proofs proofs = proofs_of(GetParam().options);
  const double safe = bound_line(proofs.safe)->value;
  const double beyond = safe > bound_line(proofs.singular)->value ? -1 : 1;
  const verifier::Verification v =
      verify_text(with_bound(proofs.safe, safe - beyond * 1e-6 * std::abs(safe)), little_effort());
  EXPECT_EQ(v.outcome, verifier::Outcome::kVerified) << v.reason;
}

INSTANTIATE_TEST_SUITE_P(
    Quantities, BoundTampering,
    testing::Values(Asked{{.quantity = "force", .row = "1"}},
                    Asked{{.quantity = "force", .row = "2", .is_signed = true}},
                    Asked{{.quantity = "speed", .row = "1"}},
                    Asked{{.quantity = "error", .freedom = "v_x"}},
                    Asked{{.quantity = "deflection", .freedom = "v_x"}},
                    Asked{{.quantity = "sigma-max"}}, Asked{{.quantity = "sigma-min"}},
                    Asked{{.quantity = "condition", .norm = "2"}}));

}  // namespace
}  // namespace regulus::detail::test
