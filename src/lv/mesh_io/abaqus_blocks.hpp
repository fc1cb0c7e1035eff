#pragma once

#include "lv/mesh_io/foreign_mesh.hpp"

#include <map>
#include <string>
#include <string_view>
#include <vector>

/// The grammar of ABAQUS input files, without their meaning.
namespace lv::mesh_io {

struct AbaqusLine {
  FileLine at;
  std::string text;
};

/// A keyword line with the data lines that follow it.
struct AbaqusBlock {
  std::string keyword;                         ///< upper case: "ELEMENT", "END PART"
  std::map<std::string, std::string> options;  ///< names and values in upper case
  FileLine at;
  std::vector<AbaqusLine> data;

  /// The value of an option, empty where it is not given.
  [[nodiscard]] std::string option(const std::string& name) const;
  [[nodiscard]] bool has(const std::string& name) const { return options.contains(name); }
};

struct AbaqusFile {
  std::vector<std::string> files;  ///< the file and those it includes
  std::vector<AbaqusBlock> blocks;
};

/// Comments and empty lines are dropped, continued keyword lines joined, *Include followed.
[[nodiscard]] AbaqusFile read_abaqus_blocks(const std::string& file);

/// The fields between the commas of a data line, without the blanks around them; an empty field
/// after a last comma does not count.
[[nodiscard]] std::vector<std::string_view> abaqus_fields(std::string_view line);

[[nodiscard]] std::string upper_case(std::string_view text);

}  // namespace lv::mesh_io
