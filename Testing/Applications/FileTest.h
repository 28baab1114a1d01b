// SPDX-License-Identifier: BSD-3-Clause
#ifndef FileTest_h
#define FileTest_h

#include "vtkNew.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

class vtkDataObject;

/** A test with a folder of its own, which is gone afterwards. Other processes may run the same test. */
class FileTest : public ::testing::Test
{
protected:
  void SetUp() override
  {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    this->Folder = std::filesystem::temp_directory_path() /
      ("neuralmesh-" + std::string(test->test_suite_name()) + "-" + test->name() + "-" +
        std::to_string(getpid()));
    std::filesystem::remove_all(this->Folder);
    std::filesystem::create_directories(this->Folder);
  }
  void TearDown() override { std::filesystem::remove_all(this->Folder); }

  std::string Path(const std::string& name) const { return (this->Folder / name).string(); }

  /** Writes a file as it is given, and returns its path. */
  std::string WriteText(const std::string& name, const std::string& text) const
  {
    std::ofstream(this->Path(name), std::ios::binary) << text;
    return this->Path(name);
  }

  /** Writes a file with a writer of VTK, made ready by `prepare`, and returns its path. */
  template <typename WriterT, typename PrepareT>
  std::string WriteWith(const std::string& name, vtkDataObject* data, PrepareT prepare) const
  {
    vtkNew<WriterT> writer;
    prepare(writer.Get());
    writer->SetFileName(this->Path(name).c_str());
    writer->SetInputDataObject(data);
    writer->Write();
    return this->Path(name);
  }
  template <typename WriterT>
  std::string WriteWith(const std::string& name, vtkDataObject* data) const
  {
    return this->WriteWith<WriterT>(name, data, [](WriterT*) {});
  }

  std::filesystem::path Folder;
};

#endif
