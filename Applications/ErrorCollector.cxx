// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorCollector.h"

#include "base/OneLine.h"
#include "base/WarningTopic.h"

#include "vtkAlgorithm.h"
#include "vtkExecutive.h"
#include "vtkObject.h"
#include "vtkOutputWindow.h"

#include <algorithm>
#include <cstddef>
#include <iostream>

namespace
{
/** Warnings name places, and end with their tag. */
constexpr std::size_t LongestMessage = 2000;

/** The text behind VTK's "ERROR: In file, line n\nvtkClass (address): ", as one line. */
std::string PlainText(const char* vtkMessage)
{
  std::string text = vtkMessage ? vtkMessage : "";
  const std::size_t firstLine = text.find('\n');
  if (firstLine != std::string::npos && text.find(": In ") < firstLine)
  {
    text.erase(0, firstLine + 1);
  }
  const std::size_t object = text.find("): ");
  if (text.starts_with("vtk") && object != std::string::npos)
  {
    text.erase(0, object + 3);
  }
  return neuralmesh::oneLine(text, LongestMessage);
}
}

void ErrorCollector::Show(const std::string& warning)
{
  ErrorCollector::AnyShown = true;
  std::cerr << "neuralmesh: warning: " << warning << std::endl;
}

void ErrorCollector::Execute(vtkObject* caller, unsigned long event, void* callData)
{
  const std::string text = PlainText(static_cast<const char*>(callData));
  if (event == vtkCommand::WarningEvent && !vtkOutputWindow::SafeDownCast(caller))
  {
    if (this->IsHidden(text))
    {
      return;
    }
    this->Shown.push_back(text);
    if (this->Deferring)
    {
      this->DeferredWarnings.push_back(text);
    }
    else
    {
      ErrorCollector::Show(text);
    }
  }
  else
  {
    this->Error = true;
    // An executive says only that its algorithm has failed.
    if (this->Message.empty() && !vtkExecutive::SafeDownCast(caller))
    {
      this->Message = text;
    }
  }
}

bool ErrorCollector::IsHidden(const std::string& warning) const
{
  const bool isOfMesh = warning.ends_with(']') &&
    !warning.ends_with(neuralmesh::taggedWarning(neuralmesh::WarningTopic::FirstMesh, ""));
  return this->HidingOfMesh &&
    (isOfMesh || std::find(this->Shown.begin(), this->Shown.end(), warning) != this->Shown.end());
}

void ErrorCollector::ShowDeferredWarnings()
{
  std::for_each(this->DeferredWarnings.begin(), this->DeferredWarnings.end(), ErrorCollector::Show);
  this->DeferredWarnings.clear();
}

void ErrorCollector::Observe(vtkObject* object)
{
  object->AddObserver(vtkCommand::ErrorEvent, this);
  object->AddObserver(vtkCommand::WarningEvent, this);
  if (auto* algorithm = vtkAlgorithm::SafeDownCast(object))
  {
    this->Observe(algorithm->GetExecutive());
  }
}
