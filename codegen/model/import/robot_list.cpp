// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/robot_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

/// A value of the list: the words of each innermost bracket.
struct ListedValue {
  int line = 0;
  std::vector<std::vector<std::string>> groups;

  /// All words, one after another.
  [[nodiscard]] std::vector<std::string> words() const {
    std::vector<std::string> all;
    for (const auto& group : groups) all.insert(all.end(), group.begin(), group.end());
    return all;
  }
};

/// Reads `key: [words, [words]]`, over several lines: the part of YAML that such lists use.
class ListReader {
 public:
  ListReader(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  std::map<std::string, ListedValue> read() {
    std::map<std::string, ListedValue> values;
    for (skip(); at_ < text_.size(); skip()) {
      const int line = line_;
      const std::string key = word();
      skip();
      if (key.empty() || !take(':')) refuse(line, "this is no KEY: [VALUE, …]");
      ListedValue& value = values[key];
      value.line = line;
      skip();
      if (at_ < text_.size() && text_[at_] == '[')
        bracket(value, 0);
      else
        value.groups.push_back({word()});
    }
    return values;
  }

 private:
  [[noreturn]] void refuse(int line, const std::string& problem) const {
    throw InputError::statement(file_, line, problem,
                                "write lists in brackets: closed_loop: [[FRAME, FRAME]]");
  }

  /// Skips white space and comments.
  void skip() {
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '#')
        while (at_ + 1 < text_.size() && text_[at_ + 1] != '\n') ++at_;
      else if (text_[at_] == '\n')
        ++line_;
      else if (std::isspace(static_cast<unsigned char>(text_[at_])) == 0)
        return;
    }
  }

  bool take(char c) {
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  std::string word() {
    if (at_ < text_.size() && (text_[at_] == '\'' || text_[at_] == '"')) {
      const std::size_t end = text_.find(text_[at_], at_ + 1);
      if (end == std::string_view::npos) refuse(line_, "a quotation does not end");
      const std::string quoted(text_.substr(at_ + 1, end - at_ - 1));
      at_ = end + 1;
      return quoted;
    }
    const std::size_t begin = at_;
    while (at_ < text_.size() &&
           std::string_view(",[]:#\n").find(text_[at_]) == std::string_view::npos)
      ++at_;
    std::string plain(text_.substr(begin, at_ - begin));
    while (!plain.empty() && std::isspace(static_cast<unsigned char>(plain.back())) != 0)
      plain.pop_back();
    return plain;
  }

  void bracket(ListedValue& value, int depth) {
    constexpr int kDeepest = 4;
    const int line = line_;
    if (depth > kDeepest) refuse(line, "brackets in brackets, too many");
    (void)take('[');
    std::vector<std::string> words;
    for (skip(); !take(']'); skip()) {
      if (at_ >= text_.size()) refuse(line, "a bracket does not end");
      if (text_[at_] == '[')
        bracket(value, depth + 1);
      else if (std::string item = word(); !item.empty())
        words.push_back(std::move(item));
      else
        refuse(line_, "there is no word between the commas");
      skip();
      if (!take(',') && at_ < text_.size() && text_[at_] != ']')
        refuse(line_, "a comma is missing");
    }
    if (!words.empty()) value.groups.push_back(std::move(words));
  }

  const std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0;
  int line_ = 1;
};

class ListedRobot {
 public:
  ListedRobot(Mechanism& mechanism, std::string_view text, const std::string& file)
      : mechanism_(mechanism), file_(file), values_(ListReader(text, file).read()) {}

  void add() {
    add_loops();
    add_joint_types();
    const ListedValue& motors = values_["name_mot"];
    for (const std::string& name : motors.words()) {
      if (!joint(name)) refuse(motors, "there is no joint " + in_quotes(name), "correct the name");
      mechanism_.actuated.push_back(name);
    }
  }

 private:
  [[noreturn]] void refuse(const ListedValue& value, const std::string& problem,
                           const std::string& remedy) const {
    throw InputError::statement(file_, value.line, problem, remedy);
  }

  ImportedJoint* joint(const std::string& name) {
    const auto at = std::ranges::find(mechanism_.joints, name, &ImportedJoint::name);
    return at == mechanism_.joints.end() ? nullptr : &*at;
  }

  void add_loops() {
    const ListedValue& loops = values_["closed_loop"];
    const std::vector<std::string> types = values_["type"].words();
    if (!types.empty() && types.size() != loops.groups.size())
      refuse(values_["type"],
             fmt::format("{} types of {} closed loops", types.size(), loops.groups.size()),
             "write a type for each");
    for (std::size_t i = 0; i < loops.groups.size(); ++i) {
      const std::vector<std::string>& pair = loops.groups[i];
      const std::string type = types.empty() ? "6d" : types[i];
      if (pair.size() != 2) refuse(loops, "a closed loop is no pair of frames", "write [A, B]");
      if (type != "3d" && type != "6d")
        refuse(values_["type"], "the type " + in_quotes(type), "it must be 3d or 6d");
      ImportedLoop loop{type == "3d" ? "connect" : "weld", {}, {}, {}, true, 0, {}};
      loop.first = frame(loops, pair[0]);
      loop.second = frame(loops, pair[1]);
      mechanism_.loops.push_back(std::move(loop));
    }
  }

  std::string frame(const ListedValue& loops, const std::string& name) const {
    std::string link = link_called(mechanism_, name);
    if (link.empty())
      refuse(loops, "the file has no link or joint " + in_quotes(name), "correct the name");
    return link;
  }

  void add_joint_types() {
    const ListedValue& types = values_["joint_type"];
    const std::vector<std::string> names = values_["joint_name"].words(), words = types.words();
    if (names.size() != words.size())
      refuse(types, fmt::format("{} types of {} joints", words.size(), names.size()),
             "write a type for each");
    for (std::size_t i = 0; i < names.size(); ++i) {
      ImportedJoint* of = joint(names[i]);
      if (of == nullptr)
        refuse(types, "there is no joint " + in_quotes(names[i]), "correct the name");
      const std::string axes = words[i].starts_with("UJOINT_") ? words[i].substr(7) : "";
      if (words[i] == "SPHERICAL")
        of->type = JointType::kOther, of->type_name = "ball";
      else if (axes.size() == 2 && axes.find_first_not_of("XYZ") == std::string::npos)
        make_universal(*of, axes);
      else
        refuse(types, "the joint type " + in_quotes(words[i]),
               "it must be SPHERICAL or UJOINT_ with two of XYZ");
    }
  }

  static std::array<WrittenNumber, 3> axis(char letter) {
    std::array<WrittenNumber, 3> result;
    result.at(std::size_t(letter - 'X')) = whole(1);
    return result;
  }

  /// Two joints that turn, about the first axis and then about the second.
  void make_universal(ImportedJoint& first, const std::string& axes) {
    ImportedJoint second = first;
    first.type = second.type = JointType::kContinuous;
    first.axis = axis(axes[0]);
    second.axis = axis(axes[1]);
    second.origin = {};
    do second.name += "_2";
    while (joint(second.name));
    first.child = second.parent = first.name + "_cross";
    while (mechanism_.has_link(first.child)) second.parent = first.child += "_";
    mechanism_.links.push_back(first.child);
    mechanism_.joints.push_back(std::move(second));
  }

  Mechanism& mechanism_;
  const std::string& file_;
  std::map<std::string, ListedValue> values_;
};

}  // namespace

std::string link_called(const Mechanism& mechanism, const std::string& name) {
  if (mechanism.has_link(name)) return name;
  const auto joint = std::ranges::find(mechanism.joints, name, &ImportedJoint::name);
  return joint == mechanism.joints.end() ? "" : joint->child;
}

void add_robot_list(Mechanism& mechanism, std::string_view text, const std::string& file) {
  ListedRobot(mechanism, text, file).add();
}

}  // namespace regulus::detail
