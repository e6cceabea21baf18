// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_arm.hpp"

#include <algorithm>
#include <array>

#include "runtime/formal/coq_keys.hpp"
#include "runtime/formal/coq_real.hpp"
#include "runtime/verifier/model/joint_chain.hpp"

namespace regulus::verifier {
namespace {

constexpr std::string_view kNamesOfAxes = "xyz";

class PartReader : FileKeys {
 public:
  PartReader(const WrittenValues& values, const CoqTextAt& text_at, std::set<std::string>& read)
      : FileKeys(values),
        text_at_(text_at),
        read_(read),
        names_(chain_names(values)),
        in_degrees_(is_arm_in_degrees(values)),
        convention_(word("serial.convention", "origins")) {}

  std::vector<CoqPart> read() {
    for (const char* key : {"unit", "convention", "angle_unit"})
      read_.insert(std::string("serial.") + key);
    for (std::size_t i = 0; has_below("serial.joints" + index(i)); ++i) {
      place_ = "serial.joints" + index(i) + '.';
      number_ = '_' + std::to_string(i + 1);
      read_joint();
    }
    if (has_below("serial.tool.")) {
      place_ = "serial.tool.", number_ = "";
      read_origin();
    }
    return std::move(parts_);
  }

 private:
  [[nodiscard]] bool has_key(const std::string& key) const {
    return has(place_ + key) || has_below(place_ + key + '[') || has_below(place_ + key + '.');
  }
  /// The tool has no tolerance.
  [[nodiscard]] std::string quantity(const std::string& key, const std::string& name,
                                     bool is_angle) const {
    return text_at_(place_ + key, number_.empty() ? "" : name + number_, is_angle);
  }
  [[nodiscard]] std::string length(const std::string& key, const std::string& name) const {
    return has_key(key) ? quantity(key, name, false) : "0";
  }
  /// An angle in radians; that of the tool is a number of degrees in the file.
  [[nodiscard]] std::string angle(const std::string& key, const std::string& name) const {
    if (!has_key(key)) return "0";
    const std::string written = quantity(key, name, true);
    return in_degrees_ && number_.empty() ? coq_argument(written) + "*deg" : written;
  }
  void add(const std::string& word, const std::string& a, const std::string& b) {
    parts_.push_back({word + ' ' + coq_argument(a) + ' ' + coq_argument(b), {}});
  }

  void read_joint() {
    for (const char* key : {"name", "type", "mimic", "range[0]", "range[1]"})
      read_.insert(place_ + key);
    if (convention_ == "origins")
      read_origin();
    else if (convention_ == "standard-dh")
      along();
    else if (convention_ == "modified-dh")
      across(), along();
    else
      refuse_model("the convention '" + convention_ + "' of its joints");
    if (word(place_ + "type", "") != "fixed") read_motion();
    if (convention_ == "standard-dh") across();
  }

  // Denavit and Hartenberg.

  void across() {
    if (has_key("a") || has_key("alpha")) add("along_x", length("a", "a"), angle("alpha", "alpha"));
  }
  void along() {
    if (has_key("d") || has_key("theta")) add("along_z", length("d", "d"), angle("theta", "theta"));
  }

  // Origins.

  void read_origin() {
    for (const char* key : {"quaternion", "rotation"})
      if (has_key(key)) refuse_model("the key " + place_ + key);
    if (has_key("xyz")) {
      std::vector<std::string> coordinates;
      for (std::size_t i = 0; i < 3; ++i)
        coordinates.push_back(length("xyz" + index(i), std::string(1, kNamesOfAxes[i])));
      parts_.push_back({"shift_by (" + text_of(coordinates, ", ") + ')', {}});
    }
    // Roll, pitch and yaw: about the axes of the frame before, first about x.
    constexpr std::array<const char*, 3> kAxes = {"x_axis", "y_axis", "z_axis"},
                                         kAngles = {"roll", "pitch", "yaw"};
    for (std::size_t i = 3; has_key("rpy") && i-- > 0;)
      if (const std::string turn = angle("rpy" + index(i), kAngles.at(i));
          turn != "0" && turn != "0*deg")
        add("turn_by", kAxes.at(i), turn);
  }

  [[nodiscard]] std::string axis() const {
    if (!has_key("axis")) return "z_axis";
    std::vector<std::string> written;
    for (std::size_t i = 0; i < 3; ++i)
      written.push_back(text_at_(place_ + "axis" + index(i), "", false));
    const std::string all = text_of(written, " ");
    const auto is_axis = [&](const char* one) {
      return all == one || all == std::string(one) + ".0";
    };
    if (is_axis("1 0 0")) return "x_axis";
    if (is_axis("0 1 0")) return "y_axis";
    if (is_axis("0 0 1")) return "z_axis";
    if (is_axis("-1 0 0")) return "(opposite x_axis)";
    if (is_axis("0 -1 0")) return "(opposite y_axis)";
    if (is_axis("0 0 -1")) return "(opposite z_axis)";
    refuse_model("an axis of a joint that is no coordinate axis");
  }

  // The variable.

  void read_motion() {
    const std::string type = word(place_ + "type", "revolute");
    const bool slides = type == "prismatic";
    if (!slides && type != "revolute" && type != "continuous")
      refuse_model("the joint type '" + type + '\'');
    const bool follows = has_key("mimic");
    const auto leader = std::ranges::find(names_, word(place_ + (follows ? "mimic" : "name"), ""),
                                          &ChainName::name);
    if (leader == names_.end()) throw Unfinished("no joint has the name in " + place_ + "mimic");
    if (in_degrees_ && leader->slides != slides)
      refuse_model("a joint that turns with one that slides, in degrees");
    const std::size_t number = std::size_t(leader - names_.begin());
    CoqPart part{(slides ? "prismatic " : "revolute ") + std::to_string(number + 1) + ' ' + axis(),
                 number};
    part.is_in_degrees = in_degrees_ && !slides;
    part.follows = follows || has_key("multiplier");
    if (has_key("multiplier")) part.multiplier = text_at_(place_ + "multiplier", "", false);
    if (has_key("offset")) part.offset = text_at_(place_ + "offset", "", !slides);
    parts_.push_back(part);
  }

  const CoqTextAt& text_at_;
  std::set<std::string>& read_;
  const std::vector<ChainName> names_;
  const bool in_degrees_;
  const std::string convention_;
  std::string place_;   ///< of the joint, with a dot behind it
  std::string number_;  ///< of the joint, behind the name of a quantity; empty: the tool
  std::vector<CoqPart> parts_;
};

}  // namespace

std::vector<CoqPart> read_coq_parts(const WrittenValues& values, const CoqTextAt& text_at,
                                    std::set<std::string>& read) {
  return PartReader(values, text_at, read).read();
}

std::string coq_part(const CoqPart& part, const std::vector<std::string>& joints) {
  if (!part.joint) return part.text;
  std::string value = joints.at(*part.joint);
  if (!part.multiplier.empty()) value = coq_argument(part.multiplier) + '*' + coq_argument(value);
  if (!part.offset.empty())
    value =
        (part.multiplier.empty() ? coq_argument(value) : value) + " + " + coq_argument(part.offset);
  if (part.is_in_degrees) value = coq_argument(value) + "*deg";
  const std::string joint = part.text + ' ' + coq_argument(value);
  if (!part.follows) return joint;
  const std::string rate = part.multiplier.empty() ? "1" : coq_argument(part.multiplier);
  return "follower " + rate + " (" + joint + ')';
}

}  // namespace regulus::verifier
