// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNeuralMeshPLYReader
 * @brief   reads a .ply with all digits of its coordinates, if the file is complete
 *
 * vtkNeuralMeshPLYReader extends vtkPLYReader in two ways: it reads coordinates other than floats, and
 * notices a file that ends early. Large coordinates, as of UTM, keep all digits of a double.
 * vtkPLYReader rounds them to float, which is half a metre there.
 *
 * @par File
 * Text, or binary of either byte order. It is an error, and the output is empty, if the file cannot
 * be opened, is no .ply, or has vertices without x, y or z. So it is if the file has less than its
 * header announces: a line for each element in text, bytes in binary. (A text that is cut within the
 * last number of its last line looks complete.)
 *
 * @par Output
 * vtkPolyData as of vtkPLYReader. The points are of double precision if a coordinate is of the type
 * double, int or uint, else of single precision. Points of double precision are not duplicated at
 * seams of a mesh with textures by face. A file that vtkNeuralMeshWriter has shifted gives the
 * points without the shift, in double precision.
 *
 * @sa vtkNeuralMeshWriter vtkNeuralMeshFileSampler vtkPLYReader
 */

#ifndef vtkNeuralMeshPLYReader_h
#define vtkNeuralMeshPLYReader_h

#include "vtkFiltersNeuralMeshModule.h" // For export macro
#include "vtkNeuralMeshBuiltWith.h"
#include "vtkPolyDataAlgorithm.h"

#include <string>

class VTKFILTERSNEURALMESH_EXPORT vtkNeuralMeshPLYReader : public vtkPolyDataAlgorithm
{
public:
  static vtkNeuralMeshPLYReader* New();
  vtkTypeMacro(vtkNeuralMeshPLYReader, vtkPolyDataAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file. Default none (an empty name, for which null may be given, too), which is an error.
   */
  void SetFileName(VTK_FILEPATH const char* name);
  VTK_FILEPATH const char* GetFileName() const { return this->FileName.c_str(); }
  ///@}

protected:
  vtkNeuralMeshPLYReader();
  ~vtkNeuralMeshPLYReader() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkNeuralMeshPLYReader(const vtkNeuralMeshPLYReader&) = delete;
  void operator=(const vtkNeuralMeshPLYReader&) = delete;

  std::string FileName;
};

#endif
