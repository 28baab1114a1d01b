// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorCollector.h"

#include "vtkObject.h"

#include <iostream>

namespace
{
/** The text behind VTK's "ERROR: In file, line n\nvtkClass (address): ". */
std::string PlainText(const char* vtkMessage)
{
  std::string text = vtkMessage ? vtkMessage : "";
  const std::size_t prefix = text.find("): ");
  if (prefix != std::string::npos)
  {
    text.erase(0, prefix + 3);
  }
  while (!text.empty() && (text.back() == '\n' || text.back() == ' '))
  {
    text.pop_back();
  }
  return text;
}
}

void ErrorCollector::Execute(vtkObject*, unsigned long event, void* callData)
{
  const std::string text = PlainText(static_cast<const char*>(callData));
  if (event == vtkCommand::WarningEvent)
  {
    std::cerr << "neuralmesh: warning: " << text << std::endl;
  }
  else if (this->Message.empty())
  {
    this->Message = text.empty() ? "unknown error" : text;
  }
}

void ErrorCollector::Observe(vtkObject* object)
{
  object->AddObserver(vtkCommand::ErrorEvent, this);
  object->AddObserver(vtkCommand::WarningEvent, this);
}
