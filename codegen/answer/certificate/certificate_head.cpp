// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/certificate/certificate_head.hpp"

namespace regulus {

CertificateHead::CertificateHead(std::istream& file) {
  std::vector<std::string> lines;
  std::string line;
  for (char c; text_.size() < kLongestHead && file.get(c);) {
    text_ += c;
    if (c != '\n' && (static_cast<unsigned char>(c) < ' ' || c == 127)) return;
    if (c != '\n') {
      line += c;
      continue;
    }
    if (line == "proof") {
      lines_ = std::move(lines);
      return;
    }
    lines.push_back(std::move(line));
    line.clear();
  }
}

std::string_view CertificateHead::value(std::string_view key) const {
  for (const std::string& line : lines_)
    if (const std::string_view value = value_of(line, key); !value.empty()) return value;
  return {};
}

std::string_view value_of(std::string_view line, std::string_view key) {
  if (!line.starts_with(key) || line.size() <= key.size() || line[key.size()] != ' ') return {};
  return line.substr(key.size() + 1);
}

ContinuedText::ContinuedText(const std::string& text, std::istream& rest)
    : rest_(rest), buffer_(text.begin(), text.end()) {
  setg(buffer_.data(), buffer_.data(), buffer_.data() + buffer_.size());
}

ContinuedText::int_type ContinuedText::underflow() {
  constexpr std::size_t kPart = 1 << 16;
  buffer_.resize(kPart);
  rest_.read(buffer_.data(), kPart);
  if (rest_.bad()) throw std::ios_base::failure("read error");
  const std::streamsize count = rest_.gcount();
  setg(buffer_.data(), buffer_.data(), buffer_.data() + count);
  return count > 0 ? traits_type::to_int_type(buffer_.front()) : traits_type::eof();
}

}  // namespace regulus
