#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "io/vtk_numbers.h"
#include "io/vtk_xml_bytes.h"

namespace isorelax {

/// An XML file of VTK: its elements, and its arrays wherever their numbers stand.
class VtkXmlFile {
 public:
  /// Throws InputError: not XML, or in a form that is not read.
  VtkXmlFile(std::string_view bytes, std::string name);

  /// The element VTKFile.
  [[nodiscard]] pugi::xml_node root() const { return document_.document_element(); }
  /// Lines of the comments before it.
  [[nodiscard]] std::vector<std::string> comments() const;
  /// The value of an attribute that counts something; 0 where there is none.
  [[nodiscard]] std::uint64_t count(pugi::xml_node node, const char* attribute) const;
  /// Reads a DataArray that has to have so many rows.
  [[nodiscard]] VtkArray array(pugi::xml_node node, std::uint64_t rows);
  /// Whether an array read so far was not of text.
  [[nodiscard]] bool has_binary() const { return has_binary_; }

  /// Throws InputError with the line of an element.
  [[noreturn]] void fail(pugi::xml_node node, const std::string& reason) const;

 private:
  void cut_appended_data(std::string_view bytes);
  void check_form();
  void read_words(pugi::xml_node node, VtkArray& array) const;
  void read_bytes(pugi::xml_node node, VtkArray& array);
  [[nodiscard]] EncodedBytes source_of(pugi::xml_node node, const std::string& text) const;
  [[noreturn]] void fail_at(std::size_t byte, const std::string& reason) const;

  std::string name_;
  std::string text_;  ///< without what stands in AppendedData
  std::string_view appended_;
  std::size_t appended_read_ = 0;
  pugi::xml_document document_;
  VtkXmlLayout layout_;
  bool has_binary_ = false;
};

}  // namespace isorelax
