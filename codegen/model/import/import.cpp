// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/import.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "codegen/model/exact/parsed_expression.hpp"
#include "codegen/model/file/model_file.hpp"
#include "codegen/model/file/read_file.hpp"
#include "codegen/model/file/written.hpp"
#include "codegen/model/import/body_graph.hpp"
#include "codegen/model/import/chain.hpp"
#include "codegen/model/import/closed_robot.hpp"
#include "codegen/model/import/hexapod.hpp"
#include "codegen/model/import/mjcf.hpp"
#include "codegen/model/import/planar_legs.hpp"
#include "codegen/model/import/robot_list.hpp"
#include "codegen/model/import/sdf.hpp"
#include "codegen/model/import/serial_text.hpp"
#include "codegen/model/import/urdf.hpp"
#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/visible_text.hpp"
#include "runtime/files/sha256.hpp"

namespace regulus {

using namespace detail;

namespace {

Mechanism read_mechanism(const XmlFile& xml, NumberReader& numbers) {
  const XmlElement root = xml.root();
  if (root.name() == "robot") return read_urdf(root, numbers);
  if (root.name() == "mujoco") return read_mjcf(root, numbers);
  // SDF before 1.3 has the root <gazebo>.
  if (root.name() == "sdf" || root.name() == "gazebo") return read_sdf(root, numbers);
  root.refuse("the root element is <" + visible(root.name()) + ">",
              "it must be <robot> (URDF), <mujoco> (MJCF) or <sdf> (SDF)");
}

/// Chains and loops are looked for in time that grows with the square of the size.
void require_size(const Mechanism& mechanism, const std::string& file) {
  constexpr std::size_t kMostLinks = 2000;
  if (mechanism.links.size() > kMostLinks || mechanism.joints.size() > kMostLinks)
    throw InputError::statement(file, 0,
                                fmt::format("the file has {} links", mechanism.links.size()),
                                fmt::format("at most {} are read", kMostLinks));
}

NumberReader number_reader(const ImportOptions& options) try {
  const GiNaC::numeric tolerance = exact_number(options.snap, {"--snap", 0, "the tolerance"});
  if (tolerance.is_negative() || tolerance > GiNaC::numeric(1, 100))
    throw UsageError("--snap: the tolerance must be between 0 and 0.01");
  return NumberReader(tolerance);
} catch (const InputError& error) {
  throw UsageError(error.what());
}

/// Returns at most 200 bytes that a label may have.
std::string label_of(const std::string& name) {
  constexpr std::size_t kMost = 200;
  std::string label = std::string(first_bytes(visible(name), kMost));
  for (char& c : label)
    if (c == '\\') c = '_';
  return label.empty() ? "robot" : label;
}

std::string file_name(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

std::string toml_label(const std::string& text) {
  return written(std::string_view(label_of(text)));
}

std::string header(const Mechanism& mechanism, const std::string& file, std::string_view text) {
  constexpr std::size_t kLongestName = 60;
  const std::string name = label_of(file_name(file)).substr(0, kLongestName);
  const std::string source =
      fmt::format("{} file {}, SHA-256 {}", mechanism.format, name, sha256(text));
  return fmt::format(
      "# Made by `regulus import {}`. Statements are proved about this file.\n"
      "regulus = 1\nname = {}\nsource = {}\n\n",
      name, toml_label(mechanism.name), toml_label(source));
}

void add_notes(Imported& to, const char* title, std::vector<std::string> lines) {
  if (!lines.empty()) to.notes.push_back({title, std::move(lines)});
}

std::vector<std::string> ignored_lines(const Mechanism& mechanism) {
  std::string line;
  for (const auto& [name, count] : mechanism.ignored)
    line += fmt::format("{}{} {}", line.empty() ? "" : ", ", count, name);
  return line.empty() ? std::vector<std::string>{} : std::vector{line};
}

std::vector<std::string> snap_lines(const NumberReader& numbers) {
  std::vector<std::string> lines;
  for (const Snap& snap : numbers.snaps())
    lines.push_back(
        fmt::format("line {}, {}: {} -> {}", snap.line, snap.what, snap.before, snap.after));
  return lines;
}

std::string chain_line(const Chain& chain) {
  const auto fixed = std::ranges::count_if(
      chain.joints, [](const ImportedJoint* j) { return j->type == JointType::kFixed; });
  const auto followers = std::ranges::count_if(chain.joints, [](const ImportedJoint* j) {
    return j->type != JointType::kFixed && j->mimics;
  });
  return fmt::format("from {} to {}: {} joints that move, {} fixed{}", in_quotes(chain.base),
                     in_quotes(chain.tip),
                     static_cast<std::ptrdiff_t>(chain.joints.size()) - fixed - followers, fixed,
                     followers > 0 ? fmt::format(", {} that follow others", followers) : "");
}

/// Returns the names in texts such as "a,b".
std::vector<std::string> split_names(const std::vector<std::string>& texts) {
  std::vector<std::string> names;
  for (const std::string& text : texts)
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find(',', begin), text.size());
      names.push_back(text.substr(begin, end - begin));
      begin = end + 1;
    }
  return names;
}

/// The tables of the model, and a line about the robot.
struct Tables {
  std::string text, robot;
};

/// A robot whose loops are open in the file's pose has none of the known forms.
bool is_open(const Mechanism& mechanism) {
  if (mechanism.loops.empty()) return false;
  const BodyGraph graph(mechanism);
  return std::ranges::any_of(graph.connections(), [](const Connection& c) { return c.gap > 0; });
}

std::optional<Tables> known_form(Mechanism& mechanism, const std::string& file,
                                 const ImportOptions& options) {
  if (options.closure || !options.at.empty() || is_open(mechanism)) return std::nullopt;
  if (const auto hexapod = find_hexapod(mechanism, file, options.base))
    return Tables{hexapod_text(*hexapod, mechanism.notes),
                  fmt::format("six legs from {} to {}, each with a joint that slides",
                              in_quotes(hexapod->base), in_quotes(hexapod->platform))};
  if (const auto robot =
          find_planar_robot(mechanism, file, options.base, split_names(options.actuated)))
    return Tables{planar_text(*robot, mechanism.notes),
                  fmt::format("{} legs in the plane {}, from {} to {}", robot->legs.size(),
                              robot->plane, in_quotes(robot->base),
                              robot->platform.empty() ? "one point" : in_quotes(robot->platform))};
  return std::nullopt;
}

/// Returns the motors that [gough] or [legs] would have; none if the robot is not of that form.
std::vector<std::string> usual_motors(const Mechanism& mechanism, const std::string& file,
                                      const std::string& base) try {
  std::vector<std::string> names;
  if (is_open(mechanism)) return names;
  if (const auto hexapod = find_hexapod(mechanism, file, base)) {
    for (const HexapodLeg& leg : hexapod->legs) names.push_back(leg.slider);
    return names;
  }
  if (const auto robot = find_planar_robot(mechanism, file, base, {}))
    for (const PlanarLeg& leg : robot->legs)
      names.push_back(leg.names.at(std::size_t(leg.actuated - 1)));
  return names;
} catch (const InputError&) {
  return {};
}

/// Returns the motors that are asked for; where neither a wish nor the file names any, the usual ones.
std::vector<std::string> motors_of(Mechanism& mechanism, const std::string& file,
                                   const ImportOptions& options) {
  std::vector<std::string> asked = split_names(options.actuated);
  if (!asked.empty() || !mechanism.actuated.empty()) return asked;
  const std::vector<std::string> usual = usual_motors(mechanism, file, options.base);
  if (!usual.empty())
    mechanism.notes.push_back(
        fmt::format("driven: {}; --actuated names others", fmt::join(usual, ", ")));
  return usual;
}

std::optional<Tables> closed_form(Mechanism& mechanism, const std::string& file,
                                  const ImportOptions& options, Identifiers& identifiers) {
  const auto robot = find_closed_robot(
      mechanism, file, {motors_of(mechanism, file, options), options.at}, identifiers);
  if (!robot) return std::nullopt;
  return Tables{closure_text(*robot), robot->summary};
}

Tables tables_of(Mechanism& mechanism, const std::string& file, const ImportOptions& options,
                 Identifiers& identifiers) {
  if (auto known = known_form(mechanism, file, options)) return std::move(*known);
  const bool asks = options.closure || !options.at.empty() || !options.actuated.empty() ||
                    !options.cuts.empty() || !options.welds.empty() || !options.list.empty();
  if (asks && options.tip.empty())
    if (auto closed = closed_form(mechanism, file, options, identifiers)) return std::move(*closed);
  if (!options.actuated.empty() || !options.at.empty() || options.closure)
    throw UsageError(
        "--actuated, --at and --closure are for robots with loops, and without --tip; this one has "
        "no loop");
  try {
    const Chain chain = find_chain(mechanism, file, options.base, options.tip);
    return {serial_text(chain, file, identifiers, mechanism.notes), chain_line(chain)};
  } catch (const std::runtime_error&) {
    // A file with loops may have an arm that is no part of them; this one has not.
    if (!options.tip.empty()) throw;
    if (auto closed = closed_form(mechanism, file, options, identifiers)) return std::move(*closed);
    throw;
  }
}

/// Adds loops "LINK=LINK": the origins of the two frames are one point, or the frames are one.
void add_cuts(Mechanism& mechanism, const std::vector<std::string>& cuts, const char* type,
              const char* option) {
  for (const std::string& cut : cuts) {
    const std::size_t equals = std::min(cut.find('='), cut.size());
    ImportedLoop loop{type, {}, {}, {}, true, 0, {}};
    loop.first = link_called(mechanism, cut.substr(0, equals));
    loop.second = equals == cut.size() ? "" : link_called(mechanism, cut.substr(equals + 1));
    for (const auto& [link, name] :
         {std::pair(loop.first, cut.substr(0, equals)),
          std::pair(loop.second, cut.substr(std::min(equals + 1, cut.size())))})
      if (link.empty())
        throw UsageError(fmt::format("{0}: there is no link or joint {1}; write {0} LINK=LINK",
                                     option, in_quotes(name)));
    mechanism.loops.push_back(std::move(loop));
  }
}

/// 1.5708 is a robot with a skew axis, and seldom meant.
void note_near_angles(Mechanism& mechanism, const NumberReader& numbers) {
  constexpr std::size_t kMost = 5;
  const std::vector<NearSnap>& near = numbers.near();
  for (std::size_t i = 0; i < std::min(near.size(), kMost); ++i) {
    const Snap& snap = near[i].snap;
    mechanism.notes.push_back(
        fmt::format("line {}, {}: {} is not {}; if it is meant, --snap 1e{} takes it for that{}",
                    snap.line, snap.what, snap.before, snap.after, near[i].exponent,
                    i + 1 == kMost && near.size() > kMost
                        ? fmt::format(" ({} numbers more)", near.size() - kMost)
                        : ""));
  }
}

/// Reads the model that was made of a file. Its lines are not those of the file.
Model parsed(const std::string& text, const std::string& file) try {
  return parse_model(text, "its model");
} catch (const InputError& error) {
  throw InputError::statement(file, 0,
                              std::string("no model can be made of this robot: ") + error.what(),
                              "correct the number in the file");
}

Imported import_mechanism(const XmlFile& xml, std::string_view text, const std::string& file,
                          const ImportOptions& options) {
  NumberReader numbers = number_reader(options);
  Mechanism mechanism = read_mechanism(xml, numbers);
  require_size(mechanism, file);
  if (!options.list.empty()) add_robot_list(mechanism, options.list, options.list_file);
  add_cuts(mechanism, options.cuts, "connect", "--cut");
  add_cuts(mechanism, options.welds, "weld", "--weld");
  Identifiers identifiers;
  Imported result;
  const Tables tables = tables_of(mechanism, file, options, identifiers);
  result.model = header(mechanism, file, text) + tables.text;
  const Model model = parsed(result.model, file);
  add_notes(result, "read",
            {fmt::format("{} {}: {} links, {} joints", mechanism.format, in_quotes(mechanism.name),
                         mechanism.links.size(), mechanism.joints.size())});
  add_notes(result, "robot", {tables.robot});
  add_notes(result, "matrix", model.matrix_notes);
  add_notes(result, "ignored", ignored_lines(mechanism));
  add_notes(result, "renamed", identifiers.changes());
  add_notes(result, "snapped", snap_lines(numbers));
  note_near_angles(mechanism, numbers);
  add_notes(result, "note", mechanism.notes);
  return result;
}

}  // namespace

std::string Imported::report() const {
  std::string text;
  for (const ImportNotes& about : notes)
    for (std::size_t i = 0; i < about.lines.size(); ++i)
      text += fmt::format("{:<11}{}\n", i == 0 ? about.title : "", about.lines[i]);
  return text;
}

Imported import_robot(std::string_view text, const std::string& file,
                      const ImportOptions& options) try {
  const XmlFile xml(file, text);
  return import_mechanism(xml, text, file, options);
} catch (const ParseRefusal& refusal) {
  throw InputError(file, 0, refusal.found, refusal.expected);
}

Imported import_robot_file(const std::string& path, const ImportOptions& options) {
  ImportOptions complete = options;
  if (path.ends_with(".urdf") && options.list.empty()) {
    constexpr std::uint64_t kLargestList = std::uint64_t{1} << 20;
    const std::string beside = path.substr(0, path.size() - 4) + "yaml";
    const auto text = read_file_if_any(beside, kLargestList, Readable::kFile);
    // Other programs have files of that name, too.
    if (text && text->find("closed_loop") != std::string::npos)
      complete.list = *text, complete.list_file = beside;
  }
  return import_robot(read_file(path, kLargestImport, Readable::kStream), path, complete);
}

}  // namespace regulus
