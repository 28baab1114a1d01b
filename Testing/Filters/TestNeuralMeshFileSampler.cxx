// SPDX-License-Identifier: BSD-3-Clause
// Promises: the points of VTK's own files are found, with colours, in the precision of the file; as
// many are drawn as asked for, and the same by the same seed; bad files are errors that name them; an
// abort is obeyed. A mesh from PointFileName has the bytes of one from the file read whole, where all
// points are drawn; it counts bad points; and there is either a file or an input.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"
#include "vtkNeuralMeshEnsemble.h"
#include "vtkNeuralMeshFileSampler.h"
#include "vtkPNeuralMesh.h"

#include "vtkExecutive.h"
#include "vtkPLYReader.h"
#include "vtkPLYWriter.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkXMLPolyDataWriter.h"

#include <cstdio>
#include <fstream>
#include <limits>
#include <sstream>

namespace
{
/** A file of the test, which is gone afterwards. */
class File
{
public:
  explicit File(const std::string& name)
    : Path("TestNeuralMeshFileSampler_" + name)
  {
  }
  ~File() { std::remove(this->Path.c_str()); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  const char* Name() const { return this->Path.c_str(); }

private:
  std::string Path;
};

/** Points on a sphere, red above and blue below. */
vtkNew<vtkPolyData> Cloud(int count = 3000, int type = VTK_FLOAT)
{
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(FilterTesting::SpherePoints(count, 1.0, { 0, 0, 0 }, type));
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("RGB");
  colors->SetNumberOfComponents(3);
  for (int i = 0; i < count; ++i)
  {
    const bool isAbove = cloud->GetPoint(i)[2] > 0.0;
    colors->InsertNextTuple3(isAbove ? 255 : 0, 0, isAbove ? 0 : 255);
  }
  cloud->GetPointData()->SetScalars(colors);
  return cloud;
}

void WritePLY(const File& file, vtkPolyData* cloud, bool isBigEndian = false)
{
  vtkNew<vtkPLYWriter> writer;
  writer->SetFileName(file.Name());
  writer->SetInputData(cloud);
  writer->SetArrayName("RGB");
  isBigEndian ? writer->SetDataByteOrderToBigEndian() : writer->SetDataByteOrderToLittleEndian();
  writer->Write();
}

void WriteVTP(const File& file, vtkPolyData* cloud, bool has64Bits = true)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetFileName(file.Name());
  writer->SetInputData(cloud);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToNone();
  has64Bits ? writer->SetHeaderTypeToUInt64() : writer->SetHeaderTypeToUInt32();
  writer->Write();
}

int CheckFiles()
{
  const auto cloud = Cloud(), doubles = Cloud(3000, VTK_DOUBLE);
  vtkNew<vtkNeuralMeshFileSampler> sampler;
  const File ply("a.ply"), vtp("a.vtp"), raw("a.raw");
  for (const bool isBigEndian : { false, true })
  {
    WritePLY(ply, cloud, isBigEndian);
    sampler->SetFileName(ply.Name());
    sampler->Modified();
    sampler->Update();
    CHECK(sampler->GetNumberOfFilePoints() == 3000);
    CHECK(FilterTesting::SameBytes(
      sampler->GetOutput()->GetPoints()->GetData(), cloud->GetPoints()->GetData()));
    CHECK(FilterTesting::SameBytes(
      sampler->GetOutput()->GetPointData()->GetScalars(), cloud->GetPointData()->GetScalars()));
  }
  for (vtkPolyData* data : { cloud.Get(), doubles.Get() })
  {
    for (const bool has64Bits : { false, true })
    {
      WriteVTP(vtp, data, has64Bits);
      sampler->SetFileName(vtp.Name());
      sampler->Modified();
      sampler->Update();
      CHECK(FilterTesting::SameBytes(
        sampler->GetOutput()->GetPoints()->GetData(), data->GetPoints()->GetData()));
    }
    vtkDataArray* points = data->GetPoints()->GetData();
    std::ofstream(raw.Name(), std::ios::binary)
      << "head"
      << std::string(static_cast<const char*>(points->GetVoidPointer(0)),
           static_cast<std::size_t>(points->GetNumberOfValues()) *
             static_cast<std::size_t>(points->GetDataTypeSize()));
    sampler->SetFileName(raw.Name());
    sampler->SetHeaderBytes(4);
    data == cloud.Get() ? sampler->SetFormatToRawFloat() : sampler->SetFormatToRawDouble();
    sampler->Update();
    CHECK(FilterTesting::SameBytes(sampler->GetOutput()->GetPoints()->GetData(), points));
    sampler->SetFormatToByExtension();
  }
  return EXIT_SUCCESS;
}

int CheckDrawing()
{
  const auto cloud = Cloud(20000);
  const File file("b.ply");
  WritePLY(file, cloud);
  vtkNew<vtkNeuralMeshFileSampler> sampler, again;
  for (vtkNeuralMeshFileSampler* other : { sampler.Get(), again.Get() })
  {
    other->SetFileName(file.Name());
    other->SetNumberOfPoints(700);
    other->Update();
    CHECK(other->GetOutput()->GetNumberOfPoints() == 700);
    CHECK(other->GetNumberOfFilePoints() == 20000);
  }
  vtkDataArray* points = sampler->GetOutput()->GetPoints()->GetData();
  CHECK(FilterTesting::SameBytes(points, again->GetOutput()->GetPoints()->GetData()));
  again->SetSeed(2);
  again->Update();
  CHECK(!FilterTesting::SameBytes(points, again->GetOutput()->GetPoints()->GetData()));
  // Colours are those of their points.
  vtkDataArray* colors = sampler->GetOutput()->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < 700; ++i)
  {
    CHECK(colors->GetComponent(i, 0) == (points->GetComponent(i, 2) > 0.0 ? 255 : 0));
  }
  return EXIT_SUCCESS;
}

int CheckMesh()
{
  const auto cloud = Cloud(5000);
  cloud->GetPoints()->SetPoint(17, 0.0, std::numeric_limits<double>::quiet_NaN(), 0.0);
  const File file("c.ply");
  WritePLY(file, cloud);
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(file.Name());
  vtkNew<vtkNeuralMesh> whole;
  whole->SetInputConnection(reader->GetOutputPort());
  vtkNew<vtkNeuralMesh> inPlace;
  vtkNew<vtkPNeuralMesh> parallel;
  whole->SetNumberOfVertices(300);
  whole->Update();
  for (vtkNeuralMesh* mesh : { inPlace.Get(), static_cast<vtkNeuralMesh*>(parallel.Get()) })
  {
    mesh->SetPointFileName(file.Name());
    mesh->SetNumberOfVertices(300);
    mesh->Update();
    CHECK(mesh->GetOutput()->GetNumberOfPoints() == 300);
    CHECK(FilterTesting::FieldValue(mesh->GetOutput(), "DroppedPoints") == 1.0);
    for (const char* name : { "RGB", "Normals", "Activity" })
    {
      CHECK(FilterTesting::SameBytes(mesh->GetOutput()->GetPointData()->GetArray(name),
        whole->GetOutput()->GetPointData()->GetArray(name)));
    }
    CHECK(FilterTesting::SameBytes(
      mesh->GetOutput()->GetPoints()->GetData(), whole->GetOutput()->GetPoints()->GetData()));
  }
  CHECK(inPlace->GetUsedMaximumPoints() == 1000000);
  inPlace->SetNumberOfVertices(100000);
  CHECK(inPlace->GetUsedMaximumPoints() == 5000000);
  inPlace->SetNumberOfVertices(300);
  inPlace->SetMaximumPoints(2000);
  CHECK(inPlace->GetUsedMaximumPoints() == 2000);
  inPlace->Update();
  CHECK(inPlace->GetOutput()->GetNumberOfPoints() == 300);
  CHECK(!FilterTesting::SameBytes(
    inPlace->GetOutput()->GetPoints()->GetData(), whole->GetOutput()->GetPoints()->GetData()));

  // The same points, drawn by the source.
  vtkNew<vtkNeuralMeshFileSampler> sampler;
  sampler->SetFileName(file.Name());
  sampler->SetNumberOfPoints(2000);
  whole->SetInputConnection(sampler->GetOutputPort());
  whole->Update();
  CHECK(FilterTesting::SameBytes(
    inPlace->GetOutput()->GetPoints()->GetData(), whole->GetOutput()->GetPoints()->GetData()));

  vtkNew<vtkNeuralMeshEnsemble> ensemble;
  ensemble->SetPointFileName(file.Name());
  ensemble->SetNumberOfVertices(300);
  ensemble->SetNumberOfMembers(1);
  ensemble->SetVerticesPerMember(100);
  ensemble->Update();
  CHECK(ensemble->GetOutput()->GetNumberOfPoints() == 300);
  return EXIT_SUCCESS;
}

int CheckErrors()
{
  vtkNew<vtkNeuralMeshFileSampler> sampler;
  vtkNew<FilterTesting::MessageCounter> messages;
  messages->Observe(sampler);
  messages->Observe(sampler->GetExecutive());
  sampler->Update();
  CHECK(messages->AllText.find("no FileName") != std::string::npos);
  const File file("d.ply");
  std::ofstream(file.Name()) << "no ply";
  for (const char* name : { "missing.ply", file.Name() })
  {
    messages->AllText.clear();
    sampler->SetFileName(name);
    sampler->Update();
    CHECK(messages->AllText.find(name) != std::string::npos);
    CHECK(sampler->GetOutput()->GetNumberOfPoints() == 0);
    CHECK(sampler->GetNumberOfFilePoints() == 0);
  }

  vtkNew<vtkNeuralMesh> mesh;
  messages->Observe(mesh);
  messages->Observe(mesh->GetExecutive());
  messages->AllText.clear();
  mesh->Update();
  CHECK(messages->AllText.find("neither an input nor a PointFileName") != std::string::npos);
  messages->AllText.clear();
  mesh->SetPointFileName(file.Name());
  mesh->Update();
  CHECK(
    messages->AllText.find(std::string(file.Name()) + ": this is no .ply") != std::string::npos);
  mesh->SetInputData(Cloud());
  mesh->Update();
  CHECK(messages->AllText.find("both an input and a PointFileName") != std::string::npos);
  CHECK(mesh->GetOutput()->GetNumberOfPoints() == 0);

  // No points are no error.
  messages->Errors = 0;
  std::ofstream(file.Name(), std::ios::binary)
    << "ply\nformat binary_little_endian 1.0\nelement vertex 0\nproperty float x\n"
       "property float y\nproperty float z\nend_header\n";
  mesh->SetInputData(nullptr);
  mesh->RemoveAllInputConnections(0);
  mesh->Update();
  sampler->SetFileName(file.Name());
  sampler->Modified();
  sampler->Update();
  CHECK(messages->Errors == 0);
  CHECK(mesh->GetOutput()->GetNumberOfPoints() == 0);
  CHECK(sampler->GetOutput()->GetNumberOfPoints() == 0);
  return EXIT_SUCCESS;
}

/** Aborts the run at the first progress, once. */
class Aborter : public vtkCommand
{
public:
  static Aborter* New() { return new Aborter; }
  void Execute(vtkObject* caller, unsigned long, void*) override
  {
    if (this->Armed)
    {
      this->Armed = false;
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
    }
  }
  bool Armed = true;
};

int CheckAbort()
{
  const File file("e.ply");
  WritePLY(file, Cloud(20000));
  vtkNew<vtkNeuralMeshFileSampler> sampler;
  vtkNew<Aborter> aborter;
  sampler->AddObserver(vtkCommand::ProgressEvent, aborter);
  sampler->SetFileName(file.Name());
  sampler->Update();
  CHECK(!aborter->Armed && sampler->GetOutput()->GetNumberOfPoints() == 0);
  sampler->Modified();
  sampler->Update();
  CHECK(sampler->GetOutput()->GetNumberOfPoints() == 20000);
  return EXIT_SUCCESS;
}

int CheckProperties()
{
  vtkNew<vtkNeuralMeshFileSampler> sampler;
  vtkNew<FilterTesting::MessageCounter> messages;
  messages->Observe(sampler);
  sampler->SetNumberOfPoints(0);
  sampler->SetSeed(-1);
  sampler->SetFormat(3);
  sampler->SetHeaderBytes(-1);
  CHECK(messages->Warnings == 4);
  CHECK(sampler->GetNumberOfPoints() == 1 && sampler->GetSeed() == 0);
  CHECK(sampler->GetFormat() == vtkNeuralMeshFileSampler::RAW_DOUBLE);
  CHECK(sampler->GetHeaderBytes() == 0);
  std::ostringstream text;
  sampler->Print(text);
  for (const char* property : { "FileName: ", "Format: 2", "HeaderBytes: 0", "NumberOfPoints: 1",
         "Seed: 0", "NumberOfFilePoints: 0", "DrawingTime: 0" })
  {
    CHECK(text.str().find(property) != std::string::npos);
  }
  return EXIT_SUCCESS;
}
}

int TestNeuralMeshFileSampler(int, char*[])
{
  CHECK(CheckFiles() == EXIT_SUCCESS);
  CHECK(CheckDrawing() == EXIT_SUCCESS);
  CHECK(CheckMesh() == EXIT_SUCCESS);
  CHECK(CheckErrors() == EXIT_SUCCESS);
  CHECK(CheckAbort() == EXIT_SUCCESS);
  CHECK(CheckProperties() == EXIT_SUCCESS);
  return EXIT_SUCCESS;
}
