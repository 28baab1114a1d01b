// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMeshPLYReader.h"

#include "cloud/PlyContents.h"
#include "vtkInnerAlgorithm.h"
#include "vtkShift.h"

#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPLYReader.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <stdexcept>

vtkStandardNewMacro(vtkNeuralMeshPLYReader);

namespace
{
vtkNew<vtkPoints> MakePoints(const std::vector<double>& coordinates)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(coordinates.size() / 3));
  auto* values = vtkDoubleArray::SafeDownCast(points->GetData());
  std::copy(coordinates.begin(), coordinates.end(), values->GetPointer(0));
  return points;
}

/** Throws std::runtime_error. */
void Read(const std::string& path, vtkPolyData* output)
{
  const neuralmesh::PlyContents contents = neuralmesh::readPlyContents(path);
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(path.c_str());
  const bool hasDoubles = !contents.coordinates.empty();
  reader->SetDuplicatePointsForFaceTexture(!hasDoubles);
  vtkInnerAlgorithm::Update(reader);
  vtkPolyData* result = reader->GetOutput();
  if (hasDoubles)
  {
    if (3 * static_cast<std::size_t>(result->GetNumberOfPoints()) != contents.coordinates.size())
    {
      throw std::runtime_error("damaged: it does not have as many points as it says");
    }
    result->SetPoints(MakePoints(contents.coordinates));
  }
  if (contents.shift)
  {
    vtkShift::Store(result, *contents.shift);
    vtkShift::Undo(result);
  }
  output->ShallowCopy(result);
}
}

vtkNeuralMeshPLYReader::vtkNeuralMeshPLYReader() { this->SetNumberOfInputPorts(0); }

vtkNeuralMeshPLYReader::~vtkNeuralMeshPLYReader() = default;

void vtkNeuralMeshPLYReader::SetFileName(const char* name)
{
  const std::string wanted = name ? name : "";
  if (this->FileName != wanted)
  {
    this->FileName = wanted;
    this->Modified();
  }
}

int vtkNeuralMeshPLYReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  if (this->FileName.empty())
  {
    vtkErrorMacro(<< "There is no FileName.");
    return 0;
  }
  try
  {
    Read(this->FileName, vtkPolyData::GetData(outputVector));
  }
  catch (const std::exception& error) // there may be too little memory, too
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

void vtkNeuralMeshPLYReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
}
