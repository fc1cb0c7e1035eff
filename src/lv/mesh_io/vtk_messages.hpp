#pragma once

#include <memory>
#include <string>

namespace lv::mesh_io {

/// Keeps what VTK has to say while it lives, instead of letting it print.
class VtkMessages {
 public:
  VtkMessages();
  ~VtkMessages();
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages& operator=(const VtkMessages&) = delete;

  /// "ERROR: In file.cxx, line 1\nvtkClass (0x1): what happened" -> "what happened"; empty if
  /// nothing happened.
  [[nodiscard]] std::string first() const;

 private:
  struct Window;
  std::unique_ptr<Window> window_;
};

}  // namespace lv::mesh_io
