#include "lv/mesh_io/vtk_messages.hpp"

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

namespace lv::mesh_io {
namespace {

class MessageWindow : public vtkOutputWindow {
 public:
  static MessageWindow* New();  // NOLINT(readability-identifier-naming): VTK's name
  // NOLINTNEXTLINE(readability-identifier-naming): VTK's name
  void DisplayText(const char* text) override { messages += text; }

  std::string messages;
};
vtkStandardNewMacro(MessageWindow);

}  // namespace

struct VtkMessages::Window {
  vtkSmartPointer<vtkOutputWindow> before = vtkOutputWindow::GetInstance();
  vtkLogger::Verbosity verbosity_before = vtkLogger::GetCurrentVerbosityCutoff();
  vtkNew<MessageWindow> own;
};

VtkMessages::VtkMessages() : window_(std::make_unique<Window>()) {
  vtkOutputWindow::SetInstance(window_->own);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

VtkMessages::~VtkMessages() {
  vtkLogger::SetStderrVerbosity(window_->verbosity_before);
  vtkOutputWindow::SetInstance(window_->before);
}

std::string VtkMessages::first() const {
  const std::string& all = window_->own->messages;
  const auto start = all.find("): ");
  if (start == std::string::npos)
    return all;
  const auto end = all.find('\n', start);
  return all.substr(start + 3, end - start - 3);
}

}  // namespace lv::mesh_io
