// SPDX-License-Identifier: GPL-3.0-or-later
// The model reader must keep each number as it is written: random spellings at random places of
// random files are compared with values known before the spelling.
#include <flint/fmpq.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "codegen/model/exact/decimal.hpp"
#include "codegen/model/file/model_file.hpp"
#include "codegen/support/errors.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail {
namespace {

using test::RandomSource;

/// Returns digits·base^exponent in FLINT's arithmetic, as "p/q" in lowest terms.
std::string fraction(const std::string& digits, int base, long exponent, bool negative) {
  fmpq_t value;
  fmpz_t scale;
  fmpq_init(value);
  fmpz_init(scale);
  fmpz_set_str(fmpq_numref(value), digits.c_str(), base);
  fmpz_set_ui(scale, 10);
  fmpz_pow_ui(scale, scale, static_cast<ulong>(exponent < 0 ? -exponent : exponent));
  if (exponent < 0)
    fmpq_div_fmpz(value, value, scale);
  else
    fmpq_mul_fmpz(value, value, scale);
  if (negative) fmpq_neg(value, value);
  char* text = fmpq_get_str(nullptr, 10, value);
  std::string result(text);
  flint_free(text);
  fmpz_clear(scale);
  fmpq_clear(value);
  return result;
}

std::string text_of(const GiNaC::ex& e) {
  std::ostringstream text;
  text << e;
  return text.str();
}

struct Number {
  std::string spelling;
  std::string value;  ///< "p/q"
};

class Speller {
 public:
  explicit Speller(std::uint64_t seed) : random_(seed) {}

  RandomSource& random() { return random_; }

  Number number(bool nonnegative) {
    const bool negative = !nonnegative && random_.one_in(3);
    switch (random_.below(8)) {
      case 0:
        return based(16, "0x", "0123456789abcdefABCDEF", 15);
      case 1:
        return based(8, "0o", "01234567", 20);
      case 2:
        return based(2, "0b", "01", 62);
      case 3:
        return integer(negative);
      default:
        return decimal(negative);
    }
  }

 private:
  std::string digits(std::size_t count, const std::string& from) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) text += from[random_.below(from.size())];
    return text;
  }

  std::string sign(bool negative) { return negative ? "-" : random_.one_in(4) ? "+" : ""; }

  std::string spaced(const std::string& text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (i > 0 && random_.one_in(9)) result += '_';
      result += text[i];
    }
    return result;
  }

  /// Returns digits without a leading 0, except for the number 0 itself.
  std::string whole(std::size_t count) {
    std::string text = digits(count, "0123456789");
    if (count > 1 && text[0] == '0') text[0] = '7';
    return text;
  }

  Number based(int base, const char* prefix, const std::string& from, std::size_t most) {
    const std::string text = digits(1 + random_.below(most), from);
    return {prefix + spaced(text), fraction(text, base, 0, false)};
  }

  Number integer(bool negative) {
    const std::string text = whole(1 + random_.below(18));
    return {sign(negative) + spaced(text), fraction(text, 10, 0, negative)};
  }

  Number decimal(bool negative) {
    const std::size_t count = 1 + random_.below(60);
    const std::size_t before = 1 + random_.below(count);
    std::string head = whole(before);
    std::string tail = digits(count - before, "0123456789");
    if (random_.one_in(3)) near_a_double(head, tail);
    long exponent = 0;
    std::string text = sign(negative) + spaced(head);
    if (!tail.empty()) text += '.' + spaced(tail);
    if (tail.empty() || random_.one_in(2)) text += exponent_text(exponent);
    return {text, fraction(head + tail, 10, exponent - static_cast<long>(tail.size()), negative)};
  }

  /// Makes a number close to a short decimal or to the middle of two doubles: 1.000000000000000001.
  void near_a_double(std::string& head, std::string& tail) {
    head = whole(1 + random_.below(3));
    tail = digits(random_.below(3), "0123456789") +
           std::string(10 + random_.below(40), random_.one_in(2) ? '0' : '9') +
           digits(1, "0123456789");
  }

  std::string exponent_text(long& exponent) {
    const long size = static_cast<long>(random_.below(random_.one_in(3) ? 240 : 12));
    const bool negative = random_.one_in(2);
    exponent = negative ? -size : size;
    std::string text(1, random_.one_in(2) ? 'e' : 'E');
    text += negative ? "-" : random_.one_in(2) ? "+" : "";
    if (random_.one_in(4)) text += '0';
    return text + std::to_string(size);
  }

  RandomSource random_;
};

/// A model with many numbers, and their values.
class Document {
 public:
  explicit Document(std::uint64_t seed) : speller_(seed) {
    newline_ = one_in(3) ? "\r\n" : "\n";
    if (one_in(3)) text_ = "\xEF\xBB\xBF";
    line("regulus = 1");
    line("name = \"\u00b5\u2126 \U0001F916 1.5\"  # 2.5 \u00e4 \"");
    if (one_in(2)) line("source = \"\"\"\\" + newline_ + "  = 1.5, [7] 'x' \u00e9 \"\" 3\"\"\"\"");
    line("pose = { x = \"\u00b5m\", y = \"=1.5,\" }");
    line("");
    geometry();
    matrix();
    motion();
  }

  [[nodiscard]] const std::string& text() const { return text_; }

  void expect_numbers() const {
    Model model;
    ASSERT_NO_THROW(model = parse_model(text_, "m.toml")) << text_;
    std::vector<std::string> found;
    for (const GeometryParameter& g : model.geometry) {
      found.push_back(text_of(g.value));
      found.push_back(
          text_of(g.ball < 0 ? g.tolerance : model.balls.at(std::size_t(g.ball)).radius));
    }
    for (unsigned i = 0; i < 2; ++i)
      for (unsigned j = 0; j < 2; ++j) found.push_back(text_of(model.matrix(i, j)));
    for (const GiNaC::ex& scale : model.row_scale) found.push_back(text_of(scale));
    const Motion& motion = model.motions.at(0);
    for (const GiNaC::ex& e : motion.pose) found.push_back(text_of(e));
    for (const GiNaC::ex& e : motion.error) found.push_back(text_of(e));
    found.push_back(text_of(motion.alpha));
    EXPECT_EQ(found, expected_) << text_;
  }

 private:
  bool one_in(std::uint64_t count) { return speller_.random().one_in(count); }
  void line(const std::string& words) { text_ += words + newline_; }

  std::string space() {
    static const std::vector<std::string> kSpaces = {"", " ", "  ", "\t", " \t"};
    return kSpaces[speller_.random().below(kSpaces.size())];
  }

  /// Returns space between the elements of an array, perhaps with lines and comments.
  std::string room() {
    if (!one_in(4)) return space();
    return space() + (one_in(2) ? "# \u00fc 0.5, \"[" : "") + newline_ + space();
  }

  Number number(bool nonnegative = true) { return speller_.number(nonnegative); }

  void expect(const Number& value, const Number& tolerance) {
    expected_.push_back(value.value);
    expected_.push_back(tolerance.value);
  }

  std::string list(const std::vector<Number>& numbers) {
    std::string text = "[";
    for (const Number& number : numbers) {
      if (text.size() > 1) text += ',';
      text.append(room()).append(number.spelling).append(room());
    }
    return text + "]";
  }

  void geometry() {
    line(space() + "[" + space() + "geometry" + space() + "]" + space() + "# 1.5");
    const Number none{"0", "0"};
    for (int i = 0; i < 6; ++i) {
      const std::string name = "g" + std::to_string(i);
      const Number value = number(false), tolerance = number();
      const std::string equals = space() + "=" + space();
      switch (speller_.random().below(5)) {
        case 0:
          line(space() + name + equals + value.spelling + space() + "#9.5");
          expect(value, none);
          break;
        case 1:
          line(name + equals + "{" + space() + "value" + equals + value.spelling + space() +
               ",group=\"a\",tolerance" + equals + tolerance.spelling + "}");
          expect(value, tolerance);
          break;
        case 2:
          line(name + ".'tolerance'" + equals + tolerance.spelling);
          line("\"" + name + "\"" + space() + "." + space() + "value" + equals + value.spelling);
          expect(value, tolerance);
          break;
        case 3: {
          const Number other = number(false);
          line(name + equals + "{ radius =" + tolerance.spelling +
               ", value =" + list({value, other, value}) + "}");
          for (const Number& n : {value, other, value}) expect(n, tolerance);
          break;
        }
        default:
          line(name + equals + list({value, value}));
          expect(value, none);
          expect(value, none);
      }
    }
  }

  void matrix() {
    const Number a = number(false), b = number(false), c = number(), d = number();
    line("[matrix]");
    line("rows = [" + room() + list({a, b}) + "," + room() + list({b, a}) + room() + "]");
    for (const Number& n : {a, b, b, a}) expected_.push_back(n.value);
    // A factor of 0 is refused, so another number replaces it.
    const auto positive = [this](Number n) {
      while (n.value == "0") n = number();
      expected_.push_back(n.value);
      return n;
    };
    line("row_scale = " + list({positive(c), positive(d)}));
  }

  void motion() {
    const Number x = number(false), y = number(false), ex = number(), ey = number(),
                 alpha = number();
    line("[motion.m]");
    line("x = " + x.spelling);
    line("y = " + y.spelling);
    line("error = {y = " + ey.spelling + ", x = " + ex.spelling + space() + "}");
    text_ += "alpha = " + alpha.spelling + (one_in(2) ? newline_ : "");
    for (const Number& n : {x, y, ex, ey, alpha}) expected_.push_back(n.value);
  }

  Speller speller_;
  std::string newline_;
  std::string text_;
  std::vector<std::string> expected_;
};

TEST(Numbers, AreWhatIsWrittenWhereverTheyStand) {
  for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
    Document(seed).expect_numbers();
    if (HasFailure()) FAIL() << "seed " << seed;
  }
}

TEST(Numbers, OfRandomSpellingsAreExact) {
  Speller speller(20070601);
  for (int i = 0; i < 30000; ++i) {
    const Number number = speller.number(false);
    const auto exact = exact_toml_number(number.spelling);
    ASSERT_TRUE(exact) << number.spelling;
    EXPECT_EQ(text_of(*exact), number.value) << number.spelling;
  }
}

/// A number with one digit changed, added or left out is another number or none.
TEST(Numbers, ThatDifferInOneDigitDiffer) {
  Speller speller(5);
  for (int i = 0; i < 5000; ++i) {
    const Number number = speller.number(false);
    const std::string& text = number.spelling;
    const std::size_t at = speller.random().below(text.size());
    if (text.starts_with('0') || !('1' <= text[at] && text[at] <= '8')) continue;
    std::string changed = text;
    ++changed[at];
    const auto exact = exact_toml_number(changed);
    if (!exact || number.value == "0") continue;
    EXPECT_NE(text_of(*exact), number.value) << text << " and " << changed;
  }
}

TEST(Numbers, AfterLettersOfSeveralBytesOnTheLineAreFound) {
  const std::string anchors =
      "[[-9.00000000000000000001, 9, 0], [9, 9, 0], [12, -3, 0],"
      " [3, -13, 0], [-3, -13, 0], [-12, -3, 0x1f]]";
  const Model model = parse_model(
      "regulus = 1\nname = \"a\"\ngough = { unit = \"\u00b5\u2126\U0001F916\", orientation = "
      "\"euler-zxz\", base_tolerance = 0.1000000000000000055511151231257827, base = " +
          anchors + ", platform = " + anchors +
          " }\n[motion.m]\nx = 0\ny = 0\nz = 1\npsi = 0\ntheta = 0\nphi = 0\n",
      "m.toml");
  EXPECT_EQ(text_of(model.geometry.at(0).value), fraction("900000000000000000001", 10, -20, true));
  EXPECT_EQ(text_of(model.geometry.at(17).value), "31");
  EXPECT_EQ(text_of(model.geometry.at(0).tolerance),
            fraction("1000000000000000055511151231257827", 10, -34, false));
}

}  // namespace
}  // namespace regulus::detail
