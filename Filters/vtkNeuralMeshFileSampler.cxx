// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMeshFileSampler.h"

#include "base/PhaseTimes.h"
#include "cloud/PointFile.h"
#include "vtkFilePoints.h"
#include "vtkNeuralMeshRun.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <optional>
#include <stdexcept>

vtkStandardNewMacro(vtkNeuralMeshFileSampler);

vtkNeuralMeshFileSampler::vtkNeuralMeshFileSampler()
{
  this->SetNumberOfInputPorts(0);
  this->SetProgressText("Neural Mesh File Sampler");
}

vtkNeuralMeshFileSampler::~vtkNeuralMeshFileSampler() = default;

void vtkNeuralMeshFileSampler::SetFileName(const char* name)
{
  const std::string wanted = name ? name : "";
  if (this->FileName != wanted)
  {
    this->FileName = wanted;
    this->Modified();
  }
}

int vtkNeuralMeshFileSampler::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  neuralmesh::PhaseTimes times;
  times.enter(neuralmesh::Phase::Drawing);
  this->NumberOfFilePoints = 0;
  if (this->FileName.empty())
  {
    vtkErrorMacro(<< "There is no FileName.");
    return 0;
  }
  vtkNeuralMeshProgress progress(this);
  try
  {
    std::optional<neuralmesh::PointFile> file;
    if (this->Format == BY_EXTENSION)
    {
      file.emplace(this->FileName);
    }
    else
    {
      file.emplace(
        this->FileName, this->Format == RAW_DOUBLE, static_cast<std::uint64_t>(this->HeaderBytes));
    }
    this->NumberOfFilePoints = static_cast<vtkIdType>(file->layout().count);
    const auto points = vtkFilePoints::Draw(*file, static_cast<std::uint64_t>(this->NumberOfPoints),
      static_cast<std::uint64_t>(this->Seed),
      [&progress](double fraction) { return progress.Report(fraction); });
    if (points)
    {
      vtkPolyData::GetData(outputVector)->ShallowCopy(points);
    }
  }
  catch (const std::runtime_error& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  this->AbortExecute = 0;
  times.leave();
  this->DrawingTime = times.seconds(neuralmesh::Phase::Drawing);
  return 1;
}

void vtkNeuralMeshFileSampler::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
  os << indent << "Format: " << this->Format << "\n";
  os << indent << "HeaderBytes: " << this->HeaderBytes << "\n";
  os << indent << "NumberOfPoints: " << this->NumberOfPoints << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "NumberOfFilePoints: " << this->NumberOfFilePoints << "\n";
  os << indent << "DrawingTime: " << this->DrawingTime << "\n";
}
