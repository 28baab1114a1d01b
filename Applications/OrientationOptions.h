// SPDX-License-Identifier: BSD-3-Clause
#ifndef OrientationOptions_h
#define OrientationOptions_h

#include <string>
#include <vector>

class vtkNeuralMesh;
class vtkPolyData;
namespace CLI
{
class App;
}

/** What is known of the outer side of the surface: --viewpoint, --views, --view-array, --normals,
 * --up. */
class OrientationOptions
{
public:
  /** Has the command take them. */
  void AddTo(CLI::App* command);

  /** Gives them to the filter. Throws UsageError where a place is none, std::runtime_error if the file of
   * views cannot be read. */
  void Apply(vtkNeuralMesh* filter) const;

  /** Whether any is given. */
  bool AreGiven() const
  {
    return !this->Viewpoints.empty() || !this->ViewFile.empty() || !this->ViewArray.empty() ||
      !this->Normals.empty() || !this->Up.empty();
  }

  /** That of --views; empty: none. */
  const std::string& GetViewFile() const { return this->ViewFile; }

  /** That of --view-array; empty: none. */
  const std::string& GetViewArray() const { return this->ViewArray; }

private:
  std::vector<std::string> Viewpoints;
  std::string ViewFile;
  std::string ViewArray;
  std::string Normals;
  std::string Up;
};

/** The line of the report on the sides of the mesh. */
void PrintSides(vtkPolyData* mesh);

#endif
