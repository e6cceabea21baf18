// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/jit/object_bundle.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace regulus::codegen {
namespace {

using testing::ElementsAre;

std::string bundle_of(const std::vector<std::string>& objects) {
  std::string bundle;
  for (const std::string& object : objects) add_to_bundle(bundle, object);
  return bundle;
}

TEST(ObjectBundle, OfOneObjectIsThatObject) {
  EXPECT_EQ(bundle_of({"an object"}), "an object");
  EXPECT_THAT(objects_in("an object"), ElementsAre("an object"));
}

TEST(ObjectBundle, GivesBackItsObjectsInOrderAndAligned) {
  const std::string bundle = bundle_of({"first", std::string(8, '\0'), "Regulus+ third"});
  const auto objects = objects_in(bundle);
  EXPECT_THAT(objects, ElementsAre("first", std::string(8, '\0'), "Regulus+ third"));
  for (const std::string_view object : objects) EXPECT_EQ((object.data() - bundle.data()) % 8, 0);
}

TEST(ObjectBundle, ThatIsCutShortIsNoBundle) {
  const std::string bundle = bundle_of({"first", "second"});
  for (std::size_t size = 0; size < bundle.size(); ++size) {
    const std::string cut = bundle.substr(0, size);
    // Cut between its objects it is a bundle of the first.
    if (size == bundle.size() / 2) continue;
    EXPECT_THAT(objects_in(cut), ElementsAre(cut)) << size;
  }
}

}  // namespace
}  // namespace regulus::codegen
