// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/page/local_paths.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace regulus::detail::test {
namespace {

ModelOptions model_at(const char* path) {
  ModelOptions model;
  model.path = path;
  return model;
}

std::string without(const LocalPaths& paths, std::string text) {
  paths.remove_from(text);
  return text;
}

TEST(LocalPathsOfAPage, AreReplacedByTheNamesOfFiles) {
  const LocalPaths paths(
      model_at("/home/me/robot.toml"),
      "regulus solve /home/me/robot.toml --waypoints ../in/way.csv --page=/tmp/p.html "
      "--certificate proofs/c.txt");
  EXPECT_EQ(
      without(paths,
              "regulus solve /home/me/robot.toml --waypoints ../in/way.csv --page=/tmp/p.html "
              "--certificate proofs/c.txt"),
      "regulus solve robot.toml --waypoints way.csv --page=p.html --certificate c.txt");
  EXPECT_EQ(without(paths, "places     2 in ../in/way.csv"), "places     2 in way.csv");
}

TEST(LocalPathsOfAPage, AreReplacedInEveryTextOfAReport) {
  nlohmann::ordered_json report = {{"model_file", "a/robot.toml"},
                                   {"list", {1, "in a/robot.toml"}}};
  LocalPaths(model_at("a/robot.toml"), "").remove_from(report);
  EXPECT_EQ(report.dump(), R"({"model_file":"robot.toml","list":[1,"in robot.toml"]})");
}

TEST(LocalPathsOfAPage, LeaveQuotientsAlone) {
  const LocalPaths paths(model_at("x/y"),
                         "regulus check x/y --range x=1/2:3/4 --certificate 1/0.5");
  EXPECT_EQ(without(paths, "x from 1/2 to 3/4, x/y and 1/0.5"), "x from 1/2 to 3/4, x/y and 1/0.5");
}

TEST(LocalPathsOfAPage, LeaveDivisorsAlone) {
  const LocalPaths paths(model_at("/2"), "");
  EXPECT_EQ(without(paths, "x = (a + b)/2 of /2"), "x = (a + b)/2 of 2");
}

TEST(LocalPathsOfAPage, AreNotTakenForTheEndsOfOthers) {
  const LocalPaths paths(model_at("a/robot.toml"), "");
  EXPECT_EQ(without(paths, "a/robot.toml /else/a/robot.toml b-a/robot.toml"),
            "robot.toml /else/a/robot.toml b-a/robot.toml");
}

TEST(LocalPathsOfAPage, MayNeedQuotes) {
  const std::string typed =
      "regulus check '/home/my robots/it'\\''s.toml' --page '/tmp/a b/p q.html'";
  const LocalPaths paths(model_at("/home/my robots/it's.toml"), typed);
  EXPECT_EQ(without(paths, typed), "regulus check 'it'\\''s.toml' --page 'p q.html'");
  EXPECT_EQ(without(paths, "file /home/my robots/it's.toml"), "file it's.toml");
}

}  // namespace
}  // namespace regulus::detail::test
