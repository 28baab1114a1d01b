// SPDX-License-Identifier: BSD-3-Clause
#include "TableWriter.h"

#include "base/AtomicFile.h"
#include "FileExtension.h"

#include "vtkDelimitedTextWriter.h"
#include "vtkNew.h"
#include "vtkTable.h"

#include <memory>
#include <stdexcept>

void RequireTableExtension(const std::string& path)
{
  if (FileExtension(path) != ".csv")
  {
    throw std::runtime_error(path + ": unknown extension; writable is .csv");
  }
}

void WriteTable(vtkTable* table, const std::string& path)
{
  RequireTableExtension(path);
  vtkNew<vtkDelimitedTextWriter> writer;
  writer->WriteToOutputStringOn();
  writer->SetInputData(table);
  writer->Write();
  const std::unique_ptr<char[]> text(writer->RegisterAndGetOutputString());
  neuralmesh::writeAtomicFile(
    path, [&](const std::string& temporary) { neuralmesh::writeText(text.get(), temporary); });
}
