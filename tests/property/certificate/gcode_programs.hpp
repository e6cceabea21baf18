// SPDX-License-Identifier: GPL-3.0-or-later
// Random programs in G-code, read by the front end and by the verifier, and interpreted by a machine of the
// tests. A reader may refuse a program; it never reads another path.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include "codegen/model/file/model_file.hpp"
#include "codegen/model/way/gcode_file.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/model/gcode.hpp"
#include "tests/support/gcode_interpreter.hpp"
#include "tests/support/random_source.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {

inline constexpr const char* kMilledGantry = R"(regulus = 1
name = "gantry"
[pose]
x = "mm"
y = "mm"
z = "mm"
[matrix]
rows = [["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]]
[motion.held]
waypoints = "way.nc"
)";

/// Words that the readers refuse, or that mean something else than they seem to.
inline constexpr const char* kRareWords[] = {"M98 P1000",
                                             "M98",
                                             "P2",
                                             "P3",
                                             "G92 X0",
                                             "G92.1",
                                             "G53",
                                             "G10 L2 P1 X1",
                                             "G28",
                                             "G30",
                                             "G52 X1",
                                             "G55",
                                             "G43 H1",
                                             "G41 D1",
                                             "G42",
                                             "G64",
                                             "G64 P0.1",
                                             "G93",
                                             "G5",
                                             "G33",
                                             "G38.2",
                                             "G73",
                                             "G81 R1",
                                             "G83 Q1",
                                             "G1.04",
                                             "G16",
                                             "G15",
                                             "G7",
                                             "G68",
                                             "G51",
                                             "M6",
                                             "M60",
                                             "M66",
                                             "M99",
                                             "M104",
                                             "M3.7",
                                             "O100",
                                             "o1 call",
                                             "#1=5",
                                             "X#1",
                                             "X[1]",
                                             "E1",
                                             "L3",
                                             "H2",
                                             "Q1",
                                             "R5",
                                             "D1",
                                             "A5",
                                             "U1",
                                             "/",
                                             "*71",
                                             "%",
                                             "(open",
                                             "(a(b)",
                                             "\r",
                                             "\rX3",
                                             "(py,x)",
                                             "@5",
                                             "N5",
                                             "N5.5",
                                             "X1",
                                             "G4",
                                             "F-1",
                                             "T1.5",
                                             "G98",
                                             "G0",
                                             "G3",
                                             "G4 P1",
                                             "M2",
                                             "M30",
                                             "G80",
                                             "G90 G91",
                                             "G96 S1 D9",
                                             "G97",
                                             "G-1",
                                             "G100",
                                             "G99999999999999999999",
                                             "X",
                                             "^1",
                                             "$2"};

/// Writes programs that are mostly right; about a third has a line with something rare.
class ProgramWriter {
 public:
  explicit ProgramWriter(std::uint64_t seed) : random_(seed), is_rare_(random_.one_in(3)) {}

  std::string write() {
    std::string text = random_.one_in(5) ? "%\n" : "";
    if (random_.one_in(2))
      text += one_of({"G21\n", "G20\n", "G17 G40 G49 G54 G80 G94\n", "(begin)\n"});
    text += "G0 X10 Y0 Z5\n";
    const auto lines = 2 + random_.below(7);
    const auto rare = random_.below(lines);
    for (std::uint64_t k = 0; k < lines; ++k) text += line(is_rare_ && k == rare);
    if (random_.one_in(3))
      text += one_of({"M2\nG0 X99\n", "M30\n", "%\nG0 X99\n", "G1 X7 M30\nX9\n"});
    return text;
  }

 private:
  using Words = std::vector<std::string>;

  std::string one_of(const Words& words) { return words[random_.below(words.size())]; }

  std::string number() {
    return one_of({"0", "1", "-1", "5", "-2.5", ".5", "10", "+3", "-5", "2.54", "12.125", "-0"});
  }

  /// The words of a line act in one order, however they are written.
  std::string line(bool is_rare) {
    Words words = move();
    if (random_.one_in(5))
      words.push_back(one_of({"G17", "G18", "G19", "G20", "G21", "G90", "G91", "G90.1", "G91.1"}));
    if (random_.one_in(5))
      words.push_back(one_of({"F100", "S5", "T1", "M3", "M8", "G61", "G94", "G4 P1", "M0"}));
    if (is_rare) words.push_back(rare_word());
    for (std::size_t k = words.size(); k > 1; --k) std::swap(words[k - 1], words[random_.below(k)]);
    std::string text;
    if (random_.one_in(10)) text = one_of({"N10 ", "n020", " ", "(note) ", "\t"});
    for (const std::string& word : words) text += word + one_of({" ", "", " ", "\t", "(c)"});
    return text + one_of({"\n", "\n", "\n", "\r\n", " ; end\n"});
  }

  Words move() {
    switch (random_.below(10)) {
      case 0:
        return {};
      case 1:
        return {one_of({"G1 X", "X", "G0X"}) + number()};
      case 2:
        return {one_of({"G1 Z", "Z"}) + number(), "Y" + number()};
      case 3:
        if (random_.one_in(4)) return {one_of({"G2", "G3"}), one_of({"I", "J", "K"}) + number()};
        return {one_of({"G2 G17 G91.1 I", "G3 G18 G91.1 K", "G3 G91.1 G19 J"}) + number()};
      case 4:  // round arcs that are right wherever they begin
      case 5:
        return {one_of({"G2", "G3", "G02", "g3"}),
                one_of({"G17 G91 G91.1 X-10 Y10 I-10 J0", "G18 G91 G91.1 Z6 X8 I5 K0 K0",
                        "G19 G91 G91.1 Y8 Z4 J5", "G91 G91.1 G17 X-10 I-5 Z1", "G91.1 G17 I-3 J4",
                        "G18 K7 G91.1", "J2.5 G19 G91.1 G91 X3", "G91.1 G17 G91 Y-8 X6 I3 J-4"})};
      case 6:
        return {"G90 G21 G17 G1 X10 Y0 Z5\n" +
                one_of({"G3 X0 Y10 G91.1 I-10", "G2 X-10 Y0 I0 J0 G90.1", "G3 Y10 X0 R10",
                        "G02 I-10 P2 G91.1", "X0 Y10 G91.1 I-10 J0 Z7 G3", "G3 X1 Y1 I1 G91.1",
                        "G4 P1 G3 I-1 G91.1", "G3 X10.0001 Y-.0001 I-10 G91.1"})};
      default:
        return {one_of({"G0", "G1", "g1", "G01", "G 1", "G1.0"}), "X" + number(), "Y" + number(),
                random_.one_in(2) ? "Z" + number() : "F200"};
    }
  }

  std::string rare_word() { return kRareWords[random_.below(std::size(kRareWords))]; }

  RandomSource random_;
  bool is_rare_;
};

/// A path as the interpreter has it, for each axis of each move.
using Path = std::vector<std::array<std::vector<double>, 3>>;

class GcodePrograms : public testing::Test {
 protected:
  std::optional<Path> by_front_end(const std::string& text) const try {
    const std::string file = (folder_.path() / "way.nc").string();
    std::ofstream(file, std::ios::binary) << text;
    Path path;
    for (const TrajectoryPiece& piece : read_gcode(model_, model_.motions.front(), file).pieces) {
      auto& move = path.emplace_back();
      for (std::size_t axis = 0; axis < 3; ++axis) move[axis] = places(piece.pose[axis]);
    }
    return path;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("way.nc:"), std::string::npos) << error.what();
    return std::nullopt;
  }

  static std::vector<double> places(const PieceOfPose& piece) {
    std::array<double, kPieceCoefficients> c{};
    for (std::size_t i = 0; i < c.size(); ++i)
      c[i] = GiNaC::ex_to<GiNaC::numeric>(coefficient(piece, i).evalf()).to_double();
    std::vector<double> result;
    for (int step = 0; step <= MachineMove::kSteps; ++step) {
      const double s = double(step) / MachineMove::kSteps;
      result.push_back(c[0] + s * (c[1] + s * (c[2] + s * c[3])) + c[4] * std::cos(c[6] * s) +
                       c[5] * std::sin(c[6] * s));
    }
    return result;
  }

  static std::optional<Path> by_verifier(const std::string& text) try {
    Path path;
    for (const verifier::ProgramMove& move : verifier::read_program(text)) {
      auto& places = path.emplace_back();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        verifier::Graph graph;
        const verifier::NodeId root = place_on_move(graph, move, axis);
        for (int step = 0; step <= MachineMove::kSteps; ++step) {
          const std::vector<verifier::Ball> at(
              1, verifier::Ball(verifier::point(double(step) / MachineMove::kSteps), 64));
          const auto value = verifier::evaluate(graph, {root}, at, 64);
          places[axis].push_back(value ? mid((*value)[0].enclosure()) : NAN);
        }
      }
    }
    return path;
  } catch (const verifier::Unfinished& why) {
    EXPECT_EQ(std::string(why.what()).rfind("line ", 0), 0U) << why.what();
    return std::nullopt;
  }

  static void expect_equal(const Path& path, const std::vector<MachineMove>& moves) {
    ASSERT_EQ(path.size(), moves.size());
    for (std::size_t k = 0; k < moves.size(); ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t step = 0; step <= MachineMove::kSteps; ++step)
          ASSERT_NEAR(path[k][axis][step], moves[k].places[step][axis], 1e-6 + moves[k].miss)
              << "line " << moves[k].line << ", axis "
              << "XYZ"[axis];
  }

  /// Reads the programs of so many seeds.
  void read_programs(unsigned first, unsigned count) {
    unsigned accepted = 0, refused = 0, arcs = 0;
    for (unsigned seed = first; seed < first + count; ++seed) {
      const std::string text = ProgramWriter(seed).write();
      SCOPED_TRACE(text);
      const auto moves = GcodeInterpreter::run(text);
      const auto one = by_front_end(text), other = by_verifier(text);
      ASSERT_EQ(one.has_value(), other.has_value());
      if (!one) {
        ++refused;
        continue;
      }
      ++accepted;
      ASSERT_TRUE(moves) << "the machine stops";
      expect_equal(*one, *moves);
      expect_equal(*other, *moves);
      if (HasFatalFailure()) return;
      for (const MachineMove& move : *moves)
        arcs += move.places[1][0] + move.places[3][0] != 2 * move.places[2][0];
    }
    std::cout << accepted << " read, with " << arcs << " arcs, " << refused << " refused\n";
    EXPECT_GT(accepted, count / 4);
    EXPECT_GT(arcs, count / 10);
  }

 private:
  TemporaryDirectory folder_;
  const Model model_ = parse_model(kMilledGantry, "gantry.toml");
};

}  // namespace regulus::detail::test
