// SPDX-License-Identifier: BSD-3-Clause
#ifndef ErrorCollector_h
#define ErrorCollector_h

#include "vtkCommand.h"

#include <string>
#include <vector>

/**
 * Observes the errors and warnings of a VTK object, and of its executive if it is an algorithm,
 * which are then not printed. Errors are kept, the first one as the message; warnings go to stderr,
 * as a line each.
 * Observe vtkOutputWindow, too, for what helpers inside a reader report: all of that is an error.
 */
class ErrorCollector : public vtkCommand
{
public:
  static ErrorCollector* New() { return new ErrorCollector; }
  vtkTypeMacro(ErrorCollector, vtkCommand)

  void Execute(vtkObject* caller, unsigned long event, void* callData) override;

  /** From now on, the errors and warnings of `object`. */
  void Observe(vtkObject* object);

  bool HasError() const { return this->Error; }
  /** Empty if all that is known is that there was an error. */
  const std::string& GetMessage() const { return this->Message; }

  /** Whether any collector has shown a warning in this process. */
  static bool HasShownWarning() { return ErrorCollector::AnyShown; }

  /** Keeps warnings back from now on, until they are asked for. */
  void DeferWarnings() { this->Deferring = true; }
  void ShowDeferredWarnings();

  /** From now on, of warnings shows those of the input alone, each once: not what has the tag of a mesh. */
  void HideWarningsOfMesh() { this->HidingOfMesh = true; }

private:
  bool IsHidden(const std::string& warning) const;

  static void Show(const std::string& warning);

  static inline bool AnyShown = false;
  bool Error = false;
  std::string Message;
  bool Deferring = false;
  std::vector<std::string> DeferredWarnings;
  bool HidingOfMesh = false;
  std::vector<std::string> Shown;
};

#endif
