// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of another program's file: exact decimals, snapped to short decimals and multiples of pi/12.
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <string_view>
#include <vector>

namespace regulus::detail {

/// A place in the file that is read, for messages.
struct XmlPlace {
  std::string file;
  int line = 0;
  std::string what;  ///< "the origin of joint 'elbow'"
};

/// A number, and the text that a model file has for it: "0.333", "-pi/2".
struct WrittenNumber {
  GiNaC::ex value = 0;
  std::string text = "0";

  [[nodiscard]] bool is_zero() const { return value.is_zero(); }
  /// The nearest double, for choices that change nothing in what is written.
  [[nodiscard]] double approx() const;
};

/// A number that is not as the file has it.
struct Snap {
  int line = 0;
  std::string what, before, after;
};

/// A number that a larger tolerance would move.
struct NearSnap {
  Snap snap;
  int exponent = 0;  ///< of the power of ten that is tolerance enough
};

enum class AngleUnit { kRadian, kDegree };

class NumberReader {
 public:
  /// `tolerance`: numbers move by at most this much; 0 leaves all of them as they are.
  explicit NumberReader(GiNaC::numeric tolerance) : tolerance_(std::move(tolerance)) {}

  /// Reads a decimal. Throws InputError for any other text. It moves by at most 1e-6, whatever the
  /// tolerance, and only to a decimal that is shorter by four digits.
  [[nodiscard]] WrittenNumber length(std::string_view text, const XmlPlace& place);

  /// The same for a component of a direction; it may move by the tolerance.
  [[nodiscard]] WrittenNumber component(std::string_view text, const XmlPlace& place);

  /// The same for an angle; the value is in rad.
  [[nodiscard]] WrittenNumber angle(std::string_view text, AngleUnit unit, const XmlPlace& place);

  /// Reads as many lengths, or angles, as there are words in the text.
  [[nodiscard]] std::vector<WrittenNumber> lengths(std::string_view text, const XmlPlace& place);
  [[nodiscard]] std::vector<WrittenNumber> angles(std::string_view text, AngleUnit unit,
                                                  const XmlPlace& place);

  void record(Snap snap) { snaps_.push_back(std::move(snap)); }
  [[nodiscard]] const std::vector<Snap>& snaps() const noexcept { return snaps_; }
  /// `exponent`: of the power of ten that is tolerance enough.
  void note_near(Snap snap, int exponent) { near_.push_back({std::move(snap), exponent}); }
  /// Returns the angles and turns that may have been meant as multiples of pi/12, but are not within
  /// the tolerance.
  [[nodiscard]] const std::vector<NearSnap>& near() const noexcept { return near_; }
  [[nodiscard]] const GiNaC::numeric& tolerance() const noexcept { return tolerance_; }

 private:
  [[nodiscard]] WrittenNumber snapped(const GiNaC::numeric& value, std::string_view text,
                                      const XmlPlace& place, const GiNaC::numeric& tolerance);

  GiNaC::numeric tolerance_;
  std::vector<Snap> snaps_;
  std::vector<NearSnap> near_;
};

/// Returns the exact number that the decimal denotes; throws InputError for any other text.
[[nodiscard]] GiNaC::numeric exact_number(std::string_view text, const XmlPlace& place);

/// Returns the text of a number with finitely many decimals: "-0.333".
[[nodiscard]] std::string decimal_text(const GiNaC::numeric& value);

[[nodiscard]] WrittenNumber whole(long value);
[[nodiscard]] WrittenNumber negated(const WrittenNumber& number);

/// Returns k·pi/12: "-pi/2".
[[nodiscard]] WrittenNumber twelfths_of_pi(long k);

/// Returns the words between white space.
[[nodiscard]] std::vector<std::string_view> words_of(std::string_view text);

}  // namespace regulus::detail
