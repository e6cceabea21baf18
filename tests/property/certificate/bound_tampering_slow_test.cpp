// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates of bounds that somebody has changed: none is verified for a bound that is smaller
// than an attained value.
#include <fmt/format.h>

#include "codegen/bound/bound_run.hpp"
#include "codegen/model/model_file.hpp"
#include "tests/property/certificate/certificate_tampering.hpp"

namespace regulus::test {
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
  return {contents(path + ".safe"), contents(path + ".singular")};
}

/// The line "parameter r in LO : HI".
struct RangeLine {
  std::size_t begin = 0, end = 0;
  double high = 0;
  bool is_two_sided = false;
};

double number(const std::string& text) {
  const std::size_t slash = text.find('/');
  return slash == std::string::npos ? std::stod(text)
                                    : std::stod(text) / std::stod(text.substr(slash + 1));
}

std::optional<RangeLine> range_line(const std::string& text) {
  RangeLine line;
  line.begin = text.find("\nparameter r in ") + 1;
  line.end = text.find('\n', line.begin);
  if (line.begin == 0 || line.end == std::string::npos) return std::nullopt;
  const std::string range = text.substr(line.begin + 15, line.end - line.begin - 15);
  const std::size_t colon = range.find(" : ");
  if (colon == std::string::npos) return std::nullopt;
  try {
    line.high = number(range.substr(colon + 3));
  } catch (const std::exception&) {
    return std::nullopt;
  }
  line.is_two_sided = range.starts_with("-");
  return line;
}

/// Returns the certificate with a larger range of r, that is, for a smaller bound.
std::string with_range(const std::string& text, double high) {
  const RangeLine line = *range_line(text);
  const long millionths = std::lround(high * 1e6);
  return text.substr(0, line.begin) +
         fmt::format("parameter r in {} : {}/1000000",
                     line.is_two_sided ? fmt::format("-{}/1000000", millionths) : "0", millionths) +
         text.substr(line.end);
}

/// Returns the question without the range of r; nullopt if that cannot be read.
std::optional<std::string> rest_of_question(const std::string& text) {
  const auto line = range_line(text);
  if (!line) return std::nullopt;
  return text.substr(0, line->begin) +
         text.substr(line->end, text.find("\nproof") - std::min(line->end, text.find("\nproof")));
}

struct Asked {
  QuantityOptions options;
};

void PrintTo(const Asked& asked, std::ostream* out) { *out << asked.options.quantity; }

class BoundTampering : public testing::TestWithParam<Asked> {};

TEST_P(BoundTampering, NeverLeadsToASmallerBoundThatIsVerified) {
  const Proofs proofs = proofs_of(GetParam().options);
  ASSERT_TRUE(range_line(proofs.safe) && range_line(proofs.singular));
  ASSERT_EQ(verify_text(proofs.safe, little_effort()).outcome, verifier::Outcome::kVerified);
  const double singular = range_line(proofs.singular)->high;
  RandomSource random(19);
  for (int change = 0; change < 60; ++change) {
    const double high = singular * (1.000001 + 0.05 * change);
    const std::string changed = with_range(proofs.safe, high);
    EXPECT_NE(verify_text(changed, little_effort()).outcome, verifier::Outcome::kVerified)
        << changed;
  }
  for (int change = 0; change < 120; ++change) {
    std::string changed = with_one_byte_changed(proofs.safe, random);
    if (change % 2 == 0) changed = with_one_byte_changed(changed, random);
    if (!judge(proofs.safe, changed, random)) continue;
    if (rest_of_question(changed) == rest_of_question(proofs.safe)) {
      EXPECT_LT(range_line(changed)->high, singular) << changed;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Quantities, BoundTampering,
    testing::Values(Asked{{.quantity = "force", .row = "1"}},
                    Asked{{.quantity = "force", .row = "2", .is_signed = true}},
                    Asked{{.quantity = "speed", .row = "1"}},
                    Asked{{.quantity = "error", .freedom = "v_x"}},
                    Asked{{.quantity = "deflection", .freedom = "v_x"}},
                    Asked{{.quantity = "sigma-max"}}, Asked{{.quantity = "sigma-min"}}));

}  // namespace
}  // namespace regulus::test
