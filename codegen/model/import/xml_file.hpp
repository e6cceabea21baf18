// SPDX-License-Identifier: GPL-3.0-or-later
// XML with the lines of its elements.
#pragma once

#include <tinyxml2.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "codegen/model/import/exact_number.hpp"

namespace regulus::detail {

/// An element of an XML file; it belongs to its XmlFile.
class XmlElement {
 public:
  XmlElement(const std::string& file, const tinyxml2::XMLElement& element)
      : file_(&file), element_(&element) {}

  [[nodiscard]] std::string name() const { return element_->Name(); }
  [[nodiscard]] int line() const { return element_->GetLineNum(); }
  /// Returns the value of the attribute; `otherwise` if there is none.
  [[nodiscard]] std::string attribute(const char* key, const std::string& otherwise = {}) const;
  [[nodiscard]] bool has(const char* key) const { return element_->Attribute(key) != nullptr; }
  /// The same; refuses an element without it.
  [[nodiscard]] std::string required(const char* key) const;
  /// Returns the text between its tags.
  [[nodiscard]] std::string text() const;
  [[nodiscard]] std::vector<XmlElement> children() const;
  [[nodiscard]] std::vector<XmlElement> children(const char* name) const;
  /// Returns the first child of that name; nullopt if there is none.
  [[nodiscard]] std::optional<XmlElement> child(const char* name) const;

  [[nodiscard]] XmlPlace place(const std::string& what) const { return {*file_, line(), what}; }
  /// Throws    InputError: "FILE:LINE: PROBLEM; REMEDY".
  [[noreturn]] void refuse(const std::string& problem, const std::string& remedy) const;

 private:
  const std::string* file_;
  const tinyxml2::XMLElement* element_;
};

class XmlFile {
 public:
  /// Throws    InputError for a text that is not XML.
  XmlFile(std::string file, std::string_view text);
  XmlFile(const XmlFile&) = delete;
  XmlFile& operator=(const XmlFile&) = delete;

  [[nodiscard]] XmlElement root() const { return {file_, *document_.RootElement()}; }

 private:
  std::string file_;
  tinyxml2::XMLDocument document_;
};

}  // namespace regulus::detail
