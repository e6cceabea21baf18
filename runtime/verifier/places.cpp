// SPDX-License-Identifier: Apache-2.0
// The lines of a part are read as the file of a certificate about one place. Nothing is taken from one
// part for another, so what is true of such a file is true of each part. With a model file, the numbers
// of a row of the table are put in the place of those of the motion, and the part is compared with that.
#include "runtime/verifier/places.hpp"

#include <algorithm>
#include <chrono>
#include <sstream>

#include "runtime/verifier/model/model_comparison.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {
namespace {

class PlacesChecker {
 public:
  PlacesChecker(Lines& lines, const Options& options, CheckPart check_part, Verification& result)
      : lines_(lines), options_(options), check_part_(check_part), result_(result) {}

  void check() {
    advance();  // to the first line, which next() returns again
    advance();
    for (std::size_t k = 0; lines_.text().starts_with(format::kPlace); ++k) {
      if (k == format::kMostPlaces) throw Rejection("there are too many places");
      const std::string expected = format::kPlace + std::to_string(k + 1);
      if (lines_.text() != expected) throw Rejection("expected the line '" + expected + '\'');
      check_next(k);
    }
    if (result_.places == 0 || lines_.text() != format::kPlaces + std::to_string(result_.places))
      throw Rejection("expected the next place, or the number of all in a line 'places'");
    if (lines_.next()) throw Rejection("there is text after the line 'places'");
    if (table_ && table_->rows() != result_.places)
      throw OtherModel("the certificate is not about " + table_->file() + ": it has " +
                       std::to_string(result_.places) + " places, the file " +
                       std::to_string(table_->rows()));
    result_.claim = format::describe_places_claim(claimed_);
    if (unfinished_) throw Unfinished(*unfinished_);
  }

 private:
  void advance() {
    if (!lines_.next()) throw Rejection("the file ends before its line 'places'");
  }

  /// Reads the lines of a part up to the next one.
  std::string read_part() {
    std::string part;
    for (advance();
         !lines_.text().starts_with(format::kPlace) && !lines_.text().starts_with(format::kPlaces);
         advance()) {
      part += lines_.text() + '\n';
      if (part.size() > format::kLongestPart) throw Rejection("the part about a place is too long");
    }
    return part;
  }

  /// An open part does not end the reading: another part may be false.
  void check_next(std::size_t k) {
    const std::size_t first = lines_.number();
    const std::string part = read_part();
    ++result_.places;
    lines_.name_line(first);
    try {
      if (part.empty()) throw Unfinished("it has no proof");
      prove(k, part);
    } catch (const Unfinished& why) {
      if (!unfinished_) unfinished_ = name_of(k) + ": " + why.what();
    }
    lines_.name_line(0);
  }

  [[nodiscard]] std::string name_of(std::size_t k) const {
    const std::string name = format::kPlace + std::to_string(k + 1);
    return table_ && k < table_->rows() ? name + ", " + table_->describe(k) : name;
  }

  void prove(std::size_t k, const std::string& part) {
    std::istringstream text(part);
    Lines lines(text);
    Verification of_part;
    PlacePart place{k, &table_};
    const auto here = [&](const std::exception& why) {
      return "line " + std::to_string(lines.number()) + " of its part: " + why.what();
    };
    const Options rest = rest_of_options();
    try {
      check_part_(lines, rest, place, of_part);
    } catch (const OtherModel& why) {
      throw OtherModel(name_of(k) + ": " + why.what());
    } catch (const Rejection& why) {
      throw Rejection(name_of(k) + ": " + here(why));
    } catch (const Unfinished& why) {
      result_.boxes += of_part.boxes;
      throw Unfinished(here(why));
    }
    add(k, of_part, part);
  }

  /// With what is left of the limits for all parts.
  [[nodiscard]] Options rest_of_options() const {
    Options rest = options_;
    if (options_.time_limit > 0) rest.time_limit = options_.time_limit - seconds();
    if (rest.time_limit < 0) throw Unfinished("the time limit was reached");
    if (result_.boxes >= options_.max_boxes)
      throw Unfinished("all places together need more than " + std::to_string(options_.max_boxes) +
                       " boxes");
    rest.max_boxes = options_.max_boxes - result_.boxes;
    if (options_.progress)
      rest.progress = [this](const Verification& of_part) {
        Verification total = result_;
        total.boxes += of_part.boxes;
        options_.progress(total);
      };
    return rest;
  }

  void add(std::size_t k, const Verification& of_part, const std::string& part) {
    if (result_.model.empty() && claimed_.complete + claimed_.none + claimed_.incomplete == 0) {
      result_.model = of_part.model;
      result_.sha256 = of_part.sha256;
      result_.motion = of_part.motion;
    }
    if (of_part.model != result_.model || of_part.sha256 != result_.sha256 ||
        of_part.motion != result_.motion)
      throw Rejection(name_of(k) + ": it is about another model or motion than the first part");
    result_.boxes += of_part.boxes;
    result_.leaves += of_part.leaves;
    result_.roots += of_part.roots;
    result_.real_roots += of_part.real_roots;
    result_.numbers += of_part.numbers;
    for (const std::string& difference : of_part.differences)
      if (std::ranges::find(result_.differences, difference) == result_.differences.end())
        result_.differences.push_back(difference);
    count(part);
  }

  /// The part is true, so its lines are what they say.
  void count(const std::string& part) {
    std::istringstream text(part);
    for (std::string line; std::getline(text, line);) {
      claimed_.solutions += line.starts_with("solution ");
      claimed_.complete += line == std::string("verdict ") + format::kComplete;
      claimed_.none += line == std::string("verdict ") + format::kNone;
      claimed_.incomplete += line == std::string("verdict ") + format::kIncomplete;
    }
  }

  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  Lines& lines_;
  const Options& options_;
  const CheckPart check_part_;
  Verification& result_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<PlaceTable> table_;
  format::ClaimedPlaces claimed_;
  std::optional<std::string> unfinished_;  ///< why the first such part is not proved
};

/// Reads the table that the options or the motion name. Throws Unfinished if there is none, unless the
/// places may be those of options.
void read_table_of(const Question& question, const WrittenValues& model, const Options& options,
                   std::optional<PlaceTable>& table) {
  if (table) return;
  const std::string file = options.waypoints.empty()
                               ? table_of_motion(model, question.motion, options.model_name)
                               : options.waypoints;
  if (!file.empty()) table.emplace(file);
  if (file.empty() && !options.all_overridden)
    throw Unfinished("the certificate is about places of a table; name it by --waypoints");
}

}  // namespace

void compare_place(Question& question, const WrittenValues& model, const Options& options,
                   const PlacePart& place, Verification& result) {
  std::optional<PlaceTable>& table = *place.table;
  read_table_of(question, model, options, table);
  if (!table) return compare_with_file(question, model, options, result);
  if (place.number >= table->rows())
    throw OtherModel("the certificate is not about " + table->file() + ", which has " +
                     std::to_string(table->rows()) + " places");
  PlaceTable::AtRow row = table->at(place.number, question, model);
  Options at_place = options;
  at_place.fixed.merge(row.fixed);
  try {
    compare_with_file(question, row.values, at_place, result);
  } catch (const OtherModel& why) {
    // Numbers that the table does not have may be those of options.
    if (row.is_whole || !options.all_overridden) throw;
    throw Unfinished(std::string("the table has not all numbers of the place, and ") + why.what());
  }
}

void check_places(Lines& lines, const Options& options, CheckPart check_part,
                  Verification& result) {
  PlacesChecker(lines, options, check_part, result).check();
}

}  // namespace regulus::verifier
