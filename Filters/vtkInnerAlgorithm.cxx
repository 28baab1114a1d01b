// SPDX-License-Identifier: BSD-3-Clause
#include "vtkInnerAlgorithm.h"

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkNew.h"

#include <stdexcept>
#include <string>

namespace
{
class FirstMessage : public vtkCommand
{
public:
  static FirstMessage* New() { return new FirstMessage; }

  void Execute(vtkObject* caller, unsigned long event, void* callData) override
  {
    this->HasFailed = this->HasFailed || event == vtkCommand::ErrorEvent;
    // An executive says only that its algorithm has failed.
    if (this->Text.empty() && callData && !vtkExecutive::SafeDownCast(caller))
    {
      const std::string message = static_cast<const char*>(callData);
      // Behind the file, the line, the class and the address.
      const std::size_t begin = message.find("): ");
      this->Text = message.substr(begin == std::string::npos ? 0 : begin + 3);
      this->Text.erase(this->Text.find_last_not_of('\n') + 1);
    }
  }

  bool HasFailed = false;
  std::string Text;
};
}

void vtkInnerAlgorithm::Update(vtkAlgorithm* algorithm)
{
  vtkNew<FirstMessage> first;
  for (vtkObject* object :
    { static_cast<vtkObject*>(algorithm), static_cast<vtkObject*>(algorithm->GetExecutive()) })
  {
    object->AddObserver(vtkCommand::ErrorEvent, first);
    object->AddObserver(vtkCommand::WarningEvent, first);
  }
  algorithm->Update();
  if (first->HasFailed)
  {
    throw std::runtime_error(first->Text.empty() ? "it cannot be done" : first->Text);
  }
}
