// SPDX-License-Identifier: GPL-3.0-or-later
// The proof in the page of a table of places.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "codegen/answer/ask.hpp"
#include "codegen/answer/page_of_answers.hpp"
#include "runtime/verifier/verify.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

const std::string kTemplate =
    "<title>@REGULUS_TITLE@</title><h1>@REGULUS_VERDICT@</h1><p>@REGULUS_CLAIM@</p>"
    "<pre>@REGULUS_REPORT@</pre><script id=\"@REGULUS_SHA256@\">@REGULUS_DATA@</script>";

class PageOfPlaces : public testing::Test {
 protected:
  PageOfPlaces() {
    model_.path = REGULUS_SOURCE_DIR "/models/rpr_6.toml";
    std::ofstream(path("lengths.csv"))
        << "rho_1, rho_2, rho_3\n14.98, 15.38, 12\n14.9, 15.4, 12.1\n100, 1, 1\n";
  }
  [[nodiscard]] std::string path(const char* name) const { return folder_.path() / name; }
  [[nodiscard]] PageOfAnswers page() const {
    return {PageTemplate(kTemplate), model_, "regulus solve", PageSubject::kPlaces};
  }
  [[nodiscard]] nlohmann::json data_of(const PageOfAnswers& page) const {
    page.write(path("page.html"));
    std::ostringstream text;
    text << std::ifstream(path("page.html")).rdbuf();
    const std::size_t at = text.str().find("\">{") + 2;
    return nlohmann::json::parse(text.str().substr(at, text.str().find("</script>") - at));
  }
  /// Asks, and returns the data of the page of the answer.
  [[nodiscard]] nlohmann::json solved() const {
    AskSolve asked{model_, {}};
    asked.search.engine = Engine::kInterpreted;
    asked.table = path("lengths.csv");
    Services services;
    services.certificate = path("proof");
    PageOfAnswers answers = page();
    static_cast<void>(ask_for_page(asked, services, answers));
    return data_of(answers);
  }

  const TemporaryDirectory folder_;
  ModelOptions model_;
};

TEST_F(PageOfPlaces, HasTheProofAtAllOfThem) {
  const nlohmann::json data = solved();
  std::istringstream proof(data.at("certificate").get<std::string>());
  EXPECT_EQ(verifier::verify(proof, {}).outcome, verifier::Outcome::kVerified);
  EXPECT_EQ(data.at("certificate_note"), "");
  EXPECT_THAT(data.at("again")[1].get<std::string>(), testing::HasSubstr(" --waypoints "));
}

/// What is left is a proof of its own: of as many places as it says, each with its whole part.
TEST_F(PageOfPlaces, HasTheFirstProofsOfMany) {
  const std::string few = solved().at("certificate");
  const std::string first = "\nplace 1\n", second = "\nplace 2\n";
  const std::size_t begin = few.find(first) + first.size();
  const std::string part = few.substr(begin, few.find(second) + 1 - begin);
  const std::size_t places = kLongestProof / part.size() + 5;
  std::ofstream file(path("long"));
  file << few.substr(0, few.find('\n') + 1);
  for (std::size_t k = 1; k <= places; ++k) file << "place " << k << '\n' << part;
  file << "places " << places << '\n';
  file.close();
  PageOfAnswers answers = page();
  nlohmann::ordered_json report{{"places", std::vector<int>(places)}};
  answers.add({"solutions", "COMPLETE", "", report, path("long"), "", {}, path("lengths.csv")});
  const nlohmann::json data = data_of(answers);
  const std::string proof = data.at("certificate");
  const std::string note = data.at("certificate_note");
  EXPECT_THAT(note, testing::HasSubstr(" of " + std::to_string(places) + " places"));
  const std::size_t found = std::stoul(note.substr(note.find("first ") + 6));
  std::string expected = few.substr(0, few.find('\n') + 1);
  for (std::size_t k = 1; k <= found; ++k) expected += "place " + std::to_string(k) + '\n' + part;
  EXPECT_TRUE(proof == expected + "places " + std::to_string(found) + '\n');
  EXPECT_LE(expected.size(), kLongestProof);
  EXPECT_GT(expected.size() + 2 * part.size(), kLongestProof);
  EXPECT_EQ(data.at("again")[1], "regulus verify proof.txt");
}

}  // namespace
}  // namespace regulus::detail::test
