// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMeshPLYReader.h"

#include "cloud/PlyContents.h"
#include "vtkInnerAlgorithm.h"
#include "vtkShift.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPLYReader.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <stdexcept>

vtkStandardNewMacro(vtkNeuralMeshPLYReader);

namespace
{
template <typename Array, typename Number>
vtkNew<vtkPoints> MakePoints(const std::vector<Number>& coordinates)
{
  vtkNew<Array> values;
  values->SetNumberOfComponents(3);
  values->SetNumberOfTuples(static_cast<vtkIdType>(coordinates.size() / 3));
  std::copy(coordinates.begin(), coordinates.end(), values->GetPointer(0));
  vtkNew<vtkPoints> points;
  points->SetData(values);
  return points;
}

/** What vtkPLYReader makes of the file; it takes each number by itself. */
vtkSmartPointer<vtkPolyData> ReadAsFloats(
  const std::string& path, const neuralmesh::PlyContents& contents)
{
  if (!contents.floats.empty())
  {
    vtkNew<vtkPolyData> result;
    result->SetPoints(MakePoints<vtkFloatArray>(contents.floats));
    return result;
  }
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(path.c_str());
  reader->SetDuplicatePointsForFaceTexture(contents.coordinates.empty());
  vtkInnerAlgorithm::Update(reader);
  return reader->GetOutput();
}

/** Throws std::runtime_error. */
void Read(const std::string& path, vtkPolyData* output)
{
  const neuralmesh::PlyContents contents = neuralmesh::readPlyContents(path);
  const vtkSmartPointer<vtkPolyData> result = ReadAsFloats(path, contents);
  if (!contents.coordinates.empty())
  {
    if (3 * static_cast<std::size_t>(result->GetNumberOfPoints()) != contents.coordinates.size())
    {
      throw std::runtime_error("damaged: it does not have as many points as it says");
    }
    result->SetPoints(MakePoints<vtkDoubleArray>(contents.coordinates));
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
