// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMeshReader.h"

#include "file/ReadFile.h"
#include "vtkFileContents.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <stdexcept>

vtkStandardNewMacro(vtkNeuralMeshReader);

vtkNeuralMeshReader::vtkNeuralMeshReader() { this->SetNumberOfInputPorts(0); }

vtkNeuralMeshReader::~vtkNeuralMeshReader() = default;

void vtkNeuralMeshReader::SetFileName(const char* name)
{
  const std::string wanted = name ? name : "";
  if (this->FileName != wanted)
  {
    this->FileName = wanted;
    this->Modified();
  }
}

bool vtkNeuralMeshReader::CanReadFile(const char* name)
{
  return name && neuralmesh::canReadFile(name);
}

std::string vtkNeuralMeshReader::GetConversion(const char* name)
{
  return name ? neuralmesh::conversionOf(name) : "";
}

int vtkNeuralMeshReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  if (this->FileName.empty())
  {
    vtkErrorMacro(<< "There is no FileName.");
    return 0;
  }
  try
  {
    const neuralmesh::FileContents contents = neuralmesh::readFile(this->FileName);
    vtkFileContents::Store(contents, vtkPolyData::GetData(outputVector));
    if (!contents.remark.empty())
    {
      vtkWarningMacro(<< this->FileName << ": " << contents.remark);
    }
  }
  catch (const std::exception& error) // there may be too little memory, too
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

void vtkNeuralMeshReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
}
