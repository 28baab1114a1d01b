// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNeuralMeshFileSampler
 * @brief   some points of a file that may be larger than the memory
 *
 * vtkNeuralMeshFileSampler is a source: it draws points at random from a binary file where they lie.
 * The file is read once, from front to back, and no more of it is held than a megabyte: memory and
 * output depend on NumberOfPoints alone. vtkNeuralMesh needs no more than 50 points per vertex; its
 * property PointFileName does the same by itself.
 *
 * @par File
 * - `.ply`, binary, of either byte order: the vertices have x, y and z, all float or all double, and
 *   any other properties but lists. What follows them does not matter; lists must not stand before
 *   them.
 * - `.vtp` whose points are appended raw and not compressed, in one piece: vtkXMLPolyDataWriter with
 *   EncodeAppendedDataOff() and SetCompressorTypeToNone() writes such.
 * - Any file of raw x y z, little-endian, behind HeaderBytes bytes of something else: see Format.
 *
 * It is an error, which names the file, if there is none, it cannot be read, is of another kind, is
 * damaged, holds fewer points than it says, or becomes shorter while it is read. A file without
 * points gives an empty output.
 *
 * @par Output
 * vtkPolyData with the points, float or double as they are in the file and in its order, and no
 * cells. Of a file with more than NumberOfPoints points, that many are drawn: one at random of each
 * of so many equal shares of the file, so that each point is as likely as any other. (A point that
 * two shares have in common may be drawn twice.) Of other files all points are taken. Points that are
 * not finite are drawn like others: vtkNeuralMesh counts and drops them. Colours of a .ply, red, green
 * and blue as bytes one behind the other, are the point data `RGB`, and nx, ny and nz of the type of the
 * coordinates the `Normals`, as vtkPLYReader has them. Nothing else is read of the file.
 *
 * The same file and seed give the same bytes. That the file has changed on the disk is not noticed:
 * call Modified().
 *
 * @par Abort
 * SetAbortExecute(1), from an observer of ProgressEvent, say, ends the drawing and leaves the output
 * empty. The flag is cleared when it has been obeyed.
 *
 * A property out of its range is clamped, with a warning.
 *
 * @par What it does not do
 * Text and compressed files, and other formats: read them whole, or write them anew.
 * See Documentation/LargeClouds.md.
 *
 * @sa vtkNeuralMesh vtkPLYReader vtkXMLPolyDataReader
 */

#ifndef vtkNeuralMeshFileSampler_h
#define vtkNeuralMeshFileSampler_h

#include "vtkFiltersNeuralMeshModule.h" // For export macro
#include "vtkNeuralMeshBuiltWith.h"
#include "vtkNeuralMeshSetClampMacro.h"
#include "vtkPolyDataAlgorithm.h"

#include <string>

class VTKFILTERSNEURALMESH_EXPORT vtkNeuralMeshFileSampler : public vtkPolyDataAlgorithm
{
public:
  static vtkNeuralMeshFileSampler* New();
  vtkTypeMacro(vtkNeuralMeshFileSampler, vtkPolyDataAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file. Default none (an empty name, for which null may be given, too), which is an error.
   */
  void SetFileName(VTK_FILEPATH const char* name);
  VTK_FILEPATH const char* GetFileName() const { return this->FileName.c_str(); }
  ///@}

  /** How points may lie in the file, for SetFormat(). */
  enum FormatType
  {
    BY_EXTENSION,
    RAW_FLOAT,
    RAW_DOUBLE
  };

  ///@{
  /**
   * How the points lie in the file. BY_EXTENSION (default): as the header of the .ply or .vtp says.
   * RAW_FLOAT, RAW_DOUBLE: x y z of 4 or of 8 bytes each, little-endian, up to the end of the file.
   */
  vtkNeuralMeshSetClampMacro(Format, int, BY_EXTENSION, RAW_DOUBLE);
  vtkGetMacro(Format, int);
  void SetFormatToByExtension() { this->SetFormat(BY_EXTENSION); }
  void SetFormatToRawFloat() { this->SetFormat(RAW_FLOAT); }
  void SetFormatToRawDouble() { this->SetFormat(RAW_DOUBLE); }
  ///@}

  ///@{
  /**
   * Where raw points begin, in bytes. Default 0, at least 0.
   */
  vtkNeuralMeshSetClampMacro(HeaderBytes, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(HeaderBytes, vtkIdType);
  ///@}

  ///@{
  /**
   * How many points are drawn of a file that has more. Default 1000000, range 1 to 4294967295.
   */
  vtkNeuralMeshSetClampMacro(NumberOfPoints, vtkIdType, 1, VTK_UNSIGNED_INT_MAX);
  vtkGetMacro(NumberOfPoints, vtkIdType);
  ///@}

  ///@{
  /**
   * Seed of the random numbers: which points are drawn. Default 1, at least 0.
   */
  vtkNeuralMeshSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}

  /**
   * How many points the file has; known after the execution.
   */
  vtkIdType GetNumberOfFilePoints() const { return this->NumberOfFilePoints; }

  /**
   * CPU seconds of the process that the last execution took.
   */
  double GetDrawingTime() const { return this->DrawingTime; }

protected:
  vtkNeuralMeshFileSampler();
  ~vtkNeuralMeshFileSampler() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkNeuralMeshFileSampler(const vtkNeuralMeshFileSampler&) = delete;
  void operator=(const vtkNeuralMeshFileSampler&) = delete;

  std::string FileName;
  int Format = BY_EXTENSION;
  vtkIdType HeaderBytes = 0;
  vtkIdType NumberOfPoints = 1000000;
  int Seed = 1;
  vtkIdType NumberOfFilePoints = 0;
  double DrawingTime = 0.0;
};

#endif
