// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/xml_file.hpp"

#include <utility>

#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/visible_text.hpp"

namespace regulus::detail {

std::string XmlElement::attribute(const char* key, const std::string& otherwise) const {
  const char* value = element_->Attribute(key);
  return value ? value : otherwise;
}

std::string XmlElement::required(const char* key) const {
  if (!has(key))
    refuse("<" + visible(name()) + "> has no '" + key + "'", std::string("add ") + key + "=\"…\"");
  return attribute(key);
}

std::string XmlElement::text() const {
  const char* text = element_->GetText();
  return text ? text : "";
}

std::vector<XmlElement> XmlElement::children() const {
  std::vector<XmlElement> result;
  for (const auto* e = element_->FirstChildElement(); e; e = e->NextSiblingElement())
    result.emplace_back(*file_, *e);
  return result;
}

std::vector<XmlElement> XmlElement::children(const char* name) const {
  std::vector<XmlElement> result;
  for (const auto* e = element_->FirstChildElement(name); e; e = e->NextSiblingElement(name))
    result.emplace_back(*file_, *e);
  return result;
}

std::optional<XmlElement> XmlElement::child(const char* name) const {
  const auto* e = element_->FirstChildElement(name);
  return e ? std::optional(XmlElement(*file_, *e)) : std::nullopt;
}

void XmlElement::refuse(const std::string& problem, const std::string& remedy) const {
  throw InputError::statement(*file_, line(), problem, remedy);
}

/// Refuses texts that are often taken for a robot.
static void require_text_of_robot(const std::string& file, std::string_view text) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    throw InputError::statement(file, 1, "the file is in UTF-16", "save it in UTF-8");
  if (text.starts_with("version https://git-lfs"))
    throw InputError::statement(file, 1, "the file is a pointer of Git LFS",
                                "get the file itself: git lfs pull");
}

XmlFile::XmlFile(std::string file, std::string_view text) : file_(std::move(file)) {
  require_text_of_robot(file_, text);
  if (document_.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS)
    throw InputError::statement(file_, document_.ErrorLineNum(),
                                "the file is not XML, so it is no URDF, MJCF or SDF file",
                                "a model in TOML needs no import; else correct the XML there");
  if (!document_.RootElement())
    throw InputError::statement(file_, 0, "the file has no XML element",
                                "it must be a URDF, MJCF or SDF file");
}

}  // namespace regulus::detail
