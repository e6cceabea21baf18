// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/facts.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "codegen/answer/keys.hpp"
#include "codegen/answer/schema.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::HasSubstr;

/// Tells a fact of each sort.
Facts tell_all(Readers readers) {
  Facts facts(readers);
  facts.tell("model", "cart", "model", "cart").add("boxes", 3).say("", "x in [1, 2] m");
  facts.say("at 0.1:", "safe").say("warning", "");
  Facts part = facts.part();
  part.tell("share", 0.5, "blocked by", "x = 1\ny = 2");
  facts.tell_part("place", std::move(part));
  return facts;
}

TEST(Facts, AreReadByPeopleAsAColumnOfLabelsAndSentences) {
  const std::string text =
      "model      cart\n"
      "           x in [1, 2] m\n"
      "at 0.1: safe\n"
      "blocked by x = 1\n"
      "           y = 2\n";
  EXPECT_EQ(tell_all(Readers::kBoth).text(), text);
  EXPECT_EQ(tell_all(Readers::kPeople).text(), text);
  EXPECT_EQ(tell_all(Readers::kPrograms).text(), "");
}

TEST(Facts, AreReadByProgramsAsKeys) {
  const Json object = {{"model", "cart"}, {"boxes", 3}, {"place", {{"share", 0.5}}}};
  EXPECT_EQ(tell_all(Readers::kBoth).object(), object);
  EXPECT_EQ(tell_all(Readers::kPrograms).object(), object);
  EXPECT_EQ(tell_all(Readers::kPeople).object(), Json::object());
}

TEST(Facts, OfTheSameKeyReplaceTheValueAndKeepThePlace) {
  Facts facts;
  facts.add("claim", nullptr).add("unit", "N").add("claim", "none");
  EXPECT_EQ(facts.object().dump(), R"({"claim":"none","unit":"N"})");
}

TEST(Facts, TakeFinishedLinesAsTheyAre) {
  for (const char* lines :
       {"", "proof      none: it is too early\n", "load       a\n           b, c\n",
        "resolution 1/4\nat         x = 1\n           with y = 2\n"}) {
    Facts facts;
    facts.say_lines(lines);
    EXPECT_EQ(facts.text(), lines);
  }
}

TEST(Facts, ReportBeginsWithTheHeadWhateverWasTold) {
  Facts facts;
  facts.add("unit", "N").add("verdict", "closed");
  const Json report = facts.report();
  auto at = report.begin();
  for (const Key& key : head_keys()) EXPECT_EQ((at++).key(), key.name);
  EXPECT_EQ(at.key(), "unit");
  EXPECT_EQ(report["verdict"], "closed");
  EXPECT_TRUE(report["claim"].is_null());
}

TEST(Facts, ReportSaysWhyThereIsNoProof) {
  EXPECT_EQ(Facts().report()["proof"][0]["reason"], kNoProofAsked);
  Facts facts;
  facts.add("proof", Json::array({{{"file", "p"}, {"reason", nullptr}}}));
  EXPECT_EQ(facts.report()["proof"][0]["file"], "p");
}

std::set<std::string> names_of_kinds() {
  std::set<std::string> names;
  for (const auto* kinds : {&report_kinds(), &object_kinds()})
    for (const ObjectKind& kind : *kinds) {
      const bool is_new = names.emplace(kind.name).second;
      EXPECT_TRUE(is_new) << kind.name;
    }
  return names;
}

TEST(Keys, OfAKindAreDifferent) {
  names_of_kinds();
  for (const auto* kinds : {&report_kinds(), &object_kinds()})
    for (const ObjectKind& kind : *kinds) {
      std::set<std::string_view> names;
      if (kinds == &report_kinds())
        for (const Key& key : head_keys()) names.insert(key.name);
      for (const auto& group : kind.keys)
        for (const Key& key : group) {
          const bool is_new = names.insert(key.name.substr(0, key.name.find('?'))).second;
          EXPECT_TRUE(is_new) << kind.name << ": " << key.name;
        }
    }
}

/// Adds the names that a schema refers to.
void add_references(const Json& schema, std::set<std::string>& names) {
  for (const auto& [key, value] : schema.items()) {
    if (key == "$ref")
      names.insert(value.get<std::string>().substr(std::string("#/$defs/").size()));
    if (value.is_structured()) add_references(value, names);
  }
}

TEST(Schema, RefersOnlyToWhatItDefinesAndUsesAllOfIt) {
  const Json schema = json_schema();
  std::set<std::string> used, defined;
  add_references(schema, used);
  for (const auto& [name, definition] : schema["$defs"].items()) defined.insert(name);
  EXPECT_EQ(used, defined);
  // No name is that of an object and of another value.
  for (const std::string name :
       {"exact", "enclosure", "range", "rounded", "approx", "sha256", "error"})
    EXPECT_FALSE(names_of_kinds().contains(name)) << name;
  EXPECT_EQ(defined.size(), names_of_kinds().size() + 7);
}

TEST(Schema, HasTheHeadInEveryReport) {
  const Json schema = json_schema();
  for (const ObjectKind& kind : report_kinds()) {
    const Json& required = schema["$defs"][std::string(kind.name)]["required"];
    for (const Key& key : head_keys())
      EXPECT_NE(std::find(required.begin(), required.end(), key.name), required.end())
          << kind.name << ": " << key.name;
  }
}

TEST(Types, OfThePageAreThoseOfTheSchema) {
  const std::string types = typescript_types();
  EXPECT_THAT(types, HasSubstr("export interface Check extends Head {\n  readonly verdict: "
                               "\"no-singularity\" | \"singularity\" | \"possible-problem\";\n"));
  EXPECT_THAT(types, HasSubstr("  readonly blocking_box: Record<string, Enclosure> | null;"));
  EXPECT_THAT(types, HasSubstr("export interface LostTwist {\n"));
}

}  // namespace
}  // namespace regulus::detail
