#include "plume/io/vtk_errors.h"

#include <vtkLogger.h>
#include <vtkObject.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <mutex>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "plume/mesh/error.h"

namespace plume {
namespace {

// "ERROR: In /a/b.cxx, line 12\nvtkReader (0x55d0): Cannot read\nthe rest\n\n" without the parts
// that speak to VTK's authors: "Cannot read the rest".
std::string one_line(std::string text) {
  for (const char* start : {"ERROR: In ", "Warning: In ", "Generic Warning: In "}) {
    if (!text.starts_with(start)) continue;
    const auto end_of_line = text.find('\n');
    text.erase(0, end_of_line == std::string::npos ? text.size() : end_of_line + 1);
  }
  if (text.starts_with("vtk")) {
    const auto address = text.find(" (0x");
    const auto end = text.find("): ");
    if (address != std::string::npos && end != std::string::npos && address < end)
      text.erase(0, end + 3);
  }
  std::string line;
  for (const char c : text) {
    const bool space = c == ' ' || c == '\n' || c == '\r' || c == '\t';
    if (!space)
      line += c;
    else if (!line.empty() && line.back() != ' ')
      line += ' ';
  }
  while (!line.empty() && (line.back() == ' ' || line.back() == '.')) line.pop_back();
  return line;
}

class Listener : public vtkOutputWindow {
 public:
  static Listener* New();
  vtkTypeMacro(Listener, vtkOutputWindow)

      void DisplayText(const char* text) override {
    take(text, nullptr, &vtkOutputWindow::DisplayText);
  }
  void DisplayErrorText(const char* text) override {
    take(text, &errors, &vtkOutputWindow::DisplayErrorText);
  }
  void DisplayWarningText(const char* text) override {
    take(text, &warnings, &vtkOutputWindow::DisplayWarningText);
  }
  void DisplayGenericWarningText(const char* text) override {
    take(text, &warnings, &vtkOutputWindow::DisplayGenericWarningText);
  }
  void DisplayDebugText(const char* text) override {
    take(text, nullptr, &vtkOutputWindow::DisplayDebugText);
  }

  std::vector<std::string> errors;
  std::vector<std::string> warnings;
  std::vector<std::string> expected;
  vtkSmartPointer<vtkOutputWindow> previous;

 private:
  void take(const char* text, std::vector<std::string>* list,
            void (vtkOutputWindow::*display)(const char*)) {
    // What the host program's other threads have to say is not ours to keep.
    if (std::this_thread::get_id() != reader_)
      (previous->*display)(text);
    else if (list && text)
      take_own(one_line(text), *list);
  }

  // The legacy reader calls it a warning when a file ends in the middle of an array.
  void take_own(const std::string& line, std::vector<std::string>& list) {
    const bool is_expected = std::any_of(expected.begin(), expected.end(), [&](const auto& text) {
      return line.find(text) != std::string::npos;
    });
    if (!is_expected) (line.starts_with("Error") ? errors : list).push_back(line);
  }

  const std::thread::id reader_ = std::this_thread::get_id();
};

Listener* Listener::New() { VTK_STANDARD_NEW_BODY(Listener); }

// VTK's logger prints what the output window shows a second time, to stderr. It has no way to ask
// for the level that it prints at, only for the highest of all its outputs.
class QuietLogger {
 public:
  QuietLogger() : previous_(vtkLogger::GetCurrentVerbosityCutoff()) {
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    // Something else, such as a log file, is at that level; stderr then has VTK's default, or less.
    if (vtkLogger::GetCurrentVerbosityCutoff() == previous_)
      previous_ = std::min(previous_, vtkLogger::VERBOSITY_INFO);
  }
  ~QuietLogger() { vtkLogger::SetStderrVerbosity(previous_); }
  QuietLogger(const QuietLogger&) = delete;
  QuietLogger& operator=(const QuietLogger&) = delete;

 private:
  vtkLogger::Verbosity previous_;
};

// Installs a listener for a scope. The host may have switched VTK's messages off; a reader that
// fails would then look like one that succeeded.
class Listening {
 public:
  explicit Listening(Listener& listener) : warnings_on_(vtkObject::GetGlobalWarningDisplay()) {
    listener.previous = vtkOutputWindow::GetInstance();
    previous_ = listener.previous;
    vtkOutputWindow::SetInstance(&listener);
    vtkObject::GlobalWarningDisplayOn();
  }
  ~Listening() {
    vtkObject::SetGlobalWarningDisplay(warnings_on_);
    vtkOutputWindow::SetInstance(previous_);
  }
  Listening(const Listening&) = delete;
  Listening& operator=(const Listening&) = delete;

 private:
  const QuietLogger quiet_logger_;
  vtkSmartPointer<vtkOutputWindow> previous_;
  const int warnings_on_;
};

}  // namespace

void with_vtk_errors(const std::filesystem::path& file, const Notice& notice,
                     const std::string& remedy, const std::function<void()>& work,
                     const std::vector<std::string>& expected) {
  static std::mutex one_at_a_time;
  const auto listener = vtkSmartPointer<Listener>::New();
  listener->expected = expected;
  {
    const std::lock_guard lock(one_at_a_time);
    const Listening listening(*listener);
    try {
      work();
    } catch (const std::bad_alloc&) {
      throw Error(file.string() + ": out of memory; if the file is not that large, it is damaged");
    } catch (const std::length_error&) {
      throw Error(file.string() + ": an array's length makes no sense; the file is damaged");
    }
  }
  if (!listener->errors.empty())
    throw Error(file.string() + ": " + listener->errors.front() + " (VTK's words); " + remedy);
  if (!notice) return;
  auto& warnings = listener->warnings;
  for (auto warning = warnings.begin(); warning != warnings.end(); ++warning)
    if (std::find(warnings.begin(), warning, *warning) == warning)
      notice(file.string() + ": " + *warning);
}

}  // namespace plume
