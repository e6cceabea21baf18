// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/sdf_frames.hpp"

#include <fmt/format.h>

#include "codegen/model/import/read_pose.hpp"
#include "codegen/model/names.hpp"

namespace regulus::detail {

void SdfFrames::declare(const XmlElement& element, const std::string& relative_to) {
  constexpr std::size_t kMostFrames = 4000;
  if (frames_.size() >= kMostFrames)
    element.refuse("the file has many frames", fmt::format("at most {} are read", kMostFrames));
  const std::string name = element.required("name");
  if (name == "__model__" || name == "world" || frames_.contains(name))
    element.refuse("the name " + in_quotes(name) + " is there twice", "rename one of them");
  frames_.emplace(name, Frame{element, read_pose(element, relative_to)});
}

SdfFrames::RelativePose SdfFrames::read_pose(const XmlElement& element,
                                             const std::string& otherwise) {
  RelativePose result{{}, otherwise};
  const auto given = element.child("pose");
  if (!given) return result;
  if (const std::string other = given->attribute("relative_to"); !other.empty())
    result.relative_to = other;
  const std::string text = given->text();
  const auto words = words_of(text);
  const XmlPlace place = given->place("the pose of " + in_quotes(element.attribute("name")));
  if (words.empty()) return result;
  const std::string format = given->attribute("rotation_format", "euler_rpy");
  const std::size_t expected = format == "quat_xyzw" ? 7 : 6;
  if (words.size() != expected)
    given->refuse(fmt::format("{} has {} numbers", place.what, words.size()),
                  fmt::format("there must be {}", expected));
  const auto rest = [&](std::size_t first) {
    std::string joined;
    for (std::size_t i = first; i < words.size(); ++i) joined += std::string(words[i]) + " ";
    return joined;
  };
  result.pose.xyz =
      read_vector(std::string(words[0]) + " " + std::string(words[1]) + " " + std::string(words[2]),
                  place, numbers_);
  if (expected == 7)
    set_quaternion(result.pose,
                   std::string(words[6]) + " " + std::string(words[3]) + " " +
                       std::string(words[4]) + " " + std::string(words[5]),
                   place, numbers_);
  else
    set_rpy(
        result.pose, rest(3),
        given->attribute("degrees", "false") == "true" ? AngleUnit::kDegree : AngleUnit::kRadian,
        place, numbers_);
  return result;
}

const Placement& SdfFrames::placement(const std::string& name, const XmlElement& user) {
  if (const auto known = resolved_.find(name); known != resolved_.end()) return known->second;
  const auto found = frames_.find(name);
  if (found == frames_.end())
    user.refuse("there is no frame " + in_quotes(name), "correct the name");
  if (!open_.insert(name).second)
    user.refuse("the frame " + in_quotes(name) + " is relative to itself", "break the cycle");
  const Frame& frame = found->second;
  const Placement reference = placement(frame.pose.relative_to, frame.element);
  open_.erase(name);
  return resolved_.emplace(name, compose(reference, placement_of(frame.pose.pose))).first->second;
}

}  // namespace regulus::detail
